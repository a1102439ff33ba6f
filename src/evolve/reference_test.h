/* The discrete model of design.md sections 2 and 3 by its definition: double precision,
 * plain arrays, cell by cell, gradients integrated by quadrature. What the engine
 * computes is compared with this. */
#ifndef FG__REFERENCE_TEST_H
#define FG__REFERENCE_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "evolve/multigrid.h"

static const double PI = 3.14159265358979323846;

typedef struct problem_description {
  int cells[2];
  double side[2];
  bool periodic[2];
  double gamma, anisotropy;
  /* of A's eigenvector of value 1; NULL: 0.6 */
  double (*angle)(double x, double y, const void *data);
  const void *angle_data;
  bool (*inside)(double x, double y); /* by the cells' centres; NULL: everywhere */
} problem_description;

typedef struct problem {
  problem_description of;
  fg_context *context;
  double spacing[2];
  int columns, rows; /* nodes; the repeated last one of a periodic axis is left out */
  size_t nodes, cells;
  fg__tensor tensor;
  double *mass;                 /* lumped: the integral of each node's basis function */
  double stiffness[4][4][2][2]; /* integral of d_i phi_a d_j phi_b over a cell */
  fg__mesh mesh;
  fg__tile tile;
  fg__multigrid multigrid;
} problem;

/* Reproducible values in [-1, 1): the 64-bit generator of Marsaglia (2003). */
static inline double random_value(uint64_t *state)
{
  *state ^= *state << 13;
  *state ^= *state >> 7;
  *state ^= *state << 17;
  return (double)(int64_t)*state * 0x1p-63;
}

static inline void *allocate_or_fail(size_t count, size_t size)
{
  void *memory = calloc(count > 0 ? count : 1, size);
  assert_non_null(memory);
  return memory;
}

static inline double *values_of(const problem *p)
{
  return allocate_or_fail(p->nodes, sizeof(double));
}

/* Index of corner a (x fastest) of a cell. */
static inline size_t corner(const problem *p, int i, int j, int a)
{
  return (size_t)((j + a / 2) % p->rows) * (size_t)p->columns +
         (size_t)((i + a % 2) % p->columns);
}

/* Two Gauss points an axis integrate products of bilinear functions' gradients exactly.
 */
static inline void integrate_cell(problem *p)
{
  double hx = p->spacing[0], hy = p->spacing[1];
  for (int g = 0; g < 4; ++g) {
    double point[2] = {0.5 + (g % 2 ? 0.5 : -0.5) / sqrt(3.0),
                       0.5 + (g / 2 ? 0.5 : -0.5) / sqrt(3.0)};
    double gradient[4][2];
    for (int a = 0; a < 4; ++a) {
      double x = a % 2 ? point[0] : 1.0 - point[0];
      double y = a / 2 ? point[1] : 1.0 - point[1];
      gradient[a][0] = (a % 2 ? 1.0 : -1.0) / hx * y;
      gradient[a][1] = (a / 2 ? 1.0 : -1.0) / hy * x;
    }
    for (int n = 0; n < 64; ++n)
      p->stiffness[n / 16][n / 4 % 4][n / 2 % 2][n % 2] +=
          0.25 * hx * hy * gradient[n / 16][n / 2 % 2] * gradient[n / 4 % 4][n % 2];
  }
}

static inline void fill_tensor(problem *p)
{
  const problem_description *of = &p->of;
  for (int j = 0; j < of->cells[1]; ++j)
    for (int i = 0; i < of->cells[0]; ++i) {
      double x = (i + 0.5) * p->spacing[0], y = (j + 0.5) * p->spacing[1];
      size_t n = (size_t)j * (size_t)of->cells[0] + (size_t)i;
      p->tensor.active[n] = !of->inside || of->inside(x, y);
      if (!p->tensor.active[n])
        continue;
      double angle = of->angle ? of->angle(x, y, of->angle_data) : 0.6;
      double c = cos(angle), s = sin(angle);
      p->tensor.xx[n] = (float)(c * c + of->anisotropy * s * s);
      p->tensor.xy[n] = (float)((1.0 - of->anisotropy) * c * s);
      p->tensor.yy[n] = (float)(s * s + of->anisotropy * c * c);
      for (int a = 0; a < 4; ++a)
        p->mass[corner(p, i, j, a)] += 0.25 * p->spacing[0] * p->spacing[1];
    }
}

