/* One section in one state. */
typedef struct {
  vec x, y, z;             /* axes of its base */
  vec q, n, r;             /* bending vector, z x q, from base to tip */
  vec turn[2], move[2];    /* J_omega and J_v of (25) */
  vec turning, moving;     /* accelerations of the tip from velocities alone, (29) */
  vec moment, force;       /* inertia forces from velocities alone, (30) */
  real bias[2];
  real sigma, t;
  int piece;
  real arc[ARC_FUNCTIONS], f[FUNCTIONS];
  /* Eliminated, (31): force and moment that an acceleration of q needs, D^-1 (xx, xy, yy), D^-1 b. */
  vec pull[2], twist[2];
  real inverse[3], u[2];
} section;

/* Axes of a base, and how fast it turns. */
typedef struct {
  vec x, y, z, omega;
} frame;

static frame root(void) {
  frame base;
  base.x = constant(ROOT[0]);
  base.y = constant(ROOT[1]);
  base.z = constant(ROOT[2]);
  base.omega = scaled(0, base.x);
  return base;
}

/* (23) to (25); the axes of `base` become those of the tip. */
static int place(int i, const real q[], frame* base, section* s) {
  const real x = q[2 * i], y = q[2 * i + 1], l = LENGTH[i];
  const real* arc = s->arc;
  vec g, dr, pull;
  s->sigma = x * x + y * y;
  s->piece = find(s->sigma, &s->t);
  if (s->piece < 0) return @NAME@_BEYOND;
  read(&ARCS[0][0][0], ARC_FUNCTIONS, s->piece, s->t, s->arc);
  s->x = base->x;
  s->y = base->y;
  s->z = base->z;
  s->q = plus(scaled(x, s->x), y, s->y);
  s->n = plus(scaled(x, s->y), -y, s->x);
  s->r = scaled(l, plus(scaled(arc[ARC_A], s->q), arc[ARC_S], s->z));
  g = plus(scaled(arc[ARC_A], s->z), arc[ARC_G], s->q);
  dr = scaled(2 * l, plus(scaled(arc[ARC_DA], s->q), arc[ARC_DS], s->z));
  s->turn[0] = plus(s->y, -y, g);
  s->turn[1] = plus(scaled(x, g), -1, s->x);
  s->move[0] = plus(scaled(l * arc[ARC_A], s->x), x, dr);
  s->move[1] = plus(scaled(l * arc[ARC_A], s->y), y, dr);
  pull = plus(scaled(arc[ARC_S], s->z), arc[ARC_A], s->q);
  base->x = plus(s->x, -x, pull);
  base->y = plus(s->y, -y, pull);
  base->z = plus(scaled(1 - s->sigma * arc[ARC_A], s->z), arc[ARC_S], s->q);
  return 0;
}

/* (29), (30), after place(); omega of `base` becomes that of the tip. The first base does not turn,
 * and nobody asks for the force on it. */
