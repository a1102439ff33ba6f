/* Projections: there and back, turned vectors, scales, outlines, and what is refused. */
#include <math.h>
#include <proj.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "map/map.h"

static const double DEGREE = 0.017453292519943295;

static fg__map *make(const char *projection)
{
  fg__map *map;
  assert_int_equal(fg__map_create(&map, NULL, projection), FG_STATUS_OK);
  return map;
}

static const char *const SOME[] = {
    "+proj=eqearth +lon_0=200 +R=6371000 +units=km",
    "+proj=laea +lat_0=90 +lon_0=-30 +R=6371000 +units=km",
    "+proj=laea +lat_0=-35 +lon_0=170 +ellps=GRS80",
    "+proj=lcc +lat_1=28 +lat_2=62 +lat_0=45 +lon_0=-40 +R=6371000 +units=km",
    "+proj=merc +lon_0=100 +ellps=WGS84",
    "+proj=utm +zone=33 +ellps=WGS84",
    "+proj=moll +R=6371000",
    "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=10 +ellps=WGS84",
};

static const double ELLIPTICITY[] = {0,          0,          0.00669438, 0,
                                     0.00669438, 0.00669438, 0,          0.00669438};

static void there_and_back(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof SOME / sizeof *SOME; ++k) {
    fg__map *map = make(SOME[k]);
    const double longitude[] = {fg__map_center(map) + 3.0, fg__map_center(map) - 2.5};
    const double latitude[] = {fg__map_center_latitude(map) * 0.9 + 4.0,
                               fg__map_center_latitude(map) * 0.8 - 6.0};
    double x[2], y[2], back[2][2];
    fg__map_forward(map, 2, longitude, latitude, x, y);
    fg__map_inverse(map, 2, x, y, back[0], back[1]);
    for (int i = 0; i < 2; ++i) {
      assert_true(fabs(back[0][i] - longitude[i]) < 1e-7);
      assert_true(fabs(back[1][i] - latitude[i]) < 1e-7);
    }
    fg__map_destroy(map);
  }
}

/* PROJ's own derivatives, which are per radian of longitude and latitude. */
static void vectors_turn_as_proj_says(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof SOME / sizeof *SOME; ++k) {
    fg__map *map = make(SOME[k]);
    PJ *own = proj_create(PJ_DEFAULT_CTX, SOME[k]);
    for (int n = 0; n < 20; ++n) {
      const double longitude = fg__map_center(map) - 4.0 + 0.37 * n;
      const double latitude = fg__map_center_latitude(map) * 0.8 - 5.0 + 0.61 * n;
      const double u = cos(0.7 * n), v = sin(0.7 * n);
      float turned[2] = {(float)u, (float)v};
      const PJ_COORD at = proj_coord(longitude * DEGREE, latitude * DEGREE, 0.0, 0.0);
      const PJ_FACTORS f = proj_factors(own, at);
      const double sine = sin(latitude * DEGREE), cosine = cos(latitude * DEGREE);
      const double e2 = ELLIPTICITY[k];
      const double ratio = (1.0 - e2 * sine * sine) / (1.0 - e2); /* N over M */
      const double x = f.dx_dlam / cosine * u + f.dx_dphi * ratio * v;
      const double y = f.dy_dlam / cosine * u + f.dy_dphi * ratio * v;
      fg__map_turn(map, 1, &longitude, &latitude, &turned[0], &turned[1]);
      assert_true(fabs((double)turned[0] - x / hypot(x, y)) < 2e-7);
      assert_true(fabs((double)turned[1] - y / hypot(x, y)) < 2e-7);
      assert_true(fabs(fg__map_area_scale(map, longitude, latitude) - f.areal_scale) <
                  1e-6 * f.areal_scale);
      assert_true(fabs(fg__map_length_scale(map, longitude, latitude) -
                       f.tissot_semimajor) < 1e-5);
    }
    proj_destroy(own);
    fg__map_destroy(map);
  }
}

