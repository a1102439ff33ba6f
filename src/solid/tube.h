/* The solid of an icon with a number that varies along it. */
#ifndef FG__TUBE_H
#define FG__TUBE_H

#include "base/context.h"

/* fg_icon_solid, and for each of its vertices the value at its place along the line:
 * `value` has one for each point of the centreline, between which it is linear.
 * *at_vertex: free it. MEMORY, ARGUMENT. */
fg_status fg__solid_with_values(fg_surface **out, float **at_vertex, fg_context *context,
                                const fg_icon *icon, const double *value);

#endif
