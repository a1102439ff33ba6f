#include "place/best.h"

#include "place/placed_test.h"

#include <limits.h>

/* Icons of one scale after another, by so many threads. */
static void place_scales(fg_icons *out[2], fg_context *context, const fg_field *field,
                         const int counts[2], fg_effort effort, int threads)
{
  const fg_placement_options options = {.effort = effort, .threads = threads};
  fg_placement *placement = NULL;
  assert_int_equal(fg_placement_create(&placement, context, field, &options),
                   FG_STATUS_OK);
  for (int k = 0; k < 2; ++k)
    out[k] = place(context, placement, counts[k]);
  fg_placement_destroy(placement);
}

/* Few icons of a first scale and of one after a finer one, and a thorough search: threads
 * make a placement each. More icons: they share one out. */
static void threads_place_alike(void **state)
{
  static const struct {
    const sampling *box;
    velocity_of velocity;
    int counts[2];
    fg_effort effort;
    int threads;
  } cases[] = {{&PLAIN, coast, {12, 7}, FG_EFFORT_NORMAL, 3},
               {&PLAIN, coast, {45, 12}, FG_EFFORT_NORMAL, 3},
               {&ROUND, winds, {16, 9}, FG_EFFORT_THOROUGH, 3},
               {&SOLID, hall, {8, 4}, FG_EFFORT_THOROUGH, 3},
               {&PLAIN, coast, {90, 60}, FG_EFFORT_NORMAL, 2},
               {&SOLID, hall, {30, 20}, FG_EFFORT_QUICK, 4}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_icons *one[2], *other[2];
    place_scales(one, *state, field, cases[n].counts, cases[n].effort, 1);
    place_scales(other, *state, field, cases[n].counts, cases[n].effort,
                 cases[n].threads);
    for (int k = 0; k < 2; ++k) {
      assert_int_equal(fg_icons_count(other[k]), cases[n].counts[k]);
      assert_same_icons(one[k], other[k]);
      fg_icons_destroy(other[k]);
      fg_icons_destroy(one[k]);
    }
    fg_field_destroy(field);
  }
}

/* What comes next goes on from the best: an icon that stays keeps its id, and a new one
 * has one that no icon had. */
static void ids_go_on_from_the_best(void **state)
{
  static const int counts[] = {60, 30, 12, 5};
  enum { SCALES = sizeof counts / sizeof *counts };
  fg_field *field = field_of(*state, &PLAIN, coast);
  const fg_placement_options options = {.threads = 3};
  fg_placement *placement = NULL;
  assert_int_equal(fg_placement_create(&placement, *state, field, &options),
                   FG_STATUS_OK);
  int next = 1;
  for (int k = 0; k < SCALES; ++k) {
    fg_icons *icons = place(*state, placement, counts[k]);
    int stayed = 0;
    for (int n = 0; n < fg_icons_count(icons); ++n) {
      const int id = fg_icons_at(icons, n)->id;
      for (int m = 0; m < n; ++m)
        assert_int_not_equal(id, fg_icons_at(icons, m)->id);
      assert_true(id < fg__icons_next_id(icons));
      stayed += id < next;
    }
    assert_true(k == 0 || 2 * stayed > counts[k]);
    assert_true(fg__icons_next_id(icons) >= next);
    next = fg__icons_next_id(icons);
    fg_icons_destroy(icons);
  }
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* After a refusal there are no icons, and none crashes. */
static void nothing_placed_is_no_icon(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_NORMAL);
  fg_icons *icons = NULL;
  fg_density *regions = NULL;
  assert_int_equal(fg_placement_place(placement, INT_MAX, NULL), FG_STATUS_ARGUMENT);
  fg_context_clear(*state);
  assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 0);
  assert_int_equal(fg_placement_regions(&regions, placement), FG_STATUS_UNSUPPORTED);
  fg_context_clear(*state);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* Threads stop with the context of the placement, which says so. */
static void threads_stop(void **state)
{
  (void)state;
  fg_context *context = NULL;
  fg_placement *placement = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = field_of(context, &PLAIN, coast);
  const fg_placement_options options = {.threads = 2};
  assert_int_equal(fg_placement_create(&placement, context, field, &options),
                   FG_STATUS_OK);
  fg_context_stop(context);
  assert_int_equal(fg_placement_place(placement, 20, NULL), FG_STATUS_STOPPED);
  assert_string_equal(fg_context_message(context), "stopped on request");
  fg_placement_destroy(placement);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {CASE(threads_place_alike),
                                     CASE(ids_go_on_from_the_best),
                                     CASE(nothing_placed_is_no_icon), CASE(threads_stop)};
  return cmocka_run_group_tests_name("place/best", tests, NULL, NULL);
}
