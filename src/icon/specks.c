#include "icon/specks.h"

#include "icon/measure.h"

#include "base/context.h"
#include "base/memory.h"
#include "solid/make.h"

#include <math.h>
#include <stdlib.h>

/* Clusters vanish by shrinking, and one that is about to leaves a speck. Shares of the
 * median length and of the mean area; docs/method/icons.md has what they take away. */
static const double SHORT = 0.3;
static const double SMALL = 0.25;

/* One that is farther than this many roots of the mean area from all others is the only
 * arrow of an inlet or of an enclosed sea: it stays. */
static const double MISSED = 1.0;

static int compare_lengths(const void *a, const void *b)
{
  double one = *(const double *)a, other = *(const double *)b;
  return (one > other) - (one < other);
}

/* From the nearer end of a speck to the nearest point of another's centreline. */
static double distance_between(const fg_icon *speck, const fg_icon *other)
{
  double nearest = HUGE_VAL;
  for (int end = 0; end < 2; end++) {
    const double *p = speck->points[end ? speck->point_count - 1 : 0];
    for (int i = 0; i < other->point_count; i++)
      nearest =
          fmin(nearest, hypot(other->points[i][0] - p[0], other->points[i][1] - p[1]));
  }
  return nearest;
}

/* Whether an arrow that stays, or may stay, lies near. */
static bool has_neighbour(const fg_icon *icon, int count, int speck, double reach)
{
  for (int n = 0; n < count; n++)
    if (n != speck && icon[n].points && distance_between(&icon[speck], &icon[n]) < reach)
      return true;
  return false;
}

fg_status fg__icons_drop_specks(fg_icon *icon, fg_context *context, int count)
{
  double area = 0.0;
  int drawn = 0;
  double *length = fg__allocate((size_t)count, sizeof *length);
  if (count > 0 && !length)
    return fg__fail_memory(context, "the arrows' lengths",
                           (size_t)count * sizeof *length);
  for (int n = 0; n < count; n++)
    if (icon[n].points) {
      length[drawn++] = fg__icon_length(&icon[n]);
      area += icon[n].area;
    }
  if (drawn > 0) {
    qsort(length, (size_t)drawn, sizeof *length, compare_lengths);
    double least_length = SHORT * length[drawn / 2];
    double least_area = SMALL * area / drawn, reach = MISSED * sqrt(area / drawn);
    for (int n = 0; n < count; n++)
      if (icon[n].points && icon[n].area < least_area &&
          fg__icon_length(&icon[n]) < least_length &&
          has_neighbour(icon, count, n, reach))
        fg__solid_icon_free(&icon[n]);
  }
  free(length);
  return FG_STATUS_OK;
}
