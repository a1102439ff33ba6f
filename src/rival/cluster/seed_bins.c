#include "rival/cluster/seed_bins.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Along an axis, in 2D and 3D, as in rival/near.c. */
enum { MOST_BINS = 4096, MOST_BINS_IN_SPACE = 256 };

/* The bin of a place along an axis. */
static int bin_of(const fg__seed_bins *bins, const double position[3], int k)
{
  int bin = (int)((position[k] - bins->domain->origin[k]) / bins->size[k]);
  return bin < 0 ? 0 : bin < bins->bins[k] ? bin : bins->bins[k] - 1;
}

fg_status fg__seed_bins_fill(fg__seed_bins *out, fg_context *context,
                             const fg__domain *domain, const fg__seed *seed, int count,
                             double lambda)
{
  int most = domain->dimension == 2 ? MOST_BINS : MOST_BINS_IN_SPACE;
  size_t total = 1;
  out->domain = domain;
  out->seed = seed;
  out->lambda = lambda;
  out->bins[2] = 1;
  for (int k = 0; k < domain->dimension; k++) {
    double side = domain->cells[k] * domain->spacing[k];
    out->bins[k] = (int)fmin(fmax(floor(side / lambda), 1), most);
    out->size[k] = side / out->bins[k];
    total *= (size_t)out->bins[k];
  }
  if (!fg__grow((void **)&out->top, &out->top_capacity, total, sizeof *out->top) ||
      !fg__grow((void **)&out->next, &out->next_capacity, (size_t)count,
                sizeof *out->next))
    return fg__fail_memory(context, "seeds", (total + (size_t)count) * sizeof *out->next);
  for (size_t i = 0; i < total; i++)
    out->top[i] = -1;
  for (int n = 0; n < count; n++) {
    int bin = 0;
    for (int k = domain->dimension - 1; k >= 0; k--)
      bin = bin * out->bins[k] + bin_of(out, seed[n].position, k);
    out->next[n] = out->top[bin];
    out->top[bin] = n;
  }
  return FG_STATUS_OK;
}

void fg__seed_bins_clear(fg__seed_bins *bins)
{
  free(bins->top);
  free(bins->next);
  *bins = (fg__seed_bins){0};
}

/* What is looked for, and the best so far. */
typedef struct query {
  const fg__seed_bins *bins;
  const fg__seed *from;
  double place_weight, turn_weight;
  int bin[3];
  int best;
  double cost;
} query;

/* Both places lie in the box, so that one period at most is too much. */
static double shortest(double way, double period)
{
  if (way > period / 2)
    return way - period;
  return way < -period / 2 ? way + period : way;
}

static double cost_of(const query *search, int seed)
{
  const fg__seed *to = &search->bins->seed[seed], *from = search->from;
  const double *period = search->bins->domain->period;
  double place = 0, turn = 0;
  for (int k = 0; k < 3; k++) {
    double way = to->position[k] - from->position[k];
    double d = to->direction[k] - from->direction[k];
    if (period[k] > 0)
      way = shortest(way, period[k]);
    place += way * way;
    turn += d * d;
  }
  return place * search->place_weight + turn * search->turn_weight;
}

static void look_into(query *search, int bin)
{
  for (int n = search->bins->top[bin]; n >= 0; n = search->bins->next[n]) {
    double cost = cost_of(search, n);
    if (cost < search->cost || (cost <= search->cost && n < search->best)) {
      search->cost = cost;
      search->best = n;
    }
  }
}

/* The bin so many steps away; -1 where the box ends or, round a period, others lie
 * nearer. */
static int bin_beside(const query *search, const int step[3])
{
  const fg__seed_bins *bins = search->bins;
  int index = 0;
  for (int k = bins->domain->dimension == 3 ? 2 : 1; k >= 0; k--) {
    int at = search->bin[k] + step[k];
    if (bins->domain->period[k] > 0) {
      if (2 * abs(step[k]) > bins->bins[k])
        return -1;
      at = (at + bins->bins[k]) % bins->bins[k];
    }
    if (at < 0 || at >= bins->bins[k])
      return -1;
    index = index * bins->bins[k] + at;
  }
  return index;
}

/* All bins that are `ring` steps away along some axis, and no more along any. */
static void look_round(query *search, int ring)
{
  bool flat = search->bins->domain->dimension == 2;
  int step[3], high = flat ? 0 : ring;
  for (step[2] = -high; step[2] <= high; step[2]++)
    for (step[1] = -ring; step[1] <= ring; step[1]++) {
      bool inner = abs(step[2]) < ring && abs(step[1]) < ring;
      for (step[0] = -ring; step[0] <= ring;
           step[0] += inner && ring > 0 ? 2 * ring : 1) {
        int bin = bin_beside(search, step);
        if (bin >= 0)
          look_into(search, bin);
      }
    }
}

/* How near a seed in the next ring can be at least, and whether there is one. */
static double least_way(const query *search, int ring)
{
  const fg__seed_bins *bins = search->bins;
  double least = HUGE_VAL;
  for (int k = 0; k < bins->domain->dimension; k++) {
    double low = search->from->position[k] - bins->domain->origin[k] -
                 search->bin[k] * bins->size[k];
    double edge = fmax(fmin(low, bins->size[k] - low), 0);
    if (ring < bins->bins[k])
      least = fmin(least, edge + (ring - 1) * bins->size[k]);
  }
  return least;
}

int fg__seed_bins_nearest(const fg__seed_bins *bins, const fg__seed *from, double weight,
                          int guess, double *cost)
{
  query search = {.bins = bins,
                  .from = from,
                  .place_weight = 1 / (bins->lambda * bins->lambda),
                  .turn_weight = weight * weight,
                  .best = guess};
  for (int k = 0; k < bins->domain->dimension; k++)
    search.bin[k] = bin_of(bins, from->position, k);
  search.cost = cost_of(&search, guess);
  for (int ring = 0;; ring++) {
    double way = ring == 0 ? 0 : least_way(&search, ring);
    if (way * way > search.cost * bins->lambda * bins->lambda || way == HUGE_VAL)
      break;
    look_round(&search, ring);
  }
  *cost = search.cost;
  return search.best;
}
