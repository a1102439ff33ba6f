/* What icons of a scale become in the next one. */
#include "icon/icons.h"
#include "place/placement.h"

#include <math.h>

/* Square of the distance from a point to a line, lambda. */
static double distance_to(const fg__place_search *search, const fg__place_line *line,
                          const double point[3])
{
  double least = HUGE_VAL;
  for (int n = 0; n < line->count; ++n) {
    double square = 0.0;
    for (int k = 0; k < search->scale.dimension; ++k) {
      double way = (point[k] - search->scale.origin[k]) / search->scale.lambda -
                   (double)line->position[k][n];
      square += way * way;
    }
    least = fmin(least, square);
  }
  return least;
}

static int parent_of(const fg__place_search *search, const fg_icon *icon)
{
  double least = HUGE_VAL;
  int parent = 0;
  for (int n = 0; n < search->count; ++n) {
    const fg__place_icon *placed = search->icon[n];
    if (placed->identity + 1 == icon->id)
      return icon->id;
    double square = distance_to(search, &placed->line, icon->seed);
    if (square < least) {
      least = square;
      parent = placed->identity + 1;
    }
  }
  return parent;
}

void fg_placement_find_parents(const fg_placement *placement, fg_icons *finer)
{
  for (int n = 0; n < fg_icons_count(finer); ++n) {
    fg_icon *icon = fg__icons_change(finer, n);
    icon->parent = parent_of(fg__placement_search(placement), icon);
  }
}
