/* Where a new icon would lower the energy most. */
#include "place/search/peaks.h"
#include "place/search/search.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Places that are tried for a new icon are at least this far apart in lambda, or with
 * offsets along the axes; the error is smoothed by this many passes of 1 2 1 (lambda/4 on
 * cells of lambda/8). */
enum { PASSES = 2 };
static const double APART = 0.5;
static const double OFFSET = 0.25;

/* How many of FG__PLACE_CANDIDATES, the best, are tried beside their places, too. */
enum { MOVED = 8 };

/* Errors beside a line do not call for another one: they count by d^2 / (d^2 + this), d
 * the distance in lambda. Rough coasts would draw all new icons else. */
static const float BESIDE = 0.04F;

static void smooth_axis(float *out, const float *in, const fg__place_raster *raster,
                        int k)
{
  size_t stride = 1, n = 0;
  for (int j = 0; j < k; ++j)
    stride *= (size_t)raster->cells[j];
  for (int z = 0; z < raster->cells[2]; ++z)
    for (int y = 0; y < raster->cells[1]; ++y)
      for (int x = 0; x < raster->cells[0]; ++x, ++n) {
        int at = k == 0 ? x : k == 1 ? y : z;
        float before = at > 0 ? in[n - stride] : in[n];
        float after = at + 1 < raster->cells[k] ? in[n + stride] : in[n];
        out[n] = 0.25F * (before + 2.0F * in[n] + after);
      }
}

static void smooth_map(fg__place_search *search)
{
  for (int pass = 0; pass < PASSES; ++pass)
    for (int k = 0; k < search->raster.dimension; ++k) {
      smooth_axis(search->smooth, search->map, &search->raster, k);
      float *kept = search->map;
      search->map = search->smooth;
      search->smooth = kept;
    }
}

/* The raster's cell with the largest value, which and those near it are then struck out;
 * false when all are. */
static bool take_maximum(fg__place_search *search, fg__place_peaks *peaks,
                         float position[3])
{
  const fg__place_raster *raster = &search->raster;
  size_t best;
  if (!(fg__place_peaks_top(&best, peaks) > 0.0F))
    return false;
  int low[3], high[3], apart = (int)(APART / (double)raster->cell + 0.5);
  for (int k = 0; k < 3; ++k) {
    int at = (int)(best % (size_t)raster->cells[k]);
    best /= (size_t)raster->cells[k];
    position[k] = ((float)at + 0.5F) * raster->cell;
    low[k] = at > apart ? at - apart : 0;
    high[k] = at + apart < raster->cells[k] ? at + apart + 1 : raster->cells[k];
  }
  for (int z = low[2]; z < high[2]; ++z)
    for (int y = low[1]; y < high[1]; ++y)
      for (int x = low[0]; x < high[0]; ++x)
        search->map[((size_t)z * (size_t)raster->cells[1] + (size_t)y) *
                        (size_t)raster->cells[0] +
                    (size_t)x] = 0.0F;
  fg__place_peaks_renew(peaks, low, high);
  return true;
}

/* How much a new icon at a candidate's seed lowers the energy; search->own holds the
 * contribution of all icons and their samples. */
static fg_status try_seed(fg__place_worker *worker, fg__place_candidate *out)
{
  const fg__place_search *search = worker->search;
  const fg__place_contribution *all = &search->own.others;
  fg__place_line line;
  out->fall = -HUGE_VAL;
  fg__place_trace(&line, search->domain, &search->scale, &out->seed);
  if (line.count == 0)
    return FG_STATUS_OK;
  fg_status status = fg__place_contribution_compute(&worker->trial, NULL, &search->raster,
                                                    &search->scale, &line);
  if (status != FG_STATUS_OK)
    return status;
  const fg__place_box *box = &worker->trial.box;
  double before = fg__place_cost(NULL, &search->raster, box, all, NULL, &search->weights);
  double after =
      fg__place_cost(NULL, &search->raster, box, all, &worker->trial, &search->weights);
  double diffusion;
  status = fg__place_diffusion_cost(&diffusion, worker, NULL, &line);
  out->fall = before - after - diffusion -
              fg__place_line_penalty(&search->scale, &search->own.beside, &line);
  return status;
}

/* The seed of a new icon at a place from the raster's origin, lambda. */
static fg__place_seed seed_at(const fg__place_search *search, const float position[3])
{
  const fg__place_scale *scale = &search->scale;
  fg__place_seed seed = {{0}, {0}};
  for (int k = 0; k < 3 && k < scale->dimension; ++k)
    seed.position[k] = scale->origin[k] + (double)position[k] * scale->lambda;
  seed.way[0] = seed.way[1] = scale->first_way;
  return seed;
}

