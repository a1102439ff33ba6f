#include "picture/polygons.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* Vertices that one straight piece may replace: keeps simplification linear in the number
 * of vertices, and a straight boundary costs one vertex in so many. */
enum { LONGEST_SKIP = 200 };

void fg__polygons_clear(fg__polygons *polygons)
{
  free(polygons->point);
  free(polygons->start);
  *polygons = (fg__polygons){0};
}

bool fg__polygons_begin(fg__polygons *polygons)
{
  void *start = polygons->start;
  if (!fg__grow(&start, &polygons->start_capacity, polygons->count + 2,
                sizeof *polygons->start))
    return false;
  polygons->start = start;
  polygons->start[polygons->count++] = polygons->point_count;
  polygons->start[polygons->count] = polygons->point_count;
  return true;
}

bool fg__polygons_add(fg__polygons *polygons, const double point[2])
{
  void *points = polygons->point;
  if (!fg__grow(&points, &polygons->point_capacity, polygons->point_count + 1,
                sizeof *polygons->point))
    return false;
  polygons->point = points;
  polygons->point[polygons->point_count][0] = point[0];
  polygons->point[polygons->point_count][1] = point[1];
  polygons->start[polygons->count] = ++polygons->point_count;
  return true;
}

void fg__polygons_drop_last(fg__polygons *polygons)
{
  polygons->point_count = polygons->start[--polygons->count];
}

double fg__polygon_area(const fg__polygons *polygons, size_t loop)
{
  size_t first = polygons->start[loop], end = polygons->start[loop + 1];
  double twice = 0.0;
  /* Relative to the first vertex: coordinates of 1e6 would cost half the digits. */
  const double *origin = polygons->point[first];
  for (size_t n = first; n + 1 < end; ++n) {
    const double *a = polygons->point[n], *b = polygons->point[n + 1];
    twice +=
        (a[0] - origin[0]) * (b[1] - origin[1]) - (b[0] - origin[0]) * (a[1] - origin[1]);
  }
  return 0.5 * twice;
}

static double distance_to_piece(const double p[2], const double a[2], const double b[2])
{
  double dx = b[0] - a[0], dy = b[1] - a[1];
  double length2 = dx * dx + dy * dy;
  double along =
      length2 > 0.0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2 : 0.0;
  along = fmin(fmax(along, 0.0), 1.0);
  return hypot(p[0] - a[0] - along * dx, p[1] - a[1] - along * dy);
}

static bool piece_suffices(double (*point)[2], size_t from, size_t to, double tolerance)
{
  for (size_t n = from + 1; n < to; ++n)
    if (distance_to_piece(point[n], point[from], point[to]) > tolerance)
      return false;
  return true;
}

void fg__polygons_simplify(fg__polygons *polygons, double tolerance)
{
  size_t kept = 0;
  for (size_t loop = 0; loop < polygons->count; ++loop) {
    size_t first = polygons->start[loop], end = polygons->start[loop + 1];
    polygons->start[loop] = kept;
    size_t at = first;
    while (at < end) {
      double x = polygons->point[at][0], y = polygons->point[at][1];
      size_t next = at + 1;
      while (next + 1 < end && next - at < LONGEST_SKIP &&
             piece_suffices(polygons->point, at, next + 1, tolerance))
        ++next;
      /* Vertices before `at` are never looked at again, so they may be overwritten. */
      polygons->point[kept][0] = x;
      polygons->point[kept++][1] = y;
      at = next;
    }
  }
  if (polygons->count)
    polygons->start[polygons->count] = kept;
  polygons->point_count = kept;
}