/* Rows 300 km apart of places 40 km apart, which go over poles and beyond outlines. */
static void rows_turn_as_their_places_do(void **state)
{
  (void)state;
  enum { PLACES = 401 };
  for (size_t k = 0; k < sizeof SOME / sizeof *SOME; ++k) {
    fg__map *map = make(SOME[k]);
    double x[PLACES], y[PLACES], longitude[PLACES], latitude[PLACES], middle[2];
    float u[2][PLACES], v[2][PLACES];
    fg__map_forward(map, 1, (double[]){fg__map_center(map)},
                    (double[]){fg__map_center_latitude(map)}, &middle[0], &middle[1]);
    for (int row = -30; row <= 30; ++row) {
      for (int n = 0; n < PLACES; ++n) {
        x[n] = middle[0] + (n - 200) * 40e3 / fg__map_unit(map);
        y[n] = middle[1] + row * 300e3 / fg__map_unit(map);
        u[0][n] = u[1][n] = (float)cos(0.3 * n);
        v[0][n] = v[1][n] = (float)sin(0.3 * n);
      }
      fg__map_inverse(map, PLACES, x, y, longitude, latitude);
      fg__map_turn(map, PLACES, longitude, latitude, u[0], v[0]);
      fg__map_turn_row(map, PLACES, longitude, latitude, u[1], v[1]);
      for (int n = 0; n < PLACES; ++n) {
        assert_int_equal(isnan(u[0][n]), isnan(u[1][n]));
        assert_false(fabsf(u[0][n] - u[1][n]) > 1.5e-7f);
        assert_false(fabsf(v[0][n] - v[1][n]) > 1.5e-7f);
      }
    }
    fg__map_destroy(map);
  }
}

/* A wind over the pole keeps its direction from one side to the other, and one at the cut
 * is turned as one beside it. */
static void poles_and_the_cut_are_no_exceptions(void **state)
{
  (void)state;
  fg__map *polar = make("+proj=laea +lat_0=90 +R=6371000");
  const double longitude[] = {0.0, 180.0, 90.0}, latitude[] = {90.0, 89.0, 90.0};
  float east[] = {0.0f, 0.0f, 1.0f}, north[] = {1.0f, -1.0f, 0.0f};
  fg__map_turn(polar, 3, longitude, latitude, east, north);
  for (int i = 0; i < 3; ++i) {
    assert_true(fabs((double)east[i]) < 1e-4);
    assert_true(fabs((double)north[i] - 1.0) < 1e-6);
  }
  fg__map_destroy(polar);
  fg__map *world = make("+proj=eqearth +lon_0=30 +R=6371000");
  const double sides[] = {-150.0, 210.0}, height[] = {50.0, 50.0};
  float u[] = {0.0f, 0.0f}, v[] = {2.0f, 2.0f};
  fg__map_turn(world, 2, sides, height, u, v);
  assert_true(u[0] > 0.5f && u[1] < -0.5f && fabsf(u[0] + u[1]) < 1e-6f);
  assert_true(fabs(hypot((double)u[0], (double)v[0]) - 2.0) < 1e-6);
  fg__map_destroy(world);
}

static void outside_the_outline_is_nothing(void **state)
{
  (void)state;
  fg__map *map = make("+proj=eqearth +R=6371000 +units=km");
  double edge[2], top[2];
  fg__map_forward(map, 2, (double[]){180.0, 0.0}, (double[]){0.0, 90.0}, edge, top);
  const double x[] = {edge[0] * 0.9999, edge[0] * 1.0001, edge[0] * 0.99, 0.0, 0.0};
  const double y[] = {0.0, 0.0, top[1] * 0.9, top[1] * 1.001, top[1] * 0.999};
  const bool inside[] = {true, false, false, false, true};
  double longitude[5], latitude[5];
  fg__map_inverse(map, 5, x, y, longitude, latitude);
  for (int i = 0; i < 5; ++i) {
    assert_int_equal(isfinite(longitude[i]) && isfinite(latitude[i]), inside[i]);
    assert_true(!inside[i] || fabs(longitude[i]) <= 180.0);
  }
  fg__map_destroy(map);
}

