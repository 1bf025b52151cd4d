# Parses headers that most sources of a target read once for all of them. The sources include what
# they need all the same; preset tidy, and whoever embeds cdcr, compile them without this.
function(cdcr_precompile target)
  if(CDCR_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
