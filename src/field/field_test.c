#include <math.h>

#include "field/made_test.h"

enum { NX = 5, NY = 4, COUNT = NX * NY };

static const double PI = 3.14159265358979323846;

typedef struct sample_set {
  fg_context *context;
  double x[NX], y[NY];
  float u[COUNT], v[COUNT];
  unsigned char valid[COUNT];
  fg_field_arrays arrays;
} sample_set;

/* Bilinear functions, so that bilinear interpolation must give them back. */
static double u_at(double x, double y)
{
  return 0.25 + 1.5 * x - 0.75 * y + 0.5 * x * y;
}

static double v_at(double x, double y)
{
  return -2.0 + 0.125 * x + 3.0 * y - 0.25 * x * y;
}

static void sample(sample_set *set)
{
  for (int j = 0; j < NY; ++j)
    for (int i = 0; i < NX; ++i) {
      set->u[j * NX + i] = (float)u_at(set->x[i], set->y[j]);
      set->v[j * NX + i] = (float)v_at(set->x[i], set->y[j]);
    }
}

static int set_up(void **state)
{
  static sample_set set;
  memset(&set, 0, sizeof set);
  const double x[NX] = {-1.5, -1.25, 0.5, 3.0, 3.25}; /* powers of two: exact in float */
  const double y[NY] = {2.0, 2.5, 4.5, 4.75};
  memcpy(set.x, x, sizeof x);
  memcpy(set.y, y, sizeof y);
  memset(set.valid, 1, sizeof set.valid);
  sample(&set);
  set.arrays = (fg_field_arrays){.dimension = 2,
                                 .size = {NX, NY, 1},
                                 .axis = {set.x, set.y, NULL},
                                 .velocity = {set.u, set.v, NULL},
                                 .valid = set.valid};
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

static void assert_refused(const sample_set *set, const char *part_of_message)
{
  assert_field_refused(set->context, &set->arrays, FG_STATUS_ARGUMENT, part_of_message);
}

static void bilinear_functions_come_back(void **state)
{
  sample_set *set = *state;
  fg_field *field = make(set);
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      const double at[2] = {-1.5 + 4.75 * i / 40.0, 2.0 + 2.75 * j / 40.0};
      double velocity[2];
      assert_true(fg_field_velocity(field, at, velocity));
      assert_true(fabs(velocity[0] - u_at(at[0], at[1])) < 1e-12);
      assert_true(fabs(velocity[1] - v_at(at[0], at[1])) < 1e-12);
    }
  fg_field_destroy(field);
}

static void samples_come_back_bit_for_bit(void **state)
{
  sample_set *set = *state;
  for (int i = 0; i < COUNT; ++i) {
    set->u[i] = 0.1f * (float)(i * i) - 7.3f;
    set->v[i] = 1e-3f / (float)(i + 1);
  }
  fg_field *field = make(set);
  for (int i = 0; i < COUNT; ++i) {
    const double at[2] = {set->x[i % NX], set->y[i / NX]};
    double velocity[2];
    assert_true(fg_field_velocity(field, at, velocity));
    assert_true((float)velocity[0] == set->u[i] && (float)velocity[1] == set->v[i]);
  }
  fg_field_destroy(field);
}

static void nothing_lies_beyond_the_boundary(void **state)
{
  fg_field *field = make(*state);
  const double beyond[][2] = {{-1.5000001, 3.0}, {3.2500001, 3.0},   {0.0, 1.9999},
                              {0.0, 4.7500001},  {(double)NAN, 3.0}, {0.0, (double)NAN},
                              {HUGE_VAL, 3.0},   {0.0, -HUGE_VAL},   {1e300, 3.0}};
  for (size_t i = 0; i < sizeof beyond / sizeof *beyond; ++i) {
    double velocity[2];
    assert_false(fg_field_velocity(field, beyond[i], velocity));
    assert_false(fg_field_tangent(field, beyond[i], velocity));
  }
  fg_field_destroy(field);
}

