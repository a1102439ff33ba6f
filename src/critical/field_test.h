/* Fields by formulas. */
#ifndef FG__CRITICAL_FIELD_TEST_H
#define FG__CRITICAL_FIELD_TEST_H

#include "base/context_test.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CASE(function)                                                                   \
  cmocka_unit_test_setup_teardown(function, context_set_up, context_tear_down)

typedef void (*velocity_of)(const double position[3], double velocity[3]);

/* A box and its nodes along each side; no z in 2D. */
typedef struct sampling {
  int dimension, nodes[3];
  double low[3], high[3];
  bool round; /* x closes one spacing after its last node */
  fg_scale scale;
} sampling;

/* Samples a formula; NAN is missing. */
static inline fg_field *field_of(fg_context *context, const sampling *box,
                                 velocity_of velocity)
{
  double *axis[3] = {0};
  float *sample[3] = {0};
  size_t samples = 1;
  fg_field *field = NULL;
  fg_field_arrays arrays = {.dimension = box->dimension, .scale = box->scale};
  for (int k = 0; k < box->dimension; ++k) {
    const int nodes = arrays.size[k] = box->nodes[k];
    arrays.axis[k] = axis[k] = calloc((size_t)nodes, sizeof(double));
    for (int i = 0; i < nodes; ++i)
      axis[k][i] = box->low[k] + (box->high[k] - box->low[k]) * i / (nodes - 1);
    samples *= (size_t)nodes;
  }
  for (int k = 0; k < box->dimension; ++k)
    arrays.velocity[k] = sample[k] = calloc(samples, sizeof(float));
  if (box->round)
    arrays.period[0] = (box->high[0] - box->low[0]) * box->nodes[0] / (box->nodes[0] - 1);
  for (size_t n = 0; n < samples; ++n) {
    double position[3] = {0}, v[3] = {0};
    size_t rest = n;
    for (int k = 0; k < box->dimension; ++k) {
      position[k] = axis[k][rest % (size_t)box->nodes[k]];
      rest /= (size_t)box->nodes[k];
    }
    velocity(position, v);
    for (int k = 0; k < box->dimension; ++k)
      sample[k][n] = (float)v[k];
  }
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  for (int k = 0; k < 3; ++k) {
    free(axis[k]);
    free(sample[k]);
  }
  return field;
}

static inline void assert_close(double found, double expected, double most)
{
  if (!(fabs(found - expected) <= most))
    fail_msg("%.12g, not %.12g within %g", found, expected, most);
}

/* Boxes and fields that are nothing special. */
static const sampling PLAIN = {
    .dimension = 2, .nodes = {31, 22}, .low = {-7, 3}, .high = {5, 11}};
static const double SLANT = 0.6;

static inline void slant(const double position[3], double v[3])
{
  (void)position;
  v[0] = 4 * cos(SLANT);
  v[1] = 4 * sin(SLANT);
}

/* Vortices and saddles. */
static inline void swirl(const double position[3], double v[3])
{
  v[0] = 3 * sin(0.75 * position[1]) + 0.4;
  v[1] = 2 * sin(0.68 * position[0]) - 0.3;
  v[2] = cos(0.5 * position[0] - position[1]) + 0.2 * position[2];
}

/* The same with an island and a missing corner. */
static inline void coast(const double position[3], double v[3])
{
  const double *p = position;
  swirl(position, v);
  if (hypot(p[0] + 1, p[1] - 6) < 1.3 || p[0] + p[1] < -1)
    v[0] = (double)NAN;
}

/* Random numbers in [0, 1). */
static inline double next_random(unsigned *state)
{
  *state = *state * 1664525U + 1013904223U;
  return (*state >> 8) / 16777216.0;
}

#endif
