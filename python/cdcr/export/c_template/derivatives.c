/* i h and its h, by the way in which C lays complex numbers out. */
typedef union {
  number parts[2];
  real number;
} pair;

static const pair STEP = {{0, (number)(sizeof(number) < sizeof(double) ? 1e-13 : 1e-20)}};

static number slope(real found) {
  pair both;
  both.number = found;
  return both.parts[1] / STEP.parts[1];
}

enum { STATES = 2 * COORDINATES, INPUTS = STATES + CABLES };

static void gather(const number q[], const number qd[], const number command[], real at[]) {
  int k;
  for (k = 0; k < COORDINATES; ++k) {
    at[k] = q[k];
    at[COORDINATES + k] = qd[k];
  }
  for (k = 0; k < CABLES; ++k) at[STATES + k] = command[k];
}

int @name@_derivatives(const @name@_real q[], const @name@_real qd[], const @name@_real command[],
                       @name@_real on_q[], @name@_real on_qd[], @name@_real on_command[]) {
  real at[INPUTS + 1], force[COORDINATES], qdd[COORDINATES];
  int column, k;
  gather(q, qd, command, at);
  for (column = 0; column < INPUTS; ++column) {
    const real before = at[column];
    number* to = column < COORDINATES ? on_q + column * COORDINATES
                 : column < STATES    ? on_qd + (column - COORDINATES) * COORDINATES
                                      : on_command + (column - STATES) * COORDINATES;
    at[column] = before + STEP.number;
    cable_force(at, at + COORDINATES, at + STATES, force);
    if (accelerate(at, at + COORDINATES, force, qdd) != 0) return @NAME@_BEYOND;
    for (k = 0; k < COORDINATES; ++k) to[k] = slope(qdd[k]);
    at[column] = before;
  }
  return 0;
}

int @name@_step_derivatives(const @name@_real q[], const @name@_real qd[], const @name@_real command[],
                            @name@_real step, int steps, @name@_real next[], @name@_real on[]) {
  real at[INPUTS + 1], sum[STATES];
  int column, i, k;
  for (column = 0; column <= INPUTS; ++column) { /* the last is the step's */
    gather(q, qd, command, at);
    at[INPUTS] = step;
    at[column] += STEP.number;
    for (i = 0; i < steps; ++i) {
      if (runge_kutta(at, at + COORDINATES, at + STATES, at[INPUTS], sum, sum + COORDINATES) != 0) {
        return @NAME@_BEYOND;
      }
      for (k = 0; k < STATES; ++k) at[k] += sum[k];
    }
    for (k = 0; k < STATES; ++k) on[column * STATES + k] = slope(at[k]);
  }
  for (k = 0; k < STATES; ++k) next[k] = (number)at[k];
  return 0;
}
