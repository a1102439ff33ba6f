/* Icons come and go: where readers err most, and where one is missed least. */
#include "place/search.h"

#include "base/memory.h"
#include "place/angle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places that are tried for a new icon, at least this far apart in lambda, each with
 * offsets along the axes; the error is smoothed by this many passes of 1 2 1 (lambda/4 on
 * cells of lambda/8). */
enum { PLACES = 30, PASSES = 2 };
static const double APART = 0.5;
static const double OFFSET = 0.25;

/* Errors beside a line do not call for another one: they count by d^2 / (d^2 + this), d
 * the distance in lambda. Rough coasts would draw all new icons else. */
static const float BESIDE = 0.04F;

/* Ways of a new icon in a free placement, in lambda. */
static const double FREE_WAY = 0.6;

/* Sweeps after an icon has come, and after one has gone. */
enum { EXCHANGE_SWEEPS = 3 };
/* A fall of the energy by less than this share of it is kept, but counts as a failure:
 * the best exchanges come first. */
static const double LITTLE_GAIN = 3e-4;

static const double FRESH = 0.1; /* first step of the neighbours, in lambda */

/* Icons that come or go in one round are at least this many lambda apart: each is priced
 * beside its neighbours. Sweeps of those after a round. */
static const double APART_IN_A_ROUND = 1.3;
enum { THIN_SWEEPS = 2 };

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
  *fall = before - after - fg__place_own_price(search, &line, &search->whole);
  return FG_STATUS_OK;
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

/* A place for a new icon and what it is worth. */
typedef struct candidate {
  fg__place_seed seed;
  double fall;
} candidate;

/* Puts a candidate in its place among the `count` best, which descend. */
static void rank(candidate best[PLACES], int *count, const candidate *next)
{
  if (*count == PLACES && best[PLACES - 1].fall >= next->fall)
    return;
  int n = *count < PLACES ? (*count)++ : PLACES - 1;
  for (; n > 0 && best[n - 1].fall < next->fall; --n)
    best[n] = best[n - 1];
  best[n] = *next;
}

