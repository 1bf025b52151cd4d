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
  real q_sum[COORDINATES], qd_sum[COORDINATES];
  int k;
  if (runge_kutta(q, qd, command, step, q_sum, qd_sum) != 0) return @NAME@_BEYOND;
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
