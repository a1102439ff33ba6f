/* A placement as the library's own files see it. */
#ifndef FG__PLACEMENT_H
#define FG__PLACEMENT_H

#include "place/descent.h"

fg_context *fg__placement_context(const fg_placement *placement);
const fg_field *fg__placement_field(const fg_placement *placement);

/* Places icons from an even start as fg_placement_place does, whatever there was before;
 * fewer where no more fit. MEMORY, STOPPED. */
fg_status fg__placement_begin_again(fg_placement *placement, int count);

/* As fg_placement_resume, without those icons whose lines find no room on this field;
 * *missing is how many. MEMORY, STOPPED. */
fg_status fg__placement_resume(fg_placement *placement, const fg_icons *icons,
                               int *missing);

/* Its icons, borrowed; none before the first scale. */
const fg__place_search *fg__placement_search(const fg_placement *placement);

#endif
