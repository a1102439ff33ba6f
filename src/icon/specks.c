#include "icon/specks.h"

#include "icon/measure.h"

#include "base/context.h"
#include "base/memory.h"
#include "solid/make.h"

#include <stdlib.h>

/* Clusters vanish by shrinking, and one that is about to leaves a speck. Shares of the
 * median length and of the mean area; docs/method/icons.md has what they take away. */
static const double SHORT = 0.3;
static const double SMALL = 0.25;

static int compare_lengths(const void *a, const void *b)
{
  double one = *(const double *)a, other = *(const double *)b;
  return (one > other) - (one < other);
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
    double least_area = SMALL * area / drawn;
    for (int n = 0; n < count; n++)
      if (icon[n].points && icon[n].area < least_area &&
          fg__icon_length(&icon[n]) < least_length)
        fg__solid_icon_free(&icon[n]);
  }
  free(length);
  return FG_STATUS_OK;
}
