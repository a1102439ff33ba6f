#include "place/domain/gaps.h"

#include "place/fields_test.h"
#include "place/placement.h"

#include <stdint.h>

static const sampling GRID = {
    .dimension = 2, .nodes = {121, 81}, .low = {0, 0}, .high = {120, 80}};

/* A wave between a coast at the right and the frame. */
static void wave(const double position[3], double v[3])
{
  v[0] = cos(position[1] / 25.0);
  v[1] = sin(position[0] / 30.0);
  v[2] = 0.0;
  if (position[0] > 110.5)
    v[0] = (double)NAN;
}

/* One sample in `every` is missing, as by chance. */
static void scattered(const double position[3], double v[3], unsigned every)
{
  const unsigned sample =
      (unsigned)(position[1] + 0.5) * 121 + (unsigned)(position[0] + 0.5);
  wave(position, v);
  if ((uint32_t)(sample * UINT32_C(2654435761)) >> 8 < (1U << 24) / every)
    v[0] = (double)NAN;
}

static void radar(const double position[3], double v[3])
{
  scattered(position, v, 12);
}

/* A third is missing: most holes are one. */
static void swath(const double position[3], double v[3])
{
  scattered(position, v, 3);
}

/* On the right two samples of five, of which no four are a cell. */
static void sparse(const double position[3], double v[3])
{
  const int place = (int)(position[0] + 0.5) + 2 * (int)(position[1] + 0.5);
  scattered(position, v, 12);
  if (position[0] > 40.5)
    v[0] = place % 5 == 0 || place % 5 == 2 ? cos(position[1] / 25.0) : (double)NAN;
}

/* Thin plates, and currents to and fro between them. */
static void plates(const double position[3], double v[3])
{
  const int at = (int)(position[1] + 0.5);
  v[0] = at / 8 % 2 ? 1.0 : -1.0;
  v[1] = v[2] = 0.0;
  if (at % 8 == 0 && position[0] > 10.5)
    v[0] = (double)NAN;
}

static void islands(const double position[3], double v[3])
{
  scattered(position, v, 1200);
}

static fg__place_domain domain_of(fg_context *context, const fg_field *field)
{
  fg__place_domain domain;
  if (fg__place_domain_create(&domain, context, field) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  return domain;
}

/* How well arrows placed on a field tell another one. */
static double error_of(fg_context *context, const fg_field *field, const fg_field *other)
{
  fg_placement *placement;
  fg_icons *icons;
  fg_score score;
  const fg_score_options options = {.lengths = FG_SCORE_FREE, .readers_only = true};
  assert_int_equal(fg_placement_create(&placement, context, field, NULL), FG_STATUS_OK);
  assert_int_equal(fg_placement_place(placement, 20, NULL), FG_STATUS_OK);
  assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(icons), 20);
  assert_int_equal(fg_icons_score(&score, context, other, icons, &options), FG_STATUS_OK);
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  return score.mean;
}

/* Filled samples are about what they were, and the coast stays. */
static void scattered_gaps_are_filled(void **state)
{
  fg_field *field = field_of(*state, &GRID, radar);
  fg__place_domain domain = domain_of(*state, field);
  assert_non_null(domain.filled);
  assert_ptr_equal(domain.given, field);
  assert_int_equal(domain.subdomain_count, 1);
  const fg_field_arrays *before = fg_field_contents(field);
  const fg_field_arrays *after = fg_field_contents(domain.filled);
  int filled = 0;
  for (int n = 0; n < 121 * 81; ++n) {
    const double at[3] = {n % 121, n / 121};
    double v[3];
    wave(at, v);
    const bool had = isfinite((double)before->velocity[0][n]);
    const bool has =
        (!after->valid || after->valid[n]) && isfinite((double)after->velocity[0][n]);
    if (isnan(v[0]))
      assert_false(has);
    if (!has || had)
      continue;
    ++filled;
    assert_close((double)after->velocity[0][n], v[0], 0.02);
    assert_close((double)after->velocity[1][n], v[1], 0.02);
  }
  assert_true(filled > 500);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

/* Lines go also where only the filled field has cells. */
static void filled_cells_may_widen_the_box(void **state)
{
  fg_field *field = field_of(*state, &GRID, sparse);
  fg__place_domain domain = domain_of(*state, field);
  assert_non_null(domain.filled);
  assert_true(domain.high[0] > 119.0);
  assert_non_null(fg__place_subdomain_at(&domain, (const double[3]){90.5, 40.5}));
  assert_int_equal(domain.subdomain_count, 1);
  fg__place_domain_clear(&domain);
  fg_field_destroy(field);
}

static void few_holes_and_straight_ones_are_walls(void **state)
{
  static const velocity_of of[] = {wave, islands, plates};
  for (int n = 0; n < 3; ++n) {
    fg_field *field = field_of(*state, &GRID, of[n]);
    fg__place_domain domain = domain_of(*state, field);
    assert_null(domain.filled);
    assert_ptr_equal(domain.field, field);
    fg__place_domain_clear(&domain);
    fg_field_destroy(field);
  }
}

/* Lines go over gaps. Where they would end there hardly one would find its length, and
 * the error would be ten times as large. */
static void gaps_cost_little_error(void **state)
{
  static const velocity_of of[] = {radar, swath};
  fg_field *whole = field_of(*state, &GRID, wave);
  const double least = error_of(*state, whole, whole);
  for (int n = 0; n < 2; ++n) {
    fg_field *gappy = field_of(*state, &GRID, of[n]);
    assert_true(error_of(*state, gappy, whole) < 1.5 * least);

    fg_field_destroy(gappy);
  }
  fg_field_destroy(whole);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(scattered_gaps_are_filled),
      CASE(filled_cells_may_widen_the_box),
      CASE(few_holes_and_straight_ones_are_walls),
      CASE(gaps_cost_little_error),
  };
  return cmocka_run_group_tests_name("place/domain/gaps", tests, NULL, NULL);
}
