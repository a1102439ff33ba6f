/* Clustering from the top down, after Heckel, Weber, Hamann and Joy, "Construction of
 * Vector Field Hierarchies", IEEE Visualization 1999. */
#ifndef FG__RIVAL_BISECT_H
#define FG__RIVAL_BISECT_H

#include "rival/domain.h"

/* A cluster: some of the cells in a row. */
typedef struct fg__part {
  int first, count;
  double error; /* fg__part_error */
} fg__part;

typedef struct fg__bisection {
  int *cell; /* [valid cells] of the raster, cluster by cluster, x fastest in each */
  fg__part *part;
  int parts;
} fg__bisection;

/* Starts with one cluster of all valid cells and divides, `count` - 1 times, the one with
 * the largest error (of equal ones that with most cells, of those the first), through the
 * mean of its cells, across their principal axis. Clusters of one cell stay. MEMORY,
 * STOPPED. */
fg_status fg__bisect(fg__bisection *out, fg_context *context, const fg__domain *domain,
                     int count);
void fg__bisection_clear(fg__bisection *bisection);

/* How far, on average, streamlines of the field stray from those of the cluster's mean
 * direction that start at the same cells of it, while they go on for the root of its
 * area; input coordinates. */
double fg__part_error(const fg__domain *domain, const int *cell, int count);

#endif
