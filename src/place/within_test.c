#include "place/placement.h"

#include "place/placed_test.h"

#include <stdio.h>

/* Rooms of a cell each, between cells that lack a corner. */
static void cells(const double position[3], double v[3])
{
  const int i = (int)lround(position[0]), j = (int)lround(position[1]);
  slant(position, v);
  if (i % 3 == 2 || j % 3 == 2)
    v[0] = (double)NAN;
}

static void a_number_fits_where_a_larger_one_does(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {18, 15}, .low = {0, 0}, .high = {17, 14}};
  fg_field *field = field_of(*state, &box, cells);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  assert_int_equal(fg_placement_place(placement, 0, NULL), FG_STATUS_ARGUMENT);
  fg_context_clear(*state);
  fg_icons_destroy(place(*state, placement, 1));
  fg_icons *icons = place(*state, placement, 60); /* two in each */
  assert_int_equal(fg_icons_count(icons), 60);
  fg_icons_destroy(icons);
  /* the way to a number that reaches an error leads over some that do not fit */
  int count = 0;
  assert_int_equal(fg_placement_within(placement, 5, 200, &count), FG_STATUS_OK);
  assert_true(count > 1 && count <= 60);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void the_fewest_within_an_error_are_found(void **state)
{
  static const double tolerances[] = {16, 10.5};
  fg_field *field = field_of(*state, &PLAIN, swirl);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  for (size_t n = 0; n < sizeof tolerances / sizeof *tolerances; ++n) {
    const double degrees = tolerances[n];
    int count = 0;
    fg_icons *icons = NULL;
    assert_int_equal(fg_placement_within(placement, degrees, 500, &count), FG_STATUS_OK);
    assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
    assert_int_equal(fg_icons_count(icons), count);
    assert_true(count > 1 && count < 100);
    assert_true(error_of(*state, field, icons) <= degrees);
    fg_icons_destroy(icons);
    assert_int_equal(fg__placement_begin_again(placement, count - 1), FG_STATUS_OK);
    assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
    assert_true(error_of(*state, field, icons) > 0.99 * degrees);
    fg_icons_destroy(icons);
  }
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* Few arrows are the best of several placements, in the search for their number, too. */
static void the_number_is_that_of_a_run(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, swirl);
  for (int degrees = 9; degrees < 20; degrees += 3) {
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_NORMAL);
    fg_icons *found = NULL;
    int count = 0;
    assert_int_equal(fg_placement_within(placement, degrees, 500, &count), FG_STATUS_OK);
    assert_int_equal(fg_placement_icons(&found, placement), FG_STATUS_OK);
    fg_placement_destroy(placement);
    placement = placement_of(*state, field, FG_EFFORT_NORMAL);
    fg_icons *icons = place(*state, placement, count);
    assert_true(fabs(error_of(*state, field, icons) - error_of(*state, field, found)) <=
                0.0);
    assert_true(error_of(*state, field, icons) <= degrees);
    fg_icons_destroy(icons);
    fg_icons_destroy(found);
    fg_placement_destroy(placement);
  }
  fg_field_destroy(field);
}

static void what_can_not_be_reached_is_refused(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, swirl);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  int count = 0;
  assert_int_equal(fg_placement_within(placement, 2, 10, &count), FG_STATUS_ARGUMENT);
  const char *message = fg_context_message(*state);
  int most;
  double degrees, reached;
  if (sscanf(message,
             "no number of arrows has a mean direction error of at most %lf "
             "degrees: that of %d is %lf",
             &degrees, &most, &reached) != 3)
    fail_msg("%s", message);
  assert_true(degrees == 2 && most == 10 && reached > 4 && reached < 60);
  fg_context_clear(*state);
  assert_int_equal(fg_placement_within(placement, 0, 10, &count), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_placement_within(placement, 20, 0, &count), FG_STATUS_ARGUMENT);
  assert_int_equal(fg_placement_within(NULL, 20, 9, &count), FG_STATUS_ARGUMENT);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(a_number_fits_where_a_larger_one_does),
      CASE(the_fewest_within_an_error_are_found),
      CASE(the_number_is_that_of_a_run),
      CASE(what_can_not_be_reached_is_refused),
  };
  return cmocka_run_group_tests_name("place/within", tests, NULL, NULL);
}
