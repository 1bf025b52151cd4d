/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@: derivatives of the accelerations by complex steps. A
 * coordinate moved by i h moves an acceleration by i h times the derivative, and nothing is
 * subtracted: it is exact to rounding. Compilers spare much by -fcx-limited-range. */
#define @NAME@_COMPLEX
#include "@name@.c"

int @name@_derivatives(const @name@_real q[], const @name@_real qd[], const @name@_real command[],
                       @name@_real on_q[], @name@_real on_qd[], @name@_real on_command[]) {
  const number h = (number)(sizeof(number) < sizeof(double) ? 1e-10 : 1e-20);
  const union { /* i h, by the way in which C lays complex numbers out */
    number parts[2];
    real number;
  } step = {{0, h}};
  real at[2 * COORDINATES + CABLES + 1], force[COORDINATES], qdd[COORDINATES];
  real *const x = at, *const xd = at + COORDINATES, *const f = at + 2 * COORDINATES;
  int column, k;
  for (k = 0; k < COORDINATES; ++k) {
    x[k] = q[k];
    xd[k] = qd[k];
  }
  for (k = 0; k < CABLES; ++k) f[k] = command[k];
  for (column = 0; column < 2 * COORDINATES + CABLES; ++column) {
    const real before = at[column];
    number* to = column < COORDINATES       ? on_q + column * COORDINATES
                      : column < 2 * COORDINATES ? on_qd + (column - COORDINATES) * COORDINATES
                                                 : on_command + (column - 2 * COORDINATES) * COORDINATES;
    at[column] = before + step.number;
    cable_force(x, xd, f, force);
    if (accelerate(x, xd, force, qdd) != 0) return @NAME@_BEYOND;
    for (k = 0; k < COORDINATES; ++k) {
      union {
        real number;
        number parts[2];
      } found;
      found.number = qdd[k];
      to[k] = found.parts[1] / h;
    }
    at[column] = before;
  }
  return 0;
}
