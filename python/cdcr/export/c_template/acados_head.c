/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@: the robot as discrete dynamics of acados, in the form of
 * its external_function_param_generic, all in this file. Of x = (q, qd) and u = command: where they are
 * an interval later, u held, by @steps@ of Runge-Kutta 4, and the derivatives of that.
 *
 *   model.dyn_ext_fun_type = "generic"
 *   model.dyn_generic_source = "@name@_acados.c"
 *   model.dyn_disc_fun = "@name@_next"
 *   model.dyn_disc_fun_jac = "@name@_next_jac"
 *
 * with the integrator DISCRETE, shooting intervals of @interval@ s and a Gauss-Newton Hessian. What is
 * beyond the model is not a number. */
#include "acados/utils/external_function_generic.h"
#include "blasfeo_d_aux.h"

#define @NAME@_COMPLEX