/* The missing sample (2, 1) spoils its four cells and no other. */
static void a_missing_corner_spoils_its_cells(void **state)
{
  sample_set *set = *state;
  for (int how = 0; how < 3; ++how) {
    memset(set->valid, 1, sizeof set->valid);
    sample(set);
    if (how == 0)
      set->valid[1 * NX + 2] = 0;
    else if (how == 1)
      set->u[1 * NX + 2] = NAN;
    else
      set->v[1 * NX + 2] = NAN;
    fg_field *field = make(set);
    assert_int_equal(fg_field_contents(field)->valid[1 * NX + 2], 0);
    for (int j = 0; j < NY - 1; ++j)
      for (int i = 0; i < NX - 1; ++i) {
        const double at[2] = {0.5 * (set->x[i] + set->x[i + 1]),
                              0.5 * (set->y[j] + set->y[j + 1])};
        double velocity[2] = {0.0, 0.0};
        const bool spoilt = (i == 1 || i == 2) && (j == 0 || j == 1);
        assert_int_equal(fg_field_velocity(field, at, velocity), !spoilt);
        assert_true(isfinite(velocity[0]) && isfinite(velocity[1]));
      }
    fg_field_destroy(field);
  }
}

/* Values under the mask may be anything. */
static void masked_values_do_not_matter(void **state)
{
  sample_set *set = *state;
  set->valid[0] = 0;
  set->u[0] = INFINITY;
  set->v[0] = 3e38f;
  fg_field *field = make(set);
  assert_true(isnan(fg_field_contents(field)->velocity[0][0]));
  fg_field_destroy(field);
}

static void a_periodic_axis_has_one_more_cell(void **state)
{
  sample_set *set = *state;
  set->arrays.period[0] = 6.0; /* the last cell lies between 3.25 and 4.5 */
  for (int j = 0; j < NY; ++j) {
    set->u[j * NX + 4] = 10.0f;
    set->u[j * NX + 0] = 20.0f;
  }
  fg_field *field = make(set);
  for (int turn = -3; turn <= 3; ++turn) {
    const double at[2] = {3.25 + 0.3 * 1.25 + 6.0 * turn, 3.1};
    double velocity[2];
    assert_true(fg_field_velocity(field, at, velocity));
    assert_true(fabs(velocity[0] - 13.0) < 1e-9);
  }
  double near[2];
  double far[2];
  assert_true(fg_field_velocity(field, (double[]){-1.0, 3.0}, near));
  assert_true(fg_field_velocity(field, (double[]){-1.0 + 6.0 * 1048576.0, 3.0}, far));
  assert_true(near[0] == far[0] && near[1] == far[1]);
  assert_true(fg_field_velocity(field, (double[]){4.5, 3.0}, near));
  assert_true(fabs(near[0] - 20.0) < 1e-12);
  assert_true(fg_field_velocity(field, (double[]){nextafter(-1.5, -9.0), 3.0}, near));
  assert_true(fabs(near[0] - 20.0) < 1e-9);
  assert_true(fg_field_velocity(field, (double[]){-1e300, 3.0}, near));
  assert_true(isfinite(near[0]));
  assert_false(fg_field_velocity(field, (double[]){HUGE_VAL, 3.0}, near));
  fg_field_destroy(field);
}

/* Uneven and nearly even axes take different ways to the cell: both must agree with the
 * samples' order. x itself is the field, so that a wrong cell shows. */
