#include "place/placement.h"

#include "place/placed_test.h"

#include <limits.h>

/* The fields that every count is placed on. */
static const struct {
  const sampling *box;
  velocity_of velocity;
} CASES[] = {
    {&PLAIN, coast}, {&STRIP, swirl}, {&ROUND, winds}, {&SOLID, hall}, {&PLAIN, swirl}};
enum { CASE_COUNT = sizeof CASES / sizeof *CASES };

/* Along the flow, within the domain, of lengths that belong to their number. */
static void check_lines(const fg_placement *placement, const fg_icons *icons,
                        double least)
{
  const fg__place_search *search = fg__placement_search(placement);
  const fg_field *field = fg__placement_field(placement);
  const int dimension = fg_field_contents(field)->dimension;
  const double lambda = lambda_of(placement);
  double angles = 0.0, lengths = 0.0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    const double length = length_of(icon) / lambda;
    assert_true(length > least - 0.005 && length < 2.01);
    assert_true(icon->id > 0 && icon->parent == 0 && icon->cluster == icon->id);
    assert_true(icon->width > 0 && icon->head_length > 0 && icon->area > 0);
    for (int m = 0; m < n; ++m)
      assert_int_not_equal(icon->id, fg_icons_at(icons, m)->id);
    const double clear_of =
        fg__place_least_clearance(search->domain, &search->scale, icon->seed);
    for (int i = 1; i < icon->point_count; ++i) {
      /* between two samples of the search's line it may be nearer */
      assert_true(fg__place_clearance(search->domain, icon->points[i]) > 0.75 * clear_of);
      double middle[3], piece[3], flow[3];
      for (int k = 0; k < 3; ++k) {
        middle[k] = (icon->points[i][k] + icon->points[i - 1][k]) / 2;
        piece[k] = icon->points[i][k] - icon->points[i - 1][k];
      }
      assert_true(fg_field_tangent(field, middle, flow));
      double size = distance_between(icon->points[i], icon->points[i - 1], 3);
      angles += size * degrees_between(piece, flow, dimension);
      lengths += size;
    }
  }
  assert_true(angles / lengths < 0.5);
  /* ink, less where the arrows stand for a part of the volume only */
  assert_true(lengths < 1.5 * lambda * fg_icons_count(icons));
}

/* Their regions make up the domain; a point beyond all reach belongs to none. */
static void check_areas(const fg_field *field, const fg_icons *icons)
{
  double sum = 0.0, domain = 1.0;
  const fg_field_arrays *arrays = fg_field_contents(field);
  for (int k = 0; k < arrays->dimension; ++k)
    domain *= arrays->period[k] > 0.0
                  ? arrays->period[k]
                  : arrays->axis[k][arrays->size[k] - 1] - arrays->axis[k][0];
  for (int n = 0; n < fg_icons_count(icons); ++n)
    sum += fg_icons_at(icons, n)->area;
  assert_close(sum, domain, 0.03 * domain);
}

static void there_are_exactly_as_many_as_given(void **state)
{
  for (int n = 0; n < CASE_COUNT; ++n) {
    const int counts[] = {1, 2, 7, n < 2 ? 60 : 20};
    fg_field *field = field_of(*state, CASES[n].box, CASES[n].velocity);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k) {
      fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
      fg_icons *icons = place(*state, placement, counts[k]);
      assert_int_equal(fg_icons_count(icons), counts[k]);
      assert_int_equal(fg_icons_clusters(icons), counts[k]);
      /* a strip is narrower than a few arrows' share */
      check_lines(placement, icons, n == 1 && counts[k] < 7 ? 0.17 : 0.35);
      if (n == 2 || n == 4)
        check_areas(field, icons);
      fg_icons_destroy(icons);
      fg_placement_destroy(placement);
    }
    fg_field_destroy(field);
  }
}

static void a_field_has_one_picture(void **state)
{
  for (int n = 0; n < CASE_COUNT; n += 3) {
    fg_field *field = field_of(*state, CASES[n].box, CASES[n].velocity);
    fg_icons *icons[2];
    for (int k = 0; k < 2; ++k) {
      fg_placement *placement =
          placement_of(*state, field, n == 0 ? FG_EFFORT_NORMAL : FG_EFFORT_QUICK);
      if (k == 1) { /* what was placed before does not matter */
        fg_icons_destroy(place(*state, placement, 5));
        assert_int_equal(fg_placement_place(placement, 12, NULL), FG_STATUS_OK);
        assert_int_equal(fg_placement_icons(&icons[1], placement), FG_STATUS_OK);
      } else
        icons[0] = place(*state, placement, 12);
      fg_placement_destroy(placement);
    }
    assert_same_icons(icons[0], icons[1]);
    fg_icons_destroy(icons[0]);
    fg_icons_destroy(icons[1]);
    fg_field_destroy(field);
  }
}

/* swirl, turned by a right angle: (x, y) goes to (-y, x). */
static void turned(const double position[3], double v[3])
{
  const double back[3] = {position[1], -position[0], 0};
  double w[3];
  swirl(back, w);
  v[0] = -w[1];
  v[1] = w[0];
}

