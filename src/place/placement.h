/* A placement as the library's own files see it. */
#ifndef FG__PLACEMENT_H
#define FG__PLACEMENT_H

#include "place/search/search.h"

/* More take minutes and a gigabyte. */
enum { FG__MOST_ARROWS = 20000 };

fg_context *fg__placement_context(const fg_placement *placement);
const fg_field *fg__placement_field(const fg_placement *placement);

/* Places icons from an even start, whatever there was before, fewer where no more fit.
 * MEMORY, STOPPED. */
fg_status fg__placement_begin_again(fg_placement *placement, int count);

/* As fg_placement_resume, without those icons whose lines find no room on this field;
 * *missing is how many. MEMORY, STOPPED. */
fg_status fg__placement_resume(fg_placement *placement, const fg_icons *icons,
                               int *missing);

/* Whether an icon comes from a placement, not from a cluster. */
bool fg__place_is_placed(const fg_icon *icon);

/* The seed of an icon: the one it was placed from; of a cluster's icon the middle of its
 * line, and half its length each way. */
fg__place_seed fg__place_seed_of(const fg_icon *icon, const fg__place_scale *scale);

/* Its icons, borrowed. */
const fg__place_search *fg__placement_search(const fg_placement *placement);

#endif
