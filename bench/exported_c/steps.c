/* Steps of an exported robot of three sections, as many as the argument says, or as often the
 * derivatives of its accelerations. */
#include <stdlib.h>

#include "arm.h"

int main(int count, char** arguments) {
  arm_real q[ARM_COORDINATES] = {0.5f, 0.1f, 0.3f, -0.2f, 0.1f, 0.4f}, qd[ARM_COORDINATES] = {0};
  const arm_real tension[ARM_CABLES] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int steps = count > 1 ? atoi(arguments[1]) : 0;
  for (int i = 0; i < steps; ++i) {
#ifdef DERIVATIVES
    static arm_real on[(2 * ARM_COORDINATES + ARM_CABLES) * ARM_COORDINATES];
    arm_real* const on_qd = on + ARM_COORDINATES * ARM_COORDINATES;
    arm_real* const on_command = on_qd + ARM_COORDINATES * ARM_COORDINATES;
    if (arm_derivatives(q, qd, tension, on, on_qd, on_command) != 0) return 1;
    q[0] += on[0] > 0 ? 1e-6f : -1e-6f;
#else
    if (arm_step(q, qd, tension, (arm_real)1e-3) != 0) return 1;
#endif
  }
  return 0;
}