/* Minima that are near each other differ by some per cent, means of three by less. */
static void a_turned_field_is_read_as_well(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {22, 31}, .low = {-11, -7}, .high = {-3, 5}};
  fg_field *fields[2] = {field_of(*state, &PLAIN, swirl), field_of(*state, &box, turned)};
  double error[2] = {0};
  for (int n = 0; n < 2; ++n) {
    for (int count = 40; count <= 80; count += 20) {
      fg_placement *placement = placement_of(*state, fields[n], FG_EFFORT_QUICK);
      fg_icons *icons = place(*state, placement, count);
      error[n] += error_of(*state, fields[n], icons) / 3;
      fg_icons_destroy(icons);
      fg_placement_destroy(placement);
    }
    fg_field_destroy(fields[n]);
  }
  assert_close(error[0], error[1], 0.06 * error[0]);
}

/* Better than the even start by a fifth at least. */
static void placing_lowers_the_error(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  const fg_placement_options fair = {.lengths = FG_LENGTHS_FAIR};
  fg_placement *placement = NULL;
  assert_int_equal(fg_placement_create(&placement, *state, field, &fair), FG_STATUS_OK);
  fg_icons *icons = place(*state, placement, 30), *lattice = no_icons(*state);
  const double lambda = lambda_of(placement);
  for (int n = 0; n < 30; ++n) {
    assert_true(length_of(fg_icons_at(icons, n)) < 1.005 * lambda);
    assert_true(fg_icons_at(icons, n)->way[0] + fg_icons_at(icons, n)->way[1] <=
                1.0001 * lambda);
  }
  /* straight pieces of the same length on a lattice */
  for (double x = -7 + lambda / 2; x < 5; x += lambda)
    for (double y = 3 + lambda / 2; y < 11; y += lambda) {
      double v[3] = {0};
      const double at[3] = {x, y, 0};
      if (!fg_field_velocity(field, at, v))
        continue;
      double half = lambda / 2 / hypot(v[0], v[1]);
      add_straight(lattice, *state, x - half * v[0], y - half * v[1], x + half * v[0],
                   y + half * v[1]);
    }
  assert_true(error_of(*state, field, icons) < 0.8 * error_of(*state, field, lattice));
  fg_icons_destroy(icons);
  fg_icons_destroy(lattice);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* The diffusion reader's iteration goes on from where it ended: criteria that differ by
 * less than this factor are the same. */
static const double SAME = 1.001;

/* What a search compares placements by. */
static double criterion_of(const fg_placement *placement)
{
  fg__place_search *search =
      (fg__place_search *)(uintptr_t)fg__placement_search(placement);
  double error, touching;
  assert_int_equal(fg__place_error(search, &error), FG_STATUS_OK);
  assert_int_equal(fg__place_touching(search, &touching), FG_STATUS_OK);
  return error * (1.0 + 4.0 * touching);
}

/* A thorough search makes the placement of the normal one and others, and takes the best;
 * it makes none that would not fit. */
static void a_thorough_search_is_better(void **state)
{
  const struct {
    const sampling *box;
    velocity_of velocity;
    int count;
  } cases[] = {{&PLAIN, coast, 50}, {&SOLID, hall, 20}};
  int better = 0;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    double criterion[2];
    for (int k = 0; k < 2; ++k) {
      fg_placement *placement =
          placement_of(*state, field, k ? FG_EFFORT_THOROUGH : FG_EFFORT_NORMAL);
      fg_icons *icons = place(*state, placement, cases[n].count);
      assert_int_equal(fg_icons_count(icons), cases[n].count);
      criterion[k] = criterion_of(placement);
      fg_icons_destroy(icons);
      fg_placement_destroy(placement);
    }
    assert_true(criterion[1] <= SAME * criterion[0]);
    better += SAME * criterion[1] < criterion[0];
    fg_field_destroy(field);
  }
  assert_true(better > 0);
  const sampling cell = {
      .dimension = 2, .nodes = {2, 2}, .low = {-3, 4}, .high = {5, 11}};
  fg_field *field = field_of(*state, &cell, slant); /* has room for 200 */
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_THOROUGH);
  fg_icons_destroy(place(*state, placement, 190));
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* From one finer scale a few are placed the better the more are tried. */
static void few_are_searched_for_thoroughly(void **state)
{
  static const fg_effort efforts[] = {FG_EFFORT_QUICK, FG_EFFORT_NORMAL,
                                      FG_EFFORT_THOROUGH};
  double criterion[3];
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_placement *first = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *finer = place(*state, first, 60);
  for (int k = 0; k < 3; ++k) {
    fg_placement *placement = placement_of(*state, field, efforts[k]);
    assert_int_equal(fg_placement_resume(placement, finer), FG_STATUS_OK);
    fg_icons_destroy(place(*state, placement, 20));
    criterion[k] = criterion_of(placement);
    fg_placement_destroy(placement);
  }
  assert_true(SAME * criterion[1] < criterion[0]);
  assert_true(criterion[2] <= SAME * criterion[1]);
  fg_icons_destroy(finer);
  fg_placement_destroy(first);
  fg_field_destroy(field);
}

