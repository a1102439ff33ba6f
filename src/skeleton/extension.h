/* Lines in 2D that go on to a cluster's boundary. */
#ifndef FG__EXTENSION_H
#define FG__EXTENSION_H

#include "skeleton/centering.h"

/* Takes both ends of an open line straight on to the boundary, in the direction that the
 * line has over the distance to the boundary; or, with `to_farthest`, in that of the
 * middle of what lies farthest beyond its end: the tip of a lens, the middle of a blunt
 * end. An end nearest to the domain's boundary, or heading for it, always keeps its own
 * direction, as the cluster would go on beyond: on[0] and on[1] (`on` may be NULL) are
 * how far such a first and last end went on, 0 for others. Points at the ends that lie
 * outside are dropped first. MEMORY. */
fg_status fg__polyline_extend(fg__polyline *line, fg_context *context,
                              const fg__signed_distance *field, bool to_farthest,
                              double on[2]);

/* Replaces a line by the chord of the cluster through a point, along the direction in
 * which the cluster's nodes lie farthest apart, the x axis when there is none. False when
 * there is no memory. */
bool fg__polyline_make_chord(fg__polyline *line, const fg__window *window,
                             const double middle[2]);

#endif
