/* Where a new icon would lower the energy most. */
#include "place/search/search.h"

#include <math.h>

/* Places that are tried for a new icon are at least this far apart in lambda, each with
 * offsets along the axes; the error is smoothed by this many passes of 1 2 1 (lambda/4 on
 * cells of lambda/8). */
enum { PASSES = 2 };
static const double APART = 0.5;
static const double OFFSET = 0.25;

/* Errors beside a line do not call for another one: they count by d^2 / (d^2 + this), d
 * the distance in lambda. Rough coasts would draw all new icons else. */
static const float BESIDE = 0.04F;

/* Ways of a new icon in a free placement, in lambda. */
static const double FREE_WAY = 0.6;

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
static bool take_maximum(fg__place_search *search, float position[3])
{
  const fg__place_raster *raster = &search->raster;
  size_t best = 0;
  for (size_t n = 1; n < raster->count; ++n)
    if (search->map[n] > search->map[best])
      best = n;
  if (!(search->map[best] > 0.0F))
    return false;
  size_t rest = best;
  int at[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = (int)(rest % (size_t)raster->cells[k]);
    rest /= (size_t)raster->cells[k];
    position[k] = ((float)at[k] + 0.5F) * raster->cell;
  }
  int apart = (int)(APART / (double)raster->cell + 0.5);
  for (int z = at[2] - apart; z <= at[2] + apart; ++z)
    for (int y = at[1] - apart; y <= at[1] + apart; ++y)
      for (int x = at[0] - apart; x <= at[0] + apart; ++x)
        if (x >= 0 && x < raster->cells[0] && y >= 0 && y < raster->cells[1] && z >= 0 &&
            z < raster->cells[2])
          search->map[((size_t)z * (size_t)raster->cells[1] + (size_t)y) *
                          (size_t)raster->cells[0] +
                      (size_t)x] = 0.0F;
  return true;
}

/* How much a new icon at a seed lowers the energy; `whole` tells what all do. */
static fg_status try_seed(fg__place_search *search, const fg__place_seed *seed,
                          double *fall)
{
  fg__place_line line;
  *fall = -HUGE_VAL;
  fg__place_trace(&line, search->domain, &search->scale, seed);
  if (line.count == 0)
    return FG_STATUS_OK;
  fg_status status = fg__place_tell(&search->trial, search->context, &search->raster,
                                    &search->scale, &line);
  if (status != FG_STATUS_OK)
    return status;
  const fg__place_box *box = &search->trial.box;
  double before =
      fg__place_cost(NULL, &search->raster, box, &search->whole, NULL, &search->price);
  double after = fg__place_cost(NULL, &search->raster, box, &search->whole,
                                &search->trial, &search->price);
  double diffusion;
  status = fg__place_diffusion_price(&diffusion, search, NULL, &line);
  *fall = before - after - diffusion - fg__place_own_price(search, &line);
  return status;
}

static fg__place_seed seed_at(const fg__place_search *search, const float position[3])
{
  const fg__place_scale *scale = &search->scale;
  fg__place_seed seed = {{0}, {0}};
  for (int k = 0; k < 3 && k < scale->dimension; ++k)
    seed.position[k] = search->domain->low[k] + (double)position[k] * scale->lambda;
  seed.way[0] = seed.way[1] = (scale->free ? FREE_WAY : 0.5) * scale->lambda;
  return seed;
}

/* The best of a place and those beside it. */
static fg_status try_place(fg__place_search *search, const float position[3],
                           fg__place_seed *best, double *most)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n <= 2 * search->scale.dimension && status == FG_STATUS_OK; ++n) {
    float beside[3] = {position[0], position[1], position[2]};
    if (n > 0)
      beside[(n - 1) / 2] += (float)(n & 1 ? OFFSET : -OFFSET);
    fg__place_seed seed = seed_at(search, beside);
    double fall;
    status = try_seed(search, &seed, &fall);
    if (fall > *most) {
      *most = fall;
      *best = seed;
    }
  }
  return status;
}

/* Puts a candidate in its place among the `count` best, which descend. */
static void rank(fg__place_candidate best[FG__PLACE_CANDIDATES], int *count,
                 const fg__place_candidate *next)
{
  if (*count == FG__PLACE_CANDIDATES && best[FG__PLACE_CANDIDATES - 1].fall >= next->fall)
    return;
  int n = *count < FG__PLACE_CANDIDATES ? (*count)++ : FG__PLACE_CANDIDATES - 1;
  for (; n > 0 && best[n - 1].fall < next->fall; --n)
    best[n] = best[n - 1];
  best[n] = *next;
}

/* The best of the places where readers err most. */
static fg_status try_maxima(fg__place_search *search,
                            fg__place_candidate best[FG__PLACE_CANDIDATES], int *count)
{
  fg_status status = FG_STATUS_OK;
  float position[3];
  smooth_map(search);
  /* where nothing fits at the first places, all others are tried */
  for (int n = 0; status == FG_STATUS_OK && (n < FG__PLACE_CANDIDATES || *count == 0);
       ++n) {
    fg__place_candidate next = {{{0}, {0}}, -HUGE_VAL};
    if (!take_maximum(search, position))
      break;
    status = try_place(search, position, &next.seed, &next.fall);
    if (next.fall > -HUGE_VAL)
      rank(best, count, &next);
  }
  return status;
}

/* The best of all cells. Where the flow is narrow beside lambda, lines fit at few seeds.
 */
static fg_status try_cells(fg__place_search *search,
                           fg__place_candidate best[FG__PLACE_CANDIDATES], int *count)
{
  const fg__place_raster *raster = &search->raster;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < raster->count && status == FG_STATUS_OK; ++n) {
    fg__place_candidate next = {{{0}, {0}}, -HUGE_VAL};
    float position[3];
    size_t rest = n;
    if (!(raster->weight[n] > 0.0F))
      continue;
    for (int k = 0; k < 3; ++k) {
      position[k] = ((float)(rest % (size_t)raster->cells[k]) + 0.5F) * raster->cell;
      rest /= (size_t)raster->cells[k];
    }
    next.seed = seed_at(search, position);
    status = try_seed(search, &next.seed, &next.fall);
    if (next.fall > -HUGE_VAL)
      rank(best, count, &next);
  }
  return status;
}

fg_status fg__place_list_candidates(fg__place_candidate best[FG__PLACE_CANDIDATES],
                                    int *count, fg__place_search *search)
{
  *count = 0;
  fg_status status = fg__place_gather_whole(search);
  if (status != FG_STATUS_OK)
    return status;
  fg__place_cost(search->map, &search->raster, &search->whole.box, &search->whole, NULL,
                 &search->price);
  float diffusion = (float)search->scale.diffusion * search->price.inverse_error;
  for (size_t n = 0; n < search->raster.count; ++n)
    search->map[n] = (search->map[n] + diffusion * search->diffusion.error[n]) *
                     search->whole.value[n] / (search->whole.value[n] + BESIDE);
  status = try_maxima(search, best, count);
  if (status == FG_STATUS_OK && *count == 0)
    status = try_cells(search, best, count);
  return status;
}
