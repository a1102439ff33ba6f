/* Every allocation of a score fails once: it is told as a lack of memory, and nothing is
 * left behind. */
#include "base/refusal_test.h"
#include "score/picture_test.h"

static void every_allocation_fails_in_turn(fg_context *context, const fg_field *field,
                                           const fg_icons *icons)
{
  fg_score score;
  const fg_score_options alone = {.threads = 1};
  failing = -1;
  asked = unfreed = 0;
  assert_int_equal(fg_icons_score(&score, context, field, icons, &alone), FG_STATUS_OK);
  assert_int_equal(unfreed, 0);
  const long all = asked;
  assert_true(all > 30);
  for (long n = 0; n < all; ++n) {
    fg_context_clear(context);
    asked = unfreed = 0;
    failing = n;
    const fg_status status = fg_icons_score(&score, context, field, icons, &alone);
    failing = -1;
    if (status != FG_STATUS_MEMORY)
      fail_msg("allocation %ld of %ld: status %d", n, all, status);
    assert_non_null(strstr(fg_context_message(context), "out of memory"));
    assert_int_equal(unfreed, 0);
  }
}

static void memory_may_run_out_at_any_place(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_icons *icons = no_icons(*state);
  add_scribbles(icons, *state, &PLAIN, 12, 1.0);
  every_allocation_fails_in_turn(*state, field, icons);
  fg_icons_destroy(icons);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {CASE(memory_may_run_out_at_any_place)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
