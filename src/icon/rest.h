/* What is left of a cluster far from its arrows. */
#ifndef FG__REST_H
#define FG__REST_H

#include "base/context.h"
#include "cluster/raster.h"

/* Finds the largest piece of a window's cluster whose points all lie far from `count`
 * icons in it; *found says whether it is a match for a cluster: then clear *rest, whose
 * nodes are the window's. MEMORY. */
fg_status fg__rest_find(fg__window *rest, bool *found, fg_context *context,
                        const fg__window *window, const fg_icon *icon, int count,
                        const fg__labels *labels);

/* Whether an icon made in a rest is long enough beside the clusters. */
bool fg__rest_deserves(const fg_icon *icon, const fg__labels *labels);

/* Takes a rest off its window's cluster. */
void fg__rest_give_up(fg__window *window, const fg__window *rest);

/* Divides the area that all of [count] icons, FG__ICON_PARTS at most, of a window have
 * alike: each gets the share of the points that are nearest to it. */
void fg__rest_share_out(fg_icon *icon, int count, const fg__window *window);

#endif
