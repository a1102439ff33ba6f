/* Fields laid on maps, and which map it is. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/memory.h"
#include "map/choose.h"
#include "map/map.h"
#include "map/project.h"

static const double DEGREE = 0.017453292519943295;

/* Turns round an axis through (30 E, 50 N), with unit speed on its equator. */
static void turn(double longitude, double latitude, double *u, double *v)
{
  const double axis[] = {30.0 * DEGREE, 50.0 * DEGREE};
  const double l = longitude * DEGREE - axis[0], p = latitude * DEGREE;
  *u = sin(axis[1]) * cos(p) - cos(axis[1]) * sin(p) * cos(l);
  *v = cos(axis[1]) * sin(l);
}

typedef struct grid {
  double west, east, south, north;
  int nx, ny;
  bool periodic, sea;
} grid;

/* Without values inland where it is of the sea: everywhere between 10 and 60 E here. */
static fg_field *make(const grid *g)
{
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {g->nx, g->ny},
                            .scale = FG_SCALE_GEO,
                            .axis_units = {"degrees_east", "degrees_north", ""},
                            .title = "rotation",
                            .time = "now"};
  const size_t n = (size_t)g->nx * (size_t)g->ny;
  double *x = calloc((size_t)g->nx, sizeof *x), *y = calloc((size_t)g->ny, sizeof *y);
  float *u = calloc(n, sizeof *u), *v = calloc(n, sizeof *v);
  assert_true(x && y && u && v);
  for (int i = 0; i < g->nx; ++i)
    x[i] = g->west + (g->east - g->west) * i / (g->periodic ? g->nx : g->nx - 1);
  for (int j = 0; j < g->ny; ++j)
    y[j] = g->south + (g->north - g->south) * j / (g->ny - 1);
  for (int j = 0; j < g->ny; ++j)
    for (int i = 0; i < g->nx; ++i) {
      const size_t at = (size_t)j * (size_t)g->nx + (size_t)i;
      double velocity[2];
      turn(x[i], y[j], &velocity[0], &velocity[1]);
      u[at] = (float)velocity[0];
      v[at] = (float)velocity[1];
      if (g->sea && fabs(y[j]) < 70.0 && i % 4 != 0)
        u[at] = NAN;
    }
  arrays.axis[0] = x;
  arrays.axis[1] = y;
  arrays.velocity[0] = u;
  arrays.velocity[1] = v;
  arrays.period[0] = g->periodic ? 360.0 : 0.0;
  fg_field *field;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  free(x);
  free(y);
  free(u);
  free(v);
  return field;
}

static const grid GLOBE = {0.0, 360.0, -90.0, 90.0, 180, 91, true, false};

static fg_field *project(const grid *g, const fg_map_options *options)
{
  fg_field *field = make(g), *out;
  assert_int_equal(fg_field_project(&out, NULL, field, options), FG_STATUS_OK);
  fg_field_destroy(field);
  return out;
}

/* Samples of the plane against the rotation itself, turned by differences of positions
 * along the streamline: independent of the Jacobian. Returns the share with values. */
static double compare(const fg_field *field, double most)
{
  const fg_field_arrays *a = fg_field_contents(field);
  fg__map *map;
  assert_int_equal(fg__map_create(&map, NULL, a->projection), FG_STATUS_OK);
  int values = 0;
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const size_t at = (size_t)j * (size_t)a->size[0] + (size_t)i;
      double longitude, latitude, u, v, x[2], y[2];
      fg__map_inverse(map, 1, &a->axis[0][i], &a->axis[1][j], &longitude, &latitude);
      if (isnan(a->velocity[0][at]))
        continue;
      ++values;
      assert_true(isfinite(longitude));
      if (fabs(latitude) > 89.0)
        continue;
      turn(longitude, latitude, &u, &v);
      const double speed = hypot(u, v), step = 1e-3;
      if (speed < 0.1)
        continue;
      const double along[] = {longitude - step * u / cos(latitude * DEGREE),
                              longitude + step * u / cos(latitude * DEGREE)};
      const double up[] = {latitude - step * v, latitude + step * v};
      fg__map_forward(map, 2, along, up, x, y);
      const double length = hypot(x[1] - x[0], y[1] - y[0]) / speed;
      if (!(fabs((double)a->velocity[0][at] - (x[1] - x[0]) / length) < most &&
            fabs((double)a->velocity[1][at] - (y[1] - y[0]) / length) < most))
        fail_msg("%s: at %g, %g: %g, %g for %g, %g", a->projection, longitude, latitude,
                 (double)a->velocity[0][at], (double)a->velocity[1][at],
                 (x[1] - x[0]) / length, (y[1] - y[0]) / length);
    }
  fg__map_destroy(map);
  return (double)values / a->size[0] / a->size[1];
}

