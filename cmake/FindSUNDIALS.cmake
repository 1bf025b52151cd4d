# CVODES of SUNDIALS 6.4 to 7, static where there is a static one: target cdcr::sundials.
#
# By header and libraries, since the CMake package of SUNDIALS asks for everything that SUNDIALS
# was built with (MPI, OpenMP, PETSc), of which CVODES uses nothing. Where it is not found,
# SUNDIALS_NOT_FOUND_MESSAGE says why. SUNDIALS_ROOT, SUNDIALS_DIR and CMAKE_PREFIX_PATH are heard.
unset(SUNDIALS_VERSION)
set(SUNDIALS_NOT_FOUND_MESSAGE "no header cvodes/cvodes.h")

set(hint "")
if(SUNDIALS_DIR)
  cmake_path(SET hint NORMALIZE "${SUNDIALS_DIR}/../../..") # PREFIX/lib/cmake/sundials
endif()
find_path(
  SUNDIALS_INCLUDE_DIR
  cvodes/cvodes.h
  HINTS "${hint}"
  PATH_SUFFIXES include
)
cmake_path(GET SUNDIALS_INCLUDE_DIR PARENT_PATH prefix)
find_library(
  SUNDIALS_CVODES_LIBRARY
  NAMES libsundials_cvodes.a sundials_cvodes
  NAMES_PER_DIR
  HINTS "${prefix}"
  PATH_SUFFIXES lib lib64
)
set(libraries SUNDIALS_CVODES_LIBRARY)
mark_as_advanced(SUNDIALS_INCLUDE_DIR SUNDIALS_CVODES_LIBRARY)

set(config "")
if(EXISTS "${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h")
  file(READ "${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h" config)
endif()
if(config MATCHES "#define SUNDIALS_VERSION \"([0-9.]+)")
  set(SUNDIALS_VERSION ${CMAKE_MATCH_1})
endif()

# From 7 on there is a library under the others, and where SUNDIALS was built with MPI its headers
# include mpi.h.
set(mpi "")
if(SUNDIALS_VERSION VERSION_GREATER_EQUAL 7)
  cmake_path(GET SUNDIALS_CVODES_LIBRARY PARENT_PATH folder)
  find_library(
    SUNDIALS_CORE_LIBRARY
    NAMES libsundials_core.a sundials_core
    NAMES_PER_DIR
    HINTS "${folder}"
  )
  mark_as_advanced(SUNDIALS_CORE_LIBRARY)
  list(APPEND libraries SUNDIALS_CORE_LIBRARY)
  if(config MATCHES "#define SUNDIALS_MPI_ENABLED 1")
    find_package(MPI QUIET COMPONENTS CXX)
    set(mpi MPI_CXX_FOUND)
  endif()
endif()

if(SUNDIALS_INCLUDE_DIR)
  set(
    SUNDIALS_NOT_FOUND_MESSAGE
    "SUNDIALS ${SUNDIALS_VERSION} in ${SUNDIALS_INCLUDE_DIR}"
  )
  foreach(needed IN LISTS libraries mpi)
    if(NOT ${needed})
      string(APPEND SUNDIALS_NOT_FOUND_MESSAGE ", without ${needed}")
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  SUNDIALS
  REQUIRED_VARS SUNDIALS_INCLUDE_DIR ${libraries} ${mpi}
  VERSION_VAR SUNDIALS_VERSION
  HANDLE_VERSION_RANGE
)

if(SUNDIALS_FOUND AND NOT TARGET cdcr::sundials)
  add_library(cdcr::sundials INTERFACE IMPORTED)
  target_include_directories(
    cdcr::sundials
    SYSTEM
    INTERFACE "${SUNDIALS_INCLUDE_DIR}"
  )
  foreach(library IN LISTS libraries)
    target_link_libraries(cdcr::sundials INTERFACE "${${library}}")
  endforeach()
  if(mpi)
    target_link_libraries(cdcr::sundials INTERFACE MPI::MPI_CXX)
  endif()
endif()
