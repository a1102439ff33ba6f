#include "place/placement.h"

#include "place/placed_test.h"

static void icons_find_their_clusters(void **state)
{
  /* a disc of u > 0 on the left, one on the right */
  enum { NODES = 61 };
  static float u[NODES * NODES];
  for (int y = 0; y < NODES; ++y)
    for (int x = 0; x < NODES; ++x)
      u[y * NODES + x] =
          hypot(x - 12, y - 30) < 6 || hypot(x - 45, y - 25) < 9 ? 0.9F : -0.9F;
  const fg_density_arrays arrays = {.dimension = 2,
                                    .nodes = {NODES, NODES, 1},
                                    .origin = {-7, 3},
                                    .spacing = {0.2, 0.13, 1},
                                    .u = u};
  fg_density *density = NULL;
  assert_int_equal(fg_density_create_from_arrays(&density, *state, &arrays),
                   FG_STATUS_OK);
  fg_icons *icons = no_icons(*state);
  static const double middles[][2] = {{12, 30}, {45, 25}, {2, 55},
                                      {60, 2},  {25, 30}, {33, 28}};
  for (int n = 0; n < 6; ++n) {
    const double points[2][3] = {{0, 5, 0}, {1, 5, 0}};
    const fg_icon icon = {.cluster = 77,
                          .point_count = 2,
                          .points = points,
                          .center = {-7 + 0.2 * middles[n][0], 3 + 0.13 * middles[n][1]}};
    assert_int_equal(fg__icons_add(icons, *state, &icon), FG_STATUS_OK);
  }
  assert_int_equal(fg_placement_find_clusters(*state, icons, density), FG_STATUS_OK);
  assert_int_equal(fg_icons_clusters(icons), 2);
  int left = fg_icons_at(icons, 0)->cluster, right = fg_icons_at(icons, 1)->cluster;
  assert_true(left + right == 3 && left != right);
  static const bool is_left[] = {true, false, true, false, true, false};
  for (int n = 0; n < 6; ++n)
    assert_int_equal(fg_icons_at(icons, n)->cluster, is_left[n] ? left : right);
  assert_int_equal(fg_placement_find_clusters(*state, NULL, density), FG_STATUS_ARGUMENT);
  fg_icons_destroy(icons);
  fg_density_destroy(density);
}

/* A cluster to the left is nearer than one across a corner. */
static void the_nearest_cluster_is_not_that_of_the_nearest_box(void **state)
{
  enum { NODES = 40 };
  static float u[NODES * NODES];
  for (int y = 0; y < NODES; ++y)
    for (int x = 0; x < NODES; ++x) {
      bool left = x >= 10 && x <= 15 && y >= 17 && y <= 23;
      bool corner = x >= 24 && x <= 29 && y >= 24 && y <= 29;
      u[y * NODES + x] = left || corner ? 0.9F : -0.9F;
    }
  const fg_density_arrays arrays = {
      .dimension = 2, .nodes = {NODES, NODES, 1}, .spacing = {1, 1, 1}, .u = u};
  fg_density *density = NULL;
  assert_int_equal(fg_density_create_from_arrays(&density, *state, &arrays),
                   FG_STATUS_OK);
  fg_icons *icons = no_icons(*state);
  static const double middles[3][2] = {{20, 20}, {12, 20}, {26, 26}};
  for (int n = 0; n < 3; ++n) {
    const double points[2][3] = {{0, 5, 0}, {1, 5, 0}};
    const fg_icon icon = {.cluster = 77,
                          .point_count = 2,
                          .points = points,
                          .center = {middles[n][0], middles[n][1]}};
    assert_int_equal(fg__icons_add(icons, *state, &icon), FG_STATUS_OK);
  }
  assert_int_equal(fg_placement_find_clusters(*state, icons, density), FG_STATUS_OK);
  assert_int_not_equal(fg_icons_at(icons, 1)->cluster, fg_icons_at(icons, 2)->cluster);
  assert_int_equal(fg_icons_at(icons, 0)->cluster, fg_icons_at(icons, 1)->cluster);
  fg_icons_destroy(icons);
  fg_density_destroy(density);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(icons_find_their_clusters),
      CASE(the_nearest_cluster_is_not_that_of_the_nearest_box),
  };
  return cmocka_run_group_tests_name("place/clusters", tests, NULL, NULL);
}
