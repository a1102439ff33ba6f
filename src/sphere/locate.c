/* Which cell holds a position, and the weights of its corners there. */
#include "sphere/inside.h"

#include <stdlib.h>

typedef struct flat_point {
  double x, y;
} flat_point;

static double cross(flat_point a, flat_point b)
{
  return a.x * b.y - a.y * b.x;
}

static flat_point minus(flat_point a, flat_point b)
{
  return (flat_point){a.x - b.x, a.y - b.y};
}

/* Corners as seen along `up` from the position: it lies at the origin. Sides that two
 * cells share look alike from both, so that nothing jumps from cell to cell. */
static bool look(flat_point out[4], const fg__sphere *sphere, const int point[4],
                 int corners, const double up[3])
{
  /* two directions across `up`, the longer way from its smallest component */
  const int a = fabs(up[0]) < fabs(up[1]) ? (fabs(up[0]) < fabs(up[2]) ? 0 : 2)
                                          : (fabs(up[1]) < fabs(up[2]) ? 1 : 2);
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  const double length = sqrt(up[b] * up[b] + up[c] * up[c]);
  const double cosine = up[c] / length, sine = up[b] / length;
  for (int k = 0; k < corners; ++k) {
    const double *p = fg__sphere_position(sphere, point[k]);
    if (fg__dot(p, up) <= 0.0)
      return false;
    const double d[3] = {p[0] - up[0], p[1] - up[1], p[2] - up[2]};
    const double along = d[b] * sine + d[c] * cosine;
    out[k] = (flat_point){d[b] * cosine - d[c] * sine, d[a] * length - up[a] * along};
  }
  return true;
}

static bool is_fraction(double s)
{
  return s >= -FG__SPHERE_ROUNDING && s <= 1.0 + FG__SPHERE_ROUNDING;
}

static double kept_inside(double s)
{
  return s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
}

static bool weigh_triangle(double weight[4], const flat_point q[3])
{
  const double area = cross(minus(q[1], q[0]), minus(q[2], q[0]));
  if (area == 0.0)
    return false;
  const double s = cross(q[2], q[0]) / area, t = cross(q[0], q[1]) / area;
  if (!(is_fraction(s) && is_fraction(t) && is_fraction(1.0 - s - t)))
    return false;
  const double sum =
      kept_inside(s) + kept_inside(t) + kept_inside(1.0 - s - t); /* 1 but for rounding */
  weight[1] = kept_inside(s) / sum;
  weight[2] = kept_inside(t) / sum;
  weight[0] = kept_inside(1.0 - s - t) / sum;
  weight[3] = 0.0;
  return true;
}

/* Roots of a s^2 + b s + c; those that are not there are NaN. */
static void solve(double root[2], double a, double b, double c)
{
  const double discriminant = b * b - 4.0 * a * c;
  const double q = -0.5 * (b + copysign(sqrt(discriminant), b));
  root[0] = c / q;
  root[1] = q / a;
}

/* The bilinear map's fractions (s, t) at the origin: q0 + s a + t (b + s d) = 0, so that
 * the cross product of q0 + s a with b + s d vanishes. */
static bool weigh_quadrilateral(double weight[4], const flat_point q[4])
{
  const flat_point a = minus(q[1], q[0]), b = minus(q[3], q[0]);
  const flat_point d = minus(minus(q[2], q[3]), a);
  double root[2];
  solve(root, cross(a, d), cross(q[0], d) + cross(a, b), cross(q[0], b));
  for (int k = 0; k < 2; ++k) {
    double s = root[k];
    if (!is_fraction(s))
      continue;
    const flat_point from = {q[0].x + s * a.x, q[0].y + s * a.y};
    const flat_point way = {b.x + s * d.x, b.y + s * d.y};
    const double t = -(from.x * way.x + from.y * way.y) / (way.x * way.x + way.y * way.y);
    if (!is_fraction(t))
      continue;
    s = kept_inside(s);
    const double u = kept_inside(t);
    weight[0] = (1.0 - s) * (1.0 - u);
    weight[1] = s * (1.0 - u);
    weight[2] = s * u;
    weight[3] = (1.0 - s) * u;
    return true;
  }
  return false;
}

static bool try_cell(fg__sphere_place *out, const fg__sphere *sphere, int n,
                     const double up[3])
{
  flat_point seen[4] = {{0.0, 0.0}};
  const int corners = fg__sphere_corners(sphere, (size_t)n, out->point);
  if (!look(seen, sphere, out->point, corners, up))
    return false;
  return (corners == 3 ? weigh_triangle : weigh_quadrilateral)(out->weight, seen) &&
         !fg__sphere_place_is_missing(sphere, out);
}

bool fg__sphere_place_in_cells(fg__sphere_place *out, const fg__sphere *sphere,
                               const double up[3], int *hint)
{
  if (*hint >= 0 && try_cell(out, sphere, *hint, up))
    return true;
  const int f = fg__sphere_face_of(up);
  const fg__sphere_face *face = &sphere->face[f];
  double at[2];
  int square[2];
  if (face->columns == 0 || !fg__sphere_onto_face(at, up, f))
    return false;
  for (int c = 0; c < 2; ++c) {
    const double slack = FG__SPHERE_ROUNDING * (face->high[c] - face->low[c]);
    if (at[c] < face->low[c] - slack || at[c] > face->high[c] + slack)
      return false;
    square[c] = fg__sphere_square((at[c] - face->low[c]) * face->inverse[c],
                                  c == 0 ? face->columns : face->rows);
  }
  const uint32_t *start =
      &face->start[(size_t)square[1] * (size_t)face->columns + (size_t)square[0]];
  for (uint32_t k = start[0]; k < start[1]; ++k) {
    const int n = face->cell[k];
    if (n == *hint || !try_cell(out, sphere, n, up))
      continue;
    *hint = n;
    return true;
  }
  return false;
}
