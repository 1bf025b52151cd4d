/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@. C99: no heap, no library, no state between calls, so that
 * any number of threads and interrupts may call it at once.
 *
 * q, qd, qdd: bending vectors of the sections, base to tip [rad], their rates and accelerations.
 * command: of each cable, section by section and then those of the robot, its tension [N], or its
 * length [m] where it is driven by length.
 * Functions that return an int give 0, or @NAME@_BEYOND and write nothing where a section is bent by
 * more than @NAME@_MAX_BENDING or a number is none.
 */
#ifndef @NAME@_H
#define @NAME@_H

#ifndef @NAME@_REAL
#define @NAME@_REAL double /* or float: -D@NAME@_REAL=float for all that includes this */
#endif
typedef @NAME@_REAL @name@_real;

#define @NAME@_SECTIONS @sections@
#define @NAME@_COORDINATES @coordinates@
#define @NAME@_CABLES @cables@
#define @NAME@_MAX_BENDING @max_bending@ /* [rad] */
#define @NAME@_BEYOND 1

#ifdef __cplusplus
extern "C" {
#endif

/* Accelerations under commands. */
int @name@_forward_dynamics(const @name@_real q[], const @name@_real qd[],
                            const @name@_real command[], @name@_real qdd[]);

/* Their derivatives, exact to rounding: on_q and on_qd (d, d), on_command (d, cables), each column
 * after the other. In @name@_derivatives.c, which only who calls this compiles; a column costs
 * some four accelerations. Where it fails it may have written some columns. */
int @name@_derivatives(const @name@_real q[], const @name@_real qd[], const @name@_real command[],
                       @name@_real on_q[], @name@_real on_qd[], @name@_real on_command[]);

/* One step of Runge-Kutta 4, commands held: (q, qd) becomes what it is `step` seconds later. */
int @name@_step(@name@_real q[], @name@_real qd[], const @name@_real command[], @name@_real step);

/* As many such steps, commands held, with their derivatives by the same file: the state (q, qd) after
 * them, and its derivatives (2 d, 2 d + cables + 1) by q, qd, command and step, each column after the
 * other. */
int @name@_step_derivatives(const @name@_real q[], const @name@_real qd[], const @name@_real command[],
                            @name@_real step, int steps, @name@_real next[], @name@_real on[]);

/* Lengths of the cables inside the robot [m]. */
void @name@_cable_lengths(const @name@_real q[], @name@_real lengths[]);

/* Where the tool is, or the tip where there is none, in the base frame: position [m], and rotation
 * by rows. */
int @name@_tip(const @name@_real q[], @name@_real position[3], @name@_real rotation[9]);

#ifdef __cplusplus
}
#endif

#endif
