#include "picture/arrow_speeds.h"

#include <math.h>
#include <stdlib.h>

#include "icon/icons.h"
#include "picture/solid_field_test.h"

enum { POINTS = 21 };

static double points[POINTS][3];

/* Speed 1 at the side of least x, 5 at the other. */
static bool faster_along_x(const double place[3], double velocity[3])
{
  double speed = 1.0 + 2.0 * (place[0] - field_low[0]);
  velocity[0] = 0.6 * speed;
  velocity[2] = -0.8 * speed;
  return true;
}

/* Along x, from one place to another. */
static fg_icon along_x(double from, double to)
{
  for (int n = 0; n < POINTS; ++n) {
    points[n][0] = from + (to - from) * n / (POINTS - 1);
    points[n][1] = -0.3;
    points[n][2] = 10.2;
  }
  return (fg_icon){.cluster = 1,
                   .point_count = POINTS,
                   .points = (const double(*)[3])points,
                   .width = 0.1,
                   .tail_width = 0.05,
                   .head_length = 0.2,
                   .head_width = 0.15,
                   .speed = 9.0};
}

static void each_point_has_its_speed(void **state)
{
  (void)state;
  fg_field *field = field_of(faster_along_x);
  fg_icon icon = along_x(2.5, 5.5);
  double *speed;
  assert_int_equal(fg__arrow_speeds(&speed, NULL, field, &icon), FG_STATUS_OK);
  for (int n = 0; n < POINTS; ++n) {
    /* beyond the box: of the first and of the last point in it, at 3.1 and at 4.9 */
    double x = fmin(fmax(points[n][0], 3.1), 4.9);
    if (fabs(points[n][0] - 3.0) > 0.01 && fabs(points[n][0] - 5.0) > 0.01)
      assert_true(fabs(speed[n] - (1.0 + 2.0 * (x - 3.0))) < 1e-5);
  }
  free(speed);
  assert_int_equal(fg__arrow_speeds(&speed, NULL, NULL, &icon), FG_STATUS_OK);
  for (int n = 0; n < POINTS; ++n)
    assert_true(fabs(speed[n] - 9.0) < 1e-12);
  free(speed);
  icon = along_x(12.0, 13.0);
  assert_int_equal(fg__arrow_speeds(&speed, NULL, field, &icon), FG_STATUS_OK);
  assert_true(fabs(speed[POINTS - 1] - 9.0) < 1e-12);
  free(speed);
  fg_field_destroy(field);
}

/* A hundred arrows, of which one lies where it is fastest. */
static void the_range_leaves_out_little_length(void **state)
{
  (void)state;
  fg_field *field = field_of(faster_along_x);
  fg_icons *icons;
  double range[2];
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg_solid_speed_range(range, NULL, field, icons), FG_STATUS_OK);
  assert_true(!(range[0] > 0.0) && !(range[1] > 0.0));
  for (int n = 0; n < 100; ++n) {
    fg_icon icon = n == 37 ? along_x(4.8, 4.9) : along_x(3.2, 3.3);
    assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  }
  assert_int_equal(fg_solid_speed_range(range, NULL, field, icons), FG_STATUS_OK);
  assert_true(range[0] > 1.39 && range[0] < 1.42);
  assert_true(range[1] > 1.57 && range[1] < 1.61);
  assert_int_equal(fg_solid_speed_range(range, NULL, field, NULL), FG_STATUS_ARGUMENT);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

/* Of the range of an arrow through the box. */
static double relative_range(bool (*law)(const double place[3], double velocity[3]))
{
  fg_field *field = field_of(law);
  fg_icons *icons;
  double range[2];
  const fg_icon icon = along_x(3.2, 4.8);
  assert_int_equal(fg__icons_create_empty(&icons, NULL), FG_STATUS_OK);
  assert_int_equal(fg__icons_add(icons, NULL, &icon), FG_STATUS_OK);
  assert_int_equal(fg_solid_speed_range(range, NULL, field, icons), FG_STATUS_OK);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
  return range[1] / range[0] - 1.0;
}

static bool hardly_faster_along_x(const double place[3], double velocity[3])
{
  velocity[1] = 3.0 + 1e-5 * place[0];
  return true;
}

static bool little_faster_along_x(const double place[3], double velocity[3])
{
  velocity[1] = 3.0 + 1e-3 * place[0];
  return true;
}

/* Colours that tell rounding errors apart would tell nothing. */
static void speeds_that_hardly_differ_are_one(void **state)
{
  (void)state;
  assert_true(fabs(relative_range(hardly_faster_along_x)) < 1e-12);
  assert_true(relative_range(little_faster_along_x) > 3e-4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_point_has_its_speed),
      cmocka_unit_test(the_range_leaves_out_little_length),
      cmocka_unit_test(speeds_that_hardly_differ_are_one),
  };
  return cmocka_run_group_tests_name("picture/arrow_speeds", tests, NULL, NULL);
}
