/* Moves a line of nodes in 2D to the ridge between them. */
#ifndef FG__CENTERING_H
#define FG__CENTERING_H

#include "cluster/window.h"
#include "skeleton/polyline.h"

/* The distance to the boundary, continued outside by its negative for a cell or so, so
 * that it can be taken between nodes next to the boundary. */
typedef struct fg__signed_distance {
  const fg__window *window;
  double *value; /* at the window's nodes */
} fg__signed_distance;

/* MEMORY. */
fg_status fg__signed_distance_create(fg__signed_distance *out, fg_context *context,
                                     const fg__window *window, const double *distance);
void fg__signed_distance_clear(fg__signed_distance *field);

/* Bilinear value at a point in input coordinates; outside the window that of the nearest
 * point in it. */
double fg__signed_distance_at(const fg__signed_distance *field, const double position[]);

/* Whether the boundary nearest to a point is the domain's, to half a cell. */
bool fg__signed_distance_to_domain(const fg__signed_distance *field,
                                   const double position[]);

/* Moves each point along the normal to where the boundary is equally far on either side,
 * and smooths; points stay about as far apart as they are, and in the window. The first
 * `held[0]` and the last `held[1]` points of an open line are only smoothed, its ends not
 * even that. MEMORY. */
fg_status fg__polyline_center(fg__polyline *line, fg_context *context,
                              const fg__signed_distance *field, int rounds,
                              const int held[2]);

#endif
