/* A box that is cut out of a field: its part of the field's own interpolation. */
#ifndef FG__REGION_H
#define FG__REGION_H

#include "base/context.h"
#include "flowgrain/field.h"

/* Bounds along the first axes; 0 axes: all of the field. */
typedef struct fg__field_region {
  int axes; /* 0, 2 or 3 */
  double low[3], high[3];
} fg__field_region;

/* Samples [first, first + count) of an axis: those in the region, and one more at each
 * end that lies between two. */
typedef struct fg__region_range {
  size_t first, count;
  double low, high; /* where the cut ends: the region's or the axis' bounds */
} fg__region_range;

/* Narrows bounds along axis k, of that name and units (terms/measure.h), to those of the
 * region, which are measured ones. ARGUMENT, with both: they have nothing in common. */
fg_status fg__region_clip(double *low, double *high, fg_context *context,
                          const char *path, const fg__field_region *region, int k,
                          const char *axis, const char *units);

/* Finds the range of ascending coordinates along axis k. ARGUMENT also where no
 * coordinate lies in the region. */
fg_status fg__region_find(fg__region_range *out, fg_context *context, const char *path,
                          const fg__field_region *region, int k, const char *axis,
                          const char *units, const double *coordinate, size_t size);

/* Replaces a whole field by its part in the region, whose outermost samples are
 * interpolated where the region ends between two. What is missing on one side is missing
 * at such an end. ARGUMENT (as above; more axes than the field has; nothing but missing
 * or zero samples), MEMORY. */
fg_status fg__region_cut(fg_field **field, fg_context *context, const char *path,
                         const fg__field_region *region);

#endif
