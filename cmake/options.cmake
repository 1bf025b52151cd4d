# A value that an option cannot have is refused: CMake itself would take maybe for ON.
foreach(option IN ITEMS CDCR_WITH_CVODE CDCR_WITH_TOML)
  string(TOUPPER "${${option}}" value)
  if(value MATCHES "^(ON|YES|TRUE|Y|1)$")
    set(${option} ON)
  elseif(value MATCHES "^(OFF|NO|FALSE|N|0)$")
    set(${option} OFF)
  elseif(value STREQUAL "AUTO")
    set(${option} AUTO)
  else()
    message(
      FATAL_ERROR
      "${option} is \"${${option}}\": it must be ON, OFF or AUTO."
    )
  endif()
endforeach()

# Those of the registers that Eigen knows.
if(NOT CDCR_EIGEN_ALIGN MATCHES "^(|16|32|64)$")
  message(
    FATAL_ERROR
    "CDCR_EIGEN_ALIGN is \"${CDCR_EIGEN_ALIGN}\": it must be 16, 32 or 64, or empty."
  )
endif()
