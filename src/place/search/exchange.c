/* Icons are added where readers err most, and removed where that costs least. */
#include "place/search/search.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sweeps after an icon was added, and after one was removed. */
enum { EXCHANGE_SWEEPS = 2 };

/* A fall of the energy by less than this share of it is kept, but counts as a failure:
 * the best exchanges come first. */
static const double LITTLE_GAIN = 3e-4;

static const double FRESH = 0.1; /* first step of the neighbours, in lambda */

/* Icons that are added or removed in one round are at least this many lambda apart, for
 * the cost of each is computed with its neighbours in place. Sweeps of these after a
 * round. */
static const double APART_IN_A_ROUND = 1.3;
enum { THIN_SWEEPS = 2 };

/* Of the icons that are missing one in so many is a candidate of the next round, at
 * least FG__PLACE_CANDIDATES. */
enum { ROUNDS = 8 };

static bool is_near(const fg__place_search *search, const double a[3], const double b[3])
{
  double near = APART_IN_A_ROUND * search->scale.lambda, way[3];
  for (int k = 0; k < 3; ++k)
    way[k] = a[k] - b[k];
  return fg__dot(way, way) < near * near;
}

/* Adds the better half of the candidates that are not near each other, as many as there
 * is room for in the scale. */
static fg_status add_better(fg__place_search *search, const fg__place_candidates *best,
                            int *added)
{
  const int first = search->count;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < (best->count + 1) / 2 && status == FG_STATUS_OK; ++n) {
    const fg__place_seed *seed = &best->list[n].seed;
    bool beside = false, inserted = false;
    for (int k = first; k < search->count && !beside; ++k)
      beside = is_near(search, search->icon[k]->seed.position, seed->position);
    if (beside || search->count >= search->scale.count)
      continue;
    status = fg__place_add(search, &inserted, seed, search->next_identity);
    search->next_identity += inserted;
    *added += inserted;
  }
  return status;
}

/* A round looks at more candidates where many icons are missing, so that there are few
 * rounds. */
static fg_status add_round(fg__place_search *search, int *added)
{
  const int share = (search->scale.count - search->count) / ROUNDS;
  fg__place_candidates best = {
      .most = share > FG__PLACE_CANDIDATES ? share : FG__PLACE_CANDIDATES};
  *added = 0;
  best.list = fg__allocate((size_t)best.most, sizeof *best.list);
  if (!best.list)
    return fg__fail_memory(search->context, "places for icons",
                           (size_t)best.most * sizeof *best.list);
  fg_status status = fg__place_list_candidates(&best, search);
  if (status == FG_STATUS_OK)
    status = add_better(search, &best, added);
  free(best.list);
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
      fg__place_reactivate(search, search->icon[n]->seed.position, FRESH);
    if (status == FG_STATUS_OK)
      status = fg__place_relax(search, THIN_SWEEPS);
  }
  return status;
}

/* Finds by how much the energy rises when an icon is removed, unless that is known. */
static fg_status find_removal_cost(void *argument, fg__place_worker *worker, int index)
{
  const fg__place_search *search = argument;
  fg__place_icon *icon = search->icon[index];
  const fg__place_box *box = &icon->contribution.box;
  if (icon->has_removal_cost)
    return FG_STATUS_OK;
  fg_status status = fg__place_gather(worker, box, index);
  if (status != FG_STATUS_OK)
    return status;
  double with = fg__place_cost(NULL, &search->raster, box, &worker->others,
                               &icon->contribution, &search->weights);
  double without =
      fg__place_cost(NULL, &search->raster, box, &worker->others, NULL, &search->weights);
  double diffusion;
  status = fg__place_diffusion_cost(&diffusion, worker, &icon->line, NULL);
  icon->removal_cost =
      without - with + diffusion -
      fg__place_line_penalty(&search->scale, &worker->beside, &icon->line);
  icon->has_removal_cost = status == FG_STATUS_OK;
  return status;
}

static fg_status find_removal_costs(fg__place_search *search)
{
  return fg__place_share(search, find_removal_cost, search, search->count);
}

static int least_of(const double *rise, int count)
{
  int least = 0;
  for (int n = 1; n < count; ++n)
    if (rise[n] < rise[least])
      least = n;
  return least;
}

