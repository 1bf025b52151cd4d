# A missing dependency is an error that names the Debian package; nothing is ever downloaded.
find_package(Eigen3 3.4 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)
  message(
    FATAL_ERROR
    "cdcr needs Eigen 3.4 or newer. On Debian or Ubuntu:\n"
    "  apt-get install libeigen3-dev"
  )
endif()

if(CDCR_WITH_CVODE)
  find_package(SUNDIALS 6.4 QUIET COMPONENTS cvodes)
  if(NOT SUNDIALS_FOUND OR NOT TARGET SUNDIALS::cvodes_static)
    message(
      FATAL_ERROR
      "cdcr::cvode needs SUNDIALS 6.4 with static CVODES. On Debian or Ubuntu:\n"
      "  apt-get install libsundials-dev\n"
      "Without it, -DCDCR_WITH_CVODE=OFF builds cdcr::cdcr alone."
    )
  endif()
endif()

if(CDCR_BUILD_PYTHON)
  if(NOT CDCR_WITH_CVODE)
    message(FATAL_ERROR "The Python extension needs CDCR_WITH_CVODE=ON.")
  endif()
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
