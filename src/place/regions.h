/* Which icon reads a point: the one that is nearest to it. */
#ifndef FG__PLACE_REGIONS_H
#define FG__PLACE_REGIONS_H

#include "place/search/search.h"

/* What the points of an icon's region add up to. */
typedef struct fg__place_share {
  double measure; /* area or volume */
  double speed;   /* mean |v| */
} fg__place_share;

/* A share for each icon of a search, by the cells of its raster. MEMORY. */
fg_status fg__place_find_shares(fg__place_share *out, fg_context *context,
                                const fg__place_search *search);

#endif
