# The library flowgrain_core: a field in memory to clusters, icons, labels, placed arrows
# and scores. Without MPI and threads it needs nothing but a C compiler and libm.
add_library(flowgrain_core ${core_objects})
if(FLOWGRAIN_FILES)
  set_target_properties(flowgrain_core PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
# by names, which an installed static library hands to its users
target_link_libraries(flowgrain_core PRIVATE m ${CMAKE_THREAD_LIBS_INIT} ${MPI_LINK_LIBRARIES})
target_include_directories(flowgrain_core PUBLIC
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
add_executable(example_core EXCLUDE_FROM_ALL examples/core.c)
target_link_libraries(example_core PRIVATE flowgrain_core m)
# The core for browsers: viewer/README.md.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
  add_executable(flowgrain_wasm EXCLUDE_FROM_ALL viewer/core/shim.c)
  target_link_libraries(flowgrain_wasm PRIVATE flowgrain_settings flowgrain_core m)
  set_source_files_properties(viewer/core/shim.c PROPERTIES
    COMPILE_OPTIONS -Wno-missing-prototypes) # JavaScript calls them by name
  target_link_options(flowgrain_wasm PRIVATE -mexec-model=reactor LINKER:--strip-all)
  set_target_properties(flowgrain_wasm PROPERTIES OUTPUT_NAME flowgrain)
endif()
