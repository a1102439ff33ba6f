/* Samples that no flow has: what they are told by, and the messages. */
#ifndef FG__REFUSED_H
#define FG__REFUSED_H

#include "field/field.h"

/* Larger speeds are refused: light makes 3e8 m/s (3e14 um/s), so they are fill values
 * that the file did not declare; and up to here (v / cos latitude)^2 is finite in float.
 */
extern const double fg__field_largest_speed;

/* Whether the components of sample i are all the same one of the numbers that stand for
 * missing data in many files: -999, -9999, ... */
bool fg__is_missing_code(const float *const velocity[3], int dimension, size_t i);

/* Refuses samples of which some are such codes in both components, before they are
 * resampled: "PATH: ...". FILE_FORMAT. */
fg_status fg__refuse_missing_codes(fg_context *context, const char *path,
                                   float *const velocity[2], size_t count);

/* Refuses a sample; `i` is its index among those held. ARGUMENT. */
fg_status fg__field_fail_speed(const fg_field *field, fg_context *context, int k,
                               double value, size_t i);
fg_status fg__field_fail_code(const fg_field *field, fg_context *context, double value,
                              size_t i);

#endif
