# install_library(LIBRARY): the library, its headers, and what pkg-config and CMake find it
# by. MPI is required for the header flowgrain/mpi.h, and by a static library.
function(install_library library)
  include(CMakePackageConfigHelpers)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/flowgrain)
  install(TARGETS ${library} EXPORT flowgrain)
  set(without "")
  if(NOT FLOWGRAIN_MPI)
    set(without PATTERN mpi.h EXCLUDE)
  endif()
  install(DIRECTORY include/flowgrain DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING ${without} PATTERN "*.h")
  install(EXPORT flowgrain NAMESPACE flowgrain:: FILE flowgrain-targets.cmake
    DESTINATION ${package_dir})
  configure_package_config_file(cmake/flowgrain-config.cmake.in
    ${PROJECT_BINARY_DIR}/flowgrain-config.cmake INSTALL_DESTINATION ${package_dir}
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/flowgrain-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/flowgrain-config.cmake
    ${PROJECT_BINARY_DIR}/flowgrain-config-version.cmake DESTINATION ${package_dir})
  list(JOIN features_here " " features_words)
  string(TOLOWER "${features_words}" features_words)
  set(pc_libraries -l${library})
  set(pc_requires "")
  get_target_property(type ${library} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    string(STRIP "${pc_libraries} -lm ${CMAKE_THREAD_LIBS_INIT}" pc_libraries)
  endif()
  if(FLOWGRAIN_MPI AND type STREQUAL STATIC_LIBRARY)
    set(pc_requires "\nRequires: ${MPI_MODULE_NAME}")
  elseif(FLOWGRAIN_MPI)
    set(pc_requires "\nRequires.private: ${MPI_MODULE_NAME}")
  endif()
  # found from where the file lies, so that what is installed can be moved
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
  if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    file(RELATIVE_PATH up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
    string(REGEX REPLACE "/$" "" pc_prefix "\${pcfiledir}/${up}")
  endif()
  foreach(dir libdir includedir)
    string(TOUPPER CMAKE_INSTALL_${dir} variable)
    set(pc_${dir} "\${prefix}/${${variable}}")
    if(IS_ABSOLUTE "${${variable}}")
      set(pc_${dir} ${${variable}})
    endif()
  endforeach()
  configure_file(cmake/flowgrain.pc.in ${PROJECT_BINARY_DIR}/flowgrain.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/flowgrain.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
