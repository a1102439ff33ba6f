#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "base/mix.h"

enum { MOST = 900 };

static double dice(size_t i)
{
  return (double)(fg__mix(i) >> 11) * 0x1p-53;
}

typedef struct points {
  double at[3][MOST];
  float of[3][MOST];
  unsigned char valid[MOST];
  fg_field_arrays arrays;
} points;

/* Those of a linear field in a box that is not one of unit size. */
static points scattered(int dimension, int count)
{
  points p = {.arrays = {.dimension = dimension, .size = {count}}};
  for (size_t i = 0; i < (size_t)count; ++i) {
    for (size_t k = 0; k < 3; ++k)
      p.at[k][i] = 10.0 * (double)k + (double)(3 - k) * dice(3 * i + k);
    p.of[0][i] = (float)(1.0 + 2.0 * p.at[0][i] - 0.25 * p.at[1][i]);
    p.of[1][i] = (float)(-3.0 + p.at[0][i] + 0.5 * p.at[1][i]);
    p.of[2][i] = (float)(0.1 * p.at[2][i]);
    p.valid[i] = 1;
  }
  return p;
}

static fg_status create(fg_field **out, fg_context *context, points *p)
{
  for (int k = 0; k < 3; ++k) {
    p->arrays.axis[k] = p->at[k];
    p->arrays.velocity[k] = p->of[k];
  }
  return fg_field_create_scattered(out, context, &p->arrays);
}

static void a_linear_field_comes_back_between_its_points(void **state)
{
  points p = scattered(2, MOST);
  const points before = p;
  fg_field *field = NULL;
  assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
  assert_memory_equal(p.at, before.at, sizeof p.at);
  assert_memory_equal(p.of, before.of, sizeof p.of);
  int inside = 0;
  for (size_t i = 0; i < 500; ++i) {
    const double at[2] = {3.0 * dice(7 * i), 10.0 + 2.0 * dice(7 * i + 1)};
    double v[2];
    if (!fg_field_velocity(field, at, v))
      continue;
    ++inside;
    assert_true(fabs(v[0] - (1.0 + 2.0 * at[0] - 0.25 * at[1])) < 1e-5);
    assert_true(fabs(v[1] - (-3.0 + at[0] + 0.5 * at[1])) < 1e-5);
  }
  assert_in_range(inside, 440, 500);
  double v[2];
  assert_false(fg_field_velocity(field, (const double[2]){3.2, 11.0}, v));
  fg_field_destroy(field);
}

/* Nothing is known round points that are missing or not there. */
static void holes_stay_holes(void **state)
{
  for (int given = 0; given < 2; ++given) {
    points p = scattered(2, MOST);
    size_t kept = 0;
    for (size_t i = 0; i < MOST; ++i) {
      const bool in_hole = hypot(p.at[0][i] - 1.5, p.at[1][i] - 11.0) < 0.6;
      p.valid[i] = !in_hole;
      if (given == 1 && !in_hole) {
        for (int k = 0; k < 2; ++k) {
          p.at[k][kept] = p.at[k][i];
          p.of[k][kept] = p.of[k][i];
        }
        ++kept;
      }
    }
    p.arrays.valid = given == 0 ? p.valid : NULL;
    p.arrays.size[0] = given == 0 ? MOST : (int)kept;
    fg_field *field = NULL;
    assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
    double v[2];
    assert_false(fg_field_velocity(field, (const double[2]){1.5, 11.0}, v));
    assert_true(fg_field_velocity(field, (const double[2]){0.5, 10.5}, v));
    fg_field_destroy(field);
  }
}

static void points_of_a_grid_are_its_samples(void **state)
{
  points p = scattered(2, 35);
  for (size_t i = 0; i < 35; ++i) {
    const size_t n = i * 12 % 35; /* in another order */
    p.at[0][i] = (double)((n % 7) * (n % 7));
    p.at[1][i] = -2.0 * (double)(n / 7);
    p.of[0][i] = (float)n;
    p.of[1][i] = 1.0f;
  }
  p.arrays.axis_name[1] = "depth";
  fg_field *field = NULL;
  assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 7);
  assert_int_equal(a->size[1], 5);
  assert_string_equal(a->axis_name[1], "depth");
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 7; ++i) {
      assert_true(a->axis[0][i] == (double)(i * i) && a->axis[1][j] == 2.0 * j - 8.0);
      assert_true(a->velocity[0][7 * j + i] == (float)(7 * (4 - j) + i));
    }
  fg_field_destroy(field);
}

