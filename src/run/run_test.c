/* A run of scales: what it gives is what its parts give, and it always ends. */
#include <math.h>

#include "icon/icons.h"
#include "run/run_test.h"

/* A run, and its evolution without it. */
typedef struct comparison {
  fg_field *field;
  fg_run *run;
  fg_evolution *evolution;
} comparison;

static comparison compare(fg_context *context, const fg_run_options *options)
{
  comparison c = {.field = field_of(context, "vortex3")};
  c.run = run_of(context, c.field, options);
  assert_int_equal(
      fg_evolution_create(&c.evolution, context, c.field, &options->evolution),
      FG_STATUS_OK);
  return c;
}

static void end_comparison(comparison *c)
{
  assert_int_equal(fg_run_ended(c->run), FG_RUN_ALL);
  fg_evolution_destroy(c->evolution);
  fg_run_destroy(c->run);
  fg_field_destroy(c->field);
}

/* Clusters: each scale is the first state at or below its number, with the icons of its
 * density. */
static void clusters_are_those_of_the_evolution(void **state)
{
  static const int numbers[] = {40, 25, 24, 9};
  static const fg_icon_options of_clusters = {.extent = FG_EXTENT_CLUSTER};
  fg_context *context = *state;
  const fg_run_options options = {.kind = FG_RUN_CLUSTERS,
                                  .numbers = numbers,
                                  .count = 4,
                                  .evolution = {.nodes = 129, .seed = 5}};
  comparison c = compare(context, &options);
  const fg_run_scale *scale;
  fg_step step = {0};
  int answered = 0, scales = 0;
  for (;;) {
    assert_int_equal(fg_run_next(&scale, c.run), FG_STATUS_OK);
    if (!scale)
      break;
    while (!step.clusters || step.clusters > numbers[answered])
      assert_int_equal(fg_evolution_step(c.evolution, &step), FG_STATUS_OK);
    assert_int_equal(scale->index, scales++);
    assert_int_equal(scale->step.step, step.step);
    for (int k = 0; k < scale->wanted_count; ++k)
      assert_int_equal(scale->wanted[k], numbers[answered++]);
    assert_true(answered == 4 || step.clusters > numbers[answered]);
    fg_density *density = NULL;
    fg_icons *icons = NULL;
    assert_int_equal(fg_density_create(&density, c.evolution), FG_STATUS_OK);
    assert_int_equal(fg_icons_create(&icons, context, c.field, density, &of_clusters),
                     FG_STATUS_OK);
    same_icons(scale->icons, icons);
    assert_int_equal(fg_density_contents(scale->density)->clusters, step.clusters);
    assert_null(scale->finer);
    fg_icons_destroy(icons);
    fg_density_destroy(density);
  }
  assert_int_equal(answered, 4);
  end_comparison(&c);
}

/* Times: each scale is the first state at or after its time, also before there are
 * clusters; one state answers two times. */
static void times_are_those_of_the_evolution(void **state)
{
  static const double times[] = {1e-6, 4e-3, 1.4e-2, 1.401e-2, 3e-2};
  static const int reached[] = {1, 1, 2, 1};
  const fg_run_options options = {.kind = FG_RUN_TIMES,
                                  .times = times,
                                  .count = 5,
                                  .evolution = {.nodes = 65, .noise = 0.02}};
  comparison c = compare(*state, &options);
  const fg_run_scale *scale;
  fg_step step = {0};
  for (int k = 0, next = 0; k < 4; next += reached[k++]) {
    double before = 0.0;
    while (step.time < times[next]) {
      before = step.time;
      assert_int_equal(fg_evolution_step(c.evolution, &step), FG_STATUS_OK);
    }
    assert_int_equal(fg_run_next(&scale, c.run), FG_STATUS_OK);
    assert_int_equal(scale->index, k);
    assert_int_equal(scale->step.step, step.step);
    assert_true(before < times[next]);
    assert_null(scale->wanted);
    assert_int_equal(scale->wanted_count, reached[k]);
    assert_memory_equal(scale->times, times + next, (size_t)reached[k] * sizeof *times);
    assert_int_equal(fg_icons_count(scale->icons) > 0, k > 1);
  }
  assert_true(step.clusters > 0);
  assert_int_equal(fg_run_next(&scale, c.run), FG_STATUS_OK);
  assert_null(scale);
  end_comparison(&c);
}

