/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@: derivatives of the accelerations by complex steps. A
 * coordinate moved by i h moves an acceleration by i h times the derivative, and nothing is
 * subtracted: it is exact to rounding. Compilers spare much by -fcx-limited-range. */
#define @NAME@_COMPLEX
#include "@name@.c"
