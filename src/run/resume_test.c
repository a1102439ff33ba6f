#include "run/run_test.h"

#include <stdlib.h>
#include <unistd.h>

/* A record and a checkpoint hold all that later scales follow from. */
static void resumes(fg_context *context, const fg_run_options *options)
{
  fg_field *field = field_of(context, "vortex3");
  char path[] = "run-test-XXXXXX";
  int file = mkstemp(path);
  assert_true(file >= 0);
  close(file);
  unlink(path);
  fg_run *run = run_of(context, field, options), *later;
  const fg_run_scale *scale, *other;
  fg_step step;
  fg_run_record record;
  fg_checkpoint *checkpoint = NULL;
  assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
  assert_int_equal(fg_run_step(&step, run), FG_STATUS_OK);
  fg_run_describe(&record, run);
  assert_int_equal(fg_evolution_save(fg_run_evolution(run), path, ""), FG_STATUS_OK);
  assert_int_equal(fg_checkpoint_open(&checkpoint, context, path), FG_STATUS_OK);
  later = run_of(context, field, options);
  assert_int_equal(fg_run_resume(&step, later, checkpoint, &record), FG_STATUS_OK);
  do {
    assert_int_equal(fg_run_next(&scale, run), FG_STATUS_OK);
    assert_int_equal(fg_run_next(&other, later), FG_STATUS_OK);
    assert_true(!scale == !other);
    if (scale) {
      assert_int_equal(scale->index, other->index);
      assert_int_equal(scale->step.step, other->step.step);
      same_icons(scale->icons, other->icons);
    }
  } while (scale);
  fg_checkpoint_destroy(checkpoint);
  fg_run_destroy(later);
  fg_run_destroy(run);
  fg_field_destroy(field);
  unlink(path);
}

static void a_resumed_run_takes_the_same_scales(void **state)
{
  static const int numbers[] = {50, 20, 14};
  static const double times[] = {1e-4, 1e-3, 4e-3};
  resumes(*state, &(fg_run_options){.kind = FG_RUN_CLUSTERS,
                                    .numbers = numbers,
                                    .count = 3,
                                    .evolution = {.nodes = 97}});
  resumes(*state, &(fg_run_options){.kind = FG_RUN_TIMES,
                                    .times = times,
                                    .count = 3,
                                    .max_time = 2e-3,
                                    .evolution = {.nodes = 97, .noise = 0.02}});
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(
      a_resumed_run_takes_the_same_scales, context_set_up, context_tear_down)};
  return cmocka_run_group_tests_name("run/resume", tests, NULL, NULL);
}
