/* Steps of an exported robot of three sections, as many as the argument says. */
#include <stdlib.h>

#include "arm.h"

int main(int count, char** arguments) {
  arm_real q[ARM_COORDINATES] = {0.5f, 0.1f, 0.3f, -0.2f, 0.1f, 0.4f}, qd[ARM_COORDINATES] = {0};
  const arm_real tension[ARM_CABLES] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int steps = count > 1 ? atoi(arguments[1]) : 0;
  for (int i = 0; i < steps; ++i) {
    if (arm_step(q, qd, tension, (arm_real)1e-3) != 0) return 1;
  }
  return 0;
}
