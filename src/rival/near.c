#include "rival/near.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Along an axis: together they take 64 MB, and 4 million lines would not fill them. */
enum { MOST_BINS = 4096 };

fg_status fg__near_create(fg__near *out, fg_context *context, const fg__domain *domain,
                          double reach)
{
  *out = (fg__near){.domain = domain};
  size_t bins = 1;
  for (int k = 0; k < 2; k++) {
    double side = domain->cells[k] * domain->spacing[k];
    out->bins[k] = (int)fmin(fmax(floor(side / reach), 1), MOST_BINS);
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
static void locate(const fg__near *near, const double position[2], double inside[2],
                   int bin[2])
{
  const fg__domain *domain = near->domain;
  for (int k = 0; k < 2; k++) {
    double offset = position[k] - domain->origin[k];
    if (domain->period[k] > 0)
      offset -= floor(offset / domain->period[k]) * domain->period[k];
    inside[k] = domain->origin[k] + offset;
    bin[k] = (int)(offset / near->size[k]);
    bin[k] = bin[k] < 0 ? 0 : bin[k] < near->bins[k] ? bin[k] : near->bins[k] - 1;
  }
}

fg_status fg__near_add(fg__near *near, fg_context *context, const double position[2],
                       int line, double s)
{
  if (!fg__grow((void **)&near->point, &near->capacity, (size_t)near->count + 1,
                sizeof *near->point))
    return fg__fail_memory(context, "points of lines",
                           ((size_t)near->count + 1) * sizeof *near->point);
  fg__near_point *point = &near->point[near->count];
  int bin[2];
  locate(near, position, point->position, bin);
  point->line = line;
  point->s = s;
  point->bin = bin[1] * near->bins[0] + bin[0];
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

/* What is asked for. */
typedef struct query {
  double inside[2];
  double square; /* of the distance */
  int line;
  double s, own;
} query;

static bool bin_has(const fg__near *near, int bin, const query *asked)
{
  bool periodic = near->domain->period[0] > 0 || near->domain->period[1] > 0;
  for (int i = near->top[bin]; i >= 0; i = near->point[i].below) {
    const fg__near_point *point = &near->point[i];
    double way[2] = {point->position[0] - asked->inside[0],
                     point->position[1] - asked->inside[1]};
    if (periodic)
      fg__domain_shortest(near->domain, way);
    if (way[0] * way[0] + way[1] * way[1] < asked->square &&
        (point->line != asked->line || fabs(point->s - asked->s) > asked->own))
      return true;
  }
  return false;
}

bool fg__near_has(const fg__near *near, const double position[2], double distance,
                  int line, double s, double own)
{
  /* the middle first: there most is near */
  static const int order[3] = {0, -1, 1};
  query asked = {.square = distance * distance, .line = line, .s = s, .own = own};
  int bin[2];
  locate(near, position, asked.inside, bin);
  for (int dy = 0; dy < 3; dy++)
    for (int dx = 0; dx < 3; dx++) {
      int at[2] = {bin[0] + order[dx], bin[1] + order[dy]};
      bool there = true;
      for (int k = 0; k < 2; k++) {
        if (near->domain->period[k] > 0)
          at[k] = (at[k] + near->bins[k]) % near->bins[k];
        there = there && at[k] >= 0 && at[k] < near->bins[k];
      }
      if (there && bin_has(near, at[1] * near->bins[0] + at[0], &asked))
        return true;
    }
  return false;
}
