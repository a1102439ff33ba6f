#include "solid/frame.h"

#include <string.h>

#include "base/vector.h"

/* Second order at points that are unevenly apart: the parabola through three of them. */
static void find_tangent(const double (*point)[3], int count, int n, double tangent[3])
{
  int middle = n < 1 ? 1 : n > count - 2 ? count - 2 : n;
  double before[3], after[3];
  if (count == 2) {
    fg__subtract(point[1], point[0], tangent);
    fg__normalise(tangent);
    return;
  }
  fg__subtract(point[middle], point[middle - 1], before);
  fg__subtract(point[middle + 1], point[middle], after);
  double a = fg__length(before), b = fg__length(after);
  /* slopes of the two pieces, weighed for where on the parabola the point lies */
  double share = n < middle ? 1 + a / (a + b) : n > middle ? -b / (a + b) : b / (a + b);
  for (int k = 0; k < 3; ++k)
    tangent[k] = share * before[k] / a + (1 - share) * after[k] / b;
  if (!fg__normalise(tangent)) {
    memcpy(tangent, before, 3 * sizeof *tangent);
    fg__normalise(tangent);
  }
}

/* Reflects a vector in the plane across `axis`. */
static void reflect(const double axis[3], double vector[3])
{
  double square = fg__dot(axis, axis);
  if (square > 0)
    fg__add_scaled(vector, -2 * fg__dot(axis, vector) / square, axis, vector);
}

void fg__frame_along(const double (*point)[3], int count, double (*tangent)[3],
                     double (*normal)[3])
{
  for (int n = 0; n < count; ++n)
    find_tangent(point, count, n, tangent[n]);
  fg__any_normal(tangent[0], normal[0]);
  for (int n = 0; n + 1 < count; ++n) {
    double across[3], turned[3], rest[3];
    fg__subtract(point[n + 1], point[n], across);
    memcpy(normal[n + 1], normal[n], sizeof normal[n]);
    memcpy(turned, tangent[n], sizeof turned);
    reflect(across, normal[n + 1]);
    reflect(across, turned);
    fg__subtract(tangent[n + 1], turned, rest);
    reflect(rest, normal[n + 1]);
    /* rounding must not add up along a line of thousands of points */
    fg__add_scaled(normal[n + 1], -fg__dot(normal[n + 1], tangent[n + 1]), tangent[n + 1],
                   normal[n + 1]);
    if (!fg__normalise(normal[n + 1]))
      fg__any_normal(tangent[n + 1], normal[n + 1]);
  }
}
