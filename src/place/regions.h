/* The region of an icon: the points that are nearer to it than to any other. */
#ifndef FG__PLACE_REGIONS_H
#define FG__PLACE_REGIONS_H

#include "place/search/search.h"

/* An icon's region. */
typedef struct fg__place_region {
  double measure; /* area or volume */
  double moving;  /* of what moves */
  double speed;   /* mean |v| of that */
} fg__place_region;

/* Measures the region of each icon of a search, by the cells of its raster; out[] is
 * zeroed. MEMORY. */
fg_status fg__place_measure_regions(fg__place_region *out, fg_context *context,
                                    const fg__place_search *search);

#endif
