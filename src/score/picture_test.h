/* Fields by formulas and icons by hand. */
#ifndef FG__SCORE_PICTURE_TEST_H
#define FG__SCORE_PICTURE_TEST_H

#include "base/context_test.h"
#include "icon/icons.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CASE(function)                                                                   \
  cmocka_unit_test_setup_teardown(function, context_set_up, context_tear_down)

typedef void (*velocity_of)(const double position[3], double velocity[3]);

/* A box sampled at so many nodes a side; no z in 2D. */
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

static inline fg_icons *no_icons(fg_context *context)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  return icons;
}

static inline void add_line(fg_icons *icons, fg_context *context,
                            const double (*points)[3], int count)
{
  const fg_icon icon = {.cluster = 1, .point_count = count, .points = points};
  assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
}

static inline void add_straight(fg_icons *icons, fg_context *context, double x, double y,
                                double to_x, double to_y)
{
  const double points[2][3] = {{x, y, 0}, {to_x, to_y, 0}};
  add_line(icons, context, points, 2);
}

static inline fg_score score_of(fg_context *context, const fg_field *field,
                                const fg_icons *icons, const fg_score_options *options)
{
  fg_score score;
  if (fg_icons_score(&score, context, field, icons, options) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  return score;
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

/* Crooked lines anywhere in the box and a little beyond. */
static inline void add_scribbles(fg_icons *icons, fg_context *context,
                                 const sampling *box, int count, double step)
{
  unsigned state = 7;
  for (int n = 0; n < count; ++n) {
    double points[9][3] = {{0}};
    for (int k = 0; k < box->dimension; ++k)
      points[0][k] =
          box->low[k] + (box->high[k] - box->low[k]) * (1.1 * next_random(&state) - 0.05);
    for (int i = 1; i < 9; ++i)
      for (int k = 0; k < box->dimension; ++k)
        points[i][k] = points[i - 1][k] + step * (next_random(&state) - 0.3);
    add_line(icons, context, (const double(*)[3])points, 9 - n % 4);
  }
}

#endif
