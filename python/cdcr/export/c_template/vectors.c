/* @about@
 *
 * Written by `cdcr export-c` of cdcr @version@. Numbers in brackets are those of the equations in
 * cpp/several-sections.md there. All vectors are expressed in the base frame. */
#include "@name@.h"

/* Arithmetic is on `real`, which is complex where @name@_derivatives.c includes this file; tables and
 * what is compared are numbers. */
typedef @name@_real number;
#ifdef @NAME@_COMPLEX
typedef @NAME@_REAL _Complex real;
#else
typedef number real;
#endif
#define N(value) ((number)(value))
typedef struct {
  real x, y, z;
} vec;
typedef struct {
  vec x, y, z; /* columns */
} mat;

enum { SECTIONS = @NAME@_SECTIONS, COORDINATES = @NAME@_COORDINATES, CABLES = @NAME@_CABLES };

/* The functions of sigma = theta^2, eqs. (26), (27): polynomials in t from -1 to 1 in each of PIECES
 * equal parts of it, as tables of [piece][power][function]; float needs fewer of their ROWS. */
enum { PIECES = @pieces@, ROWS = @powers@, POWERS = sizeof(number) < sizeof(double) ? @float_powers@ : ROWS };
enum { ARC_A, ARC_S, ARC_G, ARC_DA, ARC_DS, ARC_DG, ARC_DDA, ARC_DDS, ARC_FUNCTIONS };
enum { H0, H1, DH0, DH1, DDH0, DDH1, C0, C1, C2, C3, DC0, DC1, DC2, DC3, K0, K1, K2, K3, DK0, DK1, DK2,
       DK3, IN_A, IN_B, D_A, D_B, SPIN_Q, SPIN_Z, FUNCTIONS };

@tables@
static vec constant(const number value[3]) {
  vec c;
  c.x = value[0];
  c.y = value[1];
  c.z = value[2];
  return c;
}

static vec sum(vec a, vec b) {
  vec c = {a.x + b.x, a.y + b.y, a.z + b.z};
  return c;
}
static vec scaled(real s, vec a) {
  vec c = {s * a.x, s * a.y, s * a.z};
  return c;
}
/* a + s b */
static vec plus(vec a, real s, vec b) {
  vec c = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
  return c;
}
static real dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec cross(vec a, vec b) {
  vec c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return c;
}
static vec product(mat m, vec v) {
  return plus(plus(scaled(v.x, m.x), v.y, m.y), v.z, m.z);
}
static vec transposed_product(mat m, vec v) {
  vec c = {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
  return c;
}
/* m - a b^T */
static mat less_dyad(mat m, vec a, vec b) {
  mat c = {plus(m.x, -b.x, a), plus(m.y, -b.y, a), plus(m.z, -b.z, a)};
  return c;
}

/* Place t in [-1, 1] of sigma in its piece, which is given back, or -1 beyond them. */
static int find(real sigma, real* t) {
  const real position = sigma * PIECES_PER_SIGMA;
  int piece;
  if (!((number)sigma <= LARGEST_SIGMA)) return -1;
  piece = (int)(number)position;
  if (piece == PIECES) piece = PIECES - 1;
  *t = 2 * (position - (number)piece) - 1;
  return piece;
}

/* Four functions side by side: none waits for itself. */
static void read(const number* table, int functions, int piece, real t, real* f) {
  const number* highest = table + (piece * ROWS + POWERS - 1) * functions;
  int i, k;
  for (i = 0; i < functions; i += 4) {
    const number* row = highest + i;
    real f0 = row[0], f1 = row[1], f2 = row[2], f3 = row[3];
    for (k = 1; k < POWERS; ++k) {
      row -= functions;
      f0 = f0 * t + row[0];
      f1 = f1 * t + row[1];
      f2 = f2 * t + row[2];
      f3 = f3 * t + row[3];
    }
    f[i] = f0;
    f[i + 1] = f1;
    f[i + 2] = f2;
    f[i + 3] = f3;
  }
}
