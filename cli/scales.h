/* Which moments of the evolution become scales. */
#ifndef SCALES_H
#define SCALES_H

#include "program.h"

/* Numbers of clusters at which to take a scale, descending, and how many are behind. */
typedef struct scale_plan {
  int wanted[MAX_SCALES];
  int count;
  int next;    /* wanted[next] has not been reached; count: all have */
  bool placed; /* these are numbers of arrows: each is a scale of its own */
} scale_plan;

/* Starts with a list, or with none: the default one follows from the first number of
 * clusters seen, or is that of placed arrows in 2D or 3D. */
void scale_plan_start(scale_plan *plan, const int *list, int count);
void scale_plan_start_placed(scale_plan *plan, const int *list, int count, int dimension);

/* Says how many wanted numbers the state with `clusters` clusters is the first at or
 * below; 0: it is no scale. One state is one scale, however many numbers it passes at
 * once. `clusters` 0 means that nucleation still goes on. */
int scale_plan_reach(scale_plan *plan, int clusters);

bool scale_plan_done(const scale_plan *plan);

/* Share of the way from `first` clusters, the first number seen, to the plan's last: the
 * logarithm of the number falls about evenly. 0 when nothing can be said yet. */
double scale_plan_share(const scale_plan *plan, int first, int clusters);

/* Seconds left, by N ~ t^-0.43; negative when nothing can be said yet. `clusters`, `time`
 * and `seconds` now, and `time_0`, `seconds_0` when the number of clusters was first
 * known. */
double scale_plan_seconds_left(const scale_plan *plan, int clusters, double time,
                               double seconds, double time_0, double seconds_0);

#endif
