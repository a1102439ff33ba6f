/* Arrows of a given length through given points, in 2D or 3D. */
#ifndef FG__RIVAL_ARROWS_H
#define FG__RIVAL_ARROWS_H

#include "rival/line.h"

/* Body width of a rival's arrow in its lengths: that of most arrows of `run`, between
 * 0.03 and 0.075 (icon/arrow.c). */
#define FG__RIVAL_WIDTH 0.06

/* The straight arrow whose middle is a point, along the flow there, cut where the domain
 * ends. icon->points is allocated, or NULL where the flow stands still or less than a
 * cell is left. MEMORY. */
fg_status fg__rival_straight(fg_icon *icon, fg_context *context, const fg__domain *domain,
                             const double middle[], double length);

/* The piece of a streamline whose middle is a point of the box; as above. It turns by 300
 * degrees at most and ends at periodic boundaries. `line` is kept from call to call.
 * MEMORY.
 */
fg_status fg__rival_curved(fg_icon *icon, fg_context *context, const fg__domain *domain,
                           const double middle[], double length, fg__line *line);

/* The piece of a line from one arc length to another as an icon, moved by whole periods
 * so that its middle lies in the box; as above. MEMORY. */
fg_status fg__rival_piece(fg_icon *icon, fg_context *context, const fg__domain *domain,
                          const fg__line *line, double from, double to, double width);

void fg__rival_free_points(fg_icon *icon);

#endif
