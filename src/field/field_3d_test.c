#include <math.h>

#include "field/made_test.h"

enum { NX = 5, NY = 4, NZ = 3, COUNT = NX * NY * NZ };

typedef struct sample_set {
  fg_context *context;
  double axis[3][NX];
  float velocity[3][COUNT];
  unsigned char valid[COUNT];
  fg_field_arrays arrays;
} sample_set;

static const int SIZE[3] = {NX, NY, NZ};

/* Trilinear, so that trilinear interpolation must give it back. */
static double component_at(int c, const double x[3])
{
  const double a[3][8] = {{0.25, 1.5, -0.75, 2.0, 0.5, -0.25, 1.25, 0.125},
                          {-2.0, 0.125, 3.0, -0.5, -0.25, 0.75, 0.5, -0.375},
                          {1.0, -0.5, 0.25, -1.5, 0.375, 0.5, -0.125, 0.25}};
  return a[c][0] + a[c][1] * x[0] + a[c][2] * x[1] + a[c][3] * x[2] +
         a[c][4] * x[0] * x[1] + a[c][5] * x[0] * x[2] + a[c][6] * x[1] * x[2] +
         a[c][7] * x[0] * x[1] * x[2];
}

static int sample_index(int i, int j, int k)
{
  return (k * NY + j) * NX + i;
}

static int set_up(void **state)
{
  static sample_set set;
  memset(&set, 0, sizeof set);
  const double axis[3][NX] = {/* powers of two: exact in float */
                              {-1.5, -1.25, 0.5, 3.0, 3.25},
                              {2.0, 2.5, 4.5, 4.75},
                              {-4.0, -1.0, -0.5}};
  memcpy(set.axis, axis, sizeof axis);
  memset(set.valid, 1, sizeof set.valid);
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c) {
      const double at[3] = {axis[0][n % NX], axis[1][n / NX % NY], axis[2][n / NX / NY]};
      set.velocity[c][n] = (float)component_at(c, at);
    }
  set.arrays = (fg_field_arrays){.dimension = 3, .valid = set.valid};
  for (int k = 0; k < 3; ++k) {
    set.arrays.size[k] = SIZE[k];
    set.arrays.axis[k] = set.axis[k];
    set.arrays.velocity[k] = set.velocity[k];
  }
  *state = &set;
  return fg_context_create(&set.context) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  fg_context_destroy(((sample_set *)*state)->context);
  return 0;
}

static fg_field *make(const sample_set *set)
{
  return field_made(set->context, &set->arrays);
}

static void trilinear_functions_come_back(void **state)
{
  sample_set *set = *state;
  fg_field *field = make(set);
  for (int k = 0; k <= 14; ++k)
    for (int j = 0; j <= 15; ++j)
      for (int i = 0; i <= 16; ++i) {
        const double at[3] = {-1.5 + 4.75 * i / 16.0, 2.0 + 2.75 * j / 15.0,
                              -4.0 + 3.5 * k / 14.0};
        double velocity[3], tangent[3];
        assert_true(fg_field_velocity(field, at, velocity));
        assert_true(fg_field_tangent(field, at, tangent));
        for (int c = 0; c < 3; ++c) {
          assert_true(fabs(velocity[c] - component_at(c, at)) < 1e-12);
          assert_true(tangent[c] == velocity[c]);
        }
      }
  fg_field_destroy(field);
}

static void nothing_lies_beyond_the_boundary(void **state)
{
  fg_field *field = make(*state);
  const double inside[3] = {0.75, 3.0, -2.0};
  const double low[3] = {-1.5, 2.0, -4.0}, high[3] = {3.25, 4.75, -0.5};
  for (int k = 0; k < 3; ++k) {
    const double outside[] = {low[k] - 1e-6, high[k] + 1e-6, (double)NAN, HUGE_VAL,
                              -HUGE_VAL};
    double at[3], velocity[3];
    for (size_t n = 0; n < sizeof outside / sizeof *outside; ++n) {
      memcpy(at, inside, sizeof at);
      at[k] = outside[n];
      assert_false(fg_field_velocity(field, at, velocity));
    }
    at[k] = low[k];
    assert_true(fg_field_velocity(field, at, velocity));
    at[k] = high[k];
    assert_true(fg_field_velocity(field, at, velocity));
  }
  fg_field_destroy(field);
}

/* A missing sample in the middle spoils its eight cells and no other, by whichever
 * component, or by the mask. */