static void lookups_find_the_cell_on_any_axis(void **state)
{
  sample_set *set = *state;
  enum { LONG = 400 };
  static double x[LONG];
  static float u[LONG * 2];
  static float v[LONG * 2];
  const double y[2] = {-0.5, 0.25};
  for (int kind = 0; kind < 3; ++kind) {
    for (int i = 0; i < LONG; ++i) {
      if (kind == 0)
        x[i] = (double)(float)(0.1 * i); /* rounded like a file's float axis */
      else if (kind == 1)
        x[i] = i + 0.24 * sin(2.0 * i); /* as uneven as the even way allows */
      else
        x[i] = exp(0.02 * i);
      u[i] = u[LONG + i] = (float)i;
      v[i] = v[LONG + i] = 1.0f;
    }
    fg_field_arrays arrays = {.dimension = 2,
                              .size = {LONG, 2, 1},
                              .axis = {x, y, NULL},
                              .velocity = {u, v, NULL}};
    fg_field *field = NULL;
    assert_int_equal(fg_field_create(&field, set->context, &arrays), FG_STATUS_OK);
    for (int i = 0; i < LONG - 1; ++i)
      for (int part = 0; part < 4; ++part) {
        const double at[2] = {x[i] + 0.25 * part * (x[i + 1] - x[i]), 0.0};
        double velocity[2];
        assert_true(fg_field_velocity(field, at, velocity));
        assert_true(fabs(velocity[0] - (i + 0.25 * part)) < 1e-9);
      }
    fg_field_destroy(field);
  }
}

/* On the sphere a tangent must point along the motion: a solid rotation about an axis
 * through the equator at longitude 0 moves a point on a circle round that axis, whose
 * longitude and latitude follow from three-dimensional geometry alone. */
static void tangents_on_the_sphere_follow_the_motion(void **state)
{
  sample_set *set = *state;
  enum { LON = 361, LAT = 171 };
  static double lon[LON];
  static double lat[LAT];
  static float u[LON * LAT];
  static float v[LON * LAT];
  for (int i = 0; i < LON; ++i)
    lon[i] = -60.0 + 120.0 * i / (LON - 1);
  for (int j = 0; j < LAT; ++j)
    lat[j] = -85.0 + j;
  for (int j = 0; j < LAT; ++j)
    for (int i = 0; i < LON; ++i) {
      /* (0, -z, y): east and north parts of the rotation about the x axis */
      const double l = lon[i] * PI / 180.0;
      const double b = lat[j] * PI / 180.0;
      const double motion[3] = {0.0, -sin(b), cos(b) * sin(l)};
      u[j * LON + i] = (float)(motion[1] * cos(l));
      v[j * LON + i] = (float)(-motion[1] * sin(b) * sin(l) + motion[2] * cos(b));
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {LON, LAT, 1},
                            .axis = {lon, lat, NULL},
                            .velocity = {u, v, NULL},
                            .scale = FG_SCALE_GEO};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, set->context, &arrays), FG_STATUS_OK);
  for (int k = 0; k < 40; ++k) {
    const double radius = 0.9; /* sine of the circle's angular radius, 64 degrees */
    const double phase = 0.03 + 2.0 * PI * k / 40.0;
    const double p[3] = {sqrt(1.0 - radius * radius), radius * cos(phase),
                         radius * sin(phase)};
    const double q[3] = {p[0], radius * cos(phase + 1e-6), radius * sin(phase + 1e-6)};
    const double at[2] = {atan2(p[1], p[0]) * 180.0 / PI, asin(p[2]) * 180.0 / PI};
    if (fabs(at[0]) > 59.0)
      continue;
    const double step[2] = {atan2(q[1], q[0]) * 180.0 / PI - at[0],
                            asin(q[2]) * 180.0 / PI - at[1]};
    double tangent[2];
    assert_true(fg_field_tangent(field, at, tangent));
    const double cross = step[0] * tangent[1] - step[1] * tangent[0];
    const double dot = step[0] * tangent[0] + step[1] * tangent[1];
    assert_true(fabs(atan2(cross, dot)) < 2e-3); /* interpolation on the 1 degree grid */
  }
  fg_field_destroy(field);
}

