/* Arrows too small beside the others. */
#include <stdlib.h>

#include "base/context_test.h"
#include "icon/specks.h"
#include "solid/make.h"

enum { COUNT = 9 };

/* A bent arrow, one part along x and the double of it along y. */
static fg_icon bent(double length, double area)
{
  double(*point)[3] = calloc(3, sizeof *point);
  assert_non_null(point);
  point[0][0] = -2.5;
  point[0][1] = 7;
  point[1][0] = point[2][0] = point[0][0] + length / 3;
  point[1][1] = point[0][1];
  point[2][1] = point[0][1] - 2 * length / 3;
  return (fg_icon){.points = (const double(*)[3])point, .point_count = 3, .area = area};
}

/* Whether the last of COUNT arrows, moved along y, stays; the second place holds none,
 * and the others are 10 to 16 long with areas of 4 on average. */
static bool stays_apart(double length, double area, double way)
{
  fg_context *context;
  fg_icon icon[COUNT] = {{0}};
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (int n = 0; n < COUNT - 1; n++)
    if (n != 1)
      icon[n] = bent(n == 0 ? 13 : 9 + n, n % 2 ? 5 : 3.25);
  icon[COUNT - 1] = bent(length, area);
  double(*point)[3] = (double(*)[3])(uintptr_t)icon[COUNT - 1].points;
  for (int k = 0; k < 3; k++)
    point[k][1] += way;
  assert_int_equal(fg__icons_drop_specks(icon, context, COUNT), FG_STATUS_OK);
  for (int n = 0; n < COUNT - 1; n++)
    assert_true((icon[n].points != NULL) == (n != 1));
  bool there = icon[COUNT - 1].points != NULL;
  for (int n = 0; n < COUNT; n++)
    fg__solid_icon_free(&icon[n]);
  fg_context_destroy(context);
  return there;
}

static bool stays(double length, double area)
{
  return stays_apart(length, area, 0);
}

/* The root of the mean area is 1.9 with it. */
static void one_far_from_all_others_stays(void **state)
{
  (void)state;
  assert_false(stays_apart(2, 0.4, 1));
  assert_true(stays_apart(2, 0.4, 6));
}

static void short_arrows_of_small_clusters_go(void **state)
{
  (void)state;
  assert_false(stays(2, 0.4));
  assert_true(stays(2, 2));   /* it would leave a hole */
  assert_true(stays(8, 0.4)); /* it is seen well */
}

static void a_lone_arrow_stays(void **state)
{
  (void)state;
  fg_context *context;
  fg_icon icon[2] = {bent(0.01, 1e-9), {0}};
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  assert_int_equal(fg__icons_drop_specks(icon, context, 2), FG_STATUS_OK);
  assert_non_null(icon[0].points);
  fg__solid_icon_free(&icon[0]);
  assert_int_equal(fg__icons_drop_specks(icon, context, 2), FG_STATUS_OK);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(short_arrows_of_small_clusters_go),
      cmocka_unit_test(one_far_from_all_others_stays),
      cmocka_unit_test(a_lone_arrow_stays),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
