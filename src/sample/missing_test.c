#include "sample/missing.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

enum { SAMPLES = 400, LARGE_BLOCK = 60 };

/* Values from `low` to `high` in u, and `code` at `count` of them; v is between -1 and 1.
 */
typedef struct situation {
  double low, high, code;
  int count;
  const char *missing;
  bool refused, together; /* v is the code, too */
} situation;

static const situation SITUATIONS[] = {
    {-20, 30, -9999, LARGE_BLOCK, .refused = true},
    {-20, 30, -999999, LARGE_BLOCK, .refused = true},
    {-20, 30, 999.999, 2, .refused = true},
    {-40, 60, -99.9, 5, .refused = true},
    {-0.5, 0.5, -99.99, LARGE_BLOCK, .refused = true},
    {-20, 30, 1e20, LARGE_BLOCK, .refused = true},
    {-20, 30, -1e34, 2, .refused = true},
    {-20, 30, 9.96921e36, LARGE_BLOCK, .refused = true},
    {-20, 30, -32768, LARGE_BLOCK, .refused = true},
    {-5, 5, 12345, LARGE_BLOCK, .refused = true},
    {1e20, 3e20, 9e36, LARGE_BLOCK, .refused = true},
    /* below 99: of two bytes and a scale, of all components */
    {-5, 8, 32.767, LARGE_BLOCK, .refused = true},
    {-1, 1, -3.2768, LARGE_BLOCK, .refused = true},
    {-0.1, 0.1, -0.32768, 2, .refused = true},
    {-5, 8, 65.535, LARGE_BLOCK, .refused = true},
    {-1, 2, -9, LARGE_BLOCK, .refused = true, .together = true},
    {-1, 2, 9.999, LARGE_BLOCK, .refused = true, .together = true},
    {10, 30, -2, LARGE_BLOCK, .refused = true, .together = true},
    {10, 30, -2, LARGE_BLOCK, .refused = false},
    {10, 30, -2.5, LARGE_BLOCK, .refused = false, .together = true},
    {10, 30, 0, LARGE_BLOCK, .refused = false, .together = true},
    {0, 3, -99.0 / 4.0, LARGE_BLOCK, .refused = false, .together = true},
    {-1, 2, -9, LARGE_BLOCK, .missing = "-9", .together = true},
    /* decided by the option */
    {-20, 30, -9999, LARGE_BLOCK, .missing = "-9999"},
    {-20, 30, -9999, LARGE_BLOCK, .missing = "1e20,-9999"},
    {-20, 30, -9999, LARGE_BLOCK, .missing = "none"},
    {-20, 30, -9999, LARGE_BLOCK, .missing = "-999", .refused = true},
    /* values of flows */
    {-20, 30, 30, LARGE_BLOCK, .refused = false},
    {-20, 30, 0, LARGE_BLOCK, .refused = false},
    {0, 0, 1, LARGE_BLOCK, .refused = false},
    {-0.01, 0.01, 1, LARGE_BLOCK, .refused = false},
    {-120, 120, 130, LARGE_BLOCK, .refused = false},
    {-0.01, 0.01, 9, LARGE_BLOCK, .refused = false}, /* a plug at an inlet */
    {0, 9, 9, LARGE_BLOCK, .refused = false},        /* values clipped at 9 */
    {0, 32.767, 32.767, LARGE_BLOCK, .refused = false},
    {-0.01, 0.01, 1, LARGE_BLOCK, .refused = false, .together = true},
    {-1, 2, -1, LARGE_BLOCK, .refused = false},
    {-20, 30, 4000, 1, .refused = false},
    {1e20, 3e20, 4e20, LARGE_BLOCK, .refused = false},
};