static inline void problem_create(problem *p, const problem_description *of)
{
  *p = (problem){.of = *of};
  assert_int_equal(fg_context_create(&p->context), FG_STATUS_OK);
  for (int k = 0; k < 2; ++k) {
    p->spacing[k] = of->side[k] / of->cells[k];
    p->mesh.cells[k] = p->tile.cells[k] = of->cells[k];
    p->mesh.periodic[k] = of->periodic[k];
    p->mesh.spacing[k] = p->spacing[k];
  }
  p->columns = of->cells[0] + !of->periodic[0];
  p->rows = of->cells[1] + !of->periodic[1];
  p->nodes = (size_t)p->columns * (size_t)p->rows;
  p->cells = (size_t)of->cells[0] * (size_t)of->cells[1];
  p->tensor.xx = allocate_or_fail(p->cells, sizeof(float));
  p->tensor.xy = allocate_or_fail(p->cells, sizeof(float));
  p->tensor.yy = allocate_or_fail(p->cells, sizeof(float));
  p->tensor.active = allocate_or_fail(p->cells, 1);
  p->mass = values_of(p);
  integrate_cell(p);
  fill_tensor(p);
  assert_int_equal(fg__multigrid_create(&p->multigrid, p->context, &p->mesh, &p->tile,
                                        &p->tensor, of->gamma),
                   FG_STATUS_OK);
}

static inline void problem_clear(problem *p)
{
  fg__multigrid_clear(&p->multigrid);
  free(p->tensor.xx);
  free(p->tensor.xy);
  free(p->tensor.yy);
  free(p->tensor.active);
  free(p->mass);
  fg_context_destroy(p->context);
}

/* Values to and from an array of the finest level. */
static inline void put(const problem *p, float *array, const double *values)
{
  float *plain = allocate_or_fail(p->nodes, sizeof *plain);
  for (size_t n = 0; n < p->nodes; ++n)
    plain[n] = (float)values[n];
  fg__level_import(&p->multigrid.level[0], array, plain);
  free(plain);
}

static inline void get(const problem *p, const float *array, double *values)
{
  float *plain = allocate_or_fail(p->nodes, sizeof *plain);
  fg__level_export(&p->multigrid.level[0], array, plain);
  for (size_t n = 0; n < p->nodes; ++n)
    values[n] = (double)plain[n];
  free(plain);
}

/* out := the integrals of A grad u . grad phi for each node, or with A = I. */
static inline void apply_stiffness(const problem *p, bool laplacian, const double *u,
                                   double *out)
{
  memset(out, 0, p->nodes * sizeof *out);
  for (int j = 0; j < p->of.cells[1]; ++j)
    for (int i = 0; i < p->of.cells[0]; ++i) {
      size_t n = (size_t)j * (size_t)p->of.cells[0] + (size_t)i;
      if (!p->tensor.active[n])
        continue;
      double xx = laplacian ? 1.0 : (double)p->tensor.xx[n];
      double xy = laplacian ? 0.0 : (double)p->tensor.xy[n];
      double yy = laplacian ? 1.0 : (double)p->tensor.yy[n];
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          const double(*s)[2] = p->stiffness[a][b];
          out[corner(p, i, j, a)] +=
              (xx * s[0][0] + xy * (s[0][1] + s[1][0]) + yy * s[1][1]) *
              u[corner(p, i, j, b)];
        }
    }
}

static inline double inner_product(const problem *p, const double *a, const double *b)
{
  double sum = 0.0;
  for (size_t n = 0; n < p->nodes; ++n)
    sum += p->mass[n] * a[n] * b[n];
  return sum;
}

static inline double norm(const problem *p, const double *a)
{
  return sqrt(inner_product(p, a, a));
}

static inline double integral(const problem *p, const double *u)
{
  double sum = 0.0;
  for (size_t n = 0; n < p->nodes; ++n)
    sum += p->mass[n] * u[n];
  return sum;
}

/* w := Psi'(u) + gamma L_A u where there is mass. */
static inline void reference_potential(const problem *p, const double *u, double *w)
{
  apply_stiffness(p, false, u, w);
  for (size_t n = 0; n < p->nodes; ++n)
    w[n] = p->mass[n] > 0.0
               ? 2.0 * u[n] * (u[n] * u[n] - 1.0) + p->of.gamma * w[n] / p->mass[n]
               : 0.0;
}

static inline double reference_energy(const problem *p, const double *u)
{
  double *flux = values_of(p), sum = 0.0;
  apply_stiffness(p, false, u, flux);
  for (size_t n = 0; n < p->nodes; ++n) {
    double well = u[n] * u[n] - 1.0;
    sum += 0.5 * p->mass[n] * well * well + 0.5 * p->of.gamma * u[n] * flux[n];
  }
  free(flux);
  return sum;
}

/* What is left of both equations of a step, rows over masses:
 * first := rhs - u - tau L w, second := Psi'(u) + gamma L_A u - w. */
static inline void reference_residuals(const problem *p, double tau, const double *rhs,
                                       const double *u, const double *w, double *first,
                                       double *second)
{
  apply_stiffness(p, true, w, first);
  reference_potential(p, u, second);
  for (size_t n = 0; n < p->nodes; ++n) {
    bool alive = p->mass[n] > 0.0;
    first[n] = alive ? rhs[n] - u[n] - tau * first[n] / p->mass[n] : 0.0;
    second[n] = alive ? second[n] - w[n] : 0.0;
  }
}

#endif
