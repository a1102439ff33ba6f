/* Fields as files hold them: an axis without end gets one. */
#ifndef FG__FIELD_CLOSE_H
#define FG__FIELD_CLOSE_H

#include "base/context.h"

/* How many samples a field has. */
size_t fg__field_samples(const fg_field_arrays *field);

/* A field's arrays, or owned copies that end where they began. */
typedef struct fg__closed_field {
  fg_field_arrays arrays;
  double *axis[3];
  float *velocity[3];
} fg__closed_field;

/* Copies a field and repeats the first sample of each periodic axis at its end, but not
 * of a circle of longitude, which readers close. Without such an axis all arrays are
 * borrowed, with one the texts are. To be cleared even after a failure. MEMORY. */
fg_status fg__closed_field_create(fg__closed_field *out, fg_context *context,
                                  const fg_field_arrays *field);
void fg__closed_field_clear(fg__closed_field *closed);

#endif
