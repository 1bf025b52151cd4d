# What an install prefix gets besides the libraries and their headers: the CMake package, files for
# pkg-config, the licences.
include(CMakePackageConfigHelpers)
if(CDCR_WITH_CVODE)
  string(REGEX MATCH "^[0-9]+" sundials_end ${SUNDIALS_VERSION})
  math(EXPR sundials_end "${sundials_end} + 1") # the interface of SUNDIALS ends there
endif()
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

# Relative to where the file lies, so that the prefix can be moved.
cmake_path(APPEND CMAKE_INSTALL_LIBDIR pkgconfig OUTPUT_VARIABLE pc_dir)
cmake_path(
  ABSOLUTE_PATH pc_dir
  BASE_DIRECTORY /prefix
  OUTPUT_VARIABLE pc_dir_in_prefix
)
file(RELATIVE_PATH pc_prefix ${pc_dir_in_prefix} /prefix)
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
  install(
    TARGETS cdcr_cvode
    EXPORT cdcr-cvode-targets
    COMPONENT cpp
    FILE_SET HEADERS COMPONENT cpp
  )
  install(
    EXPORT cdcr-cvode-targets
    NAMESPACE cdcr::
    DESTINATION ${config_dir}
    COMPONENT cpp
  )
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
  configure_file(
    ${PROJECT_SOURCE_DIR}/cmake/cdcr-cvode.pc.in
    ${build_dir}/cdcr-cvode.pc
    @ONLY
  )
  list(APPEND pc_files ${build_dir}/cdcr-cvode.pc)
endif()

# Components with nothing to ask for, each with targets and a file for pkg-config of its own.
set(components "")
if(CDCR_WITH_TOML)
  list(APPEND components toml)
endif()
if(CDCR_BUILD_C)
  list(APPEND components c)
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
