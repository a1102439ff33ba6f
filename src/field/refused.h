/* Samples that no flow has: what they are told by, and the messages. */
#ifndef FG__REFUSED_H
#define FG__REFUSED_H

#include "field/field.h"

/* The method has no scale; larger numbers are refused, whose products overflow. */
extern const double fg__largest_number;

/* Whether coordinate i of those along an axis is so large, and so far from all others,
 * that it stands for a missing one. */
bool fg__is_apart_coordinate(const double *coordinate, size_t size, size_t i);

/* The same of points' coordinates, `step` apart: the first of a few that are far beyond
 * the others; else `count`. */
size_t fg__find_apart_position(const double *coordinate, size_t step, size_t count);

/* The largest speed along an axis, and the largest other one. */
typedef struct fg__fastest {
  double speed, next;
  int component;
  size_t sample;
} fg__fastest;

void fg__fastest_add(fg__fastest *fastest, double value, int component, size_t sample);

/* Whether the largest is too large, or lies so far beyond all others that it stands for a
 * missing value. */
bool fg__fastest_is_none(const fg__fastest *fastest);

/* Whether the components of sample i are all the same one of the numbers that stand for
 * missing data in many files: -999, -9999, ... */
bool fg__is_missing_code(const float *const velocity[3], int dimension, size_t i);

/* Refuses samples of which some are such codes in both components, before they are
 * resampled: "PATH: ...". FILE_FORMAT. */
fg_status fg__refuse_missing_codes(fg_context *context, const char *path,
                                   float *const velocity[2], size_t count);

/* Refuses a sample; `i` is its index among those held. ARGUMENT. */
fg_status fg__field_fail_speed(const fg_field *field, fg_context *context,
                               const fg__fastest *fastest);
fg_status fg__field_fail_code(const fg_field *field, fg_context *context, double value,
                              size_t i);

#endif