/* The best of the places where readers err most. */
static fg_status try_maxima(fg__place_search *search, candidate best[PLACES], int *count)
{
  fg_status status = FG_STATUS_OK;
  float position[3];
  smooth_map(search);
  /* where nothing fits at the first places, all others are tried */
  for (int n = 0; status == FG_STATUS_OK && (n < PLACES || *count == 0); ++n) {
    candidate next = {{{0}, {0}}, -HUGE_VAL};
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
static fg_status try_cells(fg__place_search *search, candidate best[PLACES], int *count)
{
  const fg__place_raster *raster = &search->raster;
  fg_status status = FG_STATUS_OK;
  for (size_t n = 0; n < raster->count && status == FG_STATUS_OK; ++n) {
    candidate next = {{{0}, {0}}, -HUGE_VAL};
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

/* The best candidates for a new icon, in descending order. */
static fg_status list_candidates(candidate best[PLACES], int *count,
                                 fg__place_search *search)
{
  fg__place_box all = {{0}, {0}};
  memcpy(all.size, search->raster.cells, sizeof all.size);
  *count = 0;
  fg_status status = fg__place_gather(&search->whole, search, &all, -1);
  if (status != FG_STATUS_OK)
    return status;
  fg__place_cost(search->map, &search->raster, &all, &search->whole, NULL,
                 &search->price);
  for (size_t n = 0; n < search->raster.count; ++n)
    search->map[n] *= search->whole.value[n] / (search->whole.value[n] + BESIDE);
  status = try_maxima(search, best, count);
  if (status == FG_STATUS_OK && *count == 0)
    status = try_cells(search, best, count);
  return status;
}

fg_status fg__place_insert(fg__place_search *search, bool *inserted, int passed)
{
  candidate best[PLACES];
  int count;
  *inserted = false;
  fg_status status = list_candidates(best, &count, search);
  if (status == FG_STATUS_OK && passed < count)
    status = fg__place_add(search, inserted, &best[passed].seed, search->next_identity);
  search->next_identity += *inserted;
  return status;
}

static bool is_near(const fg__place_search *search, const double a[3], const double b[3])
{
  double near = APART_IN_A_ROUND * search->scale.lambda, way[3];
  for (int k = 0; k < 3; ++k)
    way[k] = a[k] - b[k];
  return fg__place_dot(way, way) < near * near;
}

/* Adds the better half of the candidates that are not near each other, as many as there
 * is room for in the scale. */
static fg_status add_round(fg__place_search *search, int *added)
{
  candidate best[PLACES];
  int count, first = search->count;
  *added = 0;
  fg_status status = list_candidates(best, &count, search);
  for (int n = 0; n < (count + 1) / 2 && status == FG_STATUS_OK; ++n) {
    bool beside = false, inserted = false;
    for (int k = first; k < search->count && !beside; ++k)
      beside = is_near(search, search->icon[k]->seed.position, best[n].seed.position);
    if (beside || search->count >= search->scale.count)
      continue;
    status = fg__place_add(search, &inserted, &best[n].seed, search->next_identity);
    search->next_identity += inserted;
    *added += inserted;
  }
  return status;
}

/* Adds icons in rounds; after each the new ones and their neighbours move. */
static fg_status fill(fg__place_search *search)
{
  fg_status status = FG_STATUS_OK;
  int added = 1;
  while (status == FG_STATUS_OK && added > 0 && search->count < search->scale.count) {
    int first = search->count;
    status = add_round(search, &added);
    for (int n = first; n < search->count; ++n)
      fg__place_wake(search, search->icon[n]->seed.position, FRESH);
    if (status == FG_STATUS_OK)
      status = fg__place_relax(search, THIN_SWEEPS);
  }
  return status;
}

/* What the energy rises by when an icon goes. */
static fg_status price_of_loss(fg__place_search *search, int index, double *rise)
{
  fg__place_icon *icon = search->icon[index];
  const fg__place_box *box = &icon->tale.box;
  fg_status status = fg__place_gather(&search->others, search, box, index);
  if (status != FG_STATUS_OK)
    return status;
  double with = fg__place_cost(NULL, &search->raster, box, &search->others, &icon->tale,
                               &search->price);
  double without =
      fg__place_cost(NULL, &search->raster, box, &search->others, NULL, &search->price);
  *rise = without - with - fg__place_own_price(search, &icon->line, &search->others);
  return FG_STATUS_OK;
}

static int least_of(const double *rise, int count)
{
  int least = 0;
  for (int n = 1; n < count; ++n)
    if (rise[n] < rise[least])
      least = n;
  return least;
}

/* Takes an icon off, and lets its neighbours move and stay. */
static void take_off(fg__place_search *search, double *rise, int index)
{
  double place[3];
  memcpy(place, search->icon[index]->seed.position, sizeof place);
  fg__place_drop(search, index);
  memmove(&rise[index], &rise[index + 1], (size_t)(search->count - index) * sizeof *rise);
  fg__place_wake(search, place, FRESH);
  for (int n = 0; n < search->count; ++n)
    if (is_near(search, search->icon[n]->seed.position, place))
      rise[n] = HUGE_VAL;
}

fg_status fg__place_thin(fg__place_search *search, int count)
{
  fg_status status = FG_STATUS_OK;
  double *rise = fg__allocate((size_t)search->count, sizeof *rise);
  if (!rise)
    return fg__fail_memory(search->context, "the worth of icons",
                           (size_t)search->count * sizeof *rise);
  while (status == FG_STATUS_OK && search->count > count) {
    for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n)
      status = price_of_loss(search, n, &rise[n]);
    while (status == FG_STATUS_OK && search->count > count) {
      int least = least_of(rise, search->count);
      if (!(rise[least] < HUGE_VAL))
        break;
      take_off(search, rise, least);
    }
    if (status == FG_STATUS_OK)
      status = fg__place_relax(search, THIN_SWEEPS);
  }
  free(rise);
  return status;
}

/* Takes off the icon that is missed least, from where others may come. */
static fg_status remove_least(fg__place_search *search, double place[3])
{
  double least = HUGE_VAL, rise;
  int index = 0;
  for (int n = 0; n < search->count; ++n) {
    fg_status status = price_of_loss(search, n, &rise);
    if (status != FG_STATUS_OK)
      return status;
    if (rise < least) {
      least = rise;
      index = n;
    }
  }
  memcpy(place, search->icon[index]->seed.position, 3 * sizeof *place);
  fg__place_drop(search, index);
  return FG_STATUS_OK;
}

fg_status fg__place_complete(fg__place_search *search)
{
  fg_status status = fill(search);
  while (status == FG_STATUS_OK && search->count < search->scale.count &&
         fg__place_shorten(&search->scale))
    status = fill(search);
  if (status == FG_STATUS_OK && search->count > search->scale.count)
    status = fg__place_thin(search, search->scale.count);
  return status;
}

/* The icons' seeds, to come back to. */
typedef struct snapshot {
  struct {
    fg__place_seed seed;
    double step;
    int identity;
  } * icon;
  int count;
} snapshot;

static fg_status take_snapshot(snapshot *out, fg__place_search *search)
{
  out->count = search->count;
  out->icon = fg__allocate((size_t)search->count, sizeof *out->icon);
  if (!out->icon)
    return fg__fail_memory(search->context, "a copy of the icons",
                           (size_t)search->count * sizeof *out->icon);
  for (int n = 0; n < search->count; ++n) {
    out->icon[n].seed = search->icon[n]->seed;
    out->icon[n].step = search->icon[n]->step;
    out->icon[n].identity = search->icon[n]->identity;
  }
  return FG_STATUS_OK;
}

static fg_status restore(fg__place_search *search, const snapshot *from)
{
  fg_status status = FG_STATUS_OK;
  /* those that stayed where they were keep their place, the rest are made again */
  for (int n = search->count - 1; n >= 0; --n) {
    fg__place_icon *icon = search->icon[n];
    bool same = false;
    for (int k = 0; k < from->count && !same; ++k)
      same = from->icon[k].identity == icon->identity &&
             memcmp(&from->icon[k].seed, &icon->seed, sizeof icon->seed) == 0;
    if (!same)
      fg__place_drop(search, n);
  }
  for (int k = 0; k < from->count && status == FG_STATUS_OK; ++k) {
    int n = k;
    while (n < search->count && search->icon[n]->identity != from->icon[k].identity)
      ++n;
    bool added = true;
    if (n >= search->count)
      status = fg__place_add(search, &added, &from->icon[k].seed, from->icon[k].identity);
    if (status != FG_STATUS_OK || !added)
      continue;
    fg__place_icon *icon = search->icon[n];
    memmove(&search->icon[k + 1], &search->icon[k],
            (size_t)(n - k) * sizeof(fg__place_icon *));
    search->icon[k] = icon;
    icon->step = from->icon[k].step;
  }
  return status;
}

static fg_status exchange_one(fg__place_search *search, int passed)
{
  bool inserted;
  double place[3];
  fg_status status = fg__place_insert(search, &inserted, passed);
  if (status != FG_STATUS_OK || !inserted)
    return status;
  fg__place_wake(search, search->icon[search->count - 1]->seed.position, FRESH);
  status = fg__place_relax(search, EXCHANGE_SWEEPS);
  if (status == FG_STATUS_OK)
    status = remove_least(search, place);
  if (status == FG_STATUS_OK) {
    fg__place_wake(search, place, FRESH);
    status = fg__place_relax(search, EXCHANGE_SWEEPS);
  }
  return status;
}

fg_status fg__place_exchange(fg__place_search *search, int most, int failures)
{
  double energy;
  fg_status status = fg__place_energy(search, &energy);
  for (int n = 0, failed = 0; n < most && failed < failures && status == FG_STATUS_OK;
       ++n) {
    snapshot before = {0};
    double now = HUGE_VAL;
    status = take_snapshot(&before, search);
    if (status == FG_STATUS_OK)
      status = exchange_one(search, failed);
    if (status == FG_STATUS_OK)
      status = fg__place_energy(search, &now);
    if (status == FG_STATUS_OK && now < energy) {
      failed = now < energy * (1.0 - LITTLE_GAIN) ? 0 : failed + 1;
      energy = now;
    } else if (status == FG_STATUS_OK) {
      status = restore(search, &before);
      ++failed;
    }
    free(before.icon);
  }
  return status;
}
