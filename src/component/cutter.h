/* How a box is cut into pieces of components, row by row: rows into runs of positive
 * nodes (component/rows.c), which neighbouring rows join (component/joins.c); and what
 * becomes of them (component/cut.c). */
#ifndef FG__COMPONENT_CUTTER_H
#define FG__COMPONENT_CUTTER_H

#include "component/shape.h"

enum { FG__WHOLE_CELL = 1 << 24 }; /* in steps of a share */

typedef struct fg__cutter {
  fg__components *components;
  fg__shape shape;
  int run_count;
  unsigned char *marks; /* of a row's positive nodes; zeros before and after */
  unsigned char *cells; /* active cells round the x-edge that starts at each node, from
                           node -1; only with a mask */
  int *ends;            /* where runs start, and where each has ended; then steps */
  float *plane[2];      /* shares from the planes of cells before and after the row */
  float *space;
  int64_t exact_below; /* as in the box, in steps of a share; 0: every run is measured at
                          once */
} fg__cutter;

/* Marks the positive nodes of row (j, k), of a masked grid only those with an active
 * cell, whose number it then writes to `cells`. */
void fg__cutter_mark(fg__cutter *cutter, int j, int k);

/* Rows of cells round row (j, k) of nodes: what covered nodes count is in units of 2^-d
 * cells. */
int fg__cutter_row_weight(const fg__shape *shape, int j, int k);

/* Cuts row (j, k) into runs, for which there is room; returns what they cover. */
int64_t fg__cutter_cut_row(fg__cutter *cutter, int j, int k);

/* Finds the steps of a stretch of row (j, k), from the shares in `plane`; their sum over
 * a part of it. */
void fg__cutter_measure(const fg__cutter *cutter, int j, int k,
                        fg__component_stretch nodes);
int64_t fg__cutter_steps(const fg__cutter *cutter, int first, int last);

/* Joins row (j, k) with row `beside` of its plane, across the row of cells `cell`. */
void fg__cutter_join_beside(fg__cutter *cutter, int j, int beside, int cell, int k);

/* Joins row (j, k) with those of plane `below`, across the plane of cells k - 1. */
void fg__cutter_join_below(fg__cutter *cutter, int j, int k, int below);

/* The root of a run's tree. */
static inline int fg__cutter_root(struct fg__component_run *run, int index)
{
  while (run[index].parent != index) {
    run[index].parent = run[run[index].parent].parent;
    index = run[index].parent;
  }
  return index;
}

/* Joins two trees; the earlier root stays, so that a root is its piece's first run. */
static inline void fg__cutter_join(struct fg__component_run *run, int a, int b)
{
  if (run[a].parent == run[b].parent)
    return;
  a = fg__cutter_root(run, a);
  b = fg__cutter_root(run, b);
  if (a < b)
    run[b].parent = a;
  else
    run[a].parent = b;
}

#endif
