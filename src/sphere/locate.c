/* Which cell holds a position. The sphere is projected from its centre onto the faces of
 * a cube, where the sides of cells are straight; each face is divided into squares that
 * know the cells in them. */
#include "base/memory.h"
#include "sphere/inside.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Positions a rounding error outside a cell, in widths of the cell, are inside. */
static const double ROUNDING = 1e-7;

/* A face of the cube reaches 54.7 degrees from its centre, and a cell's corners lie
 * within 30 of each other: this is the cosine of a little more than the sum. */
static const double LEAST_HEIGHT = 0.08;

/* Squares: about as many as cells, on each face no more than these a side. */
static const int MOST_SQUARES = 1 << 14;

/* Squares that a cell lies in, in the mean: some four where all cells are alike. */
static const int MOST_ENTRIES = 16;

static const double *position_of(const fg__sphere *sphere, int point)
{
  return sphere->position + 3 * (size_t)point;
}

static int face_of(const double up[3])
{
  int axis = fabs(up[1]) > fabs(up[0]) ? 1 : 0;
  axis = fabs(up[2]) > fabs(up[axis]) ? 2 : axis;
  return 2 * axis + (up[axis] < 0.0);
}

/* Gnomonic coordinates on face f; false at or behind its horizon. */
static bool project(double out[2], const double up[3], int f)
{
  const int axis = f / 2;
  const double height = f & 1 ? -up[axis] : up[axis];
  if (height < LEAST_HEIGHT)
    return false;
  const double inverse = 1.0 / height;
  out[0] = up[(axis + 1) % 3] * inverse;
  out[1] = up[(axis + 2) % 3] * inverse;
  return true;
}

/* The rectangle of a cell on face f; false when it has no part there. */
static bool cover_all(double low[2], double high[2], const fg__sphere *sphere, size_t n,
                      int f)
{
  int point[4];
  const int corners = fg__sphere_corners(sphere, n, point);
  low[0] = low[1] = HUGE_VAL;
  high[0] = high[1] = -HUGE_VAL;
  for (int k = 0; k < corners; ++k) {
    double at[2];
    if (!project(at, position_of(sphere, point[k]), f))
      return false;
    for (int c = 0; c < 2; ++c) {
      low[c] = at[c] < low[c] ? at[c] : low[c];
      high[c] = at[c] > high[c] ? at[c] : high[c];
    }
  }
  for (int c = 0; c < 2; ++c) {
    if (low[c] > 1.0 || high[c] < -1.0)
      return false;
    low[c] = low[c] > -1.0 ? low[c] : -1.0;
    high[c] = high[c] < 1.0 ? high[c] : 1.0;
  }
  return true;
}

/* The same once mark_faces has told which faces a cell has a part on. */
static bool cover(double low[2], double high[2], const fg__sphere *sphere, size_t n,
                  int f)
{
  return (sphere->faces[n] >> f & 1) && cover_all(low, high, sphere, n, f);
}

/* The face that a cell lies inside of, with all of its corners; -1 for more than one. */
static int only_face(const fg__sphere *sphere, size_t n)
{
  int point[4];
  const int corners = fg__sphere_corners(sphere, n, point);
  const int face = face_of(position_of(sphere, point[0])), axis = face / 2;
  for (int k = 0; k < corners; ++k) {
    const double *up = position_of(sphere, point[k]);
    const double height = face & 1 ? -up[axis] : up[axis];
    if (!(fabs(up[(axis + 1) % 3]) < height && fabs(up[(axis + 2) % 3]) < height))
      return -1;
  }
  return face;
}

static void mark_faces(fg__sphere *sphere)
{
  for (size_t n = 0; n < sphere->count; ++n) {
    const int only = only_face(sphere, n);
    unsigned marks = only >= 0 ? 1U << only : 0U;
    double low[2], high[2];
    for (int f = 0; f < FG__SPHERE_FACES && only < 0; ++f)
      marks |= cover_all(low, high, sphere, n, f) ? 1U << f : 0U;
    sphere->faces[n] = (unsigned char)marks;
  }
}

static int clamped(double x, int count)
{
  if (!(x > 0.0))
    return 0;
  return x < count ? (int)x : count - 1;
}

/* First and last square along each axis that a rectangle may have a part in. */
static void squares_of(int first[2], int last[2], const fg__sphere_face *face,
                       const double low[2], const double high[2])
{
  for (int c = 0; c < 2; ++c) {
    const int count = c == 0 ? face->columns : face->rows;
    const double from = (low[c] - face->low[c]) * face->inverse[c];
    const double to = (high[c] - face->low[c]) * face->inverse[c];
    const double slack = ROUNDING * (to - from + 1.0);
    first[c] = clamped(from - slack, count);
    last[c] = clamped(to + slack, count);
  }
}

typedef struct face_sum {
  size_t cells;
  double width[2]; /* of all cells */
} face_sum;

