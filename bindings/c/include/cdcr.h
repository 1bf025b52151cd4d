/* cdcr from C, and from what calls C: Rust, MATLAB, Simulink, acados, LabVIEW.
 *
 * Every function returns a code, 0 (CDCR_OK) where all went well; no exception leaves the library
 * and nothing is printed. What is asked for goes into the caller's arrays, which it writes only
 * with CDCR_OK, but for those of cdcr_equilibrium.
 *
 * d = cdcr_num_coordinates, c = cdcr_num_cables. SI units and radians.
 *   q, qd, qdd  coordinates, their rates and accelerations (d): of a section of constant curvature
 *               its bending vector; of rods see cpp/rods.md
 *   command     of each cable (c): its tension [N], or its length [m] where it is driven by length
 * Matrices are stored by columns, as BLAS, MATLAB, CasADi and acados have them.
 *
 * Functions marked "real-time safe" allocate nothing, lock nothing and take bounded time.
 *
 * Threads: a model never changes, so any number of threads may use one. A workspace and a simulator
 * have a state: one for each thread. cdcr_last_error is of the thread that calls it.
 */
#ifndef CDCR_H
#define CDCR_H

#if defined(__GNUC__)
#define CDCR_C_API __attribute__((visibility("default")))
#else
#define CDCR_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cdcr_model cdcr_model;         /* a robot, ready for computing */
typedef struct cdcr_workspace cdcr_workspace; /* a model and room to compute in */
typedef struct cdcr_simulator cdcr_simulator; /* a robot in motion, period by period */

/* How a call ended. Those above 0 are of cdcr/status.hpp, in its order. */
typedef enum cdcr_status {
  CDCR_OK = 0,
  CDCR_NOT_STARTED,
  CDCR_STEP_LIMIT,
  CDCR_STEP_TOO_SMALL,
  CDCR_TOLERANCE_NOT_MET,
  CDCR_NON_FINITE_STATE,
  CDCR_BENDING_LIMIT,
  CDCR_INVALID_TENSION,
  CDCR_NOT_CONVERGED,
  CDCR_INTERRUPTED,
  CDCR_EVENT,
  CDCR_WRONG_SIZE,
  CDCR_INVALID_WRENCH,
  CDCR_COMPRESSION_LIMIT,
  CDCR_INVALID_ARGUMENT = -1, /* cdcr_last_error says what and why */
  CDCR_OUT_OF_MEMORY = -2,
  CDCR_FAILED = -3 /* something else that cdcr_last_error tells */
} cdcr_status;

/* One sentence about a code; empty for CDCR_OK. Real-time safe. */
CDCR_C_API const char* cdcr_message(cdcr_status status);
/* Why the last call of this thread that ended with a code below 0 did so, a sentence a line; valid
 * until the next such call. */
CDCR_C_API const char* cdcr_last_error(void);
/* Such as "0.1.0". */
CDCR_C_API const char* cdcr_version(void);

/* The robot of a robot file, or of the text of one. To be freed; freeing NULL does nothing. */
CDCR_C_API cdcr_status cdcr_model_load(const char* path, cdcr_model** model);
CDCR_C_API cdcr_status cdcr_model_from_toml(const char* text, cdcr_model** model);
CDCR_C_API void cdcr_model_free(cdcr_model* model);

/* Sizes; 0 of NULL. Real-time safe. */
CDCR_C_API int cdcr_num_sections(const cdcr_model* model);
CDCR_C_API int cdcr_num_coordinates(const cdcr_model* model);
CDCR_C_API int cdcr_num_cables(const cdcr_model* model);

/* Where the robot rests under commands held. Allocates, and takes as long as it takes.
 * start (d): where to look first, or NULL. q (d): the rest, or with CDCR_NOT_CONVERGED the nearest
 * to one. stable: 1 where the robot stays there, else 0; or NULL. */
CDCR_C_API cdcr_status cdcr_equilibrium(const cdcr_model* model, const double* command,
                                        const double* start, double* q, int* stable);

/* Room to compute in. It keeps a model of its own, so the one given may be freed. */
CDCR_C_API cdcr_status cdcr_workspace_create(const cdcr_model* model, cdcr_workspace** workspace);
CDCR_C_API void cdcr_workspace_free(cdcr_workspace* workspace);

/* What follows is real-time safe. Where an input is not finite or a section is bent beyond 3 pi, it
 * ends with CDCR_NON_FINITE_STATE, CDCR_BENDING_LIMIT or CDCR_COMPRESSION_LIMIT. */

/* qdd (d): accelerations under commands. */
CDCR_C_API cdcr_status cdcr_forward_dynamics(cdcr_workspace* workspace, const double* q,
                                             const double* qd, const double* command, double* qdd);
/* force (d): the generalised force that produces accelerations. */
CDCR_C_API cdcr_status cdcr_inverse_dynamics(cdcr_workspace* workspace, const double* q,
                                             const double* qd, const double* qdd, double* force);
/* Exact derivatives of the accelerations: on_q, on_qd (d, d), on_command (d, c). */
CDCR_C_API cdcr_status cdcr_derivatives(cdcr_workspace* workspace, const double* q,
                                        const double* qd, const double* command, double* on_q,
                                        double* on_qd, double* on_command);
/* mass (d, d). */
CDCR_C_API cdcr_status cdcr_mass_matrix(cdcr_workspace* workspace, const double* q, double* mass);
/* lengths (c): of the cables inside the robot [m]. */
CDCR_C_API cdcr_status cdcr_cable_lengths(cdcr_workspace* workspace, const double* q,
                                          double* lengths);
/* position (3) [m] and rotation (3, 3) of the tool, or of the tip where there is none, in the base
 * frame. */
CDCR_C_API cdcr_status cdcr_tip_pose(cdcr_workspace* workspace, const double* q, double* position,
                                     double* rotation);

/* A robot that moves by periods of `period` seconds, each of `substeps` steps of Runge-Kutta 4. It
 * keeps a model of its own. */
CDCR_C_API cdcr_status cdcr_simulator_create(const cdcr_model* model, double period, int substeps,
                                             cdcr_simulator** simulator);
CDCR_C_API void cdcr_simulator_free(cdcr_simulator* simulator);
/* Sets state (d each) and time [s]. May allocate. */
CDCR_C_API cdcr_status cdcr_simulator_reset(cdcr_simulator* simulator, const double* q,
                                            const double* qd, double time);
/* One period under commands held; on failure the state before stays. Real-time safe. */
CDCR_C_API cdcr_status cdcr_simulator_step(cdcr_simulator* simulator, const double* command);
/* State and time [s]; what is NULL is left out. Real-time safe. */
CDCR_C_API cdcr_status cdcr_simulator_state(const cdcr_simulator* simulator, double* q, double* qd,
                                            double* time);

#ifdef __cplusplus
}
#endif

#endif
