/* What an icon tells of itself, found from its centreline, in 2D or 3D. */
#ifndef FG__MEASURE_H
#define FG__MEASURE_H

#include "flowgrain/flowgrain.h"

/* Sets the widths of tail and head, and the head's length, by the body's full width. */
void fg__icon_set_width(fg_icon *icon, int dimension, double width);

/* Sets the center to the point of the centreline nearest to a point, which
 * has a z. */
void fg__icon_set_center(fg_icon *icon, const double center[3]);

/* Of the centreline. */
double fg__icon_length(const fg_icon *icon);

/* Mean of |v| along the centreline by arc length, trapezoidal; input units. */
double fg__icon_mean_speed(const fg_field *field, const fg_icon *icon);

/* A ring or an arrow, by how far it turns in all, radians (fg__streamline_node). */
fg_icon_kind fg__icon_kind_of(double turning);

#endif
