/* Which states of an evolution become scales. */
#ifndef FG__PLAN_H
#define FG__PLAN_H

#include "flowgrain/run.h"

/* Numbers at which to take a scale, descending, or times, ascending, and how many are
 * reached. */
typedef struct fg__plan {
  int wanted[FG_MOST_SCALES];
  double times[FG_MOST_SCALES];
  int count;
  int next;    /* wanted[next] has not been reached; count: all have */
  bool timed;  /* `times` are wanted */
  bool placed; /* these are numbers of arrows: each is a scale of its own */
} fg__plan;

/* Starts with a list, or with none: the default one follows from the first number of
 * clusters seen, or is that of placed arrows in 2D or 3D. */
void fg__plan_start(fg__plan *plan, const int *list, int count);
void fg__plan_start_placed(fg__plan *plan, const int *list, int count, int dimension);

void fg__plan_start_timed(fg__plan *plan, const double *times, int count);

/* Says how many wanted numbers of clusters a state is the first at or below, or how many
 * times it is the first at or after; 0: it is no scale. One state is one scale, however
 * many it passes at once. Without clusters, while phases separate, it reaches no number.
 */
int fg__plan_reach(fg__plan *plan, const fg_step *step);

bool fg__plan_done(const fg__plan *plan);

/* Share of the way from the first state with a number of clusters to the plan's last: the
 * logarithm of the number falls about evenly; of times that of the time. 0 when nothing
 * can be said yet. */
double fg__plan_share(const fg__plan *plan, const fg_step *first, const fg_step *now);

/* Seconds left, by N ~ t^-0.43, from a state and the first with a number of clusters;
 * negative when nothing can be said yet. */
double fg__plan_seconds_left(const fg__plan *plan, const fg_step *now,
                             const fg_step *first);

/* Nodes along the longest side of the mesh for clusters of that number. */
int fg__plan_nodes(const fg_field *field, int clusters);

#endif