/* One call gives what placing in steps gives. */
static void one_call_is_enough(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  const fg_arrows_options options = {.count = 23, .effort = FG_EFFORT_QUICK};
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *icons = NULL, *steps = place(*state, placement, 23);
  assert_int_equal(fg_arrows_create(&icons, *state, field, &options), FG_STATUS_OK);
  assert_same_icons(icons, steps);
  fg_icons_destroy(icons);
  fg_field *simple = field_of(*state, &PLAIN, slant);
  assert_int_equal(fg_arrows_create(&icons, *state, simple, NULL), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 40);
  fg_field_destroy(simple);
  fg_icons_destroy(icons);
  const fg_arrows_options negative = {.count = -1}, many = {.count = 1000000};
  assert_int_equal(fg_arrows_create(&icons, *state, field, &negative),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(fg_arrows_create(&icons, *state, field, &many), FG_STATUS_ARGUMENT);
  assert_null(icons);
  fg_icons_destroy(steps);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void icons_of_clusters_are_a_start(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, swirl);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *clusters = no_icons(*state), *icons = NULL;
  for (int n = 0; n < 5; ++n) {
    const double x = -6 + 2.2 * n, y = 4 + 1.3 * n;
    add_straight(clusters, *state, x - 0.5, y, x + 0.5, y);
  }
  assert_int_equal(fg_placement_place(placement, 9, clusters), FG_STATUS_OK);
  assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 9);
  check_lines(placement, icons, 0.35);
  fg_icons_destroy(clusters);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void wrong_arguments_are_refused(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, swirl);
  fg_placement *placement = NULL;
  fg_placement_options options = {.effort = (fg_effort)3};
  assert_int_equal(fg_placement_create(NULL, *state, field, NULL), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_placement_create(&placement, *state, NULL, NULL),
                   FG_STATUS_ARGUMENT);
  assert_int_equal(fg_placement_create(&placement, *state, field, &options),
                   FG_STATUS_ARGUMENT);
  options = (fg_placement_options){.lengths = (fg_lengths)2};
  assert_int_equal(fg_placement_create(&placement, *state, field, &options),
                   FG_STATUS_ARGUMENT);
  assert_null(placement);
  placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *lines = no_icons(*state);
  assert_int_equal(fg_placement_resume(placement, lines), FG_STATUS_ARGUMENT);
  add_straight(lines, *state, -3, 5, -2, 5); /* not placed */
  assert_int_equal(fg_placement_resume(placement, lines), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_placement_resume(placement, NULL), FG_STATUS_ARGUMENT);
  /* it can still be used */
  fg_icons *icons = place(*state, placement, 3);
  assert_int_equal(fg_icons_count(icons), 3);
  fg_icons_destroy(icons);
  fg_icons_destroy(lines);
  fg_placement_destroy(placement);
  fg_placement_destroy(NULL);
  fg_field_destroy(field);
}

/* The message says how many are too many. */
static void more_than_can_be_placed_are_refused(void **state)
{
  const sampling coarse = {
      .dimension = 2, .nodes = {9, 7}, .low = {-3, 4}, .high = {5, 11}};
  const struct {
    const sampling *box;
    int count;
    const char *message;
  } cases[] = {
      {&PLAIN, 20001, "20001 arrows are too many to be placed: 20000 can be"},
      {&PLAIN, INT_MAX, "2147483647 arrows are too many"},
      {&coarse, 4000, "4000 arrows do not fit into this field: 3"},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, swirl);
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
    assert_int_equal(fg_placement_place(placement, cases[n].count, NULL),
                     FG_STATUS_ARGUMENT);
    assert_ptr_equal(strstr(fg_context_message(*state), cases[n].message),
                     fg_context_message(*state));
    fg_context_clear(*state);
    fg_placement_destroy(placement);
    fg_field_destroy(field);
  }
}

/* A narrow water that winds through a wide field. */
static void river(const double position[3], double v[3])
{
  const double slope = 0.9 * cos(0.6 * position[0]);
  const double off = position[1] - 7 - 1.5 * sin(0.6 * position[0]);
  v[0] = fabs(off) < 0.06 * sqrt(1 + slope * slope) ? 1.0 : (double)NAN;
  v[1] = slope;
}

static void a_river_gets_its_arrows(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {301, 201}, .low = {-7, 3}, .high = {5, 11}};
  fg_field *field = field_of(*state, &box, river);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *icons = place(*state, placement, 40);
  assert_int_equal(fg_icons_count(icons), 40);
  check_lines(placement, icons, 0.17);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(there_are_exactly_as_many_as_given),
      CASE(a_field_has_one_picture),
      CASE(a_turned_field_is_read_as_well),
      CASE(placing_lowers_the_error),
      CASE(icons_of_clusters_are_a_start),
      CASE(one_call_is_enough),
      CASE(wrong_arguments_are_refused),
      CASE(more_than_can_be_placed_are_refused),
      CASE(a_river_gets_its_arrows),
      CASE(a_thorough_search_is_better),
      CASE(few_are_searched_for_thoroughly),
  };
  return cmocka_run_group_tests_name("place/placement", tests, NULL, NULL);
}
