#include "place/domain/domain.h"

#include "place/fields_test.h"

static fg__place_domain domain_of(fg_context *context, const fg_field *field)
{
  fg__place_domain domain;
  if (fg__place_domain_create(&domain, context, field) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  return domain;
}

/* Two rooms, the right one narrower; the cells from 1 to 2 lack a corner. */
static void rooms(const double position[3], double v[3])
{
  slant(position, v);
  if (position[0] > 0.95 && position[0] < 2.05)
    v[1] = (double)NAN;
}

static void subdomains_are_told_apart(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {37, 25}, .low = {-4, 3}, .high = {5, 9}};
  fg_field *field = field_of(*state, &box, rooms);
  fg__place_domain domain = domain_of(*state, field);
  assert_int_equal(domain.subdomain_count, 2);
  const fg__place_subdomain *left =
                                fg__place_subdomain_at(&domain, (const double[3]){-1, 5}),
                            *right =
                                fg__place_subdomain_at(&domain, (const double[3]){4, 8});
  assert_non_null(left);
  assert_non_null(right);
  assert_ptr_not_equal(left, right);
  assert_ptr_equal(left, fg__place_subdomain_at(&domain, (const double[3]){-3.9, 8.9}));
  assert_null(fg__place_subdomain_at(&domain, (const double[3]){1.5, 5}));
  assert_null(fg__place_subdomain_at(&domain, (const double[3]){-4.01, 5}));
  /* cells touching a missing corner are outside: the left room ends at 0.75 */
  assert_close(left->measure, 4.75 * 6, 0.5);
  assert_close(right->measure, 2.75 * 6, 0.3);
  assert_close(left->widest, 4.75 / 2, domain.spacing);
  assert_close(right->widest, 2.75 / 2, domain.spacing);
  assert_close(domain.whole, 7.5 * 6, 0.8);
  assert_close(domain.measure, domain.whole, 1e-9);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

/* A wall from above and one from below: the way between leads up and down. */
static void winding(const double position[3], double v[3])
{
  const double x = position[0], y = position[1];
  slant(position, v);
  if ((fabs(x + 1) < 0.4 && y > 4.5) || (fabs(x - 2) < 0.4 && y < 7.5))
    v[1] = (double)NAN;
}

static void a_winding_domain_is_one_subdomain(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {37, 25}, .low = {-4, 3}, .high = {5, 9}};
  fg_field *field = field_of(*state, &box, winding);
  fg__place_domain domain = domain_of(*state, field);
  assert_int_equal(domain.subdomain_count, 1);
  assert_close(domain.subdomains[0].measure, domain.whole, 1e-6 * domain.whole);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

static void clearance_is_that_to_the_frame_or_a_wall(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {37, 25}, .low = {-4, 3}, .high = {5, 9}};
  fg_field *field = field_of(*state, &box, rooms);
  fg__place_domain domain = domain_of(*state, field);
  unsigned random = 5;
  for (int n = 0; n < 2000; ++n) {
    double at[3] = {-4 + 4.75 * next_random(&random), 3 + 6 * next_random(&random)};
    double wanted = fmin(fmin(at[0] + 4, 0.75 - at[0]), fmin(at[1] - 3, 9 - at[1]));
    double found = fg__place_clearance(&domain, at);
    assert_close(found, wanted, domain.spacing);
    assert_true(found <= fmin(at[0] + 4, fmin(at[1] - 3, 9 - at[1])));
  }
  assert_true(fg__place_clearance(&domain, (const double[3]){5.01, 5}) == 0.0);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

static void a_period_belongs_to_the_domain(void **state)
{
  fg_field *field = field_of(*state, &ROUND, winds);
  fg__place_domain domain = domain_of(*state, field);
  assert_close(domain.high[0], 360, 1e-9);
  assert_close(domain.whole, 360.0 * 145, 360.0 * 145 * 0.02);
  double v[3] = {0}, direction[3];
  const double seam[3] = {357.3, 20};
  assert_true(fg__place_direction(&domain, seam, direction));
  assert_true(fg_field_velocity(field, seam, v));
  assert_close(degrees_between(v, direction, 2), 0, 1e-5);
  assert_close(direction[0] * direction[0] + direction[1] * direction[1], 1, 1e-12);
  assert_close(fg__place_speed(&domain, seam), hypot(v[0], v[1]), 1e-12);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

/* A fast vessel along x in a box that hardly moves. */
static void vessel(const double position[3], double v[3])
{
  bool in = hypot(position[1] - 5, position[2] - 0.2) < 0.8;
  v[0] = in ? 8 : 0.02;
  v[1] = 0.03 * sin(position[0]);
  v[2] = 0.02;
}

static void dead_volume_hardly_counts(void **state)
{
  fg_field *field = field_of(*state, &SOLID, vessel);
  fg__place_domain domain = domain_of(*state, field);
  assert_true(domain.dead);
  assert_close(domain.whole, 5 * 4 * 4.5, 4);
  assert_true(domain.measure < 0.25 * domain.whole);
  assert_true(domain.measure > 5 * 3.14 * 0.8 * 0.8 * 0.7);
  assert_true(fg__place_weight(&domain, 8) > 1000 * fg__place_weight(&domain, 0.05));
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
  /* not where the rest flows too, and not on a plane */
  field = field_of(*state, &SOLID, swirl);
  domain = domain_of(*state, field);
  assert_false(domain.dead);
  assert_true(domain.measure == domain.whole);
  assert_true(fg__place_weight(&domain, 0.05) == 1.0);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
  const sampling plane = {
      .dimension = 2, .nodes = {41, 41}, .low = {-7, 1}, .high = {-2, 9}};
  field = field_of(*state, &plane, vessel);
  domain = domain_of(*state, field);
  assert_true(domain.slow);
  assert_false(domain.dead);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

/* The vessel in a wall that does not move, in which the solver left a rest. */
static void wall(const double position[3], double v[3])
{
  vessel(position, v);
  if (v[0] < 8)
    v[0] = v[1] = v[2] = 1e-9;
}

static void what_stands_still_has_no_share(void **state)
{
  const sampling plane = {
      .dimension = 2, .nodes = {41, 81}, .low = {-7, 1}, .high = {-2, 9}};
  fg_field *field = field_of(*state, &plane, wall);
  fg__place_domain domain = domain_of(*state, field);
  assert_close(domain.whole, 5 * 8, 0.5);
  assert_close(domain.measure, 5 * 1.6, 1);
  assert_true(fg__place_moves(&domain, 0.1) && !fg__place_moves(&domain, 1e-9));
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

static void pond(const double position[3], double v[3])
{
  slant(position, v);
  if (position[0] < 2 || position[0] > 3.1 || position[1] > 5)
    v[0] = (double)NAN;
}

static void creek(const double position[3], double v[3])
{
  slant(position, v);
  if (fabs(position[0] - position[1]) > 0.15)
    v[0] = (double)NAN;
}

/* The rasters of an area in a much larger grid are the area's, and not too fine where it
 * is little of its box. */
static void wide_margins_are_no_part(void **state)
{
  const sampling box = {
      .dimension = 2, .nodes = {101, 101}, .low = {0, 0}, .high = {10, 10}};
  fg_field *field = field_of(*state, &box, pond);
  fg__place_domain domain = domain_of(*state, field);
  assert_close(domain.low[0], 2, 1e-6);
  assert_close(domain.high[0], 3.1, 1e-6);
  assert_close(domain.low[1], 0, 1e-6);
  assert_close(domain.high[1], 5, 1e-6);
  assert_close(domain.measure, 1.1 * 5, 0.1);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
  field = field_of(*state, &box, creek);
  domain = domain_of(*state, field);
  assert_close(domain.high[0] - domain.low[0], 10, 1e-6);
  assert_true(domain.whole < 1.2);
  assert_close(domain.measure, 100.0 / 64, 1e-6);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(subdomains_are_told_apart),
      CASE(a_winding_domain_is_one_subdomain),
      CASE(clearance_is_that_to_the_frame_or_a_wall),
      CASE(a_period_belongs_to_the_domain),
      CASE(dead_volume_hardly_counts),
      CASE(what_stands_still_has_no_share),
      CASE(wide_margins_are_no_part),
  };
  return cmocka_run_group_tests_name("place/domain/domain", tests, NULL, NULL);
}
