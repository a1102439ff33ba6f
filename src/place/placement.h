/* A placement as the library's own files see it. */
#ifndef FG__PLACEMENT_H
#define FG__PLACEMENT_H

#include "place/search.h"

/* Its icons, borrowed. */
const fg__place_search *fg__placement_search(const fg_placement *placement);

#endif
