/* The fewest icons within an error. */
#include "place/placement.h"

#include <math.h>

/* Where the search for a number of icons begins. */
enum { FEWEST = 4 };

/* Places `count` icons anew and asks the readers. */
static fg_status measure(fg_placement *placement, int count, double *error)
{
  fg_context *context = fg__placement_context(placement);
  fg_icons *icons = NULL;
  fg_score score;
  fg_score_options options = {.lengths = FG_SCORE_FREE, .readers_only = true};
  fg_status status = fg__placement_begin_again(placement, count);
  if (status == FG_STATUS_OK)
    status = fg_placement_icons(&icons, placement);
  if (status == FG_STATUS_OK)
    status =
        fg_icons_score(&score, context, fg__placement_field(placement), icons, &options);
  fg_icons_destroy(icons);
  *error = status == FG_STATUS_OK ? score.mean : HUGE_VAL;
  return status;
}

fg_status fg_placement_within(fg_placement *placement, double degrees, int most,
                              int *count)
{
  fg_context *context = placement ? fg__placement_context(placement) : NULL;
  if (!placement || !count || !(degrees > 0.0) || most < 1)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "placement: %g degrees with at most %d arrows", degrees, most);
  int below = 0, enough = FEWEST < most ? FEWEST : most;
  double error;
  fg_status status = measure(placement, enough, &error);
  while (status == FG_STATUS_OK && error > degrees && enough < most) {
    below = enough;
    enough = 2 * enough < most ? 2 * enough : most;
    status = measure(placement, enough, &error);
  }
  if (status == FG_STATUS_OK && error > degrees)
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "the field can not be read within %g degrees: with %d arrows it is "
                      "read within %.1f",
                      degrees, enough, error);
  while (status == FG_STATUS_OK && enough - below > 1) {
    int middle = below + (enough - below) / 2;
    status = measure(placement, middle, &error);
    if (error <= degrees)
      enough = middle;
    else
      below = middle;
  }
  if (status == FG_STATUS_OK)
    status = measure(placement, enough, &error);
  *count = enough;
  return status;
}
