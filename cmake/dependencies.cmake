# A missing dependency is an error that names the Debian package; nothing is ever downloaded.
find_package(Eigen3 3.4 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)
  message(
    FATAL_ERROR
    "cdcr needs Eigen 3.4 or newer. On Debian or Ubuntu:\n"
    "  apt-get install libeigen3-dev"
  )
endif()

find_package(Threads REQUIRED)

# From here on CDCR_WITH_CVODE is ON or OFF.
if(CDCR_WITH_CVODE)
  set(SUNDIALS_NOT_FOUND_MESSAGE "find_package is told not to look")
  list(APPEND CMAKE_MODULE_PATH "${PROJECT_SOURCE_DIR}/cmake")
  find_package(SUNDIALS 6.4...<8 QUIET MODULE)
  string(
    CONCAT how_to_get_it
    "It needs CVODES of SUNDIALS 6.4 to 7, static or shared; "
    "found: ${SUNDIALS_NOT_FOUND_MESSAGE}. On Debian or Ubuntu:\n"
    "  apt-get install libsundials-dev\n"
  )
  if(SUNDIALS_FOUND)
    set(CDCR_WITH_CVODE ON)
  elseif(CDCR_WITH_CVODE STREQUAL AUTO)
    message(
      STATUS
      "cdcr is built without CVODE (methods bdf and adams). ${how_to_get_it}"
    )
    set(CDCR_WITH_CVODE OFF)
  else()
    message(
      FATAL_ERROR
      "cdcr::cvode cannot be built. ${how_to_get_it}"
      "Without it, -DCDCR_WITH_CVODE=OFF builds everything but methods bdf and adams."
    )
  endif()
endif()

# From here on CDCR_WITH_TOML is ON or OFF. The headers alone are taken: nothing is linked.
if(CDCR_WITH_TOML)
  find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h)
  mark_as_advanced(TOMLPLUSPLUS_INCLUDE_DIR)
  if(TOMLPLUSPLUS_INCLUDE_DIR)
    set(CDCR_WITH_TOML ON)
  elseif(CDCR_WITH_TOML STREQUAL AUTO)
    message(
      STATUS
      "cdcr is built without cdcr::toml (robot files in C++). It needs toml++. "
      "On Debian or Ubuntu:\n"
      "  apt-get install libtomlplusplus-dev\n"
    )
    set(CDCR_WITH_TOML OFF)
  else()
    message(
      FATAL_ERROR
      "cdcr::toml cannot be built, since it needs toml++. On Debian or Ubuntu:\n"
      "  apt-get install libtomlplusplus-dev\n"
      "Without it, -DCDCR_WITH_TOML=OFF builds everything but robot files in C++."
    )
  endif()
endif()

if(CDCR_BUILD_PYTHON)
  find_package(Python 3.10 QUIET COMPONENTS Interpreter Development.Module)
  if(NOT Python_FOUND)
    message(
      FATAL_ERROR
      "The Python extension needs Python 3.10 or newer with its header files. "
      "On Debian or Ubuntu:\n"
      "  apt-get install python3-dev"
    )
  endif()
endif()
