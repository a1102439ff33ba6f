# The library flowgrain_core: a field in memory to clusters, icons, labels, placed arrows
# and scores. Without MPI and threads it needs nothing but a C compiler and libm.
add_library(flowgrain_core ${core_objects})
target_link_libraries(flowgrain_core PRIVATE m)
if(FLOWGRAIN_THREADS)
  target_link_libraries(flowgrain_core PRIVATE Threads::Threads)
endif()
if(FLOWGRAIN_MPI)
  target_link_libraries(flowgrain_core PRIVATE PkgConfig::MPI)
endif()
target_include_directories(flowgrain_core PUBLIC
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
add_executable(example_core EXCLUDE_FROM_ALL examples/core.c)
target_link_libraries(example_core PRIVATE flowgrain_core m)