/* Returns the step of the first scale. */
static int64_t times_up_to(fg_context *context, const fg_field *field, int64_t max_steps,
                           int scales)
{
  static const double times[] = {1e-4, 1.0};
  const fg_run_options options = {.kind = FG_RUN_TIMES,
                                  .times = times,
                                  .count = 2,
                                  .max_steps = max_steps,
                                  .evolution = {.nodes = 33}};
  fg_run *run = run_of(context, field, &options);
  const fg_run_scale *scale;
  int64_t step[2] = {0};
  int count = 0;
  while (!fg_run_next(&scale, run) && scale)
    step[count++ % 2] = scale->step.step;
  assert_int_equal(count, scales);
  assert_int_equal(step[count - 1], max_steps);
  assert_int_equal(fg_run_ended(run), FG_RUN_AT_STEPS);
  fg_run_destroy(run);
  return step[0];
}

/* The state at the end is one more scale, if it is none yet. */
static void times_end_with_the_last_state(void **state)
{
  fg_context *context = *state;
  fg_field *field = field_of(context, "vortex3");
  int64_t first = times_up_to(context, field, 30, 2);
  assert_int_equal(times_up_to(context, field, first, 1), first);
  fg_field_destroy(field);
}

/* Icons of the first scale that are given are it, and the others follow from them. */
static void the_first_scale_may_be_given(void **state)
{
  static const int numbers[] = {30, 21, 11};
  fg_context *context = *state;
  fg_field *field = field_of(context, "vortex3");
  fg_run_options options = {
      .numbers = numbers, .count = 3, .placement = {.effort = FG_EFFORT_QUICK}};
  fg_run *run = run_of(context, field, &options);
  const fg_run_scale *scale, *again;
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  fg_icons *first = NULL;
  assert_int_equal(fg__icons_copy(&first, context, scale->icons), FG_STATUS_OK);
  options.first = first;
  options.evolution.seed = 8;
  fg_run *later = run_of(context, field, &options);
  assert_int_equal(fg_run_next(&again, later), FG_STATUS_OK);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(fg_icons_count(again->icons), numbers[k]);
    for (int n = 0; n < numbers[k]; ++n) {
      const fg_icon *a = fg_icons_at(scale->icons, n), *b = fg_icons_at(again->icons, n);
      assert_int_equal(a->id, b->id);
      assert_int_equal(a->point_count, b->point_count);
      assert_memory_equal(a->points, b->points,
                          (size_t)a->point_count * sizeof *a->points);
      assert_in_range(b->cluster, 1, fg_density_contents(again->density)->clusters);
    }
    for (int n = 0; k > 0 && n < numbers[k - 1]; ++n)
      assert_int_equal(fg_icons_at(scale->finer, n)->parent,
                       fg_icons_at(again->finer, n)->parent);
    assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
    assert_int_equal(fg_run_next(&again, later), FG_STATUS_OK);
  }
  assert_null(again);
  fg_run_destroy(run);
  fg_run_destroy(later);

  for (int n = 0; n < 16; ++n) /* more than half are none that were placed */
    fg__icons_change(first, n)->id = 0;
  run = run_of(context, field, &options);
  assert_int_equal(fg_run_next(&again, run), FG_STATUS_ARGUMENT);
  fg_run_destroy(run);
  options.numbers = &numbers[1];
  options.count = 2;
  assert_int_equal(fg_run_create(&run, context, field, &options), FG_STATUS_ARGUMENT);
  fg_icons_destroy(first);
  fg_field_destroy(field);
}

static bool has_id(const fg_icons *icons, int id)
{
  for (int n = 0; n < fg_icons_count(icons); ++n)
    if (fg_icons_at(icons, n)->id == id)
      return true;
  return false;
}

