#include "rival/near.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Along an axis, in 2D and 3D: together they take 64 MB. */
enum { MOST_BINS = 4096, MOST_BINS_IN_SPACE = 256 };

fg_status fg__near_create(fg__near *out, fg_context *context, const fg__domain *domain,
                          double reach)
{
  *out = (fg__near){.domain = domain};
  size_t bins = 1;
  int most = domain->dimension == 2 ? MOST_BINS : MOST_BINS_IN_SPACE;
  out->bins[2] = 1;
  for (int k = 0; k < domain->dimension; k++) {
    double side = domain->cells[k] * domain->spacing[k];
    out->bins[k] = (int)fmin(fmax(floor(side / reach), 1), most);
    out->size[k] = side / out->bins[k];
    bins *= (size_t)out->bins[k];
  }
  out->top = fg__allocate(bins, sizeof *out->top);
  if (!out->top)
    return fg__fail_memory(context, "points of lines", bins * sizeof *out->top);
  for (size_t i = 0; i < bins; i++)
    out->top[i] = -1;
  return FG_STATUS_OK;
}

void fg__near_clear(fg__near *near)
{
  free(near->top);
  free(near->point);
  *near = (fg__near){0};
}

/* Takes periods off, and finds the bin along each axis. */
static void locate(const fg__near *near, const double position[], double inside[3],
                   int bin[3])
{
  const fg__domain *domain = near->domain;
  inside[2] = bin[2] = 0;
  for (int k = 0; k < domain->dimension; k++) {
    double offset = position[k] - domain->origin[k];
    if (domain->period[k] > 0)
      offset -= floor(offset / domain->period[k]) * domain->period[k];
    inside[k] = domain->origin[k] + offset;
    bin[k] = (int)(offset / near->size[k]);
    bin[k] = bin[k] < 0 ? 0 : bin[k] < near->bins[k] ? bin[k] : near->bins[k] - 1;
  }
}

fg_status fg__near_add(fg__near *near, fg_context *context, const double position[],
                       int line, double s)
{
  if (!fg__grow((void **)&near->point, &near->capacity, (size_t)near->count + 1,
                sizeof *near->point))
    return fg__fail_memory(context, "points of lines",
                           ((size_t)near->count + 1) * sizeof *near->point);
  fg__near_point *point = &near->point[near->count];
  int bin[3] = {0};
  locate(near, position, point->position, bin);
  point->line = line;
  point->s = s;
  point->bin = (bin[2] * near->bins[1] + bin[1]) * near->bins[0] + bin[0];
  point->below = near->top[point->bin];
  near->top[point->bin] = near->count++;
  return FG_STATUS_OK;
}

void fg__near_forget(fg__near *near, int count)
{
  while (near->count > count) {
    const fg__near_point *point = &near->point[--near->count];
    near->top[point->bin] = point->below;
  }
}

/* A search for the nearest point. */
typedef struct query {
  double inside[3];
  double square; /* of the distance */
  int line;
  double s, own;
} query;

static bool is_periodic(const fg__domain *domain)
{
  return domain->period[0] > 0 || domain->period[1] > 0 || domain->period[2] > 0;
}

static bool bin_has(const fg__near *near, int bin, const query *search)
{
  bool periodic = is_periodic(near->domain);
  for (int i = near->top[bin]; i >= 0; i = near->point[i].below) {
    const fg__near_point *point = &near->point[i];
    double way[3];
    for (int k = 0; k < 3; k++)
      way[k] = point->position[k] - search->inside[k];
    if (periodic)
      fg__domain_shortest(near->domain, way);
    if (way[0] * way[0] + way[1] * way[1] + way[2] * way[2] < search->square &&
        (point->line != search->line || fabs(point->s - search->s) > search->own))
      return true;
  }
  return false;
}

/* The bin beside another; -1 where the box ends. */
static int bin_beside(const fg__near *near, const int bin[3], const int step[3])
{
  int index = 0;
  for (int k = 2; k >= 0; k--) {
    int at = bin[k] + step[k];
    if (near->domain->period[k] > 0)
      at = (at + near->bins[k]) % near->bins[k];
    if (at < 0 || at >= near->bins[k])
      return -1;
    index = index * near->bins[k] + at;
  }
  return index;
}

bool fg__near_has(const fg__near *near, const double position[], double distance,
                  int line, double s, double own)
{
  /* the middle first: there most is near */
  static const int order[3] = {0, -1, 1};
  query search = {.square = distance * distance, .line = line, .s = s, .own = own};
  int bin[3] = {0}, beside = near->domain->dimension == 2 ? 9 : 27;
  locate(near, position, search.inside, bin);
  for (int n = 0; n < beside; n++) {
    const int step[3] = {order[n % 3], order[n / 3 % 3], order[n / 9]};
    int there = bin_beside(near, bin, step);
    if (there >= 0 && bin_has(near, there, &search))
      return true;
  }
  return false;
}
