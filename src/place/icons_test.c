#include "place/placement.h"

#include "place/placed_test.h"

static void count_kinds(int kinds[3], fg_context *context, velocity_of velocity,
                        int count)
{
  fg_field *field = field_of(context, &PLAIN, velocity);
  fg_placement *placement = placement_of(context, field, FG_EFFORT_NORMAL);
  fg_icons *icons = place(context, placement, count);
  kinds[0] = kinds[1] = kinds[2] = 0;
  for (int n = 0; n < count; ++n)
    ++kinds[fg_icons_at(icons, n)->kind];
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* Not at every number: a ring needs a radius that a line of its length goes round. */
static void vortices_get_rings_and_sinks_spirals(void **state)
{
  static const int counts[] = {9, 12, 16, 22, 30, 40};
  int rings = 0, spirals = 0, kinds[3];
  for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
    count_kinds(kinds, *state, vortex, counts[n]);
    rings += kinds[FG_ICON_RING];
    assert_int_equal(kinds[FG_ICON_SPIRAL], 0);
    count_kinds(kinds, *state, drain, counts[n]);
    spirals += kinds[FG_ICON_SPIRAL];
    assert_int_equal(kinds[FG_ICON_RING], 0);
    count_kinds(kinds, *state, slant, counts[n]);
    assert_int_equal(kinds[FG_ICON_ARROW], counts[n]);
  }
  assert_true(rings >= 2 && spirals >= 2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(vortices_get_rings_and_sinks_spirals),
  };
  return cmocka_run_group_tests_name("place/icons", tests, NULL, NULL);
}
