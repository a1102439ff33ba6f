/* Which large numbers are taken for values. */
#include "base/context_test.h"
#include "field/refused.h"

enum { MOST = 8 };

static void a_coordinate_far_from_all_others_is_none(void **state)
{
  static const struct {
    size_t size;
    double x[MOST];
    size_t apart; /* its index; MOST: none is */
  } cases[] = {
      {4, {0, 1, 2, 9.96921e36}, 3},
      {4, {0, 1, 1e20, 3}, 2},
      {4, {-1e20, 0, 1, 2}, 0},
      {2, {5, 1e20}, 1},
      {4, {0, 1e22, 2e22, 3e22}, MOST},
      {5, {-2e22, -1e22, 0, 1e22, 2e22}, MOST},
      {5, {1e15, 1e17, 1e19, 1e21, 1e23}, MOST},
      {4, {1e22, 1.1e22, 1.2e22, 1.3e22}, MOST},
      {2, {0, 1e22}, MOST},
      {4, {0, 1, 2, 1e18}, MOST},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
    for (size_t i = 0; i < cases[n].size; ++i)
      if (fg__is_apart_coordinate(cases[n].x, cases[n].size, i) != (i == cases[n].apart))
        fail_msg("case %zu, coordinate %zu", n, i);
}

static void a_few_points_far_from_most_have_no_place(void **state)
{
  static const struct {
    double x[MOST];
    size_t apart;
  } cases[] = {
      {{1, 2, 3, 4, 1e20, 6, 7, 1e20}, 4},
      {{1e22, 2e22, 3e22, -1e22, 0, 0, 1e21, 4e20}, MOST},
      {{1, 2, 3, 4, 5, 6, 7, 8e17}, MOST},
  };
  double between[3 * MOST] = {0.0};
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    for (size_t i = 0; i < MOST; ++i)
      between[3 * i + 1] = cases[n].x[i];
    assert_int_equal(fg__find_apart_position(cases[n].x, 1, MOST), cases[n].apart);
    assert_int_equal(fg__find_apart_position(between + 1, 3, MOST), cases[n].apart);
  }
}

static void a_speed_far_beyond_all_others_is_none(void **state)
{
  static const struct {
    double speed[MOST];
    bool none;
  } cases[] = {
      {{1, 2, -1e16, 3}, true},       {{1e20, 0.5, 1e20, -1e20}, true},
      {{1e20, 2e20, -3e20}, false},   {{1e20, 1e20, 1e20, 0}, false},
      {{1e20, 1e16, 1e12, 1}, false}, {{1e31, 2e31, 3e31}, true},
      {{1, 2, 9e14}, false},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg__fastest fastest = {.speed = 0.0};
    for (size_t i = 0; i < MOST; ++i)
      fg__fastest_add(&fastest, cases[n].speed[i], 0, i);
    if (fg__fastest_is_none(&fastest) != cases[n].none)
      fail_msg("case %zu", n);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_coordinate_far_from_all_others_is_none),
      cmocka_unit_test(a_few_points_far_from_most_have_no_place),
      cmocka_unit_test(a_speed_far_beyond_all_others_is_none),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
