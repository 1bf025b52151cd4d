enum { INTERVAL_STEPS = @step_count@ };
static const number INTERVAL_STEP = N(@interval@) / INTERVAL_STEPS; /* [s] */

static number none(void) {
  volatile number zero = 0;
  return zero / zero;
}

/* x and u of acados, one above the other. */
static void read_inputs(void** in, number at[]) {
  const struct blasfeo_dvec_args *x = in[0], *u = in[1];
  int k;
  for (k = 0; k < STATES; ++k) at[k] = blasfeo_dvecex1(x->x, x->xi + k);
  for (k = 0; k < CABLES; ++k) at[STATES + k] = blasfeo_dvecex1(u->x, u->xi + k);
}

static void write_next(void** out, const number next[]) {
  const struct blasfeo_dvec_args* to = out[0];
  int k;
  for (k = 0; k < STATES; ++k) blasfeo_dvecin1(next[k], to->x, to->xi + k);
}

int @name@_next(void** in, void** out, void* parameters) {
  number given[INPUTS + 1], next[STATES];
  real at[INPUTS + 1], sum[STATES];
  int i, k, beyond = 0;
  (void)parameters;
  read_inputs(in, given);
  gather(given, given + COORDINATES, given + STATES, at);
  for (i = 0; i < INTERVAL_STEPS && !beyond; ++i) {
    beyond = runge_kutta(at, at + COORDINATES, at + STATES, INTERVAL_STEP, sum, sum + COORDINATES);
    for (k = 0; k < STATES && !beyond; ++k) at[k] += sum[k];
  }
  for (k = 0; k < STATES; ++k) next[k] = beyond ? none() : (number)at[k];
  write_next(out, next);
  return beyond;
}

/* The Jacobian transposed, rows of u above those of x. */
int @name@_next_jac(void** in, void** out, void* parameters) {
  const struct blasfeo_dmat_args* to = out[1];
  number given[INPUTS + 1], next[STATES], on[(INPUTS + 1) * STATES];
  int column, k, beyond;
  (void)parameters;
  read_inputs(in, given);
  beyond = @name@_step_derivatives(given, given + COORDINATES, given + STATES, INTERVAL_STEP,
                                   INTERVAL_STEPS, next, on);
  for (column = 0; column < INPUTS; ++column) {
    const int row = column < STATES ? CABLES + column : column - STATES;
    for (k = 0; k < STATES; ++k) {
      blasfeo_dgein1(beyond ? none() : on[column * STATES + k], to->A, to->ai + row, to->aj + k);
    }
  }
  for (k = 0; k < STATES && beyond; ++k) next[k] = none();
  write_next(out, next);
  return beyond;
}
