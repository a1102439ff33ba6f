/* One placement of icons: a descent from clusters, even points, icons of another
 * placement or a finer scale. */
#ifndef FG__PLACE_DESCENT_H
#define FG__PLACE_DESCENT_H

#include "place/search/search.h"

/* More take minutes and a gigabyte. */
enum { FG__MOST_ARROWS = 20000 };

/* What is placed, and how; several may be at work on one domain. */
typedef struct fg__place_descent {
  fg_context *context;
  const fg__place_domain *domain;
  const fg_placement_options *options;
  fg__threads *threads;     /* borrowed; NULL: the caller alone */
  fg__place_search *search; /* NULL: none has begun */
} fg__place_descent;

/* How a placement comes from many icons to few. */
typedef struct fg__place_schedule {
  double ratio; /* of the numbers of icons in a chain of scales */
  double start; /* of a first scale: icons where the chain begins, as a multiple of those
                   wanted */
} fg__place_schedule;

/* That of a first scale, and the ratio of a coarser one's chain. */
extern const fg__place_schedule fg__place_first_schedule;
extern const double fg__place_chain_ratio;

/* The most icons that are placed; more would be far smaller than the samples resolve. */
double fg__descent_most(const fg__place_domain *domain);

/* Records that so many icons have no room, and how many have. ARGUMENT. */
fg_status fg__descent_fail(const fg__place_descent *descent, int wanted, int fitting);

/* Whether an icon comes from a placement, not from a cluster. */
bool fg__place_is_placed(const fg_icon *icon);

/* The seed of an icon: the one it was placed from; of a cluster's icon the middle of its
 * line, and half its length each way. */
fg__place_seed fg__place_seed_of(const fg_icon *icon, const fg__place_scale *scale);

/* Ends the search. */
void fg__descent_clear(fg__place_descent *descent);

/* Starts a search for `count` icons, of which there are none yet. ARGUMENT, MEMORY. */
fg_status fg__descent_begin(fg__place_descent *descent, int count, fg__place_grain grain);

/* Places a first scale, from clusters or, where that is NULL, from even points: first
 * more icons, as far as the field may have room for them, of which those stay that tell
 * most. ARGUMENT, MEMORY, STOPPED. */
fg_status fg__descent_first(fg__place_descent *descent, int count,
                            const fg_icons *clusters, const fg__place_schedule *by);

/* Places icons near those of another placement. ARGUMENT, MEMORY, STOPPED. */
fg_status fg__descent_near(fg__place_descent *descent, int count, const fg_icons *icons);

/* From the present icons to `count` of them, which is fewer, by a chain of scales.
 * MEMORY, STOPPED. */
fg_status fg__descent_go_down(fg__place_descent *descent, int count, double ratio);

/* Exchanges icons and relaxes them, as far as the options' effort goes. MEMORY, STOPPED.
 */
fg_status fg__descent_refine(fg__place_descent *descent);

#endif
