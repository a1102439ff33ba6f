/* Long streamlines, each from the place farthest from those before, after Mebarki,
 * Alliez and Devillers, "Farthest Point Seeding for Efficient Placement of Streamlines",
 * IEEE Visualization 2005; in 2D or 3D. */
#ifndef FG__RIVAL_FARTHEST_H
#define FG__RIVAL_FARTHEST_H

#include "rival/streamline/lines.h"

/* How near a line may come to others while it goes on, in separations: seeds are at least
 * 1.6 times as far from them. */
#define FG__FARTHEST_TEST 0.625

/* Places lines, at most `most`, until no cell is a separation away from all of them.
 * `out` is all zero, or lines to use again. MEMORY, STOPPED. */
fg_status fg__farthest_place(fg__lines *out, fg_context *context,
                             const fg__domain *domain, double separation, int most);

/* Finds the largest separation, but for a hundredth, that gives `count` lines, and places
 * them; where even the narrowest gives fewer, those. As above. */
fg_status fg__farthest_search(fg__lines *out, fg_context *context,
                              const fg__domain *domain, int count);

#endif
