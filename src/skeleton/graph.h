/* The nodes inside a cluster as a graph: in 2D each is joined to those of its 8
 * neighbours that the cluster joins it to, in 3D to all of its 26 that lie inside. */
#ifndef FG__GRAPH_H
#define FG__GRAPH_H

#include <stdint.h>

#include "cluster/window.h"
#include "skeleton/heap.h"

enum { FG__GRAPH_DIRECTIONS = 26 };

typedef struct fg__graph {
  const fg__window *window;
  int nodes;                           /* of the window */
  int directions;                      /* 8 or 26 */
  int step[FG__GRAPH_DIRECTIONS][3];   /* in 2D first along the axes, then the diagonals,
                                          anticlockwise */
  int offset[FG__GRAPH_DIRECTIONS];    /* from a node to its neighbour */
  double length[FG__GRAPH_DIRECTIONS]; /* input coordinates */
  uint32_t *joined;                    /* [nodes] a bit for each direction */
  double *cost;     /* [nodes] of a unit of length on the ridge paths */
  double *total;    /* [nodes, 2D: 2 nodes] of the last search; infinite where it did not
                       come */
  int *from;        /* the same of the state before; -1 at the source */
  int cut_x, cut_y; /* 2D: a cell in a hole: paths that cross the ray from its centre
                       towards larger x change sides; -1: no ray */
  fg__heap heap;
} fg__graph;

/* Builds the graph; cost is set to make paths keep to the ridge of `distance`. MEMORY. */
fg_status fg__graph_create(fg__graph *out, fg_context *context, const fg__window *window,
                           const double *distance);
void fg__graph_clear(fg__graph *graph);

/* Searches the shortest paths (Dijkstra) from a node, by length or by cost. A state is
 * node + nodes * side (3D: node); the source is on side 0. Ends at the state `target`
 * (-1: goes on to the end); *last is the last state settled, the farthest one. MEMORY. */
fg_status fg__graph_search(fg__graph *graph, fg_context *context, int source, int target,
                           bool by_cost, int *last);

/* The length of the path that the last search found to a state. */
double fg__graph_length(const fg__graph *graph, int state);

/* How many holes a cluster in 2D has, by Euler's formula. */
int fg__graph_holes(const fg__graph *graph);

#endif
