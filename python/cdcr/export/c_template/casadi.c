/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@: functions as CasADi calls them, with their Jacobians.
 *
 *   @name@_ode(x, u) -> xdot          x: q and qd one above the other; u: command
 *   @name@_advance(x, u, h) -> next   one step of Runge-Kutta 4 of h seconds, u held
 *
 *   cc -O2 -fcx-limited-range -shared -fPIC @name@.c @name@_derivatives.c @name@_casadi.c -o lib@name@.so
 *   f = casadi.external("@name@_ode", "./lib@name@.so")
 *
 * What is beyond the model is not a number. Where integers of CasADi are ints, as in acados:
 * -Dcasadi_int=int. */
#include "@name@.h"

#ifndef casadi_int
#define casadi_int long long
#endif

#ifdef _WIN32
#define SEEN __declspec(dllexport)
#else
#define SEEN
#endif

enum { COORDINATES = @NAME@_COORDINATES, STATES = 2 * COORDINATES, CABLES = @NAME@_CABLES };
enum { ODE_COLUMNS = STATES + CABLES, COLUMNS = ODE_COLUMNS + 1 };

/* CasADi has doubles. */
typedef char numbers_are_doubles[sizeof(@name@_real) == sizeof(double) ? 1 : -1];

/* Inputs that are not given are zero; results that nobody wants have no place. */
static void take(const double* from, int size, double to[]) {
  int k;
  for (k = 0; k < size; ++k) to[k] = from ? from[k] : 0;
}
static void give(const double from[], int size, double* to) {
  int k;
  for (k = 0; to && k < size; ++k) to[k] = from[k];
}

static void none(double values[], int size) {
  volatile double zero = 0;
  int k;
  for (k = 0; k < size; ++k) values[k] = zero / zero;
}

SEEN int @name@_ode(const double** arg, double** res, casadi_int* iw, double* w, int mem) {
  double x[STATES], u[CABLES + 1], xdot[STATES];
  (void)iw, (void)w, (void)mem;
  take(arg[0], STATES, x);
  take(arg[1], CABLES, u);
  take(x + COORDINATES, COORDINATES, xdot);
  if (@name@_forward_dynamics(x, x + COORDINATES, u, xdot + COORDINATES) != 0) none(xdot, STATES);
  give(xdot, STATES, res[0]);
  return 0;
}

SEEN int jac_@name@_ode(const double** arg, double** res, casadi_int* iw, double* w, int mem) {
  double x[STATES], u[CABLES + 1], slopes[ODE_COLUMNS * COORDINATES], whole[ODE_COLUMNS * STATES];
  int column, k;
  (void)iw, (void)w, (void)mem;
  take(arg[0], STATES, x);
  take(arg[1], CABLES, u);
  if (@name@_derivatives(x, x + COORDINATES, u, slopes, slopes + COORDINATES * COORDINATES,
                         slopes + STATES * COORDINATES) != 0) {
    none(slopes, ODE_COLUMNS * COORDINATES);
  }
  for (column = 0; column < ODE_COLUMNS; ++column) {
    double* to = whole + column * STATES;
    for (k = 0; k < COORDINATES; ++k) {
      to[k] = column == COORDINATES + k; /* the rate of q is qd */
      to[COORDINATES + k] = slopes[column * COORDINATES + k];
    }
  }
  give(whole, STATES * STATES, res[0]);
  give(whole + STATES * STATES, CABLES * STATES, res[1]);
  return 0;
}

SEEN int @name@_advance(const double** arg, double** res, casadi_int* iw, double* w, int mem) {
  double x[STATES], u[CABLES + 1], h;
  (void)iw, (void)w, (void)mem;
  take(arg[0], STATES, x);
  take(arg[1], CABLES, u);
  take(arg[2], 1, &h);
  if (@name@_step(x, x + COORDINATES, u, h) != 0) none(x, STATES);
  give(x, STATES, res[0]);
  return 0;
}

SEEN int jac_@name@_advance(const double** arg, double** res, casadi_int* iw, double* w, int mem) {
  double x[STATES], u[CABLES + 1], h, next[STATES], on[COLUMNS * STATES];
  (void)iw, (void)w, (void)mem;
  take(arg[0], STATES, x);
  take(arg[1], CABLES, u);
  take(arg[2], 1, &h);
  if (@name@_step_derivatives(x, x + COORDINATES, u, h, 1, next, on) != 0) {
    none(on, COLUMNS * STATES);
  }
  give(on, STATES * STATES, res[0]);
  give(on + STATES * STATES, CABLES * STATES, res[1]);
  give(on + ODE_COLUMNS * STATES, STATES, res[2]);
  return 0;
}

/* Dense matrices: rows, columns, 1. */
static const casadi_int X[] = {STATES, 1, 1}, U[] = {CABLES, 1, 1}, H[] = {1, 1, 1},
                        ON_X[] = {STATES, STATES, 1}, ON_U[] = {STATES, CABLES, 1};

#define NO ((const casadi_int*)0)

#define DESCRIBED(name, inputs, outputs, in_0, in_1, in_2, in_3, out_0, out_1, out_2) \
  SEEN casadi_int name##_n_in(void) {                                                 \
    return inputs;                                                                    \
  }                                                                                   \
  SEEN casadi_int name##_n_out(void) {                                                \
    return outputs;                                                                   \
  }                                                                                   \
  SEEN const casadi_int* name##_sparsity_in(casadi_int i) {                           \
    return i == 0 ? in_0 : i == 1 ? in_1 : i == 2 ? in_2 : i == 3 ? in_3 : NO;        \
  }                                                                                   \
  SEEN const casadi_int* name##_sparsity_out(casadi_int i) {                          \
    return i == 0 ? out_0 : i == 1 ? out_1 : i == 2 ? out_2 : NO;                     \
  }                                                                                   \
  SEEN int name##_work(casadi_int* args, casadi_int* results, casadi_int* integers,   \
                       casadi_int* numbers) {                                         \
    if (args) *args = inputs;                                                         \
    if (results) *results = outputs;                                                  \
    if (integers) *integers = 0;                                                      \
    if (numbers) *numbers = 0;                                                        \
    return 0;                                                                         \
  }

DESCRIBED(@name@_ode, 2, 1, X, U, NO, NO, X, NO, NO)
DESCRIBED(jac_@name@_ode, 3, 2, X, U, X, NO, ON_X, ON_U, NO)
DESCRIBED(@name@_advance, 3, 1, X, U, H, NO, X, NO, NO)
DESCRIBED(jac_@name@_advance, 4, 3, X, U, H, X, ON_X, ON_U, X)