static void move(int i, const real q[], const real qd[], frame* base, section* s) {
  const real x = q[2 * i], y = q[2 * i + 1], xd = qd[2 * i], yd = qd[2 * i + 1];
  const real l = LENGTH[i];
  const real *arc = s->arc, *f = s->f;
  const vec omega = base->omega, rate = plus(scaled(xd, s->x), yd, s->y);
  const real p = x * xd + y * yd, w = xd * xd + yd * yd, c = x * yd - y * xd, pp4 = 4 * p * p;
  const vec turning = plus(scaled(xd, s->turn[0]), yd, s->turn[1]);
  const vec moving = plus(scaled(xd, s->move[0]), yd, s->move[1]);
  real on_qd, on_q;
  read(&SHAPES[SHAPE_OF[i]][0][0][0], FUNCTIONS, s->piece, s->t, s->f);
  on_qd = 2 * p * f[D_A] + DAMPING[i];
  on_q = f[D_B] * p * p + (f[IN_B] - f[D_A]) * w + STIFFNESS[i];
  s->turning = scaled(c, plus(scaled(2 * p, plus(scaled(arc[ARC_DA], s->z), arc[ARC_DG], s->q)),
                              arc[ARC_G], rate));
  s->moving = scaled(l, plus(plus(scaled(4 * p * arc[ARC_DA], rate),
                                  2 * w * arc[ARC_DA] + pp4 * arc[ARC_DDA], s->q),
                             2 * w * arc[ARC_DS] + pp4 * arc[ARC_DDS], s->z));
  if (i > 0) {
    const vec q_ = s->q, z = s->z;
    const real o_q = dot(omega, q_), o_z = dot(omega, z), o_qd = dot(omega, rate);
    const real j_q = f[C1] * o_q + f[C2] * o_z, j_z = f[C2] * o_q + f[C3] * o_z;
    const vec h = plus(scaled(f[H1], q_), f[H0], z);
    const vec dh = scaled(2, plus(scaled(f[DH1], q_), f[DH0], z));
    const vec h_rate = plus(scaled(f[H1], rate), p, dh);
    const vec n_rate = plus(scaled(xd, s->y), -yd, s->x);
    const vec momentum =
        plus(plus(plus(plus(scaled(f[C0], omega), j_q + c * f[K1], q_), j_z + c * f[K2], z), f[K0],
                  n_rate),
             -p * f[K3], s->n);
    const real gyro = f[SPIN_Q] * o_q + f[SPIN_Z] * o_z;
    s->turning = sum(s->turning, cross(omega, turning));
    s->moving = sum(s->moving, cross(omega, plus(cross(omega, s->r), 2, moving)));
    s->force = sum(cross(omega, plus(cross(omega, h), 2, h_rate)),
                   plus(plus(scaled(4 * p * f[DH1], rate), w, dh), pp4,
                        plus(scaled(f[DDH1], q_), f[DDH0], z)));
    s->moment = plus(cross(omega, momentum), 2 * p * f[DC0], omega);
    s->moment = plus(s->moment, 2 * p * (f[DC1] * o_q + f[DC2] * o_z + c * f[DK1]) + f[C1] * o_qd, q_);
    s->moment = plus(s->moment, 2 * p * (f[DC2] * o_q + f[DC3] * o_z + c * f[DK2]) + f[C2] * o_qd, z);
    s->moment = plus(s->moment, j_q + c * f[K1], rate);
    s->moment = plus(s->moment, 2 * p * f[DK0] - p * f[K3], n_rate);
    s->moment = plus(s->moment, -(2 * p * p * f[DK3] + w * f[K3]), s->n);
    on_q -= f[DC0] * dot(omega, omega) + f[DC1] * o_q * o_q + 2 * f[DC2] * o_q * o_z +
            f[DC3] * o_z * o_z;
    s->bias[0] = on_qd * xd + on_q * x - gyro * yd - j_q * dot(omega, s->x);
    s->bias[1] = on_qd * yd + on_q * y + gyro * xd - j_q * dot(omega, s->y);
  } else {
    s->bias[0] = on_qd * xd + on_q * x;
    s->bias[1] = on_qd * yd + on_q * y;
  }
  base->omega = sum(omega, turning);
}

/* What all that lies beyond a tip asks of it: moment = J alpha + G a + moment, force = G^T alpha +
 * M a + force. */
typedef struct {
  mat J, G, M;
  vec moment, force;
} articulated;

static mat cross_matrix(vec v) {
  mat m = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  m.x.y = v.z;
  m.x.z = -v.y;
  m.y.x = -v.z;
  m.y.z = v.x;
  m.z.x = v.y;
  m.z.y = -v.x;
  return m;
}

/* A vector of a frame in the base frame. */
static vec rotated(const frame* f, vec v) {
  return plus(plus(scaled(v.x, f->x), v.y, f->y), v.z, f->z);
}

/* The payload, a rigid body at the tip. */
static articulated payload(const frame* tip) {
  const real m = PAYLOAD;
  const vec h = scaled(m, rotated(tip, constant(PAYLOAD_POSITION)));
  const vec jx = rotated(tip, constant(PAYLOAD_INERTIA[0])),
            jy = rotated(tip, constant(PAYLOAD_INERTIA[1])),
            jz = rotated(tip, constant(PAYLOAD_INERTIA[2]));
  articulated a;
  /* R I R^T: column k is (R I) times row k of R. */
  a.J.x = plus(plus(scaled(tip->x.x, jx), tip->y.x, jy), tip->z.x, jz);
  a.J.y = plus(plus(scaled(tip->x.y, jx), tip->y.y, jy), tip->z.y, jz);
  a.J.z = plus(plus(scaled(tip->x.z, jx), tip->y.z, jy), tip->z.z, jz);
  a.G = cross_matrix(h);
  a.M = cross_matrix(scaled(0, h));
  a.M.x.x = a.M.y.y = a.M.z.z = m;
  a.moment = cross(tip->omega, product(a.J, tip->omega));
  a.force = cross(tip->omega, cross(tip->omega, h));
  return a;
}

