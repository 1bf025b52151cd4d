#ifndef @NAME@_COMPLEX

int @name@_forward_dynamics(const real q[], const real qd[], const real command[], real qdd[]) {
  real force[COORDINATES], found[COORDINATES];
  int k;
  cable_force(q, qd, command, force);
  if (accelerate(q, qd, force, found) != 0) return @NAME@_BEYOND;
  for (k = 0; k < COORDINATES; ++k) qdd[k] = found[k];
  return 0;
}

int @name@_step(real q[], real qd[], const real command[], real step) {
  /* Where each stage is looked at, and its share of the step. */
  static const real at[4] = {0, (real)0.5, (real)0.5, 1}, share[4] = {1, 2, 2, 1};
  real q_k[COORDINATES], qd_k[COORDINATES], qdd[COORDINATES], force[COORDINATES];
  real q_sum[COORDINATES], qd_sum[COORDINATES];
  int stage, k;
  for (k = 0; k < COORDINATES; ++k) q_sum[k] = qd_sum[k] = qd_k[k] = qdd[k] = 0;
  for (stage = 0; stage < 4; ++stage) {
    const real h = at[stage] * step, weight = share[stage] * step / 6;
    for (k = 0; k < COORDINATES; ++k) {
      q_k[k] = q[k] + h * qd_k[k];
      qd_k[k] = qd[k] + h * qdd[k];
    }
    cable_force(q_k, qd_k, command, force);
    if (accelerate(q_k, qd_k, force, qdd) != 0) return @NAME@_BEYOND;
    for (k = 0; k < COORDINATES; ++k) {
      q_sum[k] += weight * qd_k[k];
      qd_sum[k] += weight * qdd[k];
    }
  }
  for (k = 0; k < SECTIONS; ++k) { /* the state after the step is one of the model too */
    const real x = q[2 * k] + q_sum[2 * k], y = q[2 * k + 1] + q_sum[2 * k + 1];
    if (!(x * x + y * y <= LARGEST_SIGMA)) return @NAME@_BEYOND;
  }
  for (k = 0; k < COORDINATES; ++k) {
    q[k] += q_sum[k];
    qd[k] += qd_sum[k];
  }
  return 0;
}

void @name@_cable_lengths(const real q[], real lengths[]) {
  int j, k;
  for (j = 0; j < CABLES; ++j) {
    lengths[j] = STRAIGHT[j];
    for (k = 0; k < COORDINATES; ++k) lengths[j] -= ACTUATION[j][k] * q[k];
  }
}

int @name@_tip(const real q[], real position[3], real rotation[9]) {
  section s;
  frame base = root();
  vec p = constant(BASE_POSITION), x, y, z;
  int i;
  for (i = 0; i < SECTIONS; ++i) {
    if (place(i, q, &base, &s) != 0) return @NAME@_BEYOND;
    p = sum(p, s.r);
  }
  p = sum(p, rotated(&base, constant(TOOL_POSITION)));
  x = rotated(&base, constant(TOOL[0]));
  y = rotated(&base, constant(TOOL[1]));
  z = rotated(&base, constant(TOOL[2]));
  position[0] = p.x, position[1] = p.y, position[2] = p.z;
  rotation[0] = x.x, rotation[1] = y.x, rotation[2] = z.x;
  rotation[3] = x.y, rotation[4] = y.y, rotation[5] = z.y;
  rotation[6] = x.z, rotation[7] = y.z, rotation[8] = z.z;
  return 0;
}

#endif
