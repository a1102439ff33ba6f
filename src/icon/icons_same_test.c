/* What icons do not depend on. */
#include "icon/bench_test.h"

static void mirrored_vortex(double x, double y, double v[2])
{
  vortex(20 - x, y, v);
  v[0] = -v[0];
}

static void fast_vortex(double x, double y, double v[2])
{
  vortex(x, y, v);
  v[0] *= 1024;
  v[1] *= 1024;
}

static double mirrored_family(double x, double y)
{
  return family(20 - x, y);
}

static void assert_same_line(const fg_icon *a, const fg_icon *b, bool mirror,
                             double tolerance)
{
  assert_int_equal(a->kind, b->kind);
  assert_true(fabs(fg__icon_length(a) - fg__icon_length(b)) <= tolerance);
  /* a head's clearance changes at once where a barb meets the boundary */
  assert_true(fabs(a->width - b->width) <= 0.2 * a->width);
  for (int end = 0; end < 2; end++) {
    const double *p = a->points[end * (a->point_count - 1)];
    const double *q = b->points[end * (b->point_count - 1)];
    double x = mirror ? 20 - q[0] : q[0];
    assert_true(hypot(p[0] - x, p[1] - q[1]) <= tolerance);
  }
}

static void mirrors_with_the_field(void **state)
{
  (void)state;
  test_bench plain = bench_of(vortex, family);
  test_bench mirror = bench_of(mirrored_vortex, mirrored_family);
  assert_int_equal(fg_icons_count(plain.icons), 4);
  assert_int_equal(fg_icons_count(mirror.icons), 4);
  for (int i = 0; i < 4; i++) {
    const fg_icon *icon = fg_icons_at(plain.icons, i), *image = NULL;
    for (int k = 0; k < 4; k++) { /* the order of the labels differs */
      const fg_icon *other = fg_icons_at(mirror.icons, k);
      if (fabs(other->area - icon->area) < 1e-3)
        image = other;
    }
    assert_non_null(image);
    assert_same_line(icon, image, true, 3 * SHAPE_SPACING);
  }
  end_bench(&plain);
  end_bench(&mirror);
}

static void knows_no_unit_of_speed(void **state)
{
  (void)state;
  test_bench plain = bench_of(vortex, family);
  test_bench fast = bench_of(fast_vortex, family);
  for (int i = 0; i < fg_icons_count(plain.icons); i++) {
    const fg_icon *a = fg_icons_at(plain.icons, i), *b = fg_icons_at(fast.icons, i);
    assert_int_equal(a->point_count, b->point_count);
    assert_memory_equal(a->points, b->points,
                        (size_t)a->point_count * sizeof a->points[0]);
    assert_true(fabs(b->speed / a->speed - 1024) < 1e-6);
  }
  end_bench(&plain);
  end_bench(&fast);
}

static void is_the_same_on_any_number_of_threads(void **state)
{
  (void)state;
  test_bench one = bench_with(vortex, family, NULL, 1);
  for (int threads = 2; threads <= 5; threads += 3) {
    test_bench more = bench_with(vortex, family, NULL, threads);
    assert_int_equal(fg_icons_count(one.icons), fg_icons_count(more.icons));
    for (int i = 0; i < fg_icons_count(one.icons); i++) {
      fg_icon a = *fg_icons_at(one.icons, i), b = *fg_icons_at(more.icons, i);
      assert_int_equal(a.point_count, b.point_count);
      assert_memory_equal(a.points, b.points, (size_t)a.point_count * sizeof a.points[0]);
      assert_memory_equal(a.center, b.center, sizeof a.center);
      assert_int_equal(a.cluster, b.cluster);
      assert_true(a.width == b.width && a.speed == b.speed && a.area == b.area);
    }
    end_bench(&more);
  }
  end_bench(&one);
}

static void stops_when_asked(void **state)
{
  (void)state;
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = field_of(context, vortex);
  fg_density *density = density_of(context, family, NULL);
  fg_icons *icons = NULL;
  fg_context_stop(context);
  assert_int_equal(fg_icons_create(&icons, context, field, density, NULL),
                   FG_STATUS_STOPPED);
  assert_null(icons);
  assert_int_equal(fg_icons_create(&icons, context, NULL, density, NULL),
                   FG_STATUS_ARGUMENT);
  fg_density_destroy(density);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mirrors_with_the_field),
      cmocka_unit_test(knows_no_unit_of_speed),
      cmocka_unit_test(is_the_same_on_any_number_of_threads),
      cmocka_unit_test(stops_when_asked),
  };
  return cmocka_run_group_tests_name("icon/icons_same", tests, NULL, NULL);
}
