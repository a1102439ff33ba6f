/* The outline of where a field in 3D is, or moves. */
#ifndef FG__SILHOUETTE_H
#define FG__SILHOUETTE_H

#include "base/context.h"

/* The surface that tells a reader where arrows can be; *out becomes NULL where the box
 * does. Where more than half of the domain is slow (field/still.h: a vessel in noise), it
 * is where the speed is a fifth of that above which lies half of the sum of |v|^2: a
 * share of the vessel's own speed, however small its part of the box; a branch as thin as
 * a sample counts. Else it is the surface of where the field is valid. Both are taken
 * from a raster, smoothed over two of its cells, without crumbs, and open where they end
 * at the box. A field of which other processes hold parts has none. MEMORY. */
fg_status fg__silhouette_create(fg_surface **out, fg_context *context,
                                const fg_field *field);

#endif