static void a_recurring_number_apart_is_refused(void **state)
{
  for (size_t n = 0; n < sizeof SITUATIONS / sizeof *SITUATIONS; ++n)
    for (int k = 0; k < 2; ++k) {
      const situation *s = &SITUATIONS[n];
      float u[SAMPLES], v[SAMPLES];
      for (int i = 0; i < SAMPLES; ++i) {
        u[i] = (float)(s->low + (s->high - s->low) * i / (SAMPLES - 1));
        v[i] = (float)sin(0.1 * i);
      }
      for (int i = 0; i < s->count; ++i)
        u[100 + i] = (float)s->code;
      for (int i = 0; i < s->count && s->together; ++i)
        v[100 + i] = (float)s->code;
      fg__missing_numbers given;
      const fg__raw_samples raw = {.path = "file",
                                   .name = {k ? "v" : "u", k ? "u" : "v"},
                                   .component = {k ? v : u, k ? u : v},
                                   .components = 2,
                                   .count = SAMPLES};
      assert_int_equal(fg__missing_read(&given, *state, s->missing), FG_STATUS_OK);
      const fg_status status = fg__missing_settle(*state, &raw, &given);
      if ((status != FG_STATUS_OK) != s->refused)
        fail_msg("situation %zu: %s", n, fg_context_message(*state));
      if (s->refused) {
        assert_non_null(
            strstr(fg_context_message(*state), s->together ? "' is " : "'u' is "));
        assert_non_null(strstr(fg_context_hint(*state), "--missing="));
      } else {
        assert_true(isnan(u[100]) == (given.count > 0));
      }
      fg_context_clear(*state);
    }
}

static void directions_may_be_far_from_others(void **state)
{
  static const struct {
    float direction;
    bool refused;
  } cases[] = {{270, false}, {360, false}, {361, true}, {999, true}, {-99, true}};
  const fg__missing_numbers given = {.count = 0};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const float far = cases[n].direction;
    float speed[] = {1, 2, 3, 4, 5, 6}, direction[] = {5, 10, far, far, 3, 2};
    const fg__raw_samples raw = {.path = "file",
                                 .name = {"speed", "direction"},
                                 .component = {speed, direction},
                                 .components = 2,
                                 .count = sizeof speed / sizeof *speed,
                                 .is_polar = true};
    assert_true((fg__missing_settle(*state, &raw, &given) != FG_STATUS_OK) ==
                cases[n].refused);
    fg_context_clear(*state);
  }
}

static void samples_that_are_masked_do_not_count(void **state)
{
  float u[] = {1, 2, -9999, -9999, 3, 4}, v[] = {1, 1, NAN, 1, 1, 1};
  const unsigned char valid[] = {1, 1, 1, 0, 1, 1};
  const fg__missing_numbers given = {.count = 0};
  const fg__raw_samples raw = {.path = "file",
                               .name = {"u", "v"},
                               .component = {u, v},
                               .components = 2,
                               .count = sizeof u / sizeof *u,
                               .valid = valid};
  assert_int_equal(fg__missing_settle(*state, &raw, &given), FG_STATUS_OK);
}

static void a_list_of_numbers_is_read_whole(void **state)
{
  static const char *const wrong[] = {"", "x", "1,", "1 2", "1,,2", "nothing"};
  fg__missing_numbers given;
  for (size_t n = 0; n < sizeof wrong / sizeof *wrong; ++n) {
    assert_int_equal(fg__missing_read(&given, *state, wrong[n]), FG_STATUS_ARGUMENT);
    fg_context_clear(*state);
  }
  assert_int_equal(fg__missing_read(&given, *state, "-9999,1e20"), FG_STATUS_OK);
  assert_int_equal(given.count, 2);
  assert_true(fg__is_given_missing(&given, (double)1e20F));
  assert_false(fg__is_given_missing(&given, 9999.0));
}

static int create(void **state)
{
  return (int)fg_context_create((fg_context **)state);
}

static int destroy(void **state)
{
  fg_context_destroy(*state);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_recurring_number_apart_is_refused),
      cmocka_unit_test(directions_may_be_far_from_others),
      cmocka_unit_test(samples_that_are_masked_do_not_count),
      cmocka_unit_test(a_list_of_numbers_is_read_whole),
  };
  return cmocka_run_group_tests(tests, create, destroy);
}