/* Arrows: exactly as many as are wanted, and each goes into one of the next scale. */
static void arrows_are_as_many_as_are_wanted(void **state)
{
  static const int numbers[] = {30, 29, 11};
  fg_context *context = *state;
  fg_field *field = field_of(context, "saddle");
  const fg_run_options options = {
      .numbers = numbers, .count = 3, .placement = {.effort = FG_EFFORT_QUICK}};
  fg_run *run = run_of(context, field, &options);
  const fg_run_scale *scale;
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
    assert_non_null(scale);
    assert_int_equal(fg_icons_count(scale->icons), numbers[k]);
    assert_int_equal(scale->wanted_count, 1);
    assert_int_equal(scale->wanted[0], numbers[k]);
    assert_true((scale->finer != NULL) == (k > 0));
    for (int n = 0; k > 0 && n < numbers[k - 1]; ++n)
      assert_true(has_id(scale->icons, fg_icons_at(scale->finer, n)->parent));
  }
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  assert_null(scale);
  fg_run_destroy(run);
  fg_field_destroy(field);
}

/* A number that is never reached: the run ends at its limit, with the state there. */
static void a_run_that_falls_short_shows_what_it_has(void **state)
{
  static const int numbers[] = {1};
  fg_context *context = *state;
  fg_field *field = field_of(context, "vortex");
  fg_run_options options = {.kind = FG_RUN_CLUSTERS,
                            .numbers = numbers,
                            .count = 1,
                            .evolution = {.nodes = 65},
                            .max_steps = 60};
  fg_run *run = run_of(context, field, &options);
  const fg_run_scale *scale;
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  assert_non_null(scale);
  assert_int_equal(scale->wanted_count, 0);
  assert_int_equal(scale->step.step, 60);
  assert_int_equal(fg_run_ended(run), FG_RUN_AT_STEPS);
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  assert_null(scale);
  fg_run_destroy(run);

  options.max_steps = 1; /* before there is any cluster */
  run = run_of(context, field, &options);
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  assert_null(scale);
  fg_run_destroy(run);
  fg_field_destroy(field);
}

static void wrong_numbers_are_refused(void **state)
{
  static const int rising[] = {20, 21}, none[] = {5, 0};
  static const double falling[] = {2e-3, 1e-3}, zero[] = {0.0}, endless[] = {HUGE_VAL};
  fg_context *context = *state;
  fg_field *field = field_of(context, "vortex");
  const fg_run_options wrong[] = {{.numbers = rising, .count = 2},
                                  {.numbers = none, .count = 2},
                                  {.numbers = rising, .count = FG_MOST_SCALES + 1},
                                  {.count = 1},
                                  {.kind = (fg_run_kind)7},
                                  {.kind = FG_RUN_TIMES},
                                  {.kind = FG_RUN_TIMES, .count = 1},
                                  {.kind = FG_RUN_TIMES, .times = falling, .count = 2},
                                  {.kind = FG_RUN_TIMES, .times = zero, .count = 1},
                                  {.kind = FG_RUN_TIMES, .times = endless, .count = 1},
                                  {.max_time = -1.0},
                                  {.evolution = {.mesh = (fg_mesh_kind)5}}};
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
    fg_run *run = NULL;
    assert_int_equal(fg_run_create(&run, context, field, &wrong[k]), FG_STATUS_ARGUMENT);
    assert_null(run);
    assert_true(*fg_context_message(context));
    fg_context_clear(context);
  }
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(clusters_are_those_of_the_evolution, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(times_are_those_of_the_evolution, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(times_end_with_the_last_state, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(arrows_are_as_many_as_are_wanted, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(the_first_scale_may_be_given, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(a_run_that_falls_short_shows_what_it_has,
                                      context_set_up, context_tear_down),
      cmocka_unit_test_setup_teardown(wrong_numbers_are_refused, context_set_up,
                                      context_tear_down),
  };
  return cmocka_run_group_tests_name("run/run", tests, NULL, NULL);
}
