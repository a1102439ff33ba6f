/* The fewest icons within an error. */
#include "place/placement.h"

#include <math.h>

/* The error shall be at most this share of the tolerance: other programs that score
 * the same arrows differ by up to half a per cent, in where a line is sampled. */
static const double MARGIN = 0.99;

/* Where the search for a number of icons begins. */
enum { FEWEST = 4 };

/* The least error so far, and of how many icons that was. */
typedef struct best {
  int count;
  double error;
} best;

/* Places `count` icons anew and scores them. Where fewer fit the error is infinite, and
 * *least is that of those that do. */
static fg_status measure(fg_placement *placement, int count, double *error, best *least)
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
  *error = HUGE_VAL;
  if (status == FG_STATUS_OK) {
    if (fg_icons_count(icons) == count)
      *error = score.mean;
    if (score.mean < least->error)
      *least = (best){fg_icons_count(icons), score.mean};
  }
  fg_icons_destroy(icons);
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
  best least = {0, HUGE_VAL};
  fg_status status = measure(placement, enough, &error, &least);
  const double wanted = MARGIN * degrees;
  while (status == FG_STATUS_OK && error > wanted && enough < most) {
    below = enough;
    enough = 2 * enough < most ? 2 * enough : most;
    status = measure(placement, enough, &error, &least);
  }
  if (status == FG_STATUS_OK && error > wanted)
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "no number of arrows has a mean direction error of at most %g "
                      "degrees: that of %d is %.3g",
                      degrees, least.count, least.error);
  while (status == FG_STATUS_OK && enough - below > 1) {
    int middle = below + (enough - below) / 2;
    status = measure(placement, middle, &error, &least);
    if (error <= wanted)
      enough = middle;
    else
      below = middle;
  }
  if (status == FG_STATUS_OK)
    status = measure(placement, enough, &error, &least);
  *count = enough;
  return status;
}
