/* Square root of a number from 0 to some hundred, by Newton's method; next to nothing below 1e-30. The
 * last round, on `real`, makes its derivative of that of `a`. */
static real square_root(real a) {
  number near = (number)a, scale = 1, root;
  int k;
  if (!(near > N(1e-30))) return 0;
  for (; near < N(0.25); near *= 4) scale /= 2;
  for (; near > 1; near /= 4) scale *= 2;
  root = N(0.35) + N(0.68) * near; /* within 4 per cent */
  for (k = 0; k < 4; ++k) root = (root + near / root) / 2;
  root *= scale;
  return (root + a / root) / 2;
}

/* e^-z, (1 - e^-z)/z, and of weights e^-zx on [0, 1] the shift of the centre from 1/2 towards 0,
 * coth(z/2)/2 - 1/z: by their series at z/128, |z| up to 40, and by doubling. Nothing cancels. */
typedef struct {
  real all, mean, shift;
} decay;

enum { DOUBLINGS = 7 };

static decay decays(real z) {
  const real w = z / (1 << DOUBLINGS), ww = w * w;
  decay d;
  real t;
  int k;
  d.mean = 1;
  for (k = 12; k > 1; --k) d.mean = 1 - d.mean * w / (number)k;
  d.all = 1 - w * d.mean;
  d.shift = w * (1 - ww * (1 - ww * (1 - ww / 40) / 42) / 60) / 12;
  t = w * d.mean / (1 + d.all); /* tanh(w/2) */
  for (k = 0; k < DOUBLINGS; ++k) {
    d.mean *= (1 + d.all) / 2;
    d.all *= d.all;
    d.shift = t / 4 + d.shift / 2;
    t = 2 * t / (1 + t * t);
  }
  return d;
}

static real hyperbolic_tangent(real x) {
  const int back = (number)x < 0;
  decay d;
  real t;
  if (back) x = -x;
  if ((number)x > 20) x = 20;
  d = decays(2 * x);
  t = 2 * x * d.mean / (1 + d.all);
  return back ? -t : t;
}

static real larger(real a, real b) {
  return (number)a < (number)b ? b : a;
}
static real smaller(real a, real b) {
  return (number)b < (number)a ? b : a;
}

/* Tension that is left within the entry of a cable pulled in at a speed, (105) in cpp/friction.md. */
static real entered(int j, real tension, real speed) {
  const real way = hyperbolic_tangent(speed / SLIDING_SPEED);
  tension -= ENTRY[j] * way;
  if ((number)tension < 0) return 0;
  tension = tension * decays(SHEATH[j] * way).all - VISCOSITY[j] * speed;
  return (number)tension > 0 ? tension : 0;
}

/* Adds the force of a cable with a tension at the base, which falls from section to section by the
 * friction in its holes, (37) to (39). */
static void pull(int j, const real q[], const real qd[], real tension, real force[]) {
  real beyond = 0; /* rate of the length from here to the cable's end */
  int i, k;
  for (k = 0; k < 2 * SECTIONS_OF[j]; ++k) beyond -= ACTUATION[j][k] * qd[k];
  if (ENTRY[j] > 0 || SHEATH[j] > 0 || VISCOSITY[j] > 0) tension = entered(j, tension, -beyond);
  for (i = 0; i < SECTIONS_OF[j]; ++i) {
    const number x = ACTUATION[j][2 * i], y = ACTUATION[j][2 * i + 1];
    const real rate = -(x * qd[2 * i] + y * qd[2 * i + 1]);
    const real turn = FRICTION[j][i] * square_root(q[2 * i] * q[2 * i] + q[2 * i + 1] * q[2 * i + 1]);
    real felt = tension;
    if ((number)turn > 0) {
      const real middle = beyond - rate / 2, shift = rate * decays(turn).shift;
      const real forward = middle + shift, backward = middle - shift;
      const real speed = smaller(larger(middle, forward), 0) + larger(smaller(middle, backward), 0);
      const decay along = decays(turn * hyperbolic_tangent(-speed / SLIDING_SPEED));
      felt *= along.mean;
      tension *= along.all;
    }
    force[2 * i] += x * felt;
    force[2 * i + 1] += y * felt;
    beyond -= rate;
  }
}
