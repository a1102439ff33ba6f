/* The discrete model of docs/method/README.md by its definition: double precision,
 * plain arrays, cell by cell, gradients integrated by quadrature. What the engine
 * computes is compared with this. */
#ifndef FG__REFERENCE_TEST_H
#define FG__REFERENCE_TEST_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "solver/multigrid_test.h"

static const double PI = 3.14159265358979323846;

/* The most threads that may work on a problem. */
enum { MOST_THREADS = 3 };

typedef struct problem_description {
  int cells[3]; /* cells[2] = 0: in 2D */
  double side[3];
  bool periodic[3];
  double gamma, anisotropy;
  /* of A's eigenvector of value 1; NULL: 0.6; in 3D it also rises out of the plane */
  double (*angle)(double x, double y, const void *data);
  const void *angle_data;
  bool (*inside)(double x, double y); /* by the cells' centres; NULL: everywhere */
} problem_description;

typedef struct problem {
  problem_description of;
  fg_context *context;
  int dimension, corners;
  double spacing[3];
  int count[3];              /* of cells, 1 along z in 2D */
  int columns, rows, planes; /* of nodes, without the last one of a periodic axis */
  size_t nodes, cells;
  fg__tensor tensor;
  double *mass;                 /* lumped: the integral of each node's basis function */
  double stiffness[8][8][3][3]; /* integral of d_i phi_a d_j phi_b over a cell */
  fg__mesh mesh;
  fg__threads *threads; /* of MOST_THREADS */
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
static inline size_t corner(const problem *p, int i, int j, int k, int a)
{
  size_t x = (size_t)((i + (a & 1)) % p->columns);
  size_t y = (size_t)((j + (a >> 1 & 1)) % p->rows);
  size_t z = (size_t)((k + (a >> 2)) % p->planes);
  return (z * (size_t)p->rows + y) * (size_t)p->columns + x;
}

static inline size_t cell(const problem *p, int i, int j, int k)
{
  return ((size_t)k * (size_t)p->count[1] + (size_t)j) * (size_t)p->count[0] + (size_t)i;
}

static inline double volume_of(const problem *p)
{
  double volume = 1.0;
  for (int k = 0; k < p->dimension; ++k)
    volume *= p->spacing[k];
  return volume;
}

/* Two Gauss points an axis integrate products of multilinear functions' gradients
 * exactly. */
static inline void integrate_cell(problem *p)
{
  for (int g = 0; g < p->corners; ++g) {
    double gradient[8][3];
    for (int a = 0; a < p->corners; ++a)
      for (int m = 0; m < p->dimension; ++m) {
        gradient[a][m] = (a >> m & 1 ? 1.0 : -1.0) / p->spacing[m];
        for (int k = 0; k < p->dimension; ++k) {
          double point = 0.5 + (g >> k & 1 ? 0.5 : -0.5) / sqrt(3.0);
          if (k != m)
            gradient[a][m] *= a >> k & 1 ? point : 1.0 - point;
        }
      }
    for (int a = 0; a < p->corners; ++a)
      for (int b = 0; b < p->corners; ++b)
        for (int m = 0; m < p->dimension; ++m)
          for (int n = 0; n < p->dimension; ++n)
            p->stiffness[a][b][m][n] +=
                volume_of(p) / p->corners * gradient[a][m] * gradient[b][n];
  }
}

static inline void set_tensor(problem *p, size_t n, double x, double y, double z)
{
  const problem_description *of = &p->of;
  double angle = of->angle ? of->angle(x, y, of->angle_data) : 0.6;
  double rise = p->dimension < 3 ? 0.0 : of->angle ? 0.4 + 1.3 * z - x : 0.4;
  double e[3] = {cos(angle) * cos(rise), sin(angle) * cos(rise), sin(rise)};
  float *to[3][3] = {{p->tensor.xx, p->tensor.xy, p->tensor.xz},
                     {p->tensor.xy, p->tensor.yy, p->tensor.yz},
                     {p->tensor.xz, p->tensor.yz, p->tensor.zz}};
  for (int m = 0; m < 3 && m < p->dimension; ++m)
    for (int k = m; k < 3 && k < p->dimension; ++k)
      to[m][k][n] =
          (float)((1.0 - of->anisotropy) * e[m] * e[k] + (m == k ? of->anisotropy : 0.0));
}

static inline void fill_tensor(problem *p)
{
  const problem_description *of = &p->of;
  for (int k = 0; k < p->count[2]; ++k)
    for (int j = 0; j < p->count[1]; ++j)
      for (int i = 0; i < p->count[0]; ++i) {
        double x = (i + 0.5) * p->spacing[0], y = (j + 0.5) * p->spacing[1];
        size_t n = cell(p, i, j, k);
        p->tensor.active[n] = !of->inside || of->inside(x, y);
        if (!p->tensor.active[n])
          continue;
        set_tensor(p, n, x, y, (k + 0.5) * p->spacing[2]);
        for (int a = 0; a < p->corners; ++a)
          p->mass[corner(p, i, j, k, a)] += volume_of(p) / p->corners;
      }
}

static inline void problem_create(problem *p, const problem_description *of)
{
  *p = (problem){.of = *of, .dimension = of->cells[2] > 0 ? 3 : 2};
  p->corners = 1 << p->dimension;
  assert_int_equal(fg_context_create(&p->context), FG_STATUS_OK);
  p->mesh.dimension = p->dimension;
  int nodes[3] = {1, 1, 1};
  p->cells = p->nodes = 1;
  for (int k = 0; k < 3; ++k) {
    bool used = k < p->dimension;
    p->count[k] = used ? of->cells[k] : 1;
    p->spacing[k] = used ? of->side[k] / of->cells[k] : 1.0;
    p->mesh.cells[k] = p->count[k];
    p->mesh.periodic[k] = used && of->periodic[k];
    p->mesh.spacing[k] = p->spacing[k];
    nodes[k] = used ? of->cells[k] + !of->periodic[k] : 1;
    p->cells *= (size_t)p->count[k];
    p->nodes *= (size_t)nodes[k];
  }
  p->columns = nodes[0];
  p->rows = nodes[1];
  p->planes = nodes[2];
  float **components[6] = {&p->tensor.xx, &p->tensor.xy, &p->tensor.yy,
                           &p->tensor.zz, &p->tensor.xz, &p->tensor.yz};
  for (int n = 0; n < (p->dimension == 3 ? 6 : 3); ++n)
    *components[n] = allocate_or_fail(p->cells, sizeof(float));
  p->tensor.active = allocate_or_fail(p->cells, 1);
  p->mass = values_of(p);
  integrate_cell(p);
  fill_tensor(p);
  assert_int_equal(fg__threads_create(&p->threads, p->context, MOST_THREADS),
                   FG_STATUS_OK);
  assert_int_equal(multigrid_of_tensor(&p->multigrid, p->context, &p->mesh, &p->tensor,
                                       of->gamma, p->threads),
                   FG_STATUS_OK);
}

static inline void problem_clear(problem *p)
{
  fg__multigrid_clear(&p->multigrid);
  fg__threads_destroy(p->threads);
  free(p->tensor.xx);
  free(p->tensor.xy);
  free(p->tensor.yy);
  free(p->tensor.zz);
  free(p->tensor.xz);
  free(p->tensor.yz);
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
  fg__fill_ghosts(&p->multigrid.level[0], array);
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

/* A term of A grad u . grad phi over a cell: what the entries of A with the same value
 * multiply. */
typedef struct term {
  const float *value; /* of each cell; NULL: 1 */
  double stiffness[8][8];
} term;

static inline int terms_of(const problem *p, bool laplacian, term terms[6])
{
  const float *from[3][3] = {{p->tensor.xx, p->tensor.xy, p->tensor.xz},
                             {p->tensor.xy, p->tensor.yy, p->tensor.yz},
                             {p->tensor.xz, p->tensor.yz, p->tensor.zz}};
  int count = 0;
  for (int m = 0; m < p->dimension; ++m)
    for (int n = m; n < p->dimension; ++n) {
      if (laplacian && m != n)
        continue;
      term *t = &terms[laplacian ? 0 : count];
      if (!laplacian || count == 0)
        *t = (term){.value = laplacian ? NULL : from[m][n]};
      for (int a = 0; a < p->corners; ++a)
        for (int b = 0; b < p->corners; ++b)
          t->stiffness[a][b] +=
              p->stiffness[a][b][m][n] + (m == n ? 0.0 : p->stiffness[a][b][n][m]);
      ++count;
    }
  return laplacian ? 1 : count;
}

/* out := the integrals of A grad u . grad phi for each node, or with A = I. */
static inline void apply_stiffness(const problem *p, bool laplacian, const double *u,
                                   double *out)
{
  term terms[6] = {{.value = NULL}};
  const int term_count = terms_of(p, laplacian, terms);
  memset(out, 0, p->nodes * sizeof *out);
  for (int k = 0; k < p->count[2]; ++k)
    for (int j = 0; j < p->count[1]; ++j)
      for (int i = 0; i < p->count[0]; ++i) {
        size_t at = cell(p, i, j, k), corners[8];
        double values[8];
        if (!p->tensor.active[at])
          continue;
        for (int a = 0; a < p->corners; ++a) {
          corners[a] = corner(p, i, j, k, a);
          values[a] = u[corners[a]];
        }
        for (int t = 0; t < term_count; ++t) {
          double value = terms[t].value ? (double)terms[t].value[at] : 1.0;
          for (int a = 0; a < p->corners; ++a) {
            const double *row = terms[t].stiffness[a];
            double sum = 0.0;
            for (int b = 0; b < p->corners; ++b)
              sum += row[b] * values[b];
            out[corners[a]] += value * sum;
          }
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
