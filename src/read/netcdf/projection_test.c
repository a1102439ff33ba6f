/* A polar stereographic plane on a sphere, whose formulas are short, and a flow that is
 * known in longitude and latitude. */
#include <math.h>

#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

#define RADIANS 0.017453292519943295

enum { SIDE = 9 };

static const double EARTH = 6371000.0, MERIDIAN = -40.0, STEP = 250000.0;

/* x and y in metres of the plane that touches the North Pole, y up along MERIDIAN + 180.
 */
static void degrees_of(double *longitude, double *latitude, double x, double y)
{
  *latitude = 90.0 - 2.0 * atan2(hypot(x, y), 2.0 * EARTH) / RADIANS;
  *longitude = MERIDIAN + atan2(x, -y) / RADIANS;
}

typedef struct plane_file {
  double unit;   /* metres of the axes' unit */
  double offset; /* of the axes from the projection's origin, in metres */
  bool east;     /* components along east and north */
  bool has_positions;
  double wrong;  /* added to the longitudes, degrees */
  bool unmapped; /* no grid mapping */
  bool alike;    /* all positions are one, as in idealised runs */
  bool unnamed;  /* no standard names: long names where they are along east and north */
  bool polar;    /* speed and direction from where the wind comes; of `east` */
} plane_file;

/* A wind of 3 along x and 4 along y everywhere, or its components along east and
 * north. */
static void write_plane(sample_file *f, const plane_file *how)
{
  double x[SIDE], y[SIDE], longitude[SIDE * SIDE], latitude[SIDE * SIDE], u[SIDE * SIDE],
      v[SIDE * SIDE];
  sample_begin(f, 0);
  for (int i = 0; i < SIDE; ++i) {
    x[i] = (STEP * (i - 1.5) + how->offset) / how->unit;
    y[i] = STEP * (i - 6.2) / how->unit;
  }
  for (int n = 0; n < SIDE * SIDE; ++n) {
    degrees_of(&longitude[n], &latitude[n], STEP * (n % SIDE - 1.5),
               STEP * (n / SIDE - 6.2));
    const double turn = (longitude[n] - MERIDIAN) * RADIANS; /* angle of east from x */
    u[n] = how->east ? 3.0 * cos(turn) + 4.0 * sin(turn) : 3.0;
    v[n] = how->east ? 4.0 * cos(turn) - 3.0 * sin(turn) : 4.0;
    if (how->polar) {
      v[n] = atan2(-u[n], -v[n]) / RADIANS;
      u[n] = 5.0;
    }
    longitude[n] = how->alike ? MERIDIAN : longitude[n] + how->wrong;
    latitude[n] = how->alike ? 45.0 : latitude[n];
  }
  const char *units = how->unit == 1.0 ? "m" : "km";
  const int rows = sample_axis(f, "y", SIDE, y, units);
  const int columns = sample_axis(f, "x", SIDE, x, units);
  const int plane[2] = {rows, columns};
  const int crs = sample_variable(f, "crs", NC_INT, 0, NULL);
  sample_text(f, crs, "grid_mapping_name", "polar_stereographic");
  sample_number(f, crs, "latitude_of_projection_origin", NC_DOUBLE, 90.0);
  sample_number(f, crs, "straight_vertical_longitude_from_pole", NC_DOUBLE, MERIDIAN);
  sample_number(f, crs, "scale_factor_at_projection_origin", NC_DOUBLE, 1.0);
  sample_number(f, crs, "earth_radius", NC_DOUBLE, EARTH);
  for (int k = 0; k < 2; ++k) {
    static const char *const names[] = {"u", "v", "ws", "wd"};
    static const char *const standard[] = {"x_wind",        "y_wind",
                                           "eastward_wind", "northward_wind",
                                           "wind_speed",    "wind_from_direction"};
    const int id = sample_variable(f, names[how->polar ? 2 + k : k], NC_FLOAT, 2, plane);
    if (!how->unmapped)
      sample_text(f, id, "grid_mapping", "crs");
    if (!how->unnamed)
      sample_text(f, id, "standard_name", standard[2 * (how->east + how->polar) + k]);
    else if (how->east)
      sample_text(f, id, "long_name", k == 0 ? "Eastward wind" : "Northward wind");
    sample_put(f, id, k == 0 ? u : v);
  }
  for (int k = 0; k < 2 && how->has_positions; ++k) {
    const int id = sample_variable(f, k == 0 ? "lon" : "lat", NC_DOUBLE, 2, plane);
    sample_text(f, id, "units", k == 0 ? "degrees_east" : "degrees_north");
    sample_put(f, id, k == 0 ? longitude : latitude);
  }
  sample_end(f);
}

static void projections_come_with_the_field(void **state)
{
  static const plane_file files[] = {
      {.unit = 1.0},
      {.unit = 1000.0, .has_positions = true},
      {.unit = 1.0, .east = true},
      {.unit = 1.0, .east = true, .unnamed = true},
      {.unit = 1.0, .east = true, .polar = true},
      {.unit = 1000.0, .offset = 70000.0, .east = true, .has_positions = true}};
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof files / sizeof *files; ++n) {
    write_plane(f, &files[n]);
    fg_field *field = read_with(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->scale, FG_SCALE_MAP);
    assert_non_null(a->projection);
    const char *words[] = {"+proj=stere ", "+lat_0=90 ", "+lon_0=-40 ", "+R=6371000 ",
                           files[n].unit == 1.0 ? "+units=m" : "+units=km"};
    for (size_t w = 0; w < sizeof words / sizeof *words; ++w)
      if (!strstr(a->projection, words[w]))
        fail_msg("\"%s\" lacks \"%s\"", a->projection, words[w]);
    const char *shift = strstr(a->projection, "+x_0=");
    assert_true((shift != NULL) == (files[n].offset != 0.0));
    assert_true(!shift || fabs(strtod(shift + 5, NULL) - files[n].offset) < 1.0);
    for (int i = 0; i < SIDE * SIDE; ++i) {
      assert_float_equal((double)a->velocity[0][i], 3.0, 1e-3);
      assert_float_equal((double)a->velocity[1][i], 4.0, 1e-3);
    }
    fg_field_destroy(field);
  }
}

