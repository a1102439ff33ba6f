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

bool fg__polygon_contains(const fg__polygons *polygons, size_t loop, double x, double y)
{
  const size_t first = polygons->start[loop], end = polygons->start[loop + 1];
  bool inside = false;
  for (size_t n = first; n < end; ++n) {
    const double *a = polygons->point[n];
    const double *b = polygons->point[n + 1 < end ? n + 1 : first];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
      inside = !inside;
  }
  return inside;
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

/* Points of a loop, a step apart and closed. Returns how many, 0 where a loop is shorter
 * than three steps; SIZE_MAX: no memory. */
static size_t resample(double (**out)[2], const fg__polygons *from, size_t loop,
                       double step)
{
  const size_t first = from->start[loop], end = from->start[loop + 1];
  double length = 0.0, passed = 0.0;
  for (size_t n = first; n < end; ++n) {
    const double *a = from->point[n], *b = from->point[n + 1 < end ? n + 1 : first];
    length += hypot(b[0] - a[0], b[1] - a[1]);
  }
  const size_t count = (size_t)(length / step);
  *out = NULL;
  if (count < 3)
    return 0;
  *out = fg__allocate(count, sizeof **out);
  if (!*out)
    return SIZE_MAX;
  size_t made = 0;
  for (size_t n = first; n < end && made < count; ++n) {
    const double *a = from->point[n], *b = from->point[n + 1 < end ? n + 1 : first];
    const double piece = hypot(b[0] - a[0], b[1] - a[1]);
    for (double at = (double)made * length / (double)count - passed;
         at < piece && made < count;
         at = (double)++made * length / (double)count - passed)
      for (int k = 0; k < 2; ++k)
        (*out)[made][k] = a[k] + (b[k] - a[k]) * at / piece;
    passed += piece;
  }
  return made;
}

static bool is_on_box(const double point[2], double slack, const double low[2],
                      const double high[2])
{
  for (int k = 0; k < 2; ++k)
    if (point[k] < low[k] + slack || point[k] > high[k] - slack)
      return true;
  return false;
}

/* Each turn is a mean with weights 1/4, 1/2, 1/4. */
static void average(double (*point)[2], size_t count, double slack, const double low[2],
                    const double high[2])
{
  const double first[2] = {point[0][0], point[0][1]};
  double before[2] = {point[count - 1][0], point[count - 1][1]};
  for (size_t n = 0; n < count; ++n) {
    const double here[2] = {point[n][0], point[n][1]};
    const double *after = n + 1 < count ? point[n + 1] : first;
    for (int k = 0; k < 2 && !is_on_box(here, slack, low, high); ++k)
      point[n][k] = 0.25 * before[k] + 0.5 * here[k] + 0.25 * after[k];
    before[0] = here[0];
    before[1] = here[1];
  }
}

bool fg__polygons_add_smooth(fg__polygons *polygons, const fg__polygons *from,
                             double distance, const double low[2], const double high[2])
{
  enum { TURNS = 18 }; /* a standard deviation of three steps: `distance` */
  const double step = distance / 3.0;
  bool good = true;
  for (size_t loop = 0; loop < from->count && good; ++loop) {
    double(*point)[2];
    const size_t count = resample(&point, from, loop, step);
    good = count != SIZE_MAX && (count == 0 || fg__polygons_begin(polygons));
    for (int turn = 0; turn < TURNS && good && count > 0; ++turn)
      average(point, count, 0.5 * step, low, high);
    for (size_t n = 0; n < count && good; ++n)
      good = fg__polygons_add(polygons, point[n]);
    free(point);
  }
  return good;
}
