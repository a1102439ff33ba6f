/* Land, lakes and borders on a field's plane. */
#ifndef FG__LAND_H
#define FG__LAND_H

#include "coast/coast.h"
#include "picture/map/plane.h"

/* Adds what the plane shows of a layer, and a little more, in the field's coordinates.
 * areas: closed loops to be filled by the even-odd rule; NULL: not wanted, as of borders.
 * lines: open lines along coasts, banks or borders, none along the cut or the rim; NULL:
 * not wanted. MEMORY. */
fg_status fg__land_trace(fg__polygons *areas, fg__polygons *lines, fg_context *context,
                         const fg__plane *plane, fg__coast_layer layer,
                         fg__coast_detail detail);

#endif
