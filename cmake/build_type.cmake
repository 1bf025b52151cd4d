# Without optimisation cdcr is 200 times slower, and no build type means none: then it is Release.
# A project that embeds cdcr chooses for itself, and is told.
get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
string(TOUPPER "${CMAKE_BUILD_TYPE}" cdcr_build_type)
if(NOT is_multi_config AND NOT CMAKE_BUILD_TYPE AND PROJECT_IS_TOP_LEVEL)
  message(STATUS "cdcr: no CMAKE_BUILD_TYPE was given, so it is Release")
  set(
    CMAKE_BUILD_TYPE
    Release
    CACHE STRING
    "Debug, Release, RelWithDebInfo or MinSizeRel"
    FORCE
  )
elseif(NOT is_multi_config AND cdcr_build_type MATCHES "^(NONE)?$")
  # None is for packages of distributions, whose flags are all in CMAKE_CXX_FLAGS.
  if(
    NOT
      "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${cdcr_build_type}}"
        MATCHES
        "-O([1-3sgz]|fast)"
  )
    message(
      WARNING
      "cdcr is compiled without optimisation, which makes it 200 times slower: "
      "-DCMAKE_BUILD_TYPE=Release has its flags, or CMAKE_CXX_FLAGS may, such as -O2."
    )
  endif()
elseif(NOT is_multi_config AND PROJECT_IS_TOP_LEVEL)
  # A type that CMake does not know has no flags, unless they are given with it.
  if(
    NOT cdcr_build_type MATCHES "^(DEBUG|RELEASE|RELWITHDEBINFO|MINSIZEREL)$"
    AND "${CMAKE_CXX_FLAGS_${cdcr_build_type}}" STREQUAL ""
  )
    message(
      FATAL_ERROR
      "CMAKE_BUILD_TYPE is \"${CMAKE_BUILD_TYPE}\": it must be Debug, Release, RelWithDebInfo, "
      "MinSizeRel or None, or a type whose flags CMAKE_CXX_FLAGS_${cdcr_build_type} are given."
    )
  endif()
endif()