static void rotations_stay_rotations(void **state)
{
  (void)state;
  static const struct {
    const char *projection;
    double share; /* of the rectangle that the globe fills */
  } maps[] = {{"auto", 0.881},    {"mollweide", 0.785},
              {"robin", 0.0},     {"mercator", 1.0},
              {"laea", 0.785},    {"+proj=eqearth +lon_0=200 +R=6371000", 0.881},
              {"lcc", 0.0},       {"polar", 0.785},
              {"EPSG:3035", 0.0}, {"EPSG:3857", 1.0}};
  for (size_t k = 0; k < sizeof maps / sizeof *maps; ++k) {
    const fg_map_options options = {
        .projection = maps[k].projection, .samples = 240, .threads = 1 + (int)k % 3};
    fg_field *field = project(&GLOBE, &options);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->scale, FG_SCALE_MAP);
    assert_string_equal(a->axis_units[0], "km");
    assert_string_equal(a->title, "rotation");
    assert_int_equal(a->size[0] > a->size[1] ? a->size[0] : a->size[1], 240);
    /* on ellipsoids by the difference of latitudes */
    const double share = compare(field, strstr(a->projection, "+R=") ? 2e-3 : 6e-3);
    assert_true(maps[k].share == 0.0 ? share > 0.2 : fabs(share - maps[k].share) < 0.02);
    fg_field_destroy(field);
  }
}

