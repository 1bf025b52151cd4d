#pragma once

// What the headers here declare is what a shared library of cdcr exports, whatever the program's
// and the library's flags hide. The CMake targets and cdcr.pc define CDCR_SHARED where it is one.
#ifdef CDCR_SHARED
#define CDCR_EXPORT [[gnu::visibility("default")]]
#else
#define CDCR_EXPORT
#endif