static void tangents_stay_finite_at_the_poles(void **state)
{
  sample_set *set = *state;
  const double y[NY] = {-90.0, -89.0, 10.0, 90.00001};
  memcpy(set->y, y, sizeof y);
  set->arrays.scale = FG_SCALE_GEO;
  fg_field *field = make(set);
  const double latitude[] = {-90.0, -89.999999, 90.0, 90.00001, 89.99};
  for (size_t i = 0; i < sizeof latitude / sizeof *latitude; ++i) {
    double tangent[2];
    assert_true(fg_field_tangent(field, (double[]){1.0, latitude[i]}, tangent));
    assert_true(isfinite(tangent[0]) && isfinite(tangent[1]));
    assert_true(fabs(tangent[0]) > 0.0);
  }
  fg_field_destroy(field);
  set->y[3] = 91.0;
  assert_refused(set, "beyond the poles");
}

/* Off the sphere a tangent is the velocity. */
static void tangents_on_a_plane_are_velocities(void **state)
{
  sample_set *set = *state;
  set->arrays.scale = FG_SCALE_MAP;
  fg_field *field = make(set);
  double velocity[2];
  double tangent[2];
  assert_true(fg_field_velocity(field, (double[]){1.1, 4.6}, velocity));
  assert_true(fg_field_tangent(field, (double[]){1.1, 4.6}, tangent));
  assert_true(velocity[0] == tangent[0] && velocity[1] == tangent[1]);
  fg_field_destroy(field);
}

static void words_are_copied(void **state)
{
  sample_set *set = *state;
  char title[] = "10 m wind";
  set->arrays.title = title;
  set->arrays.velocity_units = "m/s";
  set->arrays.axis_name[0] = "longitude";
  set->arrays.axis_units[1] = "km";
  set->arrays.velocity_name[1] = "v10";
  set->arrays.time = "2014-01-31";
  fg_field *field = make(set);
  title[0] = '!';
  const fg_field_arrays *own = fg_field_contents(field);
  assert_string_equal(own->title, "10 m wind");
  assert_string_equal(own->velocity_units, "m/s");
  assert_string_equal(own->axis_name[0], "longitude");
  assert_string_equal(own->axis_name[1], "y");
  assert_string_equal(own->axis_units[0], "");
  assert_string_equal(own->axis_units[1], "km");
  assert_string_equal(own->velocity_name[0], "u");
  assert_string_equal(own->velocity_name[1], "v10");
  assert_string_equal(own->time, "2014-01-31");
  assert_null(own->level);
  assert_int_equal(own->scale, FG_SCALE_PLAIN);
  assert_null(own->valid);
  assert_memory_equal(own->velocity[0], set->u, sizeof set->u);
  assert_memory_equal(own->axis[0], set->x, sizeof set->x);
  fg_field_destroy(field);
}

static void bad_axes_are_refused(void **state)
{
  sample_set *set = *state;
  set->x[2] = set->x[1];
  assert_refused(set, "does not ascend");
  set->x[2] = -7.0;
  assert_refused(set, "does not ascend");
  set->x[2] = (double)NAN;
  assert_refused(set, "not a usable number");
  set->x[2] = 0.5;
  set->y[3] = 9.9e36;
  assert_refused(set, "9.9e+36");
  set->y[3] = 4.75;
  set->arrays.period[0] =
      4.75; /* exactly the extent: the last sample repeats the first */
  assert_refused(set, "period");
  set->arrays.period[0] = -6.0;
  assert_refused(set, "period");
  set->arrays.period[0] = (double)NAN;
  assert_refused(set, "period");
  set->arrays.period[0] = 0.0;
  set->arrays.axis[1] = NULL;
  assert_refused(set, "y axis is missing");
}

