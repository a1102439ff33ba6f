#include "place/placement.h"

#include "icon/icons.h"

#include "place/placed_test.h"

/* The kind of the icon through a point at `radius` from the eye, all round as far as a
 * line may turn, or a quarter of that. */
static fg_icon_kind kind_at(fg_context *context, velocity_of velocity, double radius,
                            double share)
{
  enum { COUNT = 12 };
  fg_field *field = field_of(context, &PLAIN, velocity);
  fg_placement *placement = placement_of(context, field, FG_EFFORT_QUICK);
  fg_icons *icons = place(context, placement, COUNT), *made;
  fg_icon *icon = fg__icons_change(icons, 4);
  icon->seed[0] = EYE[0] + 0.6 * radius;
  icon->seed[1] = EYE[1] - 0.8 * radius;
  icon->way[0] = icon->way[1] = share * 164.0 * DEGREE * radius;
  assert_int_equal(fg_placement_resume(placement, icons), FG_STATUS_OK);
  assert_int_equal(fg_placement_icons(&made, placement), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(made), COUNT);
  fg_icon_kind kind = fg_icons_at(made, 4)->kind;
  fg_icons_destroy(made);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
  return kind;
}

static void orbits_are_rings_and_swirls_spirals(void **state)
{
  for (double radius = 0.5; radius < 1.0; radius += 0.15) {
    assert_int_equal(kind_at(*state, vortex, radius, 1.0), FG_ICON_RING);
    assert_int_equal(kind_at(*state, drain, radius, 1.0), FG_ICON_SPIRAL);
    assert_int_equal(kind_at(*state, slant, radius, 1.0), FG_ICON_ARROW);
    assert_int_equal(kind_at(*state, vortex, radius, 0.5), FG_ICON_ARROW);
  }
}

static void count_kinds(int kinds[3], fg_context *context, velocity_of velocity,
                        fg_effort effort, int count)
{
  fg_field *field = field_of(context, &PLAIN, velocity);
  fg_placement *placement = placement_of(context, field, effort);
  fg_icons *icons = place(context, placement, count);
  kinds[0] = kinds[1] = kinds[2] = 0;
  for (int n = 0; n < count; ++n)
    ++kinds[fg_icons_at(icons, n)->kind];
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void no_field_gets_a_kind_that_it_has_not(void **state)
{
  static const int counts[] = {9, 14, 30};
  int kinds[3];
  for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
    const fg_effort effort = n < 2 ? FG_EFFORT_NORMAL : FG_EFFORT_QUICK;
    count_kinds(kinds, *state, vortex, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_SPIRAL], 0);
    count_kinds(kinds, *state, drain, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_RING], 0);
    count_kinds(kinds, *state, slant, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_ARROW], counts[n]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(orbits_are_rings_and_swirls_spirals),
      CASE(no_field_gets_a_kind_that_it_has_not),
  };
  return cmocka_run_group_tests_name("place/icons", tests, NULL, NULL);
}
