# Cross build of flowgrain_core for WebAssembly (WASI, vectors of 128 bits, one thread).
# Debian: clang-14 lld-14 llvm-14 wasi-libc libclang-rt-14-dev-wasm32
# cmake -B build-wasm --toolchain cmake/wasm32.cmake -DFLOWGRAIN_FILES=OFF \
#   -DFLOWGRAIN_MPI=OFF -DFLOWGRAIN_THREADS=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-14)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-14)
set(CMAKE_RANLIB llvm-ranlib-14)
set(CMAKE_EXECUTABLE_SUFFIX_C .wasm)
set(CMAKE_C_FLAGS_INIT -msimd128)
set(CMAKE_C_FLAGS_RELEASE_INIT "-O3 -DNDEBUG")
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,-z,stack-size=1048576)
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
