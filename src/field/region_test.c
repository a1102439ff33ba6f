/* Parts of fields in a region. */
#include <math.h>
#include <string.h>

#include "field/made_test.h"
#include "field/region.h"
#include "terms/measure.h"

enum { NX = 7, NY = 5, NZ = 4, COUNT = NX * NY * NZ };

/* Linear in space, so that interpolation is exact, and no two components alike. */
static double component_at(int c, const double x[3])
{
  static const double a[3][4] = {
      {0.5, 1.0, -2.0, 0.25}, {-1.0, 0.5, 0.75, 2.0}, {2.0, -0.25, 1.5, -1.0}};
  return a[c][0] + a[c][1] * x[0] + a[c][2] * x[1] + a[c][3] * x[2];
}

/* x from -1 to 2 in steps of 0.5; y at 10, 10.5, 11.5, 13, 15; z at 3, 4, 5, 6. One
 * sample is missing. */
static fg_field *make(fg_context *context, int dimension, int missing)
{
  static double axis[3][NX];
  static float velocity[3][COUNT];
  static const int size[3] = {NX, NY, NZ};
  fg_field_arrays arrays = {.dimension = dimension, .axis_name = {"east", "y", "height"}};
  for (int i = 0; i < NX; ++i) {
    axis[0][i] = -1.0 + 0.5 * i;
    axis[1][i] = 10.0 + 0.25 * i * (i + 1);
    axis[2][i] = 3.0 + i;
  }
  for (int k = 0; k < dimension; ++k) {
    arrays.size[k] = size[k];
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = velocity[k];
  }
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < dimension; ++c) {
      const double at[3] = {axis[0][n % NX], axis[1][n / NX % NY],
                            dimension == 3 ? axis[2][n / NX / NY] : 0.0};
      velocity[c][n] = n == missing ? NAN : (float)component_at(c, at);
    }
  return field_made(context, &arrays);
}

typedef struct situation {
  int dimension;
  fg__field_region region;
  int size[3];
  double low[3], high[3]; /* of the part */
} situation;

static void check_part(const fg_field *field, const situation *s)
{
  const fg_field_arrays *a = fg_field_contents(field);
  int count = 1;
  assert_int_equal(a->dimension, s->dimension);
  for (int k = 0; k < s->dimension; ++k) {
    assert_int_equal(a->size[k], s->size[k]);
    assert_true(a->axis[k][0] == s->low[k]);
    assert_true(a->axis[k][s->size[k] - 1] == s->high[k]);
    count *= a->size[k];
  }
  for (int n = 0; n < count; ++n) {
    const int i = n % a->size[0], j = n / a->size[0] % a->size[1];
    const int l = n / a->size[0] / a->size[1];
    const double at[3] = {a->axis[0][i], a->axis[1][j],
                          s->dimension == 3 ? a->axis[2][l] : 0.0};
    for (int c = 0; c < s->dimension; ++c)
      assert_true(fabs((double)a->velocity[c][n] - component_at(c, at)) < 1e-5);
  }
}

static void a_part_is_the_field_itself_there(void **state)
{
  static const situation cases[] = {
      {2, {0}, {7, 5}, {-1, 10}, {2, 15}},
      {2, {2, {-0.75, 11}, {1.2, 14}}, {6, 4}, {-0.75, 11}, {1.2, 14}},
      {2, {2, {-0.5, 10.5}, {1.5, 13}}, {5, 3}, {-0.5, 10.5}, {1.5, 13}},
      {2, {2, {-9, -9}, {0.25, 99}}, {4, 5}, {-1, 10}, {0.25, 15}},
      {2, {2, {-9, -9}, {9, 99}}, {7, 5}, {-1, 10}, {2, 15}},
      /* a bound that was rounded is the sample's own */
      {2, {2, {0.5 - 1e-12, 10}, {1.5 + 1e-12, 15}}, {3, 5}, {0.5, 10}, {1.5, 15}},
      /* from a sample into the next interval */
      {2, {2, {0.5, 10}, {0.75, 15}}, {2, 5}, {0.5, 10}, {0.75, 15}},
      {3, {2, {0.1, 11}, {1.1, 14}}, {4, 4, 4}, {0.1, 11, 3}, {1.1, 14, 6}},
      {3,
       {3, {0.1, 11, 3.5}, {1.1, 14, 5.25}},
       {4, 4, 4},
       {0.1, 11, 3.5},
       {1.1, 14, 5.25}},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = make(*state, cases[n].dimension, -1);
    if (fg__region_cut(&field, *state, "wind.vti", &cases[n].region))
      fail_msg("case %zu: %s", n, fg_context_message(*state));
    check_part(field, &cases[n]);
    fg_field_destroy(field);
  }
}

