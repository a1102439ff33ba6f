/* The best of several placements of one scale. */
#ifndef FG__PLACE_BEST_H
#define FG__PLACE_BEST_H

#include "place/descent.h"

/* Places `count` icons: a first scale, from clusters or even points, or else a scale that
 * is coarser than the present one. Several placements are made where the effort is worth
 * it, by several threads (options), which give the same result as one. ARGUMENT (so many
 * have no room), MEMORY, STOPPED. */
fg_status fg__place_best(fg__place_descent *descent, int count, const fg_icons *clusters,
                         bool is_first);

#endif
