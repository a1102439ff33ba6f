#include "base/context_test.h"
#include "base/context.h"

static void first_failure_is_kept_with_its_own_hint(void **state)
{
  fg_context *context = *state;
  assert_int_equal(fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: %d bytes", "a.nc", 3),
                   FG_STATUS_FILE_FORMAT);
  assert_int_equal(fg__fail(context, FG_STATUS_ARGUMENT, "b.nc: no such variable"),
                   FG_STATUS_ARGUMENT);
  fg__hint(context, "of b.nc");
  assert_string_equal(fg_context_message(context), "a.nc: 3 bytes");
  assert_string_equal(fg_context_hint(context), "");
}

static void failure_has_one_hint(void **state)
{
  fg_context *context = *state;
  fg__hint(context, "of nothing");
  assert_string_equal(fg_context_hint(context), "");
  fg__fail(context, FG_STATUS_ARGUMENT, "17 nodes");
  fg__hint(context, "from %d on", 33);
  fg__hint(context, "another");
  assert_string_equal(fg_context_hint(context), "from 33 on");
}

static void cleared_context_takes_the_next_failure(void **state)
{
  fg_context *context = *state;
  fg__fail(context, FG_STATUS_ARGUMENT, "the first");
  fg__hint(context, "its hint");
  fg_context_clear(context);
  assert_string_equal(fg_context_message(context), "");
  assert_string_equal(fg_context_hint(context), "");
  fg__fail(context, FG_STATUS_MEMORY, "the second");
  assert_string_equal(fg_context_message(context), "the second");
  fg__hint(context, "the second's");
  assert_string_equal(fg_context_hint(context), "the second's");
}

static void texts_stay_on_one_line(void **state)
{
  fg_context *context = *state;
  fg__fail(context, FG_STATUS_FILE_ACCESS, "%s: gone", "a\nb\x1b[2J\x7f");
  assert_string_equal(fg_context_message(context), "a?b?[2J?: gone");
}

static void stop_outlasts_a_clearing(void **state)
{
  fg_context *context = *state;
  assert_int_equal(fg__check_stop(context), FG_STATUS_OK);
  fg_context_stop(context);
  assert_int_equal(fg__check_stop(context), FG_STATUS_STOPPED);
  fg_context_clear(context);
  assert_int_equal(fg__check_stop(context), FG_STATUS_STOPPED);
}

static void no_context_keeps_nothing(void **state)
{
  (void)state;
  assert_int_equal(fg__fail(NULL, FG_STATUS_MEMORY, "lost"), FG_STATUS_MEMORY);
  fg__hint(NULL, "lost");
  assert_string_equal(fg_context_message(NULL), "");
  assert_int_equal(fg__check_stop(NULL), FG_STATUS_OK);
}

#define WITH_CONTEXT(test)                                                               \
  cmocka_unit_test_setup_teardown(test, context_set_up, context_tear_down)

int main(void)
{
  const struct CMUnitTest tests[] = {
      WITH_CONTEXT(first_failure_is_kept_with_its_own_hint),
      WITH_CONTEXT(failure_has_one_hint),
      WITH_CONTEXT(cleared_context_takes_the_next_failure),
      WITH_CONTEXT(texts_stay_on_one_line),
      WITH_CONTEXT(stop_outlasts_a_clearing),
      cmocka_unit_test(no_context_keeps_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
