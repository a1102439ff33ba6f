/* What an icon in 3D tells of itself, found from its centreline: icon/measure.h in space.
 */
#ifndef FG__SOLID_MEASURE_H
#define FG__SOLID_MEASURE_H

#include "flowgrain/flowgrain.h"

/* Sets the widths of tail and head, and the head's length, by the body's full width. */
void fg__solid_set_width(fg_icon *icon, double width);

/* Sets the center to the point of the centreline nearest to a point. */
void fg__solid_set_center(fg_icon *icon, const double center[3]);

/* Mean of |v| along the centreline by arc length, trapezoidal; input units. */
double fg__solid_mean_speed(const fg_field *field, const fg_icon *icon);

/* A ring or an arrow, by the angles along it added up, radians. */
fg_icon_kind fg__solid_kind_of(double turning);

#endif