/* Moves the reference from the tip of r to its foot; r x (force) is the caller's. */
static void shift(articulated* a, vec r) {
  /* J + [r] G^T - (G + [r] M) [r] */
  vec row;
  row.x = a->G.x.x, row.y = a->G.y.x, row.z = a->G.z.x;
  a->J.x = sum(a->J.x, cross(r, row));
  row.x = a->G.x.y, row.y = a->G.y.y, row.z = a->G.z.y;
  a->J.y = sum(a->J.y, cross(r, row));
  row.x = a->G.x.z, row.y = a->G.y.z, row.z = a->G.z.z;
  a->J.z = sum(a->J.z, cross(r, row));
  a->G.x = sum(a->G.x, cross(r, a->M.x));
  a->G.y = sum(a->G.y, cross(r, a->M.y));
  a->G.z = sum(a->G.z, cross(r, a->M.z));
  /* Minus G [r], of which column x is G.y r_z - G.z r_y, and so on. */
  a->J.x = plus(plus(a->J.x, -r.z, a->G.y), r.y, a->G.z);
  a->J.y = plus(plus(a->J.y, -r.x, a->G.z), r.z, a->G.x);
  a->J.z = plus(plus(a->J.z, -r.y, a->G.x), r.x, a->G.y);
}

/* Adds a section's own inertia about its base, (26). */
static void add(articulated* a, int i, const section* s) {
  const real* f = s->f;
  const vec h = plus(scaled(f[H1], s->q), f[H0], s->z);
  const mat g = cross_matrix(h);
  const real m = MASS[i];
  a->J = less_dyad(a->J, s->q, scaled(-1, plus(scaled(f[C1], s->q), f[C2], s->z)));
  a->J = less_dyad(a->J, s->z, scaled(-1, plus(scaled(f[C2], s->q), f[C3], s->z)));
  a->J.x.x += f[C0];
  a->J.y.y += f[C0];
  a->J.z.z += f[C0];
  a->G.x = sum(a->G.x, g.x);
  a->G.y = sum(a->G.y, g.y);
  a->G.z = sum(a->G.z, g.z);
  a->M.x.x += m;
  a->M.y.y += m;
  a->M.z.z += m;
}

/* Eliminates q of section i, (31). */
static void eliminate(int i, const real q[], const real force[], section* s, articulated* a) {
  const real x = q[2 * i], y = q[2 * i + 1];
  const real* f = s->f;
  const vec f_tip = sum(a->force, sum(transposed_product(a->G, s->turning), product(a->M, s->moving)));
  const vec m_tip = sum(a->moment, sum(product(a->J, s->turning), product(a->G, s->moving)));
  /* Momenta of qd: the columns of (28). */
  const vec dh = scaled(2, plus(scaled(f[DH1], s->q), f[DH0], s->z));
  const vec spin = plus(scaled(f[K1], s->q), f[K2], s->z);
  vec F[2], T[2], UD[2], VD[2];
  real D[3], b[2], factor;
  int k;
  D[0] = f[IN_A] + f[IN_B] * x * x;
  D[1] = f[IN_B] * x * y;
  D[2] = f[IN_A] + f[IN_B] * y * y;
  for (k = 0; k < 2; ++k) {
    F[k] = sum(transposed_product(a->G, s->turn[k]), product(a->M, s->move[k]));
    T[k] = sum(product(a->J, s->turn[k]), product(a->G, s->move[k]));
    b[k] = s->bias[k] - force[2 * i + k] + dot(s->turn[k], m_tip) + dot(s->move[k], f_tip);
  }
  D[0] += dot(s->turn[0], T[0]) + dot(s->move[0], F[0]);
  D[1] += dot(s->turn[0], T[1]) + dot(s->move[0], F[1]);
  D[2] += dot(s->turn[1], T[1]) + dot(s->move[1], F[1]);
  factor = 1 / (D[0] * D[2] - D[1] * D[1]);
  s->inverse[0] = D[2] * factor;
  s->inverse[1] = -D[1] * factor;
  s->inverse[2] = D[0] * factor;
  s->u[0] = s->inverse[0] * b[0] + s->inverse[1] * b[1];
  s->u[1] = s->inverse[1] * b[0] + s->inverse[2] * b[1];
  s->pull[0] = sum(F[0], plus(scaled(f[H1], s->x), x, dh));
  s->pull[1] = sum(F[1], plus(scaled(f[H1], s->y), y, dh));
  if (i == 0) return; /* its base passes nothing on */

  s->twist[0] = plus(plus(scaled(f[K0], s->y), -y, spin), -x * f[K3], s->n);
  s->twist[1] = plus(plus(scaled(-f[K0], s->x), x, spin), -y * f[K3], s->n);
  for (k = 0; k < 2; ++k) s->twist[k] = sum(s->twist[k], sum(T[k], cross(s->r, F[k])));
  shift(a, s->r);
  add(a, i, s);
  for (k = 0; k < 2; ++k) {
    UD[k] = plus(scaled(s->inverse[k], s->twist[0]), s->inverse[k + 1], s->twist[1]);
    VD[k] = plus(scaled(s->inverse[k], s->pull[0]), s->inverse[k + 1], s->pull[1]);
  }
  for (k = 0; k < 2; ++k) {
    a->J = less_dyad(a->J, UD[k], s->twist[k]);
    a->G = less_dyad(a->G, UD[k], s->pull[k]);
    a->M = less_dyad(a->M, VD[k], s->pull[k]);
  }
  a->force = sum(f_tip, s->force);
  a->moment = sum(sum(m_tip, cross(s->r, f_tip)), s->moment);
  for (k = 0; k < 2; ++k) {
    a->force = plus(a->force, -s->u[k], s->pull[k]);
    a->moment = plus(a->moment, -s->u[k], s->twist[k]);
  }
}

