#include <math.h>

#include "base/context_test.h"
#include "icon/icons.h"

/* Speeds of icons whose other properties do not matter. */
static void range_of(double range[2], const double *speed, int count, double unit)
{
  const double points[2][3] = {{1, 2, 0}, {4, 3, 0}};
  fg_context *context = NULL;
  fg_icons *icons = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  for (int n = 0; n < count; ++n) {
    fg_icon icon = {.cluster = n + 1,
                    .point_count = 2,
                    .points = points,
                    .width = 0.1,
                    .speed = unit * speed[n]};
    assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
  }
  fg_icons_speed_range(range, icons);
  fg_icons_destroy(icons);
  fg_context_destroy(context);
}

static void assert_range(const double *speed, int count, double low, double high)
{
  for (double unit = 0.01; unit < 300; unit *= 17) {
    double range[2];
    range_of(range, speed, count, unit);
    assert_true(fabs(range[0] - unit * low) <= 1e-12 * unit * high);
    assert_true(fabs(range[1] - unit * high) <= 1e-12 * unit * high);
  }
}

static void even_speeds_are_all_in_the_range(void **state)
{
  (void)state;
  const double even[] = {7, 3, 11, 5, 2, 9, 4, 12, 8, 6};
  assert_range(even, 10, 2, 12);
  /* a long tail is no outlier: each is less than 3 quartile distances away */
  const double tail[] = {1, 1.4, 2, 2.7, 3.6, 4.8, 6.5, 8.8, 12};
  assert_range(tail, 9, 1, 12);
}

static void one_far_out_does_not_rule_the_others(void **state)
{
  (void)state;
  const double fast[] = {7, 3, 11, 5, 90, 2, 9, 4, 12, 8, 6};
  assert_range(fast, 11, 2, 12);
  const double two[] = {7, 3, 61, 11, 5, 90, 2, 9, 4, 12, 8, 6};
  assert_range(two, 12, 2, 12);
}

static void few_or_equal_speeds_have_no_outliers(void **state)
{
  (void)state;
  const double interpolated[] = {0.99998, 0.99995, 0.99998, 0.99991};
  assert_range(interpolated, 4, 0.99998, 0.99998);
  const double near[] = {0.9998, 0.9999, 1.0, 0.9995};
  assert_range(near, 4, 0.9995, 1.0);
  const double few[] = {2, 3, 4, 3, 2, 90, 3};
  assert_range(few, 7, 2, 90);
  const double equal[] = {5, 5, 5, 5, 5, 5, 5, 5, 5, 8};
  assert_range(equal, 10, 5, 8);
  double none[2] = {3, 4};
  range_of(none, NULL, 0, 1);
  assert_true(none[0] == 0 && none[1] == 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(even_speeds_are_all_in_the_range),
      cmocka_unit_test(one_far_out_does_not_rule_the_others),
      cmocka_unit_test(few_or_equal_speeds_have_no_outliers),
  };
  return cmocka_run_group_tests_name("icon/speeds", tests, NULL, NULL);
}
