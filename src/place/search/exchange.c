/* Icons come and go: where readers err most, and where one is missed least. */
#include "place/search/search.h"

#include "base/memory.h"
#include "place/angle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sweeps after an icon has come, and after one has gone. */
enum { EXCHANGE_SWEEPS = 2 };

/* A fall of the energy by less than this share of it is kept, but counts as a failure:
 * the best exchanges come first. */
static const double LITTLE_GAIN = 3e-4;

static const double FRESH = 0.1; /* first step of the neighbours, in lambda */

/* Icons that come or go in one round are at least this many lambda apart: each is priced
 * beside its neighbours. Sweeps of those after a round. */
static const double APART_IN_A_ROUND = 1.3;
enum { THIN_SWEEPS = 2 };

fg_status fg__place_insert(fg__place_search *search, bool *inserted, int passed)
{
  fg__place_candidate best[FG__PLACE_CANDIDATES];
  int count;
  *inserted = false;
  fg_status status = fg__place_list_candidates(best, &count, search);
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
  fg__place_candidate best[FG__PLACE_CANDIDATES];
  int count, first = search->count;
  *added = 0;
  fg_status status = fg__place_list_candidates(best, &count, search);
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
  const fg__place_box *box = &icon->contribution.box;
  fg_status status = fg__place_gather(&search->others, search, box, index);
  if (status != FG_STATUS_OK)
    return status;
  double with = fg__place_cost(NULL, &search->raster, box, &search->others,
                               &icon->contribution, &search->price);
  double without =
      fg__place_cost(NULL, &search->raster, box, &search->others, NULL, &search->price);
  double diffusion;
  status = fg__place_diffusion_price(&diffusion, search, &icon->line, NULL);
  *rise = without - with + diffusion - fg__place_own_price(search, &icon->line);
  return status;
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
static fg_status take_off(fg__place_search *search, double *rise, int index)
{
  double place[3];
  memcpy(place, search->icon[index]->seed.position, sizeof place);
  fg_status status = fg__place_drop(search, index);
  if (status != FG_STATUS_OK)
    return status;
  memmove(&rise[index], &rise[index + 1], (size_t)(search->count - index) * sizeof *rise);
  fg__place_wake(search, place, FRESH);
  for (int n = 0; n < search->count; ++n)
    if (is_near(search, search->icon[n]->seed.position, place))
      rise[n] = HUGE_VAL;
  return FG_STATUS_OK;
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
      status = take_off(search, rise, least);
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
  return fg__place_drop(search, index);
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
  for (int n = search->count - 1; n >= 0 && status == FG_STATUS_OK; --n) {
    fg__place_icon *icon = search->icon[n];
    bool same = false;
    for (int k = 0; k < from->count && !same; ++k)
      same = from->icon[k].identity == icon->identity &&
             memcmp(&from->icon[k].seed, &icon->seed, sizeof icon->seed) == 0;
    if (!same)
      status = fg__place_drop(search, n);
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