static void a_missing_corner_spoils_its_cells(void **state)
{
  sample_set *set = *state;
  const int missing = sample_index(2, 1, 1);
  for (int how = 0; how < 4; ++how) {
    float saved = 0.0f;
    if (how < 3) {
      saved = set->velocity[how][missing];
      set->velocity[how][missing] = NAN;
    } else {
      set->valid[missing] = 0;
    }
    fg_field *field = make(set);
    int spoilt = 0;
    for (int k = 0; k < NZ - 1; ++k)
      for (int j = 0; j < NY - 1; ++j)
        for (int i = 0; i < NX - 1; ++i) {
          const int cell[3] = {i, j, k};
          double at[3], velocity[3];
          for (int d = 0; d < 3; ++d)
            at[d] = 0.75 * set->axis[d][cell[d]] + 0.25 * set->axis[d][cell[d] + 1];
          bool beside = (i == 1 || i == 2) && j <= 1;
          spoilt += beside;
          assert_true(fg_field_velocity(field, at, velocity) == !beside);
        }
    assert_int_equal(spoilt, 8);
    const fg_field_arrays *own = fg_field_contents(field);
    assert_int_equal(own->valid[missing], 0);
    for (int c = 0; c < 3; ++c)
      assert_true(isnan(own->velocity[c][missing]));
    fg_field_destroy(field);
    if (how < 3)
      set->velocity[how][missing] = saved;
  }
}

/* Between the last sample and the first, one period on. */
static void a_periodic_axis_has_one_more_cell(void **state)
{
  sample_set *set = *state;
  const double period[3] = {6.0, 4.0, 5.0};
  for (int d = 0; d < 3; ++d) {
    memset(set->arrays.period, 0, sizeof set->arrays.period);
    set->arrays.period[d] = period[d];
    fg_field *field = make(set);
    double last[3], first[3], between[3], at[3] = {0.5, 2.5, -1.0};
    at[d] = set->axis[d][SIZE[d] - 1];
    assert_true(fg_field_velocity(field, at, last));
    at[d] = set->axis[d][0] + 3.0 * period[d];
    assert_true(fg_field_velocity(field, at, first));
    at[d] = 0.5 * (set->axis[d][SIZE[d] - 1] + set->axis[d][0] + period[d]);
    assert_true(fg_field_velocity(field, at, between));
    for (int c = 0; c < 3; ++c)
      assert_true(fabs(between[c] - 0.5 * (last[c] + first[c])) < 1e-12);
    fg_field_destroy(field);
  }
}

static void contents_are_complete(void **state)
{
  sample_set *set = *state;
  set->arrays.velocity_name[2] = "omega";
  set->arrays.axis_units[2] = "m";
  fg_field *field = make(set);
  const fg_field_arrays *own = fg_field_contents(field);
  assert_int_equal(own->dimension, 3);
  assert_null(own->valid);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(own->size[k], SIZE[k]);
    assert_memory_equal(own->axis[k], set->axis[k], (size_t)SIZE[k] * sizeof(double));
    assert_memory_equal(own->velocity[k], set->velocity[k], sizeof set->velocity[k]);
  }
  assert_string_equal(own->velocity_name[2], "omega");
  assert_string_equal(own->axis_name[2], "z");
  assert_string_equal(own->axis_units[2], "m");
  fg_field_destroy(field);
}

static void impossible_volumes_are_refused(void **state)
{
  sample_set *set = *state;
  set->axis[2][2] = set->axis[2][1];
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT,
                       "the z axis does not ascend");
  set->axis[2][2] = -0.5;
  set->arrays.velocity[2] = NULL;
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT,
                       "component 2 is missing");
  set->arrays.velocity[2] = set->velocity[2];
  set->arrays.size[2] = 1;
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT, "5 x 4 x 1");
  for (int k = 0; k < 3; ++k)
    set->arrays.size[k] = INT32_MAX - 1;
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT,
                       "than memory can address");
  for (int k = 0; k < 3; ++k)
    set->arrays.size[k] = SIZE[k];
  set->velocity[2][sample_index(3, 2, 1)] = -3e15f;
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT,
                       "w is -3e+15 at sample (3, 2, 1)");
  set->velocity[2][sample_index(3, 2, 1)] = 0.0f;
  set->arrays.scale = FG_SCALE_GEO;
  assert_field_refused(set->context, &set->arrays, FG_STATUS_UNSUPPORTED,
                       "longitude, latitude and height");
}

/* Motion along z alone is motion. */
static void one_component_moves_enough(void **state)
{
  sample_set *set = *state;
  for (int c = 0; c < 3; ++c)
    memset(set->velocity[c], 0, sizeof set->velocity[c]);
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT,
                       "zero everywhere (24 cells)");
  set->velocity[2][7] = 1e-30f;
  fg_field_destroy(make(set));
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(trilinear_functions_come_back),
      CASE(nothing_lies_beyond_the_boundary),
      CASE(a_missing_corner_spoils_its_cells),
      CASE(a_periodic_axis_has_one_more_cell),
      CASE(contents_are_complete),
      CASE(impossible_volumes_are_refused),
      CASE(one_component_moves_enough),
  };
  return cmocka_run_group_tests_name("field/field_3d", tests, NULL, NULL);
}
