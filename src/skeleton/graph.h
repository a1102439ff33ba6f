/* The nodes inside a cluster as a graph: each joined to those of its eight neighbours
 * that the cluster joins it to. */
#ifndef FG__GRAPH_H
#define FG__GRAPH_H

#include "cluster/raster.h"
#include "skeleton/heap.h"

typedef struct fg__graph {
  const fg__window *window;
  int nodes;             /* of the window */
  unsigned char *joined; /* a bit for each of the eight directions */
  double *cost;          /* [nodes] of a unit of length on the ridge paths */
  double *total;    /* [2 nodes] of the last search; infinite where it did not come */
  int *from;        /* [2 nodes] the state before; -1 at the source */
  int cut_x, cut_y; /* a cell in a hole: paths that cross the ray from its centre
                       towards larger x change sides; -1: no ray */
  fg__heap heap;
} fg__graph;

enum { FG__GRAPH_DIRECTIONS = 8 };

/* One step in each direction. */
extern const int fg__graph_step[FG__GRAPH_DIRECTIONS][2];

/* Builds the graph; cost is set to make paths keep to the ridge of `distance`. MEMORY. */
fg_status fg__graph_create(fg__graph *out, fg_context *context, const fg__window *window,
                           const double *distance);
void fg__graph_clear(fg__graph *graph);

/* Searches the shortest paths (Dijkstra) from a node, by length or by cost. A state is
 * node + nodes * side; the source is on side 0. Ends at the state `target` (-1: goes on
 * to the end); *last is the last state settled, the farthest one. MEMORY. */
fg_status fg__graph_search(fg__graph *graph, fg_context *context, int source, int target,
                           bool by_cost, int *last);

/* The length of the path that the last search found to a state. */
double fg__graph_length(const fg__graph *graph, int state);

/* How many holes the cluster has, by Euler's formula. */
int fg__graph_holes(const fg__graph *graph);

#endif
