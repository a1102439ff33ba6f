/* Fields that the rivals are tested on: sides, cells and origin that are nothing special.
 */
#ifndef FG__RIVAL_FIELDS_TEST_H
#define FG__RIVAL_FIELDS_TEST_H

#include "base/context_test.h"
#include "icon/measure.h"

#include <math.h>

#define CASE(function)                                                                   \
  cmocka_unit_test_setup_teardown(function, context_set_up, context_tear_down)

enum { COLUMNS = 61, ROWS = 45 };
static const double CORNER[2] = {-7, 3};
static const double SAMPLING[2] = {0.5, 0.4};

typedef void (*velocity_of)(double x, double y, double velocity[2]);

/* Samples a formula; NAN is missing. With `round` the x axis closes after COLUMNS. */
static inline fg_field *field_of(fg_context *context, velocity_of velocity, bool round)
{
  static float sample[2][COLUMNS * ROWS];
  static double axis[2][COLUMNS];
  for (int i = 0; i < COLUMNS; i++)
    axis[0][i] = CORNER[0] + SAMPLING[0] * i;
  for (int j = 0; j < ROWS; j++)
    axis[1][j] = CORNER[1] + SAMPLING[1] * j;
  for (int j = 0; j < ROWS; j++)
    for (int i = 0; i < COLUMNS; i++) {
      double v[2];
      velocity(axis[0][i], axis[1][j], v);
      sample[0][j * COLUMNS + i] = (float)v[0];
      sample[1][j * COLUMNS + i] = (float)v[1];
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {COLUMNS, ROWS, 1},
                            .axis = {axis[0], axis[1]},
                            .period = {round ? COLUMNS * SAMPLING[0] : 0},
                            .velocity = {sample[0], sample[1]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* A vortex and a saddle, of unlike speeds. */
static inline void swirl(double x, double y, double v[2])
{
  v[0] = 3 * sin(0.35 * y) + 0.4;
  v[1] = 2 * sin(0.28 * x) - 0.3;
}

/* The same with an island and a missing corner. */
static inline void coast(double x, double y, double v[2])
{
  swirl(x, y, v);
  if (hypot(x - 4, y - 11) < 3 || x + y < 0)
    v[0] = (double)NAN;
}

/* A uniform flow. */
static const double SLANT = 0.6;
static inline void slant(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = 4 * cos(SLANT);
  v[1] = 4 * sin(SLANT);
}

static inline double angle_between(const double a[2], const double b[2])
{
  return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/* Every piece of every icon follows the flow within `most` radians, inside the domain. */
static inline void assert_along_flow(const fg_icons *icons, const fg_field *field,
                                     double most)
{
  for (int n = 0; n < fg_icons_count(icons); n++) {
    const fg_icon *icon = fg_icons_at(icons, n);
    for (int i = 1; i < icon->point_count; i++) {
      const double *p = icon->points[i - 1], *q = icon->points[i];
      double piece[2] = {q[0] - p[0], q[1] - p[1]}, tangent[3];
      double middle[2] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
      assert_true(fg_field_tangent(field, middle, tangent));
      assert_true(fabs(angle_between(piece, tangent)) < most);
    }
  }
}

static inline fg_rival *rival_of(fg_context *context, const fg_field *field,
                                 fg_rival_method method, int nodes)
{
  fg_rival_options options = {.method = method, .nodes = nodes};
  fg_rival *rival = NULL;
  assert_int_equal(fg_rival_create(&rival, context, field, &options), FG_STATUS_OK);
  return rival;
}

/* The icons of a method whose icons are pieces of streamlines. */
static inline fg_icons *curved_icons(fg_rival *rival, const fg_field *field, int count)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg_rival_icons(&icons, rival, count), FG_STATUS_OK);
  assert_along_flow(icons, field, 0.03);
  return icons;
}

#endif