static void longitudes_go_on_beyond_the_antimeridian(void **state)
{
  points p = scattered(2, 400);
  p.arrays.scale = FG_SCALE_GEO;
  for (size_t i = 0; i < 400; ++i) { /* from 165 to 195 east, turning about the poles */
    const double east = 165.0 + 30.0 * dice(2 * i);
    p.at[0][i] = east > 180.0 ? east - 360.0 : east;
    p.at[1][i] = 40.0 + 20.0 * dice(2 * i + 1);
    p.of[0][i] = (float)cos(p.at[1][i] * 0.017453292519943295);
    p.of[1][i] = 0.0f;
  }
  fg_field *field = NULL;
  assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
  double v[2];
  assert_true(fg_field_velocity(field, (const double[2]){180.0, 50.0}, v));
  assert_true(fabs(v[0] - 0.643) < 0.01 && fabs(v[1]) < 0.01);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->axis[0][0] > 160.0 && a->axis[0][a->size[0] - 1] < 200.0);
  fg_field_destroy(field);
}

static void a_plane_in_space_is_a_field_in_2d(void **state)
{
  points p = scattered(3, 300);
  for (size_t i = 0; i < 300; ++i)
    p.at[1][i] = 7.0;
  fg_field *field = NULL;
  assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->dimension, 2);
  assert_string_equal(a->level, "y = 7");
  fg_field_destroy(field);
  p = scattered(3, MOST); /* and points that fill a volume one in 3D */
  assert_int_equal(create(&field, *state, &p), FG_STATUS_OK);
  assert_int_equal(fg_field_contents(field)->dimension, 3);
  fg_field_destroy(field);
}

typedef enum fault {
  FEW,
  NONE,
  ON_LINE,
  NO_NUMBER,
  DOUBLED,
  CODE,
  STILL,
  FLAT_WORLD,
  NO_COMPONENT,
  FAULTS
} fault;

static void spoil(points *p, fault which)
{
  for (size_t i = 0; i < 40; ++i) {
    if (which == ON_LINE)
      p->at[1][i] = 2.0 * p->at[0][i];
    if (which == DOUBLED)
      p->at[0][i] = p->at[1][i] = (double)(i % 20);
    if (which == STILL)
      p->of[0][i] = p->of[1][i] = 0.0f;
  }
  if (which == NO_NUMBER)
    p->at[1][17] = (double)NAN;
  if (which == CODE)
    p->of[0][9] = p->of[1][9] = -9999.0f;
  if (which == FEW)
    p->arrays.size[0] = 2;
  if (which == NONE)
    p->arrays.size[0] = -1;
  if (which == FLAT_WORLD) {
    p->arrays.scale = FG_SCALE_GEO;
    p->at[1][3] = 91.0;
  }
}

static void what_gives_no_field_is_refused(void **state)
{
  static const struct {
    fg_status status;
    const char *words;
  } expected[FAULTS] = {
      [FEW] = {FG_STATUS_ARGUMENT, "2 points with a place"},
      [NONE] = {FG_STATUS_ARGUMENT, "-1 points"},
      [ON_LINE] = {FG_STATUS_UNSUPPORTED, "40 points lie on one line"},
      [NO_NUMBER] = {FG_STATUS_ARGUMENT, "point 17: the point's coordinate 2 is nan"},
      [DOUBLED] = {FG_STATUS_ARGUMENT, "20 of 40 points lie where another does"},
      [CODE] = {FG_STATUS_ARGUMENT, "point 9: both components are -9999"},
      [STILL] = {FG_STATUS_ARGUMENT, "zero everywhere"},
      [FLAT_WORLD] = {FG_STATUS_ARGUMENT, "is no place on the globe"},
      [NO_COMPONENT] = {FG_STATUS_ARGUMENT, "no coordinate or component along y"},
  };
  for (int f = 0; f < FAULTS; ++f) {
    points p = scattered(2, 40);
    fg_field *field = NULL;
    spoil(&p, (fault)f);
    fg_status status = create(&field, *state, &p);
    if (f == NO_COMPONENT) {
      fg_field_destroy(field);
      p.arrays.velocity[1] = NULL;
      status = fg_field_create_scattered(&field, *state, &p.arrays);
    }
    if (status != expected[f].status ||
        !strstr(fg_context_message(*state), expected[f].words))
      fail_msg("%d: %d, \"%s\"", f, (int)status, fg_context_message(*state));
    assert_null(field);
    fg_context_clear(*state);
  }
  assert_int_equal(fg_field_create_scattered(NULL, *state, NULL), FG_STATUS_ARGUMENT);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_linear_field_comes_back_between_its_points),
      cmocka_unit_test(holes_stay_holes),
      cmocka_unit_test(points_of_a_grid_are_its_samples),
      cmocka_unit_test(longitudes_go_on_beyond_the_antimeridian),
      cmocka_unit_test(a_plane_in_space_is_a_field_in_2d),
      cmocka_unit_test(what_gives_no_field_is_refused),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