/* Tries the places beside a candidate, which the best of them becomes. */
static fg_status try_beside(void *argument, fg__place_worker *worker, int n)
{
  fg__place_candidate *best = (fg__place_candidate *)argument + n;
  const fg__place_scale *scale = &worker->search->scale;
  const fg__place_seed center = best->seed;
  fg_status status = FG_STATUS_OK;
  for (int side = 0; side < 2 * scale->dimension && status == FG_STATUS_OK; ++side) {
    fg__place_candidate next = {.seed = center};
    next.seed.position[side / 2] += (side & 1 ? -OFFSET : OFFSET) * scale->lambda;
    status = try_seed(worker, &next);
    if (next.fall > best->fall)
      *best = next;
  }
  return status;
}

/* Tries a candidate, or where none fits at its place those beside it. */
static fg_status try_place(void *argument, fg__place_worker *worker, int n)
{
  fg__place_candidate *out = (fg__place_candidate *)argument + n;
  fg_status status = try_seed(worker, out);
  return status == FG_STATUS_OK && !(out->fall > -HUGE_VAL)
             ? try_beside(argument, worker, n)
             : status;
}

/* Moves a candidate to its place among those before it, which descend. */
static void rise(const fg__place_candidates *best, int n)
{
  const fg__place_candidate moved = best->list[n];
  for (; n > 0 && best->list[n - 1].fall < moved.fall; --n)
    best->list[n] = best->list[n - 1];
  best->list[n] = moved;
}

/* Puts a candidate in its place among the best. */
static void rank(fg__place_candidates *best, const fg__place_candidate *next)
{
  if (best->count == best->most && best->list[best->most - 1].fall >= next->fall)
    return;
  best->count += best->count < best->most;
  best->list[best->count - 1] = *next;
  rise(best, best->count - 1);
}

/* Tries the next places where readers err most, as many as candidates are wanted; false
 * where there are none. */
static bool try_next(fg_status *status, fg__place_search *search, fg__place_peaks *peaks,
                     fg__place_candidate *next, fg__place_candidates *best)
{
  float position[3];
  int count = 0;
  while (count < best->most && take_maximum(search, peaks, position))
    next[count++].seed = seed_at(search, position);
  *status = fg__place_share(search, try_place, next, count);
  for (int n = 0; n < count && *status == FG_STATUS_OK; ++n)
    if (next[n].fall > -HUGE_VAL)
      rank(best, &next[n]);
  return count > 0 && *status == FG_STATUS_OK;
}

/* The best of the places where readers err most. */
static fg_status try_maxima(fg__place_search *search, fg__place_candidates *best)
{
  const size_t most = (size_t)best->most;
  fg__place_peaks peaks;
  fg__place_candidate *next = fg__allocate(most, sizeof *next);
  if (!next)
    return fg__fail_memory(search->context, "places for icons", most * sizeof *next);
  smooth_map(search);
  fg_status status =
      fg__place_peaks_create(&peaks, search->context, &search->raster, search->map, NULL);
  /* where nothing fits at the first places, all others are tried */
  while (status == FG_STATUS_OK && best->count == 0 &&
         try_next(&status, search, &peaks, next, best))
    continue;
  fg__place_peaks_clear(&peaks);
  free(next);
  const int moved = best->most * MOVED / FG__PLACE_CANDIDATES;
  const int count = best->count < moved ? best->count : moved;
  if (status == FG_STATUS_OK)
    status = fg__place_share(search, try_beside, best->list, count);
  for (int n = 0; n < count; ++n)
    rise(best, n);
  return status;
}

/* The best of all cells. Where the flow is narrow beside lambda, lines fit at few seeds.
 */
static fg_status try_cells(fg__place_search *search, fg__place_candidates *best)
{
  const fg__place_raster *raster = &search->raster;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < raster->count && status == FG_STATUS_OK; ++n) {
    fg__place_candidate next;
    float position[3];
    size_t rest = n;
    if (!(raster->weight[n] > 0.0F))
      continue;
    for (int k = 0; k < 3; ++k) {
      position[k] = ((float)(rest % (size_t)raster->cells[k]) + 0.5F) * raster->cell;
      rest /= (size_t)raster->cells[k];
    }
    next.seed = seed_at(search, position);
    status = try_seed(&search->own, &next);
    if (next.fall > -HUGE_VAL)
      rank(best, &next);
  }
  return status;
}

fg_status fg__place_list_candidates(fg__place_candidates *best, fg__place_search *search)
{
  best->count = 0;
  fg_status status = fg__place_gather_whole(search);
  if (status != FG_STATUS_OK)
    return status;
  const fg__place_contribution *all = &search->own.others;
  fg__place_cost(search->map, &search->raster, &all->box, all, NULL, &search->weights);
  float diffusion = (float)search->scale.diffusion * search->weights.inverse_error;
  for (size_t n = 0; n < search->raster.count; ++n)
    search->map[n] = (search->map[n] + diffusion * search->diffusion.error[n]) *
                     all->value[n] / (all->value[n] + BESIDE);
  status = try_maxima(search, best);
  if (status == FG_STATUS_OK && best->count == 0)
    status = try_cells(search, best);
  return status;
}
