# Linked as $<BUILD_INTERFACE:cdcr_warnings>, so consumers never inherit our warning flags.
add_library(cdcr_warnings INTERFACE)
target_compile_options(
  cdcr_warnings
  INTERFACE
    -Wall
    -Wextra
    -Wpedantic
    -Wshadow
    -Wredundant-decls
    -Wconversion
    -Wno-sign-conversion
    $<$<BOOL:${CDCR_WARNINGS_AS_ERRORS}>:-Werror>
    # With -mavx GCC 12 warns of wide reads of Eigen's small vectors, in branches not taken.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>
)