static void projecting_has_the_same_bits_on_threads_and_slabs(void **state)
{
  (void)state;
  fg_field *field = make(&GLOBE), *whole, *other;
  fg__sphere *sphere;
  fg_map_options options = {.samples = 101};
  assert_int_equal(fg_field_project(&whole, NULL, field, &options), FG_STATUS_OK);
  options.threads = 3;
  assert_int_equal(fg_field_project(&other, NULL, field, &options), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(whole), *b = fg_field_contents(other);
  const size_t row = (size_t)a->size[0], bytes = row * (size_t)a->size[1] * sizeof(float);
  assert_memory_equal(a->velocity[1], b->velocity[1], bytes);
  fg_field_destroy(other);
  assert_int_equal(fg__sphere_of_field(&sphere, NULL, field), FG_STATUS_OK);
  for (int slab = 0; slab < 3; ++slab) {
    int first, count;
    assert_int_equal(fg__sphere_project(&other, NULL, sphere, &options, slab, 3),
                     FG_STATUS_OK);
    assert_true(fg_field_is_slab(other, &first, &count));
    b = fg_field_contents(other);
    assert_memory_equal(a->velocity[0] + (size_t)first * row, b->velocity[0],
                        (size_t)count * row * sizeof(float));
    fg_field_destroy(other);
  }
  fg__sphere_destroy(sphere);
  fg_field_destroy(whole);
  fg_field_destroy(field);
}

/* Four samples of the data in each of the plane's: what alternates is gone, and its mean
 * stays. */
static void finer_data_are_averaged(void **state)
{
  (void)state;
  enum { NX = 721, NY = 361 };
  static float u[NX * NY], v[NX * NY];
  static double x[NX], y[NY];
  for (int i = 0; i < NX; ++i)
    x[i] = 0.05 * i;
  for (int j = 0; j < NY; ++j)
    y[j] = -9.0 + 0.05 * j;
  for (int n = 0; n < NX * NY; ++n)
    u[n] = (n % NX + n / NX) % 2 ? 3.0f : -1.0f;
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {NX, NY},
                                  .axis = {x, y},
                                  .velocity = {u, v},
                                  .scale = FG_SCALE_GEO};
  fg_field *field, *out;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  assert_int_equal(fg_field_project(&out, NULL, field, &(fg_map_options){.samples = 181}),
                   FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(out);
  for (int j = 2; j < a->size[1] - 2; ++j)
    for (int i = 2; i < a->size[0] - 2; ++i)
      assert_true(
          fabs((double)a->velocity[0][(size_t)j * (size_t)a->size[0] + (size_t)i] - 1.0) <
          0.3);
  fg_field_destroy(out);
  fg_field_destroy(field);
}

/* What "auto" says of what a field covers. */
static void auto_takes_a_map_by_what_is_covered(void **state)
{
  (void)state;
  static const struct {
    fg__map_area area;
    const char *string;
  } rules[] = {
      {{-180, 180, -90, 90, false}, "+proj=eqearth +lon_0=0"},
      {{0, 360, -80, 85, true}, "+proj=eqearth +lon_0=-160"},
      {{-180, 180, 20, 90, false}, "+proj=laea +lon_0=0 +lat_0=90"},
      {{-180, 180, -90, -40, false}, "+proj=laea +lon_0=0 +lat_0=-90"},
      {{0, 60, 55, 85, false}, "+proj=laea +lon_0=30 +lat_0=90"},
      {{100, 300, -30, 40, false}, "+proj=eqearth +lon_0=-160"},
      {{-20, 60, -50, 50, false}, "+proj=laea +lon_0=20 +lat_0=0"},
      {{90, 150, -20, 30, false}, "+proj=merc +lon_0=120 +lat_ts=5"},
      {{-80, 0, 20, 70, false}, "+proj=lcc +lon_0=-40 +lat_0=45 +lat_1=28 +lat_2=62"},
      {{5, 25, -42, -25, false},
       "+proj=lcc +lon_0=15 +lat_0=-33.5 +lat_1=-39.2 +lat_2=-27.8"},
      {{5, 12, 55, 75, false}, "+proj=tmerc +lon_0=8.5 +lat_0=65"},
  };
  for (size_t k = 0; k < sizeof rules / sizeof *rules; ++k) {
    char string[FG__MAP_STRING_BYTES], wanted[FG__MAP_STRING_BYTES];
    assert_int_equal(fg__map_choose(string, NULL, &(fg_map_options){0}, &rules[k].area),
                     FG_STATUS_OK);
    snprintf(wanted, sizeof wanted, "%s +R=6371000 +units=km", rules[k].string);
    assert_string_equal(string, wanted);
  }
  const fg__map_area europe = {-10, 30, 35, 70, false};
  static const struct {
    fg_map_options options;
    const char *string;
  } named[] = {
      {{.projection = "EPSG:3035"},
       "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80 +units=km"},
      {{.projection = "utm"}, "+proj=utm +zone=32 +ellps=WGS84 +units=km"},
      {{.projection = "ortho",
        .has_center = true,
        .has_center_latitude = true,
        .center = {20, 40}},
       "+proj=ortho +lon_0=20 +lat_0=40 +R=6371000 +units=km"},
      {{.projection = "+proj=merc +units=m +ellps=WGS84"},
       "+proj=merc +ellps=WGS84 +units=km"},
  };
  for (size_t k = 0; k < sizeof named / sizeof *named; ++k) {
    char string[FG__MAP_STRING_BYTES];
    assert_int_equal(fg__map_choose(string, NULL, &named[k].options, &europe),
                     FG_STATUS_OK);
    assert_string_equal(string, named[k].string);
  }
}

/* Whether a plane has samples up to its edge at the image of every place of a region, and
 * none of its edges is farther out. */
static void assert_encloses(const fg_field *field, const double region[4])
{
  enum { SIDE = 41 };
  const fg_field_arrays *a = fg_field_contents(field);
  const double least[2] = {a->axis[0][0], a->axis[1][0]};
  const double most[2] = {a->axis[0][a->size[0] - 1], a->axis[1][a->size[1] - 1]};
  const double slack = 1.01 * (a->axis[0][1] - a->axis[0][0]);
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  fg__map *map;
  assert_int_equal(fg__map_create(&map, NULL, a->projection), FG_STATUS_OK);
  for (int n = 0; n < SIDE * SIDE; ++n) {
    const double longitude =
        region[0] + (region[1] - region[0]) * (n % SIDE) / (SIDE - 1);
    const double latitude = region[2] + (region[3] - region[2]) * (n / SIDE) / (SIDE - 1);
    double at[2];
    fg__map_forward(map, 1, &longitude, &latitude, &at[0], &at[1]);
    for (int k = 0; k < 2; ++k) {
      low[k] = fmin(low[k], at[k]);
      high[k] = fmax(high[k], at[k]);
    }
  }
  for (int k = 0; k < 2; ++k) {
    assert_true(fabs(low[k] - least[k]) < slack);
    assert_true(fabs(high[k] - most[k]) < slack);
  }
  fg__map_destroy(map);
}

/* A rectangle round all of the region, or round. */
static void regions_are_rectangles_or_round(void **state)
{
  (void)state;
  const fg_map_options boxes[] = {
      {.region = {-80, 0, 20, 70}},
      {.region = {-80, 0, 20, 70}, .projection = "mercator"},
      {.region = {-260, -70, 0, 65}},
      {.region = {0, 60, 40, 80}, .projection = "cea"},
      {.region = {-80, 0, -60, 0}, .projection = "robinson"},
      {.region = {-60, 60, -50, 60}},
  };
  for (size_t n = 0; n < sizeof boxes / sizeof *boxes; ++n) {
    fg_map_options options = boxes[n];
    options.has_region = true;
    options.samples = 100;
    fg_field *box = project(&GLOBE, &options);
    assert_encloses(box, options.region);
    assert_true(compare(box, 4e-3) == 1.0);
    fg_field_destroy(box);
  }
  fg_field *field;
  const fg_field_arrays *a;
  field = project(&GLOBE, &(fg_map_options){.has_region = true,
                                            .region = {-180, 180, -90, -50},
                                            .samples = 100});
  a = fg_field_contents(field);
  assert_int_equal(a->size[0], a->size[1]);
  assert_true(fabs(compare(field, 2e-3) - 0.785) < 0.02);
  fg_field_destroy(field);
  /* across the antimeridian */
  field = project(&GLOBE, &(fg_map_options){.has_region = true,
                                            .region = {160, -150, 30, 60},
                                            .samples = 80});
  assert_non_null(strstr(fg_field_contents(field)->projection, "+lon_0=-175 "));
  assert_true(compare(field, 2e-3) == 1.0);
  fg_field_destroy(field);
}

/* A whole globe would be torn along lines of its own; a lobe is whole, and so is a
 * globe whose one cut is opposite the centre, wherever that is. */
static void interrupted_planes_are_for_regions(void **state)
{
  (void)state;
  static const char *const torn[] = {
      "+proj=igh",  "+proj=imoll", "+proj=healpix",
      "+proj=tcea", "tmerc",       "+proj=ob_tran +o_proj=moll +o_lat_p=45"};
  static const char *const whole[] = {
      "+proj=goode", "+proj=moll +lon_0=77",  "eqearth",    "+proj=hammer +lon_0=-120",
      "robinson",    "+proj=bonne +lat_1=40", "+proj=poly", "polar"};
  fg_field *field = make(&GLOBE), *out;
  fg_map_options options = {.samples = 40};
  for (size_t k = 0; k < sizeof torn / sizeof *torn; ++k) {
    options.projection = torn[k];
    assert_int_equal(fg_field_project(&out, NULL, field, &options), FG_STATUS_ARGUMENT);
  }
  for (size_t k = 0; k < sizeof whole / sizeof *whole; ++k) {
    options.projection = whole[k];
    if (fg_field_project(&out, NULL, field, &options) != FG_STATUS_OK)
      fail_msg("%s is refused", whole[k]);
    fg_field_destroy(out);
  }
  options = (fg_map_options){.projection = "+proj=igh",
                             .has_region = true,
                             .region = {10.0, 60.0, -40.0, 60.0},
                             .samples = 60};
  assert_int_equal(fg_field_project(&out, NULL, field, &options), FG_STATUS_OK);
  assert_true(compare(out, 3e-3) > 0.9);
  fg_field_destroy(out);
  fg_field_destroy(field);
}

/* From a plane to another one by way of the globe: vectors are the rotation's in the
 * second plane, too, whatever the axes of the first. */
static void planes_become_others(void **state)
{
  (void)state;
  static const grid europe = {-10.0, 30.0, 35.0, 70.0, 161, 141, false, false};
  static const char *const first[] = {
      "+proj=lcc +lat_1=30 +lat_2=60 +lat_0=40 +lon_0=60 +ellps=WGS84 +x_0=400000",
      "+proj=stere +lat_0=90 +lat_ts=60 +lon_0=-60 +R=6371000", "aeqd"};
  static const char *const second[] = {"laea", "mercator", "+proj=utm +zone=31"};
  for (size_t k = 0; k < sizeof first / sizeof *first; ++k)
    for (size_t n = 0; n < sizeof second / sizeof *second; ++n) {
      fg_field *plane =
          project(&europe, &(fg_map_options){.projection = first[k], .samples = 300});
      fg_field *other;
      assert_int_equal(
          fg_field_project(&other, NULL, plane,
                           &(fg_map_options){.projection = second[n], .samples = 120}),
          FG_STATUS_OK);
      assert_string_not_equal(fg_field_contents(other)->projection,
                              fg_field_contents(plane)->projection);
      assert_true(compare(other, 3e-3) > 0.3);
      fg_field_destroy(other);
      /* its own, unless another is asked for; a region is cut out of it */
      const fg_map_options part = {
          .has_region = true, .region = {0.0, 10.0, 45.0, 55.0}, .samples = 60};
      assert_int_equal(fg_field_project(&other, NULL, plane, &part), FG_STATUS_OK);
      fg__map *maps[2];
      for (int i = 0; i < 2; ++i)
        assert_int_equal(fg__map_create(&maps[i], NULL,
                                        fg_field_contents(i ? other : plane)->projection),
                         FG_STATUS_OK);
      double x[2], y[2];
      for (int i = 0; i < 2; ++i) {
        fg__map_forward(maps[i], 1, (double[]){7.0}, (double[]){50.0}, &x[i], &y[i]);
        fg__map_destroy(maps[i]);
      }
      assert_true(fabs(x[0] - x[1]) < 1e-6 && fabs(y[0] - y[1]) < 1e-6);
      assert_true(compare(other, 3e-3) == 1.0);
      fg_field_destroy(other);
      fg_field_destroy(plane);
    }
}

static void what_no_map_can_show_is_refused(void **state)
{
  (void)state;
  const grid europe = {-10.0, 30.0, 35.0, 70.0, 41, 36, false, false};
  static const struct {
    fg_map_options options;
    const char *words;
  } cases[] = {
      {{.projection = "nowhere"}, "nowhere"},
      {{.projection = "equal earth"}, "not a name"},
      {{.projection = "none"}, "a projection"},
      {{.projection = "EPSG:4326"}, "no plane"},
      {{.projection = "+proj=longlat"}, "no plane"},
      {{.projection = "EPSG:999999"}, "no projected system"},
      {{.projection = "EPSG:3e5"}, "a number"},
      {{.projection = "+proj=laea", .has_center = true}, "centre of its own"},
      {{.projection = "adams_hemi"}, "PROJ refuses"},
      {{.projection = "mollwiede"}, "is mollweide meant?"},
      {{.has_region = true, .region = {100, 120, 0, 20}}, "has no values"},
      {{.has_region = true, .region = {0, 10, 50, 50}}, "south below north"},
      {{.has_region = true, .region = {10, 10, 30, 50}}, "west apart from east"},
      {{.has_center = true, .center = {(double)NAN, 0}}, "centre"},
      {{.samples = 3}, "3 samples"},
      {{.projection = "+proj=igh +lon_0=60"}, "it is torn near longitude"},
  };
  fg_context *context;
  fg_field *field = make(&europe), *out;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    if (fg_field_project(&out, context, field, &cases[k].options) != FG_STATUS_ARGUMENT)
      fail_msg("not refused: %s", cases[k].words);
    assert_null(out);
    if (!strstr(fg_context_message(context), cases[k].words) &&
        !strstr(fg_context_hint(context), cases[k].words))
      fail_msg("%s", fg_context_message(context));
    fg_context_clear(context);
  }
  assert_int_equal(fg_field_create_analytic(&out, context, "vortex", 9), FG_STATUS_OK);
  fg_field *again;
  assert_int_equal(fg_field_project(&again, context, out, NULL), FG_STATUS_ARGUMENT);
  fg_context_clear(context);
  fg_context_set_input(context, &(fg_input_options){.most_memory = 1e6});
  assert_int_equal(fg_field_project(&again, context, field, NULL), FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(context), "1 MB may be used"));
  fg_field_destroy(out);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rotations_stay_rotations),
      cmocka_unit_test(projecting_has_the_same_bits_on_threads_and_slabs),
      cmocka_unit_test(finer_data_are_averaged),
      cmocka_unit_test(auto_takes_a_map_by_what_is_covered),
      cmocka_unit_test(regions_are_rectangles_or_round),
      cmocka_unit_test(planes_become_others),
      cmocka_unit_test(interrupted_planes_are_for_regions),
      cmocka_unit_test(what_no_map_can_show_is_refused),
  };
  return cmocka_run_group_tests_name("map/project", tests, NULL, NULL);
}
