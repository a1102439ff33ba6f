#include "icon/arc_samples.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Samples of a line in 2D. The head of an arrow at least a thirtieth as wide as long is a
 * tenth of it long: 16 samples on the longest lines. */
enum { FEWEST_SAMPLES = 40, MOST_SAMPLES = 160, CLEARANCE_BISECTIONS = 4 };
static const double SAMPLE_SPACING = 0.5; /* in spacings of the density */

double fg__interior_distance(const fg__interior *interior, const double position[])
{
  const fg__window *window = interior->window;
  if (window->dimension == 3)
    return fg__window_value(window, interior->distance, position);
  int at[3];
  double share[3];
  fg__window_find(window, position, at, share);
  const double *low = interior->distance + fg__window_node(window, at[0], at[1], 0);
  const double *high = low + window->nodes[0];
  double bottom = low[0] + (low[1] - low[0]) * share[0];
  double top = high[0] + (high[1] - high[0]) * share[0];
  return bottom + (top - bottom) * share[1];
}

bool fg__interior_has(const fg__interior *interior, double x, double y)
{
  double point[2] = {x, y};
  return fg__window_level(interior->window, point) > 0;
}

/* Free way from a point along a direction, at most `reach`; the first `known` of it is.
 */
static double find_clearance(const fg__interior *interior, const double position[2],
                             double dx, double dy, double known, double reach)
{
  double inside = fmax(known, 0), outside = inside;
  while (inside < reach) {
    outside = inside + interior->spacing / 2;
    if (!fg__interior_has(interior, position[0] + outside * dx,
                          position[1] + outside * dy))
      break;
    inside = outside;
  }
  if (inside >= reach)
    return reach;
  for (int i = 0; i < CLEARANCE_BISECTIONS; i++) {
    double middle = (inside + outside) / 2;
    if (fg__interior_has(interior, position[0] + middle * dx, position[1] + middle * dy))
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

static double angle_between(const double a[2], const double b[2])
{
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

fg_status fg__arc_samples_place(fg__arc_samples *samples, fg_context *context,
                                const fg__streamline *line, int intervals)
{
  double length = fg__streamline_length(line);
  size_t count = (size_t)intervals + 1;
  if (!fg__grow((void **)&samples->sample, &samples->capacity, count,
                sizeof *samples->sample))
    return fg__fail_memory(context, "an arrow", count * sizeof *samples->sample);
  samples->count = intervals + 1;
  samples->step = length / intervals;
  int hint = 0;
  for (int i = 0; i < samples->count; i++) {
    fg__arc_sample *sample = &samples->sample[i];
    sample->s = length * i / intervals;
    sample->turning =
        fg__streamline_at(line, sample->s, &hint, sample->position, sample->tangent);
  }
  return FG_STATUS_OK;
}

fg_status fg__arc_samples_place_flat(fg__arc_samples *samples, fg_context *context,
                                     const fg__streamline *line,
                                     const fg__interior *interior, double reach)
{
  double wanted =
      ceil(fg__streamline_length(line) / (SAMPLE_SPACING * interior->spacing));
  int intervals = (int)fmin(fmax(wanted, FEWEST_SAMPLES), MOST_SAMPLES);
  fg_status status = fg__arc_samples_place(samples, context, line, intervals);
  if (status != FG_STATUS_OK)
    return status;
  reach += interior->margin;
  for (int i = 0; i < samples->count; i++) {
    fg__arc_sample *sample = &samples->sample[i];
    sample->turning =
        i > 0 ? sample[-1].turning + angle_between(sample[-1].tangent, sample->tangent)
              : 0;
    double known = fg__interior_distance(interior, sample->position) -
                   FG__DISTANCE_ERROR * interior->spacing;
    double free_way = reach;
    if (known < reach) {
      double dx = -sample->tangent[1], dy = sample->tangent[0];
      free_way = find_clearance(interior, sample->position, dx, dy, known, reach);
      free_way = find_clearance(interior, sample->position, -dx, -dy, known, free_way);
    }
    sample->clearance = free_way - interior->margin;
  }
  return FG_STATUS_OK;
}

void fg__arc_samples_bend(fg__arc_samples *samples, double width)
{
  fg__arc_sample *sample = samples->sample;
  int last = samples->count - 1;
  int reach = (int)lround(width / samples->step);
  reach = reach < 1 ? 1 : reach;
  samples->bend_window = 2 * reach * samples->step;
  double sum = 0;
  for (int i = 0; i <= last; i++) {
    int before = i > reach ? i - reach : 0, after = i + reach < last ? i + reach : last;
    sample[i].bend = fabs(sample[after].turning - sample[before].turning);
    sample[i].bend_sum = sum;
    sum += sample[i].bend * sample[i].bend;
  }
}

void fg__arc_samples_clear(fg__arc_samples *samples)
{
  free(samples->sample);
  *samples = (fg__arc_samples){0};
}
