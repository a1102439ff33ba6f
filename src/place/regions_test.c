#include "place/regions.h"

#include "place/placed_test.h"

static void regions_are_those_of_the_arrows(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *icons = place(*state, placement, 15);
  fg_density *regions = NULL;
  assert_int_equal(fg_placement_regions(&regions, placement), FG_STATUS_OK);
  const fg_density_arrays *arrays = fg_density_contents(regions);
  assert_int_equal(arrays->clusters, 15);
  size_t inside = 0, between = 0, active = 0;
  for (int y = 0, n = 0; y < arrays->nodes[1]; ++y)
    for (int x = 0; x < arrays->nodes[0]; ++x, ++n) {
      const double at[3] = {arrays->origin[0] + x * arrays->spacing[0],
                            arrays->origin[1] + y * arrays->spacing[1], 0};
      double nearest[2] = {HUGE_VAL, HUGE_VAL};
      for (int m = 0; m < 15; ++m) {
        double least = HUGE_VAL;
        const fg_icon *icon = fg_icons_at(icons, m);
        for (int i = 0; i < icon->point_count; ++i)
          least = fmin(least, distance_between(at, icon->points[i], 2));
        nearest[1] = fmin(nearest[1], fmax(nearest[0], least));
        nearest[0] = fmin(nearest[0], least);
      }
      /* far from the middle between two arrows */
      if (nearest[0] < 1.4 * lambda_of(placement) &&
          nearest[1] - nearest[0] > 0.2 * lambda_of(placement)) {
        assert_true(arrays->u[n] > 0);
        ++inside;
      } else if (nearest[1] - nearest[0] < 0.1 * arrays->spacing[0]) {
        between += arrays->u[n] < 0;
        assert_true(arrays->u[n] < 0.5F);
      }
    }
  assert_true(inside > 1000 && between > 10);
  for (int n = 0; n < (arrays->nodes[0] - 1) * (arrays->nodes[1] - 1); ++n)
    active += arrays->active[n] != 0;
  double area = (double)active * arrays->spacing[0] * arrays->spacing[1];
  assert_close(area, fg__placement_search(placement)->domain->whole, 0.03 * area);
  fg_density_destroy(regions);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
  field = field_of(*state, &SOLID, swirl);
  placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons_destroy(place(*state, placement, 2));
  assert_int_equal(fg_placement_regions(&regions, placement), FG_STATUS_UNSUPPORTED);
  assert_null(regions);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* A constant flow with many holes. */
static void pierced(const double position[3], double v[3])
{
  const bool hole = sin(5.0 * position[0]) * sin(5.0 * position[1]) > 0.6;
  v[0] = hole ? (double)NAN : 1.5;
  v[1] = 0.5;
}

/* Nothing of a hole counts as slow. */
static void speeds_are_means_over_what_is_there(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, pierced);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *icons = place(*state, placement, 15);
  for (int n = 0; n < 15; ++n)
    assert_close(fg_icons_at(icons, n)->speed, hypot(1.5, 0.5), 1e-5);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(regions_are_those_of_the_arrows),
      CASE(speeds_are_means_over_what_is_there),
  };
  return cmocka_run_group_tests_name("place/regions", tests, NULL, NULL);
}
