/* Points of lines in square (cubic) bins, to find what is near. */
#ifndef FG__RIVAL_NEAR_H
#define FG__RIVAL_NEAR_H

#include "rival/domain.h"

typedef struct fg__near_point {
  double position[3]; /* in the box: periods taken off */
  int line;
  double s;  /* where on its line, arc length */
  int below; /* the next point of its bin, -1: none */
  int bin;
} fg__near_point;

typedef struct fg__near {
  const fg__domain *domain;
  int bins[3];
  double size[3]; /* of a bin: at least the reach */
  int *top;       /* the last point of each bin, -1: none */
  fg__near_point *point;
  size_t capacity;
  int count;
} fg__near;

/* reach: the greatest distance of a search. MEMORY. */
fg_status fg__near_create(fg__near *out, fg_context *context, const fg__domain *domain,
                          double reach);
void fg__near_clear(fg__near *near);

/* MEMORY. */
fg_status fg__near_add(fg__near *near, fg_context *context, const double position[],
                       int line, double s);

/* Takes the last points away, so that `count` are left. */
void fg__near_forget(fg__near *near, int count);

/* Whether a point lies nearer than `distance`, at most the reach, to one of another line
 * than `line`, or of the same farther than `own` from s along it. */
bool fg__near_has(const fg__near *near, const double position[], double distance,
                  int line, double s, double own);

#endif
