/* A loop at 1 kHz in C: a robot is brought to rest at the shape
 * that 5 N on cable 1 would hold, by a damping that its cables add. */
#include <cdcr.h>
#include <stdio.h>
#include <stdlib.h>

static void demand(cdcr_status status) {
  if (status == CDCR_OK) return;
  fprintf(stderr, "%s\n", status < 0 ? cdcr_last_error() : cdcr_message(status));
  exit(1);
}

int main(int argc, char** argv) {
  /* Set up: may allocate. */
  cdcr_model* model = NULL;
  demand(cdcr_model_load(argc > 1 ? argv[1] : "robot.toml", &model));
  if (cdcr_num_coordinates(model) != 2 || cdcr_num_cables(model) != 3) return 1;

  const double pull[3] = {5.0, 0.0, 0.0};
  double rest[2], zero[2] = {0.0, 0.0};
  demand(cdcr_equilibrium(model, pull, NULL, rest, NULL));

  cdcr_simulator* robot = NULL;
  demand(cdcr_simulator_create(model, 1e-3, 1, &robot));
  demand(cdcr_simulator_reset(robot, zero, zero, 0.0));

  /* Run: no allocation, no exception. */
  double time = 0.0, q[2], qd[2];
  for (int period = 0; period < 3000; ++period) {
    demand(cdcr_simulator_state(robot, q, qd, &time));
    const double damped = 5.0 - 1.5 * qd[0];
    const double tension[3] = {damped > 0.0 ? damped : 0.0, 0.0, 0.0};
    demand(cdcr_simulator_step(robot, tension));
  }
  demand(cdcr_simulator_state(robot, q, qd, &time));
  printf("after %.0f s: theta = %.4f rad, at rest %.4f rad\n", time, q[0], rest[0]);

  cdcr_workspace* workspace = NULL;
  double tip[3], rotation[9];
  demand(cdcr_workspace_create(model, &workspace));
  demand(cdcr_tip_pose(workspace, q, tip, rotation));
  printf("tip at %.4f m beside and %.4f m above the base\n", tip[0], tip[2]);

  cdcr_workspace_free(workspace);
  cdcr_simulator_free(robot);
  cdcr_model_free(model);
  return 0;
}