static void bad_sizes_are_refused(void **state)
{
  sample_set *set = *state;
  set->arrays.size[1] = 1;
  assert_refused(set, "5 x 1");
  set->arrays.size[1] = -4;
  assert_refused(set, "5 x -4");
  set->arrays.size[1] = INT32_MAX;
  assert_refused(set, "2147483647");
  set->arrays.size[1] = NY;
  set->arrays.dimension = 4;
  assert_refused(set, "4 dimensions");
  set->arrays.dimension = 3;
  assert_refused(set, "5 x 4 x 1 samples");
}

static void infinite_values_are_missing(void **state)
{
  sample_set *set = *state;
  fg_field *field = make(set);
  assert_int_equal(fg_field_infinite(field), 0);
  fg_field_destroy(field);
  set->u[7] = INFINITY;
  set->v[7] = 1e30f; /* the same sample */
  set->v[19] = -INFINITY;
  set->u[3] = NAN;
  field = make(set);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(fg_field_infinite(field), 2);
  for (int i = 0; i < COUNT; ++i)
    assert_int_equal(a->valid[i], i != 7 && i != 19 && i != 3);
  assert_true(isnan(a->velocity[1][7]) && isnan(a->velocity[0][19]));
  fg_field_destroy(field);
  set->v[5] = 2e15f;
  assert_refused(set, "v is 2e+15 at sample (0, 1)");
}

static void bad_values_are_refused(void **state)
{
  sample_set *set = *state;
  set->u[7] = 9.96921e36f;
  assert_refused(set, "u is 9.96921e+36 at sample (2, 1)");
  set->u[7] = -1e34f;
  assert_refused(set, "-1e+34");
  set->u[7] = -999.0f; /* one component may be that */
  fg_field_destroy(make(set));
  set->v[7] = -999.0f;
  assert_refused(set, "every component is -999 at sample (2, 1)");
  set->valid[7] = 0;
  fg_field_destroy(make(set));
  set->valid[7] = 1;
  memset(set->u, 0, sizeof set->u);
  memset(set->v, 0, sizeof set->v);
  assert_refused(set, "zero everywhere");
  set->v[7] = 1e-30f; /* small is not zero */
  fg_field_destroy(make(set));
  memset(set->valid, 0, sizeof set->valid);
  assert_refused(set, "all 20 samples are missing");
  for (int i = 0; i < COUNT; ++i)
    set->valid[i] = (i % NX + i / NX) % 2 == 0; /* a chessboard has no whole cell */
  assert_refused(set, "none of its 12 cells");
}

/* What moves must lie in a cell, not at a lone sample. */
static void motion_outside_the_cells_does_not_count(void **state)
{
  sample_set *set = *state;
  memset(set->u, 0, sizeof set->u);
  memset(set->v, 0, sizeof set->v);
  set->u[0] = 3.0f;
  set->valid[1] = 0;
  assert_refused(set, "zero everywhere");
}

static void no_arrays_make_no_field(void **state)
{
  fg_field *field = *state;
  assert_int_equal(fg_field_create(&field, NULL, NULL), FG_STATUS_ARGUMENT);
  assert_null(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      CASE(bilinear_functions_come_back),
      CASE(samples_come_back_bit_for_bit),
      CASE(nothing_lies_beyond_the_boundary),
      CASE(a_missing_corner_spoils_its_cells),
      CASE(masked_values_do_not_matter),
      CASE(a_periodic_axis_has_one_more_cell),
      CASE(lookups_find_the_cell_on_any_axis),
      CASE(tangents_on_the_sphere_follow_the_motion),
      CASE(tangents_stay_finite_at_the_poles),
      CASE(tangents_on_a_plane_are_velocities),
      CASE(words_are_copied),
      CASE(bad_axes_are_refused),
      CASE(bad_sizes_are_refused),
      CASE(infinite_values_are_missing),
      CASE(bad_values_are_refused),
      CASE(motion_outside_the_cells_does_not_count),
      CASE(no_arrays_make_no_field),
  };
  return cmocka_run_group_tests_name("field/field", tests, NULL, NULL);
}
