#include "scales.h"

#include <math.h>
#include <string.h>

/* About a dozen arrows are the simplest picture worth having (the paper's coarsest). */
enum { COARSEST = 12 };

/* Coarsening goes as N ~ t^-0.4 ... t^-0.46 between 150 and 12 clusters (measured). */
static const double coarsening_rate = 0.43;

void scale_plan_start(scale_plan *plan, const int *list, int count)
{
  memset(plan, 0, sizeof *plan);
  plan->count = count;
  for (int k = 0; k < count; ++k)
    plan->wanted[k] = list[k];
}

void scale_plan_start_placed(scale_plan *plan, const int *list, int count, int dimension)
{
  static const int flat[] = {200, 100, 50, 25, 12}, solid[] = {60, 25, 12};
  const int *usual = dimension == 3 ? solid : flat;
  size_t usual_count = dimension == 3 ? sizeof solid : sizeof flat;
  if (!count)
    scale_plan_start(plan, usual, (int)(usual_count / sizeof *usual));
  else
    scale_plan_start(plan, list, count);
  plan->placed = true;
}

/* The first number seen, then those of 12 * 2^k that differ from it by more than half a
 * halving: two scales closer than that look alike. */
static void fill_default(scale_plan *plan, int first)
{
  plan->wanted[plan->count++] = first;
  int largest = COARSEST;
  while (largest < first / 2)
    largest *= 2;
  if (largest > COARSEST && largest * sqrt(2.0) > first)
    largest /= 2;
  for (int wanted = largest; wanted >= COARSEST && wanted < first; wanted /= 2)
    plan->wanted[plan->count++] = wanted;
}

int scale_plan_reach(scale_plan *plan, int clusters)
{
  if (clusters < 1)
    return 0;
  if (!plan->count)
    fill_default(plan, clusters);
  int reached = 0;
  while (plan->next < plan->count && clusters <= plan->wanted[plan->next]) {
    ++plan->next;
    ++reached;
  }
  return reached;
}

bool scale_plan_done(const scale_plan *plan)
{
  return plan->count && plan->next == plan->count;
}

double scale_plan_share(const scale_plan *plan, int first, int clusters)
{
  if (!plan->count || clusters < 1 || first < 1)
    return 0.0;
  int last = plan->wanted[plan->count - 1];
  if (clusters <= last || first <= last)
    return 1.0;
  return fmax(0.0, log((double)first / clusters) / log((double)first / last));
}

double scale_plan_seconds_left(const scale_plan *plan, int clusters, double time,
                               double seconds, double time_0, double seconds_0)
{
  if (!plan->count || clusters < 1 || !(time > time_0) || !(seconds > seconds_0))
    return -1.0;
  int last = plan->wanted[plan->count - 1];
  if (clusters <= last)
    return 0.0;
  /* the step control spends about the same work on every factor of t */
  double seconds_per_log = (seconds - seconds_0) / log(time / time_0);
  return log((double)clusters / last) / coarsening_rate * seconds_per_log;
}
