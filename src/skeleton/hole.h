/* The holes of a cluster in 2D. */
#ifndef FG__HOLE_H
#define FG__HOLE_H

#include "skeleton/graph.h"

/* Finds the largest hole: a cell of the window in it, to the right of which the ray
 * leaves the hole for good (cell[0] = -1 when there is none, or none that holds a whole
 * cell's centre). MEMORY. */
fg_status fg__hole_find(int cell[2], fg_context *context, const fg__graph *graph);

#endif
