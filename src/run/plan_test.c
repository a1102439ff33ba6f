#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "run/plan.h"

static int reach(fg__plan *plan, int clusters)
{
  return fg__plan_reach(plan, &(fg_step){.clusters = clusters});
}

static double share(const fg__plan *plan, int first, int now)
{
  return fg__plan_share(plan, &(fg_step){.clusters = first}, &(fg_step){.clusters = now});
}

static void a_list_is_followed(void **state)
{
  (void)state;
  const int list[] = {200, 60, 20};
  fg__plan plan;
  fg__plan_start(&plan, list, 3);
  assert_int_equal(reach(&plan, 0), 0);
  assert_int_equal(reach(&plan, 201), 0);
  assert_int_equal(reach(&plan, 200), 1);
  assert_int_equal(reach(&plan, 200), 0);
  assert_int_equal(reach(&plan, 61), 0);
  assert_false(fg__plan_done(&plan));
  assert_int_equal(reach(&plan, 19), 2); /* one state answers 60 and 20 */
  assert_true(fg__plan_done(&plan));
  assert_int_equal(reach(&plan, 3), 0);
}

static void the_number_may_rise_again(void **state)
{
  (void)state;
  const int list[] = {50, 40};
  fg__plan plan;
  fg__plan_start(&plan, list, 2);
  assert_int_equal(reach(&plan, 50), 1);
  assert_int_equal(reach(&plan, 52), 0);
  assert_int_equal(reach(&plan, 50), 0);
}

/* Whatever the first number: it comes first, each next one is well below the one before
 * it, and the last is 12 (or the first itself, below that). */
static void the_default_halves(void **state)
{
  (void)state;
  for (int first = 1; first < 3000; ++first) {
    fg__plan plan;
    fg__plan_start(&plan, NULL, 0);
    assert_int_equal(reach(&plan, 0), 0);
    assert_false(fg__plan_done(&plan));
    assert_true(reach(&plan, first) >= 1);
    assert_int_equal(plan.wanted[0], first);
    assert_int_equal(plan.wanted[plan.count - 1], first > 12 ? 12 : first);
    for (int k = 1; k < plan.count; ++k) {
      double ratio = (double)plan.wanted[k - 1] / plan.wanted[k];
      assert_true(ratio < 2.0 * sqrt(2.0) + 1e-9);
      assert_true(k == plan.count - 1 || ratio > sqrt(2.0) - 1e-9);
    }
  }
}

/* Numbers of arrows: the given ones, or the defaults. */
static void placed_arrows_have_numbers_of_their_own(void **state)
{
  (void)state;
  static const int list[] = {70, 9},
                   defaults[][5] = {{200, 100, 50, 25, 12}, {60, 25, 12}};
  fg__plan plan;
  fg__plan_start(&plan, list, 2);
  assert_false(plan.placed);
  fg__plan_start_placed(&plan, list, 2, 3);
  assert_true(plan.placed);
  assert_int_equal(plan.count, 2);
  assert_memory_equal(plan.wanted, list, sizeof list);
  assert_int_equal(reach(&plan, 8), 2); /* a scale each */
  for (int dimension = 2; dimension <= 3; ++dimension) {
    fg__plan_start_placed(&plan, NULL, 0, dimension);
    assert_true(plan.placed);
    assert_int_equal(plan.count, dimension == 2 ? 5 : 3);
    assert_memory_equal(plan.wanted, defaults[dimension - 2],
                        (size_t)plan.count * sizeof(int));
    assert_false(fg__plan_done(&plan));
  }
}

static void time_left_follows_the_power_law(void **state)
{
  (void)state;
  const int list[] = {10};
  fg__plan plan;
  fg__plan_start(&plan, list, 1);
  const fg_step first = {.clusters = 80, .time = 3e-6, .seconds = 2.0};
  /* nothing is known at the first snapshot */
  assert_true(fg__plan_seconds_left(&plan, &first, &first) < 0.0);
  /* with N = t^-0.43 and the same work for every factor of t, half of the way in log N
   * takes half of the time */
  fg_step now = {.clusters = 40, .time = 3e-6 * pow(2.0, 1.0 / 0.43), .seconds = 3.5};
  assert_true(fabs(fg__plan_seconds_left(&plan, &now, &first) - 3.0) <= 1e-9);
  now.clusters = 9;
  assert_true(fg__plan_seconds_left(&plan, &now, &first) == 0.0);
}

static void the_share_of_the_way_is_even_in_the_logarithm(void **state)
{
  (void)state;
  const int list[] = {100, 10};
  fg__plan plan;
  fg__plan_start(&plan, list, 2);
  assert_true(share(&plan, 0, 0) == 0.0);
  assert_true(share(&plan, 160, 160) == 0.0);
  assert_true(fabs(share(&plan, 160, 40) - 0.5) <= 1e-9);
  assert_true(share(&plan, 160, 170) == 0.0);
  assert_true(share(&plan, 160, 7) == 1.0);
  assert_true(share(&plan, 9, 9) == 1.0);
}

/* Whatever the number of clusters. */
static void times_are_reached_in_order(void **state)
{
  (void)state;
  const double times[] = {1e-4, 3e-4, 4e-4, 1e-2};
  const fg_step early = {.time = 0.99e-4}, exact = {.time = 1e-4, .clusters = 5000},
                both = {.time = 5e-4, .clusters = 80, .seconds = 1.0},
                now = {.time = sqrt(5e-4 * 1e-2), .clusters = 60, .seconds = 3.0},
                last = {.time = 2e-2, .clusters = 90, .seconds = 6.0};
  fg__plan plan;
  fg__plan_start_timed(&plan, times, 4);
  assert_int_equal(fg__plan_reach(&plan, &early), 0);
  assert_int_equal(fg__plan_reach(&plan, &exact), 1);
  assert_int_equal(fg__plan_reach(&plan, &exact), 0);
  assert_int_equal(fg__plan_reach(&plan, &both), 2);
  assert_int_equal(plan.next, 3);
  assert_true(fabs(fg__plan_share(&plan, &both, &now) - 0.5) <= 1e-9);
  assert_true(fabs(fg__plan_seconds_left(&plan, &now, &both) - 2.0) <= 1e-9);
  assert_false(fg__plan_done(&plan));
  assert_int_equal(fg__plan_reach(&plan, &last), 1);
  assert_true(fg__plan_done(&plan));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_list_is_followed),
      cmocka_unit_test(the_number_may_rise_again),
      cmocka_unit_test(the_default_halves),
      cmocka_unit_test(times_are_reached_in_order),
      cmocka_unit_test(the_share_of_the_way_is_even_in_the_logarithm),
      cmocka_unit_test(placed_arrows_have_numbers_of_their_own),
      cmocka_unit_test(time_left_follows_the_power_law),
  };
  return cmocka_run_group_tests_name("run/plan", tests, NULL, NULL);
}
