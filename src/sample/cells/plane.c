/* Surfaces in space that are planes. */
#include <float.h>
#include <math.h>

#include "sample/cells/set.h"

/* Of the surface's width: points so near to a plane are in it. */
static const double FLAT = 1e-5;

/* A component of a normal that is smaller is rounding. */
static const double NO_COMPONENT = 1e-5;

enum { SWEEPS = 12 }; /* Jacobi's method doubles its figures each time */

static void find_middle(double out[3], const fg__cell_set *set)
{
  double count = 0.0;
  out[0] = out[1] = out[2] = 0.0;
  for (size_t c = 0; c < set->count; ++c)
    for (int i = 0; i < fg__cell_corners(set->shape[c]); ++i, ++count)
      for (int k = 0; k < 3; ++k)
        out[k] += fg__cell_set_corner(set, c, i)[k];
  for (int k = 0; k < 3; ++k)
    out[k] /= count;
}

/* The corners' scatter matrix: sums of products of distances from the middle. */
static void find_scatter(double out[3][3], const fg__cell_set *set,
                         const double middle[3])
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[i][j] = 0.0;
  for (size_t c = 0; c < set->count; ++c)
    for (int n = 0; n < fg__cell_corners(set->shape[c]); ++n) {
      const double *p = fg__cell_set_corner(set, c, n);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          out[i][j] += (p[i] - middle[i]) * (p[j] - middle[j]);
    }
}

/* Turns rows and columns p and q of m so that m[p][q] is zero; v follows. */
static void rotate(double m[3][3], double v[3][3], int p, int q)
{
  if (!(fabs(m[p][q]) > 0.0))
    return;
  const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
  const double t =
      (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
  const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
  for (int k = 0; k < 3; ++k) {
    const double a = m[k][p], b = m[k][q];
    m[k][p] = c * a - s * b;
    m[k][q] = s * a + c * b;
  }
  for (int k = 0; k < 3; ++k) {
    const double a = m[p][k], b = m[q][k];
    m[p][k] = c * a - s * b;
    m[q][k] = s * a + c * b;
    const double x = v[k][p], y = v[k][q];
    v[k][p] = c * x - s * y;
    v[k][q] = s * x + c * y;
  }
}

/* The scatter matrix' eigenvector of its least eigenvalue, by Jacobi's method. */
static void find_normal(double out[3], double scatter[3][3])
{
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < SWEEPS; ++sweep) {
    rotate(scatter, v, 0, 1);
    rotate(scatter, v, 0, 2);
    rotate(scatter, v, 1, 2);
  }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (scatter[k][k] < scatter[least][least])
      least = k;
  for (int k = 0; k < 3; ++k)
    out[k] = fabs(v[k][least]) < NO_COMPONENT ? 0.0 : v[k][least];
}

/* How far the corners are from a plane at most, how far apart along the axes, and how
 * precise their coordinates can be in single precision. */
static void measure(double *off, double *width, double *rounding, const fg__cell_set *set,
                    const double middle[3], const double normal[3])
{
  *off = *width = *rounding = 0.0;
  for (size_t c = 0; c < set->count; ++c)
    for (int i = 0; i < fg__cell_corners(set->shape[c]); ++i) {
      const double *p = fg__cell_set_corner(set, c, i);
      double from[3];
      for (int k = 0; k < 3; ++k) {
        from[k] = p[k] - middle[k];
        *width = fmax(*width, 2.0 * fabs(from[k]));
        *rounding = fmax(*rounding, 4.0 * (double)FLT_EPSILON * fabs(p[k]));
      }
      *off = fmax(*off, fabs(fg__dot(from, normal)));
    }
}

fg_status fg__cell_set_turn(fg__cell_set *set)
{
  double middle[3], scatter[3][3], normal[3], off, width, rounding;
  find_middle(middle, set);
  find_scatter(scatter, set, middle);
  find_normal(normal, scatter);
  measure(&off, &width, &rounding, set, middle, normal);
  if (!fg__plane_basis_of(&set->basis, normal) || !(off <= FLAT * width + rounding)) {
    fg__fail(set->context, FG_STATUS_UNSUPPORTED,
             "%s: a surface that is not plane: it is up to %.3g from the nearest plane, "
             "%.2g %% of its width %.3g",
             set->path, off, 100.0 * off / width, width);
    fg__hint(set->context, "cut it by a plane, with ParaView's filter Slice, and save "
                           "that");
    return FG_STATUS_UNSUPPORTED;
  }
  set->tilted = true;
  for (size_t n = 0; n < set->points; ++n) {
    double *p = set->position + 3 * n;
    const double s = fg__dot(p, set->basis.direction[0]);
    p[1] = fg__dot(p, set->basis.direction[1]);
    p[0] = s;
    p[2] = 0.0;
  }
  return FG_STATUS_OK;
}
