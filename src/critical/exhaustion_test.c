/* Every allocation of a search fails once: it is told as a lack of memory, and nothing is
 * left behind. */
#include "base/refusal_test.h"
#include "critical/field_test.h"
#include "flowgrain/critical.h"

static void memory_may_run_out_at_any_place(void **state)
{
  fg_critical_points *points = NULL;
  fg_field *field = field_of(*state, &PLAIN, coast);
  failing = -1;
  asked = unfreed = 0;
  assert_int_equal(fg_critical_points_find(&points, *state, field, NULL), FG_STATUS_OK);
  fg_critical_points_destroy(points);
  assert_int_equal(unfreed, 0);
  const long all = asked;
  assert_true(all > 10);
  for (long n = 0; n < all; ++n) {
    fg_context_clear(*state);
    asked = unfreed = 0;
    failing = n;
    const fg_status status = fg_critical_points_find(&points, *state, field, NULL);
    failing = -1;
    assert_int_equal(status, FG_STATUS_MEMORY);
    assert_null(points);
    assert_non_null(strstr(fg_context_message(*state), "out of memory"));
    assert_int_equal(unfreed, 0);
  }
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {CASE(memory_may_run_out_at_any_place)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