/* Longitudes that no shift of the axes explains take precedence over the projection. */
static void positions_go_before_a_wrong_projection(void **state)
{
  sample_file *f = *state;
  write_plane(f, &(plane_file){.unit = 1.0, .has_positions = true, .wrong = 25.0});
  fg_field *field = read_with(f, NULL);
  assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_GEO);
  assert_null(fg_field_contents(field)->projection);
  assert_non_null(strstr(fg_field_contents(field)->doubts,
                         "from where the projection of 'crs' has them"));
  fg_field_destroy(field);
}

/* Of a plane of unknown projection points lie at their longitudes and latitudes. */
static void positions_are_the_place_without_a_projection(void **state)
{
  sample_file *f = *state;
  for (int n = 0; n < 5; ++n) {
    write_plane(f, &(plane_file){.unit = 1.0,
                                 .has_positions = true,
                                 .unmapped = true,
                                 .east = n & 1 || n == 4,
                                 .unnamed = n & 2,
                                 .polar = n == 4});
    fg_field *field = read_with(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    size_t found = 0;
    assert_int_equal(a->scale, FG_SCALE_GEO);
    for (int i = 0; i < a->size[0] * a->size[1]; ++i) {
      const double turn = (a->axis[0][i % a->size[0]] - MERIDIAN) * RADIANS;
      if (isnan(a->velocity[0][i]) || a->axis[1][i / a->size[0]] > 85.0)
        continue;
      ++found;
      const double u = 3.0 * cos(turn) + 4.0 * sin(turn);
      const double v = 4.0 * cos(turn) - 3.0 * sin(turn);
      assert_true(fabs((double)a->velocity[0][i] - u) < 0.05);
      assert_true(fabs((double)a->velocity[1][i] - v) < 0.05);
    }
    assert_true(found > 50);
    fg_field_destroy(field);
  }
  write_plane(
      f,
      &(plane_file){.unit = 1.0, .has_positions = true, .unmapped = true, .alike = true});
  fg_field *ideal = read_with(f, NULL);
  assert_int_equal(fg_field_contents(ideal)->scale, FG_SCALE_MAP);
  fg_field_destroy(ideal);
  write_plane(f, &(plane_file){.unit = 1.0, .has_positions = true, .unmapped = true});
  fg_field *field = read_with(f, &(fg_read_options){.scale = FG_SCALE_MAP});
  assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_MAP);
  fg_field_destroy(field);
}

/* A rotated grid is a plane of degrees: directions are those of the wind, lengths its
 * speed. */
static void rotated_poles_are_planes(void **state)
{
  static const double x[4] = {-3.0, -1.0, 1.0, 3.0}, y[3] = {50.0, 55.0, 60.0};
  static const char *const standard[] = {"grid_longitude", "grid_latitude"};
  double u[12], v[12];
  sample_file *f = *state;
  sample_begin(f, 0);
  const int rows = sample_axis(f, "rlat", 3, y, "degrees");
  const int columns = sample_axis(f, "rlon", 4, x, "degrees");
  for (int k = 0; k < 2; ++k) {
    int id;
    nc_must(nc_inq_varid(f->id, k == 0 ? "rlon" : "rlat", &id));
    sample_text(f, id, "standard_name", standard[k]);
  }
  const int crs = sample_variable(f, "rotated_pole", NC_INT, 0, NULL);
  sample_text(f, crs, "grid_mapping_name", "rotated_latitude_longitude");
  sample_number(f, crs, "grid_north_pole_latitude", NC_DOUBLE, 39.25);
  sample_number(f, crs, "grid_north_pole_longitude", NC_DOUBLE, -162.0);
  sample_number(f, crs, "earth_radius", NC_DOUBLE, EARTH);
  for (int n = 0; n < 12; ++n) {
    u[n] = 2.0;
    v[n] = 3.0;
  }
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "U_10M" : "V_10M", NC_FLOAT, 2,
                                   (int[]){rows, columns});
    sample_text(f, id, "grid_mapping", "rotated_pole");
    sample_text(f, id, "standard_name",
                k == 0 ? "grid_eastward_wind" : "grid_northward_wind");
    sample_put(f, id, k == 0 ? u : v);
  }
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->scale, FG_SCALE_MAP);
  assert_non_null(a->projection);
  assert_non_null(strstr(a->projection, "+proj=ob_tran +o_proj=longlat +o_lat_p=39.25"));
  assert_non_null(strstr(a->projection, "+lon_0=18 "));
  for (int n = 0; n < 12; ++n) {
    const double u_there = (double)a->velocity[0][n], v_there = (double)a->velocity[1][n];
    assert_true(fabs(hypot(u_there, v_there) - sqrt(13.0)) < 1e-5);
    assert_true(fabs(v_there / u_there - 1.5 * cos(y[n / 4] * RADIANS)) < 1e-5);
  }
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(projections_come_with_the_field),
      CASE(positions_go_before_a_wrong_projection),
      CASE(positions_are_the_place_without_a_projection),
      CASE(rotated_poles_are_planes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
