/* The rows of a field that a slab of it reads. */
#ifndef FG__ROWS_H
#define FG__ROWS_H

#include "base/context.h"
#include "flowgrain/field.h"

/* What a reader is to read: slab `number` of `count` (field/slab.h), or with a count of 1
 * all. */
typedef struct fg__slab_index {
  int number, count;
} fg__slab_index;

/* Rows along the last axis: [first, first + own) and up to `held` what follows. */
typedef struct fg__rows {
  int first, own, held;
} fg__rows;

/* The rows of a slab; all when there are fewer than slabs: then `slab` becomes that. */
fg__rows fg__rows_of(fg__slab_index *slab, int rows, bool periodic);

/* The field of the arrays of such rows; velocity[k], which is arrays->velocity[k],
 * becomes NULL where the field takes it over. */
fg_status fg__field_of_rows(fg_field **out, fg_context *context,
                            const fg_field_arrays *arrays, float *velocity[3],
                            const fg__slab_index *slab);

/* The rows of a slab of a field that is there whole, or a copy of all of it where it has
 * fewer rows than there are slabs. */
fg_status fg__field_slab_of(fg_field **out, fg_context *context, const fg_field *whole,
                            fg__slab_index slab);

/* A number as a velocity: a finite one beyond float becomes the largest float, which is
 * larger than any speed that is accepted. */
float fg__as_velocity(double number);

#endif
