#include "base/context_test.h"
#include "icon/icons.h"

static fg_icon icon_of(int cluster, const double (*points)[3], int count)
{
  return (fg_icon){.cluster = cluster,
                   .point_count = count,
                   .points = points,
                   .width = 0.25 * cluster,
                   .center = {points[0][0], points[0][1], 0}};
}

static void keeps_copies_in_order(void **state)
{
  (void)state;
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 0);
  assert_null(fg_icons_at(icons, 0));

  const fg_icon *first = NULL;
  for (int i = 1; i <= 40; i++) {
    double points[3][3] = {{i, 2, 0}, {i + 1, 3, 0}, {i + 5, 7, 0}};
    fg_icon icon = icon_of(i, (const double(*)[3])points, 2 + i % 2);
    assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
    points[0][0] = -1; /* the list must not see this */
    if (i == 1)
      first = fg_icons_at(icons, 0);
  }
  fg__icons_set_clusters(icons, 43, 3);

  assert_int_equal(fg_icons_count(icons), 40);
  assert_int_equal(fg_icons_clusters(icons), 43);
  assert_int_equal(fg_icons_dropped(icons), 3);
  assert_ptr_equal(fg_icons_at(icons, 0), first);
  assert_null(fg_icons_at(icons, 40));
  assert_null(fg_icons_at(icons, -1));
  for (int i = 1; i <= 40; i++) {
    const fg_icon *icon = fg_icons_at(icons, i - 1);
    assert_int_equal(icon->cluster, i);
    assert_int_equal(icon->point_count, 2 + i % 2);
    assert_true(icon->points[0][0] == i);
    assert_true(icon->points[1][1] == 3);
    assert_true(icon->width == 0.25 * i);
  }
  fg_icons_destroy(icons);
  fg_icons_destroy(NULL);
  fg_context_destroy(context);
}

static void refuses_an_icon_without_a_line(void **state)
{
  (void)state;
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  double point[1][3] = {{4, 5, 0}};
  fg_icon icon = icon_of(1, (const double(*)[3])point, 1);
  assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_icons_count(icons), 0);
  fg_icons_destroy(icons);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(keeps_copies_in_order),
      cmocka_unit_test(refuses_an_icon_without_a_line),
  };
  return cmocka_run_group_tests_name("icon/icons", tests, NULL, NULL);
}
