/* How fast the flow is along an arrow. */
#ifndef FG__ARROW_SPEEDS_H
#define FG__ARROW_SPEEDS_H

#include "base/context.h"

/* |v| at each point of an icon's centreline; beyond the field that of the nearest point
 * before, or else after. Where the field is NULL or shared by several processes, or
 * holds none of the points: the icon's mean speed. *out: free it. MEMORY. */
fg_status fg__arrow_speeds(double **out, fg_context *context, const fg_field *field,
                           const fg_icon *icon);

/* The solid of an icon, and for each of its vertices the speed at its place along the
 * line. *at_vertex: free it. MEMORY, ARGUMENT. */
fg_status fg__arrow_solid(fg_surface **out, float **at_vertex, fg_context *context,
                          const fg_field *field, const fg_icon *icon);

#endif
