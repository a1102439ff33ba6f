/* Lines without the kinks that a broad stroke cannot follow. */
#ifndef FG__SMOOTH_LINE_H
#define FG__SMOOTH_LINE_H

#include "flowgrain/icons.h"

#include <stdbool.h>

/* Averages a line along itself with a kernel that leaves parabolas as they are (of fourth
 * order: Gasser and Mueller 1979), over `reach` to either side, less on tight arcs and
 * towards the ends, which stay. *out is allocated: free it; NULL where no point moves by
 * `least` or more. The third coordinate is 0. False: no memory. */
bool fg__smooth_line(double (**out)[3], int *count, const double (*points)[3],
                     int point_count, double reach, double least);

/* The line of a placed icon as it is drawn; *out is allocated: free it, NULL: as it is.
 * Those of clusters stay, for they are known to lie in their clusters. 2D. False: no
 * memory. */
bool fg__icon_smooth(double (**out)[3], int *count, const fg_icon *icon);

#endif
