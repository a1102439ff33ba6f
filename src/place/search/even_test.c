#include "place/search/even.h"

#include "place/fields_test.h"

typedef struct setting {
  fg_field *field;
  fg__place_domain domain;
  fg__place_search search;
} setting;

static void set(setting *s, fg_context *context, const sampling *box,
                velocity_of velocity, int count)
{
  *s = (setting){.field = field_of(context, box, velocity)};
  assert_int_equal(fg__place_domain_create(&s->domain, context, s->field), FG_STATUS_OK);
  assert_int_equal(fg__place_search_create(&s->search, context, &s->domain, count, true,
                                           FG__PLACE_FINE),
                   FG_STATUS_OK);
  assert_int_equal(fg__place_fill_evenly(&s->search, count), FG_STATUS_OK);
}

static void clear(setting *s)
{
  fg__place_search_clear(&s->search);
  fg__place_domain_clear(&s->domain);
  fg_field_destroy(s->field);
}

/* Distances to the nearest other seed, in lambda. */
static void measure(const fg__place_search *search, double *least, double *most)
{
  *least = HUGE_VAL;
  *most = 0.0;
  for (int n = 0; n < search->count; ++n) {
    double near = HUGE_VAL;
    for (int m = 0; m < search->count; ++m)
      if (m != n)
        near = fmin(near, distance_between(search->icon[n]->seed.position,
                                           search->icon[m]->seed.position,
                                           search->scale.dimension));
    *least = fmin(*least, near / search->scale.lambda);
    *most = fmax(*most, near / search->scale.lambda);
  }
}

static void seeds_are_evenly_apart(void **state)
{
  static const int counts[] = {2, 7, 19, 60, 150};
  for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
    setting s;
    double least, most;
    set(&s, *state, &PLAIN, slant, counts[n]);
    assert_int_equal(s.search.count, counts[n]);
    measure(&s.search, &least, &most);
    assert_true(least > 0.7 && most < 1.3);
    clear(&s);
  }
  setting s;
  double least, most;
  set(&s, *state, &SOLID, swirl, 40);
  assert_int_equal(s.search.count, 40);
  measure(&s.search, &least, &most);
  assert_true(least > 0.6 && most < 1.4);
  clear(&s);
}

static void seeds_lie_in_the_domain(void **state)
{
  setting s;
  set(&s, *state, &PLAIN, coast, 60);
  assert_true(s.search.count >= 56 && s.search.count <= 60);
  for (int n = 0; n < s.search.count; ++n) {
    double v[2];
    assert_true(fg_field_velocity(s.field, s.search.icon[n]->seed.position, v));
    assert_int_equal(s.search.icon[n]->identity, n);
  }
  clear(&s);
}

/* Beside icons of the left half all new ones lie in the right one, as far from the icons
 * as from each other. */
static void gaps_are_filled_evenly(void **state)
{
  setting s;
  double least, most;
  set(&s, *state, &PLAIN, slant, 60);
  const double middle = 0.5 * (s.domain.low[0] + s.domain.high[0]);
  for (int n = s.search.count - 1; n >= 0; --n)
    if (s.search.icon[n]->seed.position[0] > middle)
      assert_int_equal(fg__place_remove(&s.search, n), FG_STATUS_OK);
  const int there = s.search.count;
  assert_true(there > 20 && there < 40);
  assert_int_equal(fg__place_fill_evenly(&s.search, there), FG_STATUS_OK);
  assert_int_equal(s.search.count, there);
  assert_int_equal(fg__place_fill_evenly(&s.search, 60), FG_STATUS_OK);
  assert_int_equal(s.search.count, 60);
  for (int n = there; n < 60; ++n)
    assert_true(s.search.icon[n]->seed.position[0] > middle);
  measure(&s.search, &least, &most);
  assert_true(least > 0.65 && most < 1.35);
  clear(&s);
}

static void there_is_one_even_start(void **state)
{
  setting a, b;
  set(&a, *state, &PLAIN, coast, 33);
  set(&b, *state, &PLAIN, coast, 33);
  assert_int_equal(a.search.count, b.search.count);
  for (int n = 0; n < a.search.count; ++n)
    assert_memory_equal(&a.search.icon[n]->seed, &b.search.icon[n]->seed,
                        sizeof a.search.icon[n]->seed);
  clear(&a);
  clear(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(seeds_are_evenly_apart),
      CASE(seeds_lie_in_the_domain),
      CASE(gaps_are_filled_evenly),
      CASE(there_is_one_even_start),
  };
  return cmocka_run_group_tests_name("place/search/search/even", tests, NULL, NULL);
}
