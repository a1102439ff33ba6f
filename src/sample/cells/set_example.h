/* Sets of cells for the tests. */
#ifndef FG__CELL_SET_EXAMPLE_H
#define FG__CELL_SET_EXAMPLE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "sample/cells/set.h"

static inline double linear(const double p[3])
{
  return 4.0 - 1.5 * p[0] + 0.75 * p[1] + 2.25 * p[2];
}

static inline fg__cell_set set_of(fg_context *context, const double *position,
                                  size_t points)
{
  fg__cell_set set = {.context = context, .path = "cells", .points = points};
  set.position = malloc(3 * points * sizeof(double));
  assert_non_null(set.position);
  memcpy(set.position, position, 3 * points * sizeof(double));
  fg_context_clear(context);
  return set;
}

static inline void add(fg__cell_set *set, fg__cell_shape shape, const int *corner)
{
  assert_int_equal(fg__cell_set_add_points(set, shape, corner, (int)set->numbers++),
                   FG_STATUS_OK);
}

static inline void locate(fg__cell_set *set)
{
  if (fg__cell_set_locate(set) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(set->context));
}

static inline size_t samples_of(const fg__cell_set *set)
{
  return (size_t)set->size[0] * (size_t)set->size[1] * (size_t)set->size[2];
}

static inline void position_of(double out[3], const fg__cell_set *set, size_t n)
{
  for (int k = 0; k < 3; ++k) {
    out[k] = set->origin[k] + set->spacing[k] * (double)(n % (size_t)set->size[k]);
    n /= (size_t)set->size[k];
  }
}

static inline float *sample(const fg__cell_set *set, double (*value)(const double p[3]))
{
  float *of_point = malloc(set->points * sizeof *of_point);
  float *out = malloc(samples_of(set) * sizeof *out);
  assert_true(of_point && out);
  for (size_t p = 0; p < set->points; ++p)
    of_point[p] = (float)value(set->position + 3 * p);
  fg__cell_set_sample(out, set, of_point, 0, samples_of(set));
  free(of_point);
  return out;
}

#endif
