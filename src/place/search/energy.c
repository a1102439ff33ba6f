/* The energy of a placement (docs/method/placement.md). */
#include "place/search/search.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The readers' error counts by its own size, but not below this many degrees: where most
 * of the field is reconstructed well, icons would gather in what is left. 8 raises the
 * mean error at free lengths by 1 %. */
static const double LEAST_ERROR = 5.0;

/* Shorter than this many lambda costs nu times the square of what is missing. */
static const double BRIEF = 0.8;

/* Lines nearer than this many lambda touch: 0.1 and a little, for between its samples a
 * line may be nearer. */
static const float TOUCHING = 0.11F;

/* exp(-x) for x >= 0 as (1 - x / 8)^8: the same bits everywhere, and 0 from 8 on. */
static double decay(double x)
{
  double f = 1.0 - x / 8.0;
  f = f > 0.0 ? f * f : 0.0;
  return f * f * f * f;
}

/* A head that touches another arrow's tail makes one arrow of two. */
static double end_penalty(const fg__place_scale *scale, float square)
{
  double near =
      fg__most(0.0, 1.0 - sqrt((double)square) * scale->lambda / scale->end_gap);
  return scale->ends * near * near;
}

/* A line that touches another one. */
static double touch_penalty(const fg__place_scale *scale, float square)
{
  double near =
      fg__most(0.0, 1.0 - sqrt((double)square) * scale->lambda / scale->touch_gap);
  return scale->touch * near * near;
}

double fg__place_line_penalty(const fg__place_scale *scale, const fg__place_points *near,
                              const fg__place_line *line)
{
  double range = scale->crowd_range / scale->lambda, crowd = 0.0, ends = 0.0;
  double sampling = scale->sampling / scale->lambda,
         length = line->length / scale->lambda;
  float square[FG__PLACE_SAMPLES];
  fg__place_points_nearest(square, near, line);
  for (int n = 0; n < line->count; ++n)
    crowd += (double)line->share[n] * sampling *
             (2.0 * scale->crowding * decay((double)square[n] / (2.0 * range * range)) +
              touch_penalty(scale, square[n]));
  if (line->count > 0)
    ends = end_penalty(scale, square[0]) + end_penalty(scale, square[line->count - 1]);
  double brief = fg__most(0.0, BRIEF - length);
  return crowd + ends + scale->brevity * brief * brief + scale->ink * length;
}

fg_status fg__place_gather_whole(fg__place_search *search)
{
  fg__place_box all = {{0}, {0}};
  memcpy(all.size, search->raster.cells, sizeof all.size);
  return fg__place_check(search, fg__place_gather(&search->own, &all, -1));
}

fg_status fg__place_error(fg__place_search *search, double *error)
{
  fg_status status = fg__place_gather_whole(search);
  if (status == FG_STATUS_OK)
    status = fg__place_diffusion_solve(&search->diffusion, search->context, false);
  if (status != FG_STATUS_OK)
    return status;
  fg__place_weights errors = {1.0F, 0.0F, (float)fg__place_reach(search)};
  const fg__place_contribution *all = &search->own.others;
  double sum = fg__place_cost(NULL, &search->raster, &all->box, all, NULL, &errors);
  sum += search->scale.diffusion * fg__place_diffusion_sum(&search->diffusion);
  *error = sum / search->scale.count / (2.0 + search->scale.diffusion);
  return FG_STATUS_OK;
}

fg_status fg__place_touching(fg__place_search *search, double *share)
{
  fg_status status = FG_STATUS_OK;
  double touching = 0.0, all = 0.0;
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n) {
    const fg__place_icon *icon = search->icon[n];
    const fg__place_line *line = &icon->line;
    float square[FG__PLACE_SAMPLES];
    status = fg__place_check(
        search, fg__place_find_near(&search->own, &icon->contribution.box, n));
    if (status != FG_STATUS_OK)
      break;
    fg__place_points_nearest(square, &search->own.beside, line);
    for (int i = 0; i < line->count; ++i) {
      all += (double)line->share[i];
      touching += square[i] < TOUCHING * TOUCHING ? (double)line->share[i] : 0.0;
    }
  }
  *share = all > 0.0 ? touching / all : 0.0;
  return status;
}

fg_status fg__place_set_reference_error(fg__place_search *search)
{
  fg_status status = fg__place_error(search, &search->reference_error);
  if (status != FG_STATUS_OK)
    return status;
  search->reference_error = fg__most(search->reference_error, LEAST_ERROR);
  search->weights.inverse_error = (float)(1.0 / search->reference_error);
  for (int n = 0; n < search->count; ++n)
    search->icon[n]->has_removal_cost = false;
  return FG_STATUS_OK;
}

fg_status fg__place_energy(fg__place_search *search, double *energy)
{
  fg_status status = fg__place_gather_whole(search);
  if (status == FG_STATUS_OK)
    status = fg__place_diffusion_solve(&search->diffusion, search->context, true);
  const fg__place_contribution *all = &search->own.others;
  *energy = 0.0;
  if (status == FG_STATUS_OK)
    *energy =
        fg__place_cost(NULL, &search->raster, &all->box, all, NULL, &search->weights) +
        search->scale.diffusion * (double)search->weights.inverse_error *
            fg__place_diffusion_sum(&search->diffusion);
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n) {
    fg__place_icon *icon = search->icon[n];
    status = fg__place_check(
        search, fg__place_find_near(&search->own, &icon->contribution.box, n));
    if (status == FG_STATUS_OK) /* both of a pair pay */
      *energy += fg__place_line_penalty(&search->scale, &search->own.beside, &icon->line);
  }
  return status;
}
