#include "run/plan.h"

#include <math.h>
#include <string.h>

/* About a dozen arrows are the simplest picture worth having (the paper's coarsest). */
enum { COARSEST = 12 };

/* Coarsening goes as N ~ t^-0.4 ... t^-0.46 between 150 and 12 clusters (measured). */
static const double coarsening_rate = 0.43;

void fg__plan_start(fg__plan *plan, const int *list, int count)
{
  memset(plan, 0, sizeof *plan);
  plan->count = count;
  for (int k = 0; k < count; ++k)
    plan->wanted[k] = list[k];
}

void fg__plan_start_placed(fg__plan *plan, const int *list, int count, int dimension)
{
  static const int flat[] = {200, 100, 50, 25, 12}, solid[] = {60, 25, 12};
  const int *defaults = dimension == 3 ? solid : flat;
  size_t default_count = dimension == 3 ? sizeof solid : sizeof flat;
  if (!count)
    fg__plan_start(plan, defaults, (int)(default_count / sizeof *defaults));
  else
    fg__plan_start(plan, list, count);
  plan->placed = true;
}

void fg__plan_start_timed(fg__plan *plan, const double *times, int count)
{
  memset(plan, 0, sizeof *plan);
  plan->timed = true;
  plan->count = count;
  memcpy(plan->times, times, (size_t)count * sizeof *times);
}

/* The first number seen, then those of 12 * 2^k that differ from it by more than half a
 * halving: two scales closer than that look alike. */
static void fill_default(fg__plan *plan, int first)
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

static bool reaches(const fg__plan *plan, const fg_step *step, int n)
{
  return plan->timed ? step->time >= plan->times[n] : step->clusters <= plan->wanted[n];
}

int fg__plan_reach(fg__plan *plan, const fg_step *step)
{
  if (step->clusters < 1 && !plan->timed)
    return 0;
  if (!plan->count)
    fill_default(plan, step->clusters);
  int reached = 0;
  while (plan->next < plan->count && reaches(plan, step, plan->next)) {
    ++plan->next;
    ++reached;
  }
  return reached;
}

bool fg__plan_done(const fg__plan *plan)
{
  return plan->count && plan->next == plan->count;
}

/* Logarithm of what is left from a state to the plan's last. */
static double way_left(const fg__plan *plan, const fg_step *step)
{
  int last = plan->count - 1;
  double ratio = plan->timed ? plan->times[last] / step->time
                             : (double)step->clusters / plan->wanted[last];
  return fmax(0.0, log(ratio));
}

double fg__plan_share(const fg__plan *plan, const fg_step *first, const fg_step *now)
{
  if (!plan->count || now->clusters < 1 || first->clusters < 1)
    return 0.0;
  double left = way_left(plan, now), way = way_left(plan, first);
  return left > 0.0 && way > 0.0 ? fmax(0.0, 1.0 - left / way) : 1.0;
}

double fg__plan_seconds_left(const fg__plan *plan, const fg_step *now,
                             const fg_step *first)
{
  if (!plan->count || now->clusters < 1 || !(now->time > first->time) ||
      !(now->seconds > first->seconds))
    return -1.0;
  /* the step control spends about the same work on every factor of t */
  double seconds_per_log = (now->seconds - first->seconds) / log(now->time / first->time);
  return way_left(plan, now) / (plan->timed ? 1.0 : coarsening_rate) * seconds_per_log;
}

/* In 2D some hundred nodes in each cluster where clusters cover 0.3 of the domain, in 3D
 * a thousand; clusters below that are lost before they are counted. Not below what shows
 * a dozen well. */
int fg__plan_nodes(const fg_field *field, int clusters)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  double measure = 1.0, longest = 0.0;
  for (int k = 0; k < arrays->dimension; ++k) {
    const double *axis = arrays->axis[k];
    double length =
        arrays->period[k] > 0.0 ? arrays->period[k] : axis[arrays->size[k] - 1] - axis[0];
    measure *= length;
    longest = fmax(longest, length);
  }
  double boxes = clusters * pow(longest, arrays->dimension) / measure;
  bool flat = arrays->dimension == 2;
  double nodes = flat ? 18.0 * sqrt(boxes) : 16.0 * cbrt(boxes);
  double least = flat ? 129.0 : 49.0, most = flat ? 2049.0 : 257.0;
  return (int)fmin(fmax(nodes, least), most);
}
