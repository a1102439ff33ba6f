/* Distance to a cluster's border for the nodes next to it. */
#ifndef FG__BORDER_H
#define FG__BORDER_H

#include "cluster/raster.h"

/* Sets `distance` (the window's nodes) to the distance from the border at nodes near it,
 * on either side, and to infinity elsewhere. The border is the zero set of the bilinear
 * level in the active cells, the positive parts of the edges between active and masked
 * cells, and, if it counts, of the domain's border. Values up to the smaller spacing are
 * exact but for taking the hyperbola in a cell as two chords (an eighth of its bend off);
 * larger ones are upper bounds. */
void fg__border_distance(double *distance, const fg__window *window,
                         bool domain_border_counts);

#endif
