/* Fields made of a formula, their textures, and what is measured in these. */
#ifndef FG__PAINTED_TEST_H
#define FG__PAINTED_TEST_H

#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "flowgrain/texture.h"

/* A box of 3 x 2 at (10, -2), with few samples: pixels are far finer. */
enum { SAMPLES_X = 25, SAMPLES_Y = 17 };

typedef struct formula {
  void (*velocity)(double v[2], double x, double y, double angle);
  double angle; /* degrees, for the formula */
  bool periodic;
} formula;

static inline void straight(double v[2], double x, double y, double angle)
{
  (void)x;
  (void)y;
  v[0] = 7.0 * cos(angle);
  v[1] = 7.0 * sin(angle);
}

/* Round (11.7, -0.9), the slower the nearer. */
static inline void swirl(double v[2], double x, double y, double angle)
{
  (void)angle;
  v[0] = -3.0 * (y + 0.9);
  v[1] = 3.0 * (x - 11.7);
}

/* Three waves over the width of the box. */
static inline void waves(double v[2], double x, double y, double angle)
{
  (void)y;
  v[0] = 4.0;
  v[1] = 3.0 * sin(2.0 * angle * (x - 10.0));
}

/* Missing in a corner, still in another. */
static inline void holes(double v[2], double x, double y, double angle)
{
  straight(v, x, y, angle);
  if (x < 11.0 && y < -1.2)
    v[0] = (double)NAN;
  if (x > 12.0 && y > -0.9)
    v[0] = v[1] = 0.0;
}

static inline fg_field *field_of(fg_context *context, const formula *f)
{
  double x[SAMPLES_X], y[SAMPLES_Y];
  float u[SAMPLES_X * SAMPLES_Y], v[SAMPLES_X * SAMPLES_Y];
  const int across = f->periodic ? SAMPLES_X : SAMPLES_X - 1;
  for (int i = 0; i < SAMPLES_X; ++i)
    x[i] = 10.0 + 3.0 * i / across;
  for (int j = 0; j < SAMPLES_Y; ++j)
    y[j] = -2.0 + 2.0 * j / (SAMPLES_Y - 1);
  for (int n = 0; n < SAMPLES_X * SAMPLES_Y; ++n) {
    double velocity[2];
    f->velocity(velocity, x[n % SAMPLES_X], y[n / SAMPLES_X],
                f->angle * acos(-1.0) / 180.0);
    u[n] = (float)velocity[0];
    v[n] = (float)velocity[1];
  }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {SAMPLES_X, SAMPLES_Y, 0},
                            .axis = {x, y, NULL},
                            .velocity = {u, v, NULL}};
  arrays.period[0] = f->periodic ? 3.0 : 0.0;
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static inline fg_texture *texture_of(fg_context *context, const formula *f,
                                     const fg_texture_options *options)
{
  fg_field *field = field_of(context, f);
  fg_texture *texture = NULL;
  if (fg_texture_create(&texture, context, field, options))
    fail_msg("%s", fg_context_message(context));
  fg_field_destroy(field);
  return texture;
}

static inline double value_at(const fg_texture_arrays *t, int i, int j)
{
  return (double)t->value[(size_t)j * (size_t)t->size[0] + (size_t)i];
}

/* A rectangle of pixels. */
typedef struct part {
  int first[2], size[2];
} part;

static inline part whole_of(const fg_texture_arrays *t)
{
  return (part){{0, 0}, {t->size[0], t->size[1]}};
}

static inline double mean_of(const fg_texture_arrays *t, part p)
{
  double sum = 0.0;
  for (int j = 0; j < p.size[1]; ++j)
    for (int i = 0; i < p.size[0]; ++i)
      sum += value_at(t, p.first[0] + i, p.first[1] + j);
  return sum / p.size[0] / p.size[1];
}

static inline double spread_within(const fg_texture_arrays *t, part p)
{
  const double mean = mean_of(t, p);
  double sum = 0.0;
  for (int j = 0; j < p.size[1]; ++j)
    for (int i = 0; i < p.size[0]; ++i) {
      const double off = value_at(t, p.first[0] + i, p.first[1] + j) - mean;
      sum += off * off;
    }
  return sqrt(sum / p.size[0] / p.size[1]);
}

/* How alike pixels are that lie (dx, dy) apart: 1 the same, 0 nothing in common. */
static inline double correlation(const fg_texture_arrays *t, int dx, int dy)
{
  const double mean = mean_of(t, whole_of(t));
  double both = 0.0, square = 0.0;
  for (int j = abs(dy); j < t->size[1] - abs(dy); ++j)
    for (int i = abs(dx); i < t->size[0] - abs(dx); ++i) {
      const double here = value_at(t, i, j) - mean;
      both += here * (value_at(t, i + dx, j + dy) - mean);
      square += here * here;
    }
  return both / square;
}

/* The direction, 0 to 180 degrees, in which a part's values change least: that of the
 * structure tensor's smaller eigenvalue. */
static inline double streaks_angle(const fg_texture_arrays *t, part p)
{
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int j = 1; j < p.size[1] - 1; ++j)
    for (int i = 1; i < p.size[0] - 1; ++i) {
      const int x = p.first[0] + i, y = p.first[1] + j;
      double gx = 0.0, gy = 0.0;
      for (int n = -1; n <= 1; ++n) {
        const double weight = n ? 3.0 : 10.0; /* Scharr 2000: true to direction */
        gx += weight * (value_at(t, x + 1, y + n) - value_at(t, x - 1, y + n));
        gy += weight * (value_at(t, x + n, y + 1) - value_at(t, x + n, y - 1));
      }
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  const double across = 0.5 * atan2(2.0 * xy, xx - yy) * 180.0 / acos(-1.0);
  return fmod(across + 90.0 + 180.0, 180.0);
}

static inline double angle_between(double a, double b)
{
  const double difference = fabs(fmod(a - b + 540.0, 180.0));
  return fmin(difference, 180.0 - difference);
}

#endif
