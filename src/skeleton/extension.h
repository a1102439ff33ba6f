/* Lines that go on to a cluster's border. */
#ifndef FG__EXTENSION_H
#define FG__EXTENSION_H

#include "skeleton/centering.h"

/* Takes both ends of an open line on to the border: each goes on in the direction and
 * with the curvature that it has over the distance to the border. Points at the ends that
 * lie outside are dropped first. False when there is no memory. */
bool fg__polyline_extend(fg__polyline *line, const fg__signed_distance *field);

/* Replaces a line by the chord of the cluster through a point, along the direction in
 * which the cluster's nodes lie spread widest, the x axis when they do not. False when
 * there is no memory. */
bool fg__polyline_make_chord(fg__polyline *line, const fg__window *window,
                             const double middle[2]);

#endif
