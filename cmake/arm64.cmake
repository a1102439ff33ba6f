# Cross build for arm64 on Debian:
# cmake -B build-arm64 --toolchain cmake/arm64.cmake
# FLOWGRAIN_SYSROOT in the environment names a folder of unpacked arm64 packages: all is
# built, and tests run under qemu. Without it headers are this machine's, none of which is
# particular to its processor, and only objects can be built (.ci/run does).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
if(DEFINED ENV{FLOWGRAIN_SYSROOT})
  set(CMAKE_SYSROOT $ENV{FLOWGRAIN_SYSROOT})
  set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
  set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L ${CMAKE_SYSROOT})
  set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
  set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
  set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
  set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
  set(ENV{PKG_CONFIG_LIBDIR}
    ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)
else()
  # after the compiler's own, so that libc's are of arm64
  # (libjpeg has one in the folder of this machine's processor, the same on arm64)
  execute_process(COMMAND gcc -print-multiarch OUTPUT_VARIABLE here
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(CMAKE_C_FLAGS_INIT "-idirafter /usr/include -idirafter /usr/include/${here}")
endif()