/* Squares of the mean cell's size, but no more than twice as many as cells. */
static void divide(fg__sphere_face *face, const face_sum *sum)
{
  double side[2], squares = 1.0;
  for (int c = 0; c < 2; ++c) {
    const double length = face->high[c] - face->low[c];
    const double mean = sum->width[c] / (double)sum->cells;
    side[c] = mean > 0.0 ? ceil(length / mean) : 1.0;
    squares *= side[c];
  }
  const double most = 2.0 * (double)sum->cells + 1.0;
  const double factor = squares > most ? sqrt(most / squares) : 1.0;
  for (int c = 0; c < 2; ++c) {
    const double length = face->high[c] - face->low[c];
    const int count = 1 + clamped(side[c] * factor, MOST_SQUARES);
    *(c == 0 ? &face->columns : &face->rows) = count;
    face->inverse[c] = length > 0.0 ? count / length : 1.0;
  }
}

/* Counts each square's cells, or once there is room for them puts them in, from
 * start[n + 1] downwards. Returns in how many squares cells lie, all in all. */
static uint64_t visit_squares(fg__sphere *sphere, int f)
{
  fg__sphere_face *face = &sphere->face[f];
  uint64_t entries = 0;
  for (size_t n = 0; n < sphere->count; ++n) {
    double low[2], high[2];
    int first[2], last[2];
    if (!cover(low, high, sphere, n, f))
      continue;
    squares_of(first, last, face, low, high);
    entries += (uint64_t)(last[0] - first[0] + 1) * (uint64_t)(last[1] - first[1] + 1);
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        uint32_t *start = &face->start[(size_t)j * (size_t)face->columns + (size_t)i];
        if (face->cell)
          face->cell[--*start] = (int)n;
        else
          ++*start;
      }
  }
  return entries;
}

static size_t squares_in(const fg__sphere_face *face)
{
  return (size_t)face->columns * (size_t)face->rows;
}

/* Counts the squares' cells. Squares become larger where cells of very different sizes
 * would lie in too many. */
static uint64_t count_in_squares(fg__sphere *sphere, int f, size_t cells)
{
  fg__sphere_face *face = &sphere->face[f];
  uint64_t entries;
  while ((entries = visit_squares(sphere, f)) > (uint64_t)MOST_ENTRIES * cells) {
    memset(face->start, 0, squares_in(face) * sizeof *face->start);
    for (int c = 0; c < 2; ++c) {
      int *count = c == 0 ? &face->columns : &face->rows;
      face->inverse[c] *= (double)((*count + 1) / 2) / *count;
      *count = (*count + 1) / 2;
    }
  }
  return entries;
}

/* Returns how many cells lie on it. */
static size_t outline_face(fg__sphere *sphere, int f)
{
  fg__sphere_face *face = &sphere->face[f];
  face_sum sum = {0};
  for (size_t n = 0; n < sphere->count; ++n) {
    double low[2], high[2];
    if (!cover(low, high, sphere, n, f))
      continue;
    for (int c = 0; c < 2; ++c) {
      face->low[c] = sum.cells == 0 || low[c] < face->low[c] ? low[c] : face->low[c];
      face->high[c] = sum.cells == 0 || high[c] > face->high[c] ? high[c] : face->high[c];
      sum.width[c] += high[c] - low[c];
    }
    ++sum.cells;
  }
  if (sum.cells > 0)
    divide(face, &sum);
  return sum.cells;
}

static fg_status sort_face(fg__sphere *sphere, fg_context *context, int f)
{
  fg__sphere_face *face = &sphere->face[f];
  const size_t cells = outline_face(sphere, f);
  if (cells == 0)
    return FG_STATUS_OK;
  const size_t most = squares_in(face) + 1;
  face->start = fg__allocate(most, sizeof *face->start);
  if (!face->start)
    return fg__fail_memory(context, "squares of the sphere", most * sizeof *face->start);
  const uint64_t entries = count_in_squares(sphere, f, cells);
  face->cell =
      entries < UINT32_MAX ? fg__allocate((size_t)entries, sizeof *face->cell) : NULL;
  if (!face->cell)
    return fg__fail_memory(context, "the squares' cells",
                           (size_t)entries * sizeof *face->cell);
  for (size_t n = 1; n <= squares_in(face); ++n)
    face->start[n] += face->start[n - 1];
  visit_squares(sphere, f);
  return FG_STATUS_OK;
}

fg_status fg__sphere_sort_cells(fg__sphere *sphere, fg_context *context)
{
  fg_status status = FG_STATUS_OK;
  sphere->faces = fg__allocate(sphere->count, 1);
  if (!sphere->faces)
    return fg__fail_memory(context, "faces of cells", sphere->count);
  mark_faces(sphere);
  for (int f = 0; f < FG__SPHERE_FACES && status == FG_STATUS_OK; ++f)
    status = sort_face(sphere, context, f);
  free(sphere->faces);
  sphere->faces = NULL;
  return status;
}

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
    const double *p = position_of(sphere, point[k]);
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
  return s >= -ROUNDING && s <= 1.0 + ROUNDING;
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
  const int f = face_of(up);
  const fg__sphere_face *face = &sphere->face[f];
  double at[2];
  int square[2];
  if (face->columns == 0 || !project(at, up, f))
    return false;
  for (int c = 0; c < 2; ++c) {
    const double slack = ROUNDING * (face->high[c] - face->low[c]);
    if (at[c] < face->low[c] - slack || at[c] > face->high[c] + slack)
      return false;
    square[c] = clamped((at[c] - face->low[c]) * face->inverse[c],
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
