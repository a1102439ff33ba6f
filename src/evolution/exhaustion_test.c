/* Every allocation of an evolution fails once: each failure is told as such, nothing is
 * left behind, and an evolution whose step has failed can go on or be ended. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/refusal_test.h"

enum { COLUMNS = 22, ROWS = 18, STEPS = 40 };

/* Walls divide it, into a small subdomain too. */
static fg_status make_masked(fg_field **out, fg_context *context)
{
  static float u[ROWS][COLUMNS], v[ROWS][COLUMNS];
  double x[COLUMNS], y[ROWS];
  for (int j = 0; j < ROWS; ++j)
    for (int i = 0; i < COLUMNS; ++i) {
      bool wall = i == 12 || (j == 4 && i < 5) || (i == 4 && j < 5);
      x[i] = 0.1 * i;
      y[j] = 0.13 * j;
      u[j][i] = wall ? (float)NAN : (float)cos(0.3 * i + 0.4 * j);
      v[j][i] = (float)sin(0.2 * j - 0.1 * i);
    }
  fg_field_arrays arrays = {
      .dimension = 2, .size = {COLUMNS, ROWS}, .axis = {x, y}, .velocity = {u[0], v[0]}};
  return fg_field_create(out, context, &arrays);
}

typedef struct example {
  const char *name; /* NULL: the masked field */
  int samples, nodes, threads;
  fg_scheme scheme;
} example;

/* A failed step is tried once more, when there is memory again. counting: so far that
 * clusters are counted. */
static fg_status take_steps(fg_evolution *e, fg_context *context, bool counting)
{
  fg_step step = {0};
  for (int n = 0; n < STEPS; ++n) {
    fg_status status = fg_evolution_step(e, &step);
    if (status == FG_STATUS_MEMORY) {
      fg_context_clear(context);
      assert_int_equal(fg_evolution_step(e, &step), FG_STATUS_OK);
    }
    if (status != FG_STATUS_OK)
      return status;
  }
  assert_true((step.clusters > 0) == counting);
  return FG_STATUS_OK;
}

static fg_status live_through(fg_context *context, const example *x)
{
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_evolution_options options = {
      .nodes = x->nodes, .threads = x->threads, .scheme = x->scheme};
  fg_status status = x->name
                         ? fg_field_create_analytic(&field, context, x->name, x->samples)
                         : make_masked(&field, context);
  if (status == FG_STATUS_OK)
    status = fg_evolution_create(&evolution, context, field, &options);
  if (status == FG_STATUS_OK)
    status = take_steps(evolution, context, x->scheme != FG_SCHEME_THETA);
  if (status == FG_STATUS_OK)
    status = fg_density_create(&density, evolution);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  return status;
}

static void fail_in_turn(fg_context *context, const example *x)
{
  failing = -1;
  asked = unfreed = 0;
  assert_int_equal(live_through(context, x), FG_STATUS_OK);
  assert_int_equal(unfreed, 0);
  long all = asked;
  for (long n = 0; n < all; ++n) {
    fg_context_clear(context);
    asked = unfreed = 0;
    failing = n;
    assert_int_equal(live_through(context, x), FG_STATUS_MEMORY);
    assert_int_equal(unfreed, 0);
  }
  failing = -1;
}

static void in_2d(void **state)
{
  fail_in_turn(*state, &(example){"benard", 20, 33, 1, FG_SCHEME_BDF2});
}

static void with_a_mask(void **state)
{
  fail_in_turn(*state, &(example){NULL, 0, 33, 1, FG_SCHEME_BDF2});
}

static void in_3d(void **state)
{
  fail_in_turn(*state, &(example){"vortex3d", 9, 17, 1, FG_SCHEME_BDF2});
}

static void by_the_theta_scheme(void **state)
{
  fail_in_turn(*state, &(example){"vortex", 12, 17, 1, FG_SCHEME_THETA});
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {CASE(in_2d), CASE(with_a_mask), CASE(in_3d),
                                     CASE(by_the_theta_scheme)};
  return cmocka_run_group_tests_name("evolution/exhaustion", tests, NULL, NULL);
}
