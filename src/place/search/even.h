/* An even start: seeds that need no random number. */
#ifndef FG__PLACE_EVEN_H
#define FG__PLACE_EVEN_H

#include "place/search/search.h"

/* Adds icons at evenly distributed points of the domain, where lines can be, for `count`
 * together with those that are there: each the point farthest from all others, then moved
 * to the centroids of their Voronoi regions (Lloyd, IEEE Transactions on Information
 * Theory 28, 1982). MEMORY, STOPPED. */
fg_status fg__place_fill_evenly(fg__place_search *search, int count);

#endif
