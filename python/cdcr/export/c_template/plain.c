/* Adds the force of a cable with a tension at the base, Q = B F. */
static void pull(int j, const real q[], const real qd[], real tension, real force[]) {
  int k;
  (void)q, (void)qd;
  for (k = 0; k < COORDINATES; ++k) force[k] += ACTUATION[j][k] * tension;
}