static void a_region_without_samples_is_refused(void **state)
{
  static const struct {
    int dimension;
    fg__field_region region;
    const char *words;
  } cases[] = {
      {2,
       {2, {3, 10}, {4, 15}},
       "wind.vti: nothing lies in the region: it goes from east = 3 to 4, and the field "
       "from -1 to 2"},
      {3, {3, {0, 10, 7}, {1, 15, 8}}, "from height = 7 to 8, and the field from 3 to 6"},
      {2,
       {2, {0, 13.5}, {1, 14.5}},
       "no sample lies in the region: it goes from y = 13.5 to 14.5, and samples lie at "
       "13 and 15 (of 10 to 15)"},
      {2,
       {3, {0, 10, 0}, {1, 15, 1}},
       "a region of six numbers, and the field is a plane along east and y"},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg_field *field = make(*state, cases[n].dimension, -1);
    assert_int_equal(fg__region_cut(&field, *state, "wind.vti", &cases[n].region),
                     FG_STATUS_ARGUMENT);
    if (!strstr(fg_context_message(*state), cases[n].words))
      fail_msg("case %zu: %s", n, fg_context_message(*state));
    fg_context_clear(*state);
    fg_field_destroy(field);
  }
}

/* Sample (2, 1), at (0, 10.5), is missing: so is what is interpolated from it. */
static void a_bound_beside_a_missing_sample_is_missing(void **state)
{
  const fg__field_region beside = {2, {0.25, 10}, {2, 15}},
                         from = {2, {0.5, 10}, {2, 15}};
  fg_field *field = make(*state, 2, NX + 2);
  assert_int_equal(fg__region_cut(&field, *state, "wind.vti", &beside), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 5);
  for (int n = 0; n < a->size[0] * a->size[1]; ++n)
    assert_true(isnan(a->velocity[0][n]) == (n == a->size[0]));
  fg_field_destroy(field);
  field = make(*state, 2, NX + 2);
  assert_int_equal(fg__region_cut(&field, *state, "wind.vti", &from), FG_STATUS_OK);
  assert_null(fg_field_contents(field)->valid);
  fg_field_destroy(field);
}

/* Past its last sample a periodic axis goes on to the first. */
static void a_period_ends_with_the_region(void **state)
{
  const fg__field_region region = {2, {0.75, 0}, {1.0, 0.5}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, *state, "abc", 9), FG_STATUS_OK);
  const float first = fg_field_contents(field)->velocity[1][0];
  assert_int_equal(fg__region_cut(&field, *state, "synth:abc", &region), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 3);
  assert_int_equal(a->size[1], 5);
  assert_int_equal(a->size[2], 8);
  assert_true(a->period[0] == 0.0 && a->period[1] == 0.0 && a->period[2] == 1.0);
  assert_true(a->axis[0][2] == 1.0);
  assert_true(a->velocity[1][2] == first);
  fg_field_destroy(field);
}

/* Of an axis that is drawn on another scale. */
static void regions_are_measured(void **state)
{
  enum { SIDE = 5 };
  static const double axis[2][SIDE] = {{0, 1, 2, 3, 4}, {-40, -30, -20, -10, -4}};
  float velocity[SIDE * SIDE];
  fg_field *field;
  for (int n = 0; n < SIDE * SIDE; ++n)
    velocity[n] = 1.0F;
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {SIDE, SIDE},
                                  .axis = {axis[0], axis[1]},
                                  .velocity = {velocity, velocity},
                                  .axis_name = {"x", "level"},
                                  .axis_units = {"m", "-25 hPa"}};
  const fg__field_region region = {2, {1, 250}, {3, 1000}},
                         beyond = {2, {1, 1100}, {3, 1200}};
  char units[FG__MEASURE_BYTES];
  assert_int_equal(fg_field_create(&field, *state, &arrays), FG_STATUS_OK);
  assert_int_equal(fg__region_cut(&field, *state, "a", &beyond), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(*state),
                         "from level = 1100 to 1200, and the field from 1000 to 100"));
  fg_context_clear(*state);
  assert_int_equal(fg__region_cut(&field, *state, "a", &region), FG_STATUS_OK);
  const fg_field_arrays *cut = fg_field_contents(field);
  assert_int_equal(cut->size[1], 4);
  assert_true(fg_field_measured(field, 1, cut->axis[1][0]) == 1000.0);
  assert_true(fg_field_measured(field, 1, cut->axis[1][3]) == 250.0);
  assert_true(fg_field_measured(field, 0, cut->axis[0][0]) == 1.0);
  fg_field_measured_units(units, sizeof units, field, 1);
  assert_string_equal(units, "hPa");
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_are_measured),
      cmocka_unit_test(a_part_is_the_field_itself_there),
      cmocka_unit_test(a_region_without_samples_is_refused),
      cmocka_unit_test(a_bound_beside_a_missing_sample_is_missing),
      cmocka_unit_test(a_period_ends_with_the_region),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