static void a_line_may_go_on_past_the_cut(void **state)
{
  (void)state;
  fg__map *map = make("+proj=eqearth +lon_0=10 +R=6371000");
  double x[3], y[3];
  fg__map_forward(map, 3, (double[]){189.0, 190.0, 191.0}, (double[]){5.0, 5.0, 5.0}, x,
                  y);
  assert_true(fabs((x[2] - x[1]) - (x[1] - x[0])) < 1e-3 && x[2] > x[1]);
  fg__map_destroy(map);
}

static void maps_tell_what_they_are(void **state)
{
  (void)state;
  static const struct {
    const char *string;
    double unit, longitude, latitude;
    bool world;
    fg__map_kind kind;
  } maps[] = {
      {"+proj=eqearth +R=6371000 +units=km", 1000, 0, 0, true, FG__MAP_OTHER},
      {"+proj=merc +lon_0=30w +R=6371000", 1, -30, 0, false, FG__MAP_CYLINDRICAL},
      {"+proj=laea +lat_0=-90 +units=us-ft", 0.304801, 0, -90, false, FG__MAP_AZIMUTHAL},
      {"+proj=lcc +lat_1=30 +lat_0=40 +units=m", 1, 0, 40, false, FG__MAP_CONIC},
      {"+proj=utm +zone=1 +units=km", 1000, -177, 0, false, FG__MAP_OTHER},
      {"+proj=ob_tran +o_proj=longlat +o_lat_p=40 +lon_0=10 +R=6371000", 111195, 10, 0,
       false, FG__MAP_OTHER},
  };
  for (size_t k = 0; k < sizeof maps / sizeof *maps; ++k) {
    fg__map *map = make(maps[k].string);
    assert_true(fabs(fg__map_unit(map) - maps[k].unit) < 1e-6);
    assert_true(fabs(fg__map_center(map) - maps[k].longitude) < 1e-9);
    assert_true(fabs(fg__map_center_latitude(map) - maps[k].latitude) < 1e-9);
    assert_int_equal(fg__map_is_world(map), maps[k].world);
    assert_int_equal(fg__map_kind_of(map), maps[k].kind);
    fg__map_destroy(map);
  }
  fg__map *map = make(" proj=laea  +no_defs +lat_0=52 +nadgrids=@null +type=crs ");
  assert_string_equal(fg__map_projection(map), "+proj=laea +lat_0=52");
  fg__map_destroy(map);
}

static void what_is_no_map_is_refused(void **state)
{
  (void)state;
  static const char *const strings[] = {
      "",
      "eqearth",
      "+proj=nothing",
      "+proj=adams_hemi",
      "+proj=lcc +lat_1=91",
      "+proj=laea +proj=merc",
      "+proj=pipeline +step +proj=merc",
      "+proj=merc +nadgrids=/etc/passwd",
      "+proj=vgridshift +grids=/etc/passwd",
      "+init=epsg:3857 +proj=merc",
      "+proj=cart +ellps=GRS80",
      "+proj=unitconvert +xy_in=m +xy_out=km",
      "+proj=laea +R=-1",
      "+proj=laea +R=nan",
      "+proj=merc +lon_0=east",
  };
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (size_t k = 0; k < sizeof strings / sizeof *strings; ++k) {
    fg__map *map;
    assert_int_equal(fg__map_create(&map, context, strings[k]), FG_STATUS_ARGUMENT);
    assert_null(map);
    assert_non_null(strstr(fg_context_message(context), "projection"));
    fg_context_clear(context);
  }
  char *longer = calloc(5000, 1);
  memset(longer, 'a', 4999);
  fg__map *map;
  assert_int_equal(fg__map_create(&map, context, longer), FG_STATUS_ARGUMENT);
  free(longer);
  fg_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(there_and_back),
      cmocka_unit_test(vectors_turn_as_proj_says),
      cmocka_unit_test(rows_turn_as_their_places_do),
      cmocka_unit_test(poles_and_the_cut_are_no_exceptions),
      cmocka_unit_test(outside_the_outline_is_nothing),
      cmocka_unit_test(a_line_may_go_on_past_the_cut),
      cmocka_unit_test(maps_tell_what_they_are),
      cmocka_unit_test(what_is_no_map_is_refused),
  };
  return cmocka_run_group_tests_name("map/map", tests, NULL, NULL);
}
