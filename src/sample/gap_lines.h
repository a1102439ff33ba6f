/* Gaps along the axes of a grid. */
#ifndef FG__GAP_LINES_H
#define FG__GAP_LINES_H

#include "base/context.h"
#include "flowgrain/field.h"

/* How many intervals of an axis with `size` samples go over gaps (gaps.h). */
size_t fg__axis_gaps(const double *axis, size_t size);

/* Puts a line of missing samples in the middle of each gap along an axis of arrays that
 * are there whole, so that nothing is interpolated over it. velocity[k], *valid and
 * axis[k] are replaced where there is a gap: axis[k], which is NULL before, by one to be
 * freed, also after a failure. MEMORY. */
fg_status fg__gap_lines_insert(fg_field_arrays *arrays, float *velocity[3],
                               unsigned char **valid, double *axis[3],
                               fg_context *context);

#endif