/* Of all cables, with F of (36) where one is driven by length. */
static void cable_force(const real q[], const real qd[], const real command[], real force[]) {
  int j, k;
  for (k = 0; k < COORDINATES; ++k) force[k] = 0;
  for (j = 0; j < CABLES; ++j) {
    real tension = command[j];
    if (CABLE_STIFFNESS[j] > 0) {
      real stretch = STRAIGHT[j] - command[j], rate = 0;
      for (k = 0; k < COORDINATES; ++k) {
        stretch -= ACTUATION[j][k] * q[k];
        rate -= ACTUATION[j][k] * qd[k];
      }
      tension = CABLE_STIFFNESS[j] * stretch + CABLE_PRETENSION[j] + CABLE_DAMPING[j] * rate;
      if (!((number)tension > 0)) tension = 0;
    }
    pull(j, q, qd, tension, force);
  }
}

static int accelerate(const real q[], const real qd[], const real force[], real qdd[]) {
  section s[SECTIONS];
  frame base = root();
  articulated beyond;
  vec alpha = scaled(0, base.x), a = scaled(-1, constant(GRAVITY)); /* weight: an acceleration upwards */
  real total = 0;
  int i, k;
  for (i = 0; i < SECTIONS; ++i) {
    if (place(i, q, &base, &s[i]) != 0) return @NAME@_BEYOND;
    move(i, q, qd, &base, &s[i]);
  }
  beyond = payload(&base);
  for (i = SECTIONS - 1; i >= 0; --i) eliminate(i, q, force, &s[i], &beyond);
  for (i = 0; i < SECTIONS; ++i) { /* (32) */
    real w[2], rate[2];
    for (k = 0; k < 2; ++k) {
      w[k] = dot(s[i].pull[k], a);
      if (i > 0) w[k] += dot(s[i].twist[k], alpha);
    }
    rate[0] = -s[i].u[0] - (s[i].inverse[0] * w[0] + s[i].inverse[1] * w[1]);
    rate[1] = -s[i].u[1] - (s[i].inverse[1] * w[0] + s[i].inverse[2] * w[1]);
    qdd[2 * i] = rate[0];
    qdd[2 * i + 1] = rate[1];
    total += rate[0] + rate[1];
    a = sum(a, sum(cross(alpha, s[i].r), s[i].moving));
    alpha = sum(alpha, s[i].turning);
    for (k = 0; k < 2; ++k) {
      a = plus(a, rate[k], s[i].move[k]);
      alpha = plus(alpha, rate[k], s[i].turn[k]);
    }
  }
  total -= total;
  return (number)total == 0 ? 0 : @NAME@_BEYOND; /* not of NaN and infinity */
}

/* What a step of Runge-Kutta 4 adds to a state. */
static int runge_kutta(const real q[], const real qd[], const real command[], real step,
                       real q_sum[], real qd_sum[]) {
  /* Where each stage is looked at, and its share of the step. */
  static const number at[4] = {0, N(0.5), N(0.5), 1}, share[4] = {1, 2, 2, 1};
  real q_k[COORDINATES], qd_k[COORDINATES], qdd[COORDINATES], force[COORDINATES];
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
    if (!((number)(x * x + y * y) <= LARGEST_SIGMA)) return @NAME@_BEYOND;
  }
  return 0;
}
