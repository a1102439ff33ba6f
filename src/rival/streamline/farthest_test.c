#include "rival/fields_test.h"
#include "rival/streamline/farthest.h"
#include "rival/streamline/lines_test.h"
#include "rival/streamline/voids.h"

#include <stdlib.h>

static double distance_to(const fg__domain *domain, const double place[2],
                          double (*points)[3], int count)
{
  double least = HUGE_VAL;
  for (int i = 0; i < count; i++) {
    double way[2] = {place[0] - points[i][0], place[1] - points[i][1]};
    fg__domain_shortest(domain, way);
    least = fmin(least, hypot(way[0], way[1]));
  }
  return least;
}

/* Brings each cell's distance to the lines so far up to date with line n. */
static void approach(double *distance, fg_context *context, const fg__domain *domain,
                     const fg__lines *lines, int n)
{
  double(*points)[3];
  int count =
      sample_line(&points, context, domain, lines, n, fg__domain_cell_size(domain) / 2);
  for (int i = 0; i < fg__domain_cell_count(domain); i++) {
    double center[2];
    fg__domain_center(domain, i, center);
    distance[i] = fmin(distance[i], distance_to(domain, center, points, count));
  }
  free(points);
}

static double largest(const double *distance, const fg__domain *domain)
{
  double most = 0;
  for (int i = 0; i < fg__domain_cell_count(domain); i++)
    if (domain->valid[i])
      most = fmax(most, distance[i]);
  return most;
}

/* Every seed after the first is as far from the lines before it as any cell is, but for
 * places from which only a short line would come; those keep a share of the number. */
static void seeds_are_farthest(fg_context *context, velocity_of velocity, bool round)
{
  fg_field *field = field_of(context, velocity, round);
  fg__domain domain;
  fg__lines lines = {0};
  assert_int_equal(fg__domain_create(&domain, context, field, 61), FG_STATUS_OK);
  assert_int_equal(fg__farthest_search(&lines, context, &domain, 17), FG_STATUS_OK);
  assert_int_equal(lines.count, 17);
  double *distance = calloc((size_t)fg__domain_cell_count(&domain), sizeof *distance);
  assert_non_null(distance);
  for (int i = 0; i < fg__domain_cell_count(&domain); i++)
    distance[i] = HUGE_VAL;
  int farthest = 0;
  for (int n = 0; n < lines.count; n++) {
    int cell = fg__domain_cell(&domain, lines.part[n].seed);
    assert_true(cell >= 0 && domain.valid[cell]);
    /* half a cell: samples of the lines, and how distances are passed on */
    double slack = fg__domain_cell_size(&domain) / 2;
    assert_true(distance[cell] > lines.separation - slack);
    farthest += n > 0 && distance[cell] > largest(distance, &domain) - slack;
    approach(distance, context, &domain, &lines, n);
  }
  assert_true(farthest > 12);
  free(distance);
  fg__lines_clear(&lines);
  fg__domain_clear(&domain);
  fg_field_destroy(field);
}

static void each_seed_is_farthest_from_the_lines(void **state)
{
  seeds_are_farthest(*state, swirl, false);
  seeds_are_farthest(*state, coast, false);
  seeds_are_farthest(*state, swirl, true);
}

/* Points of lines are a sixteenth of a separation apart in the method. */
static void lines_keep_their_distance(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, coast, false);
  fg__domain domain;
  fg__lines lines = {0};
  assert_int_equal(fg__domain_create(&domain, context, field, 121), FG_STATUS_OK);
  assert_int_equal(fg__farthest_place(&lines, context, &domain, 1.7, 1000), FG_STATUS_OK);
  assert_true(lines.count > 8 && lines.count < 1000);
  double test = 0.99 * FG__FARTHEST_TEST * 1.7;
  for (int n = 0; n < lines.count; n++)
    for (int m = 0; m < n; m++) {
      double(*a)[3], (*b)[3];
      int of_a = sample_line(&a, context, &domain, &lines, n, 0.15);
      int of_b = sample_line(&b, context, &domain, &lines, m, 0.15);
      for (int i = 0; i < of_a; i++)
        assert_true(distance_to(&domain, a[i], b, of_b) > test);
      free(a);
      free(b);
    }
  fg__lines_clear(&lines);
  fg__domain_clear(&domain);
  fg_field_destroy(field);
}

static void exactly_so_many_arrows(void **state)
{
  fg_context *context = *state;
  for (int round = 0; round < 2; round++) {
    fg_field *field = field_of(context, coast, round);
    fg_rival *rival = rival_of(context, field, FG_RIVAL_FARTHEST, 61);
    for (int count = 1; count < 60; count += 24) {
      fg_icons *icons = curved_icons(rival, field, count);
      assert_int_equal(fg_icons_count(icons), count);
      for (int n = 0; n < count && round; n++) {
        const fg_icon *icon = fg_icons_at(icons, n);
        for (int i = 0; i < icon->point_count; i++)
          assert_true(icon->points[i][0] > CORNER[0] - 1e-9 &&
                      icon->points[i][0] < CORNER[0] + COLUMNS * SAMPLING[0] + 1e-9);
      }
      fg_icons_destroy(icons);
    }
    fg_rival_destroy(rival);
    fg_field_destroy(field);
  }
}

/* Where the raster has too few cells for the number, a finer one is taken. */
static void a_coarse_raster_is_made_finer(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, swirl, false);
  fg_rival *rival = rival_of(context, field, FG_RIVAL_FARTHEST, 17);
  fg_icons *icons = curved_icons(rival, field, 60);
  assert_int_equal(fg_icons_count(icons), 60);
  fg_icons_destroy(icons);
  fg_rival_destroy(rival);
  fg_field_destroy(field);
}

/* Distances on the raster against all points one by one. */
static void distances_are_those_to_the_nearest_point(void **state)
{
  fg_context *context = *state;
  static double points[][3] = {{-3.1, 5.2, 0}, {21.7, 19.9, 0}, {4.4, 12.3, 0},
                               {4.9, 12.1, 0}, {-6.9, 3.1, 0},  {22.8, 11, 0}};
  enum { POINTS = sizeof points / sizeof *points };
  for (int round = 0; round < 2; round++) {
    fg_field *field = field_of(context, coast, round);
    fg__domain domain;
    fg__voids voids;
    assert_int_equal(fg__domain_create(&domain, context, field, 83), FG_STATUS_OK);
    assert_int_equal(fg__voids_create(&voids, context, &domain), FG_STATUS_OK);
    for (int n = 0; n < POINTS; n++) {
      fg__voids_add(&voids, points[n]);
      if (n % 2)
        fg__voids_update(&voids);
    }
    for (int i = 0; i < fg__domain_cell_count(&domain); i++) {
      double center[2];
      fg__domain_center(&domain, i, center);
      double exact = distance_to(&domain, center, points, POINTS);
      assert_true(fabs(sqrt(voids.square[i]) - exact) <
                  0.1 * fg__domain_cell_size(&domain));
    }
    fg__voids_clear(&voids);
    fg__domain_clear(&domain);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(each_seed_is_farthest_from_the_lines),
      CASE(lines_keep_their_distance),
      CASE(exactly_so_many_arrows),
      CASE(a_coarse_raster_is_made_finer),
      CASE(distances_are_those_to_the_nearest_point),
  };
  return cmocka_run_group_tests_name("rival/streamline/streamline/farthest", tests, NULL,
                                     NULL);
}