/* Removes an icon; its neighbours may move, and stay in this round. */
static fg_status remove_in_round(fg__place_search *search, double *rise, int index)
{
  double place[3];
  memcpy(place, search->icon[index]->seed.position, sizeof place);
  fg_status status = fg__place_remove(search, index);
  if (status != FG_STATUS_OK)
    return status;
  memmove(&rise[index], &rise[index + 1], (size_t)(search->count - index) * sizeof *rise);
  fg__place_reactivate(search, place, FRESH);
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
    return fg__fail_memory(search->context, "the removal costs of icons",
                           (size_t)search->count * sizeof *rise);
  while (status == FG_STATUS_OK && search->count > count) {
    status = find_removal_costs(search);
    for (int n = 0; n < search->count; ++n)
      rise[n] = search->icon[n]->removal_cost;
    while (status == FG_STATUS_OK && search->count > count) {
      int least = least_of(rise, search->count);
      if (!(rise[least] < HUGE_VAL))
        break;
      status = remove_in_round(search, rise, least);
    }
    if (status == FG_STATUS_OK)
      status = fg__place_relax(search, THIN_SWEEPS);
  }
  free(rise);
  return status;
}

/* Removes the icon of the least removal cost; `place` becomes that of its seed. */
static fg_status remove_least(fg__place_search *search, double place[3])
{
  int least = 0;
  fg_status status = find_removal_costs(search);
  if (status != FG_STATUS_OK)
    return status;
  for (int n = 1; n < search->count; ++n)
    if (search->icon[n]->removal_cost < search->icon[least]->removal_cost)
      least = n;
  memcpy(place, search->icon[least]->seed.position, 3 * sizeof *place);
  return fg__place_remove(search, least);
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

/* Places for new icons; they stay the best ones while exchanges are undone. */
typedef struct choice {
  fg__place_candidate list[FG__PLACE_CANDIDATES];
  int count;
  bool is_made;
} choice;

static fg_status choose(choice *out, fg__place_search *search)
{
  if (out->is_made)
    return FG_STATUS_OK;
  fg__place_candidates best = {.list = out->list, .most = FG__PLACE_CANDIDATES};
  fg_status status = fg__place_list_candidates(&best, search);
  out->count = best.count;
  out->is_made = status == FG_STATUS_OK;
  return status;
}

static fg_status exchange_one(fg__place_search *search, const fg__place_seed *seed)
{
  bool inserted;
  double place[3];
  fg_status status = fg__place_add(search, &inserted, seed, search->next_identity);
  if (status != FG_STATUS_OK || !inserted)
    return status;
  ++search->next_identity;
  fg__place_reactivate(search, search->icon[search->count - 1]->seed.position, FRESH);
  status = fg__place_relax_some(search, EXCHANGE_SWEEPS);
  if (status == FG_STATUS_OK)
    status = remove_least(search, place);
  if (status == FG_STATUS_OK) {
    fg__place_reactivate(search, place, FRESH);
    status = fg__place_relax_some(search, EXCHANGE_SWEEPS);
  }
  return status;
}

fg_status fg__place_exchange(fg__place_search *search, int most, int failures,
                             double least_fall)
{
  double energy;
  choice places = {.is_made = false};
  fg_status status = fg__place_energy(search, &energy);
  for (int n = 0, failed = 0; n < most && failed < failures && status == FG_STATUS_OK;
       ++n) {
    fg__place_snapshot before = {0};
    double now = HUGE_VAL;
    status = choose(&places, search);
    if (status != FG_STATUS_OK || failed >= places.count)
      break;
    status = fg__place_remember(&before, search);
    if (status == FG_STATUS_OK)
      status = exchange_one(search, &places.list[failed].seed);
    if (status == FG_STATUS_OK)
      status = fg__place_energy(search, &now);
    if (status == FG_STATUS_OK && now < energy * (1.0 - least_fall)) {
      failed = now < energy * (1.0 - LITTLE_GAIN) ? 0 : failed + 1;
      energy = now;
      places.is_made = false;
    } else if (status == FG_STATUS_OK) {
      status = fg__place_restore(search, &before);
      ++failed;
    }
    fg__place_snapshot_clear(&before);
  }
  return status;
}
