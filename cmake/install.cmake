# What an install prefix gets besides the libraries and their headers: the CMake package, files for
# pkg-config, the licences.
include(CMakePackageConfigHelpers)
if(CDCR_WITH_CVODE)
  string(REGEX MATCH "^[0-9]+" sundials_end ${SUNDIALS_VERSION})
  math(EXPR sundials_end "${sundials_end} + 1") # the interface of SUNDIALS ends there
endif()
# Each has targets and a file for pkg-config of its own.
set(components "")
if(CDCR_WITH_CVODE)
  list(APPEND components cvode)
endif()
if(CDCR_WITH_TOML)
  list(APPEND components toml)
endif()
if(CDCR_BUILD_C)
  list(APPEND components c)
endif()
list(JOIN components " " package_components)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cdcr)
set(build_dir ${PROJECT_BINARY_DIR}/cmake)

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/cdcr-config.cmake.in
  ${build_dir}/cdcr-config.cmake
  INSTALL_DESTINATION ${config_dir}
)
write_basic_package_version_file(
  ${build_dir}/cdcr-config-version.cmake
  COMPATIBILITY SameMinorVersion
)
set(
  package_files
  ${build_dir}/cdcr-config.cmake
  ${build_dir}/cdcr-config-version.cmake
)

# Relative to where the file lies, so that the prefix can be moved; a folder for libraries that is
# absolute lies in no prefix, and does not move.
cmake_path(APPEND CMAKE_INSTALL_LIBDIR pkgconfig OUTPUT_VARIABLE pc_dir)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH pc_prefix "/prefix/${pc_dir}" /prefix)
  string(PREPEND pc_prefix "\${pcfiledir}/")
endif()
cmake_path(APPEND pc_libdir "\${prefix}" ${CMAKE_INSTALL_LIBDIR})
cmake_path(APPEND pc_includedir "\${prefix}" ${CMAKE_INSTALL_INCLUDEDIR})
set(pc_flags "")
if(BUILD_SHARED_LIBS)
  set(pc_flags -DCDCR_SHARED)
endif()
if(CDCR_EIGEN_ALIGN)
  string(
    APPEND pc_flags
    " -DEIGEN_MAX_ALIGN_BYTES=${CDCR_EIGEN_ALIGN} -DEIGEN_MALLOC_ALREADY_ALIGNED=0"
  )
endif()
configure_file(
  ${PROJECT_SOURCE_DIR}/cmake/cdcr.pc.in
  ${build_dir}/cdcr.pc
  @ONLY
)
set(pc_files ${build_dir}/cdcr.pc)

if(CDCR_WITH_CVODE)
  list(APPEND package_files ${PROJECT_SOURCE_DIR}/cmake/FindSUNDIALS.cmake)
  # Only a static library leaves it to the program to link SUNDIALS.
  set(pc_sundials "")
  if(NOT BUILD_SHARED_LIBS)
    set(
      pc_sundials
      ${SUNDIALS_CVODES_LIBRARY}
      ${SUNDIALS_CORE_LIBRARY}
      ${MPI_CXX_LIBRARIES}
    )
    list(JOIN pc_sundials " " pc_sundials)
  endif()
endif()

foreach(component IN LISTS components)
  install(
    TARGETS cdcr_${component}
    EXPORT cdcr-${component}-targets
    COMPONENT cpp
    FILE_SET HEADERS COMPONENT cpp
  )
  install(
    EXPORT cdcr-${component}-targets
    NAMESPACE cdcr::
    DESTINATION ${config_dir}
    COMPONENT cpp
  )
  configure_file(
    ${PROJECT_SOURCE_DIR}/cmake/cdcr-${component}.pc.in
    ${build_dir}/cdcr-${component}.pc
    @ONLY
  )
  list(APPEND pc_files ${build_dir}/cdcr-${component}.pc)
endforeach()

install(
  TARGETS cdcr
  EXPORT cdcr-targets
  COMPONENT cpp
  FILE_SET HEADERS COMPONENT cpp
)
install(
  EXPORT cdcr-targets
  NAMESPACE cdcr::
  DESTINATION ${config_dir}
  COMPONENT cpp
)
# CMake 3.25 writes the prefix before an absolute folder of headers: it is taken away again.
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  cmake_path(APPEND installed_config "\${CMAKE_INSTALL_PREFIX}" ${config_dir})
  install(
    CODE
      "
      file(GLOB exports \"\$ENV{DESTDIR}${installed_config}/cdcr*-targets.cmake\")
      foreach(export IN LISTS exports)
        file(READ \"\${export}\" text)
        string(REPLACE [[\"\${_IMPORT_PREFIX}//]] [[\"/]] text \"\${text}\")
        file(WRITE \"\${export}\" \"\${text}\")
      endforeach()"
    COMPONENT cpp
  )
endif()
install(FILES ${package_files} DESTINATION ${config_dir} COMPONENT cpp)
install(FILES ${pc_files} DESTINATION ${pc_dir} COMPONENT cpp)
install(
  FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT cpp
)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/licenses
  DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT cpp
)
