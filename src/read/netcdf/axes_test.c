#include <math.h>

#include "read/netcdf/sample.h"

enum { ROWS = 3, MOST = 80 };

static const double LATITUDES[ROWS] = {-10.0, 5.0, 30.0};

/* Column i holds u = i + 1, which identifies it at its longitude. */
static void put_columns(sample_file *f, int u, int v, size_t columns)
{
  double values[ROWS * MOST];
  for (size_t k = 0; k < ROWS * columns; ++k)
    values[k] = (double)(k % columns) + 1.0;
  sample_put(f, u, values);
  sample_put(f, v, values);
}

static void make(sample_file *f, const double *longitude, size_t columns)
{
  sample_begin(f, 0);
  const int lat = sample_axis(f, "lat", ROWS, LATITUDES, "degrees_north");
  const int lon = sample_axis(f, "lon", columns, longitude, "degrees_east");
  const int all[2] = {lat, lon};
  const int u = sample_variable(f, "u", NC_FLOAT, 2, all);
  const int v = sample_variable(f, "v", NC_FLOAT, 2, all);
  put_columns(f, u, v, columns);
  sample_end(f);
}

static fg_field *read_field(sample_file *f)
{
  fg_field *field = NULL;
  if (fg_field_read(&field, f->context, f->path, NULL) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  return field;
}

static void refuse(sample_file *f, const char *words)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, NULL),
                   FG_STATUS_UNSUPPORTED);
  if (!strstr(fg_context_message(f->context), words))
    fail_msg("\"%s\" lacks \"%s\"", fg_context_message(f->context), words);
}

/* u at a longitude, in the first row of cells. */
static double column_at(const fg_field *field, double longitude)
{
  double velocity[2] = {-1.0, -1.0};
  assert_true(fg_field_velocity(field, (double[]){longitude, 0.0}, velocity));
  return velocity[0];
}

static void a_closed_circle_is_periodic(void **state)
{
  sample_file *f = *state;
  double longitude[MOST];
  for (int i = 0; i < 36; ++i)
    longitude[i] = 5.0 + 10.0 * i;
  make(f, longitude, 36);
  fg_field *field = read_field(f);
  assert_true(fg_field_contents(field)->period[0] == 360.0);
  assert_int_equal(fg_field_contents(field)->size[0], 36);
  assert_true(fabs(column_at(field, -355.0) - 1.0) < 1e-6);
  assert_true(fabs(column_at(field, 357.5) - (36.0 + 0.25 * (1.0 - 36.0))) < 1e-6);
  fg_field_destroy(field);
}

static void a_region_is_not_periodic(void **state)
{
  sample_file *f = *state;
  double longitude[MOST];
  for (int i = 0; i < 35; ++i) /* one column short */
    longitude[i] = 10.0 * i;
  make(f, longitude, 35);
  fg_field *field = read_field(f);
  double velocity[2];
  assert_true(fg_field_contents(field)->period[0] == 0.0);
  assert_false(fg_field_velocity(field, (double[]){345.0, 0.0}, velocity));
  fg_field_destroy(field);
}

/* Longitudes from 0 to 360 or beyond: columns at either end that repeat others are read
 * once. */
static void repeated_columns_are_dropped(void **state)
{
  sample_file *f = *state;
  double longitude[MOST];
  for (int extra = 1; extra <= 5; extra += 2)
    for (int descending = 0; descending < 2; ++descending) {
      const int columns = 36 + extra;
      for (int i = 0; i < columns; ++i)
        longitude[i] = 10.0 * (descending ? columns - 1 - i : i) - 180.0;
      make(f, longitude, (size_t)columns);
      fg_field *field = read_field(f);
      assert_int_equal(fg_field_contents(field)->size[0], 36);
      assert_true(fg_field_contents(field)->period[0] == 360.0);
      for (int i = 0; i < 36; ++i)
        assert_true(fabs(column_at(field, 10.0 * i - 180.0) -
                         (descending ? columns - i : i + 1)) < 1e-6);
      fg_field_destroy(field);
    }
}

static void longitudes_that_jump_go_on(void **state)
{
  sample_file *f = *state;
  static const double jump[][6] = {
      {150.0, 170.0, -170.0, -150.0, -110.0, -60.0},
      {300.0, 340.0, 0.0, 20.0, 30.0, 35.5},
      {-150.0, -170.0, 170.0, 150.0, 149.0, 120.0}, /* westward */
  };
  static const double first[] = {150.0, 300.0, -240.0};
  static const double last[] = {300.0, 395.5, -150.0};
  for (int k = 0; k < 3; ++k) {
    make(f, jump[k], 6);
    fg_field *field = read_field(f);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_true(fabs(a->axis[0][0] - first[k]) < 1e-9);
    assert_true(fabs(a->axis[0][5] - last[k]) < 1e-9);
    for (int i = 0; i < 6; ++i) {
      const double turned = remainder(jump[k][i] - first[k], 360.0);
      const double on = first[k] + (turned < 0.0 ? turned + 360.0 : turned);
      assert_true(fabs(column_at(field, on) - (i + 1)) < 1e-6);
    }
    fg_field_destroy(field);
  }
}

static void axes_out_of_order_are_refused(void **state)
{
  sample_file *f = *state;
  make(f, (double[]){1.0, 2.0, 2.0, 4.0}, 4);
  refuse(f, "not strictly monotonic: 2 and 2 at samples 1 and 2");
  make(f, (double[]){9.0, 7.0, 8.0, 4.0}, 4);
  refuse(f, "not strictly monotonic: 7 and 8 at samples 1 and 2");
  make(f, (double[]){1.0, (double)NAN, 3.0}, 3);
  refuse(f, "coordinate 1 of 'lon' is");
  make(f, (double[]){1.0, 2.0, NC_FILL_DOUBLE}, 3);
  refuse(f, "coordinate 2 of 'lon' is");
  make(f, (double[]){1.0}, 1);
  refuse(f, "only 1 sample");
}

/* Two-dimensional longitude and latitude; dimensions may be swapped. */
static void make_plane(sample_file *f, double shear, bool transposed, bool timed)
{
  static const double lon[4] = {300.0, 350.0, 5.0, 20.0}; /* jumps from 360 to 0 */
  double plane[2][4 * ROWS];
  double value[4 * ROWS];
  sample_begin(f, NC_NETCDF4);
  const int a = sample_dimension(f, "cross", transposed ? 4 : ROWS);
  const int b = sample_dimension(f, "along", transposed ? ROWS : 4);
  const int all[3] = {timed ? sample_dimension(f, "Time", 1) : a, timed ? a : b, b};
  const int rank = timed ? 3 : 2;
  const int u = sample_variable(f, "u", NC_FLOAT, rank, all);
  const int v = sample_variable(f, "v", NC_FLOAT, rank, all);
  const int x = sample_variable(f, "nav_lon", NC_DOUBLE, rank, all);
  const int y = sample_variable(f, "nav_lat", NC_DOUBLE, rank, all);
  sample_text(f, x, "units", "degrees_east");
  sample_text(f, y, "units", "degrees_north");
  for (int j = 0; j < ROWS; ++j)
    for (int i = 0; i < 4; ++i) {
      const int k = transposed ? i * ROWS + j : j * 4 + i;
      plane[0][k] = lon[i] + shear * j;
      plane[1][k] = LATITUDES[j] + shear * i;
      value[k] = i + 1;
    }
  sample_put(f, x, plane[0]);
  sample_put(f, y, plane[1]);
  sample_put(f, u, value);
  sample_put(f, v, value);
  sample_end(f);
}

static void grids_in_disguise_are_recognised(void **state)
{
  sample_file *f = *state;
  for (int way = 0; way < 4; ++way) {
    make_plane(f, 1e-5, way % 2 == 1, way >= 2); /* shear like the rounding of float */
    fg_field *field = read_field(f);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->scale, FG_SCALE_GEO);
    assert_int_equal(a->size[0], 4);
    assert_int_equal(a->size[1], ROWS);
    assert_true(fabs(a->axis[0][3] - 380.0) < 1e-3);
    assert_true(fabs(a->axis[1][2] - 30.0) < 1e-3);
    assert_string_equal(a->axis_name[1], "latitude");
    assert_true(fabs(column_at(field, 365.0) - 3.0) < 1e-3);
    fg_field_destroy(field);
  }
}

static void curvilinear_grids_need_a_frame(void **state)
{
  sample_file *f = *state;
  make_plane(f, 2.0, false, false);
  refuse(f, "nothing says whether 'u' and 'v' point east");
  assert_non_null(strstr(fg_context_hint(f->context), "--frame grid"));
  refuse_with(f, &(fg_read_options){.scale = FG_SCALE_MAP}, FG_STATUS_UNSUPPORTED,
              "curvilinear");
  assert_non_null(strstr(fg_context_hint(f->context), "--scale plain"));
  fg_context_clear(f->context);
  fg_field *field = NULL;
  const fg_read_options plain = {.scale = FG_SCALE_PLAIN};
  assert_int_equal(fg_field_read(&field, f->context, f->path, &plain), FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->axis[0][0] == 0.0 && a->axis[0][3] == 3.0);
  assert_string_equal(a->axis_name[0], "along");
  assert_string_equal(a->axis_units[0], "");
  fg_field_destroy(field);
}

/* Lines of a swath at times of their own are no times of the field (SWOT). */
static void swaths_run_along_time(void **state)
{
  sample_file *f = *state;
  static const double seconds[ROWS] = {0.0, 3.0, 6.0};
  int lines;
  make_plane(f, 2.0, false, false);
  nc_must(nc_open(f->path, NC_WRITE, &f->id));
  nc_must(nc_inq_dimid(f->id, "cross", &lines));
  const int time = sample_variable(f, "time", NC_DOUBLE, 1, &lines);
  sample_text(f, time, "units", "seconds since 2000-01-01");
  sample_put(f, time, seconds);
  sample_end(f);
  fg_field *field = read_with(f, &(fg_read_options){.frame = FG_FRAME_EAST});
  assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_GEO);
  fg_field_destroy(field);
}

/* Components along east on axes that do not run east. */
static void components_must_run_along_the_axes(void **state)
{
  sample_file *f = *state;
  static const char *const mapping[] = {"lambert_conformal_conic", "mercator"};
  static const double metres[4] = {0.0, 2500.0, 5000.0, 7500.0};
  for (int k = 0; k < 2; ++k) {
    sample_begin(f, 0);
    const int y = sample_axis(f, "y", ROWS, metres, "m");
    const int x = sample_axis(f, "x", 4, metres, "m");
    const int crs = sample_variable(f, "crs", NC_INT, 0, NULL);
    sample_text(f, crs, "grid_mapping_name", mapping[k]);
    const int u = sample_variable(f, "u", NC_FLOAT, 2, (int[]){y, x});
    const int v = sample_variable(f, "v", NC_FLOAT, 2, (int[]){y, x});
    sample_text(f, u, "standard_name", "eastward_wind");
    sample_text(f, v, "standard_name", "northward_wind");
    sample_text(f, u, "grid_mapping", "crs");
    put_columns(f, u, v, 4);
    sample_end(f);
    if (k == 0) {
      refuse(f, "points east");
      assert_non_null(strstr(fg_context_hint(f->context), "--scale map"));
    }
    const fg_read_options map = {.scale = k == 0 ? FG_SCALE_MAP : FG_SCALE_AUTO};
    fg_field *field = NULL;
    fg_context_clear(f->context);
    assert_int_equal(fg_field_read(&field, f->context, f->path, &map), FG_STATUS_OK);
    assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_MAP);
    fg_field_destroy(field);
  }
}

/* Nothing says where on the Earth it is. */
static void a_rotated_pole_alone_is_a_plane(void **state)
{
  sample_file *f = *state;
  static const double degrees[4] = {-3.0, -2.0, -1.0, 0.5};
  sample_begin(f, 0);
  const int y = sample_axis(f, "rlat", ROWS, LATITUDES, "degrees");
  const int x = sample_axis(f, "rlon", 4, degrees, "degrees");
  int id;
  nc_must(nc_inq_varid(f->id, "rlat", &id));
  sample_text(f, id, "standard_name", "grid_latitude");
  nc_must(nc_inq_varid(f->id, "rlon", &id));
  sample_text(f, id, "standard_name", "grid_longitude");
  const int u = sample_variable(f, "u", NC_FLOAT, 2, (int[]){y, x});
  const int v = sample_variable(f, "v", NC_FLOAT, 2, (int[]){y, x});
  put_columns(f, u, v, 4);
  sample_end(f);
  fg_field *field = read_field(f);
  assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_PLAIN);
  assert_string_equal(fg_field_contents(field)->axis_name[0], "grid longitude");
  assert_string_equal(fg_field_contents(field)->axis_units[0], "°");
  fg_field_destroy(field);
  nc_must(nc_open(f->path, NC_WRITE, &f->id));
  sample_text(f, u, "standard_name", "eastward_wind");
  sample_text(f, v, "standard_name", "northward_wind");
  sample_end(f);
  refuse(f, "'u' points east, but the axes of its rotated grid do not");
}

/* Without coordinates or known names the last dimension is x. */
static void bare_arrays_are_read_on_their_indices(void **state)
{
  sample_file *f = *state;
  sample_begin(f, 0);
  const int member = sample_dimension(f, "one", 1);
  const int y = sample_dimension(f, "gridx", ROWS);
  const int x = sample_dimension(f, "gridy", 4);
  const int u = sample_variable(f, "u", NC_FLOAT, 3, (int[]){member, y, x});
  const int v = sample_variable(f, "v", NC_FLOAT, 3, (int[]){member, y, x});
  put_columns(f, u, v, 4);
  sample_end(f);
  fg_field *field = read_field(f);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 4);
  assert_int_equal(a->size[1], ROWS);
  assert_int_equal(a->scale, FG_SCALE_PLAIN);
  assert_true(a->velocity[0][ROWS * 4 - 1] == 4.0f);
  fg_field_destroy(field);
}

static void dimensions_that_fit_nothing_are_refused(void **state)
{
  sample_file *f = *state;
  sample_begin(f, 0);
  int all[5];
  all[0] = sample_dimension(f, "time", 2);
  all[1] = sample_dimension(f, "lev", 2);
  all[2] = sample_dimension(f, "member", 3);
  all[3] = sample_axis(f, "lat", ROWS, LATITUDES, "degrees_north");
  all[4] = sample_axis(f, "lon", ROWS, LATITUDES, "degrees_east");
  sample_variable(f, "u", NC_FLOAT, 5, all);
  sample_variable(f, "v", NC_FLOAT, 5, all);
  sample_end(f);
  refuse(f, "dimension 'member' of 3 samples is neither time nor level");
  assert_non_null(strstr(fg_context_hint(f->context), "--at member=0"));
  sample_begin(f, 0);
  all[0] = sample_dimension(f, "time", NC_UNLIMITED);
  all[1] = sample_axis(f, "lat", ROWS, LATITUDES, "degrees_north");
  all[2] = sample_axis(f, "lon", ROWS, LATITUDES, "degrees_east");
  sample_variable(f, "u", NC_FLOAT, 3, all);
  sample_variable(f, "v", NC_FLOAT, 3, all);
  sample_end(f);
  refuse(f, "dimension 'time' is empty");
  sample_begin(f, 0);
  all[0] = sample_dimension(f, "time", 4);
  all[1] = sample_dimension(f, "station", 7);
  sample_variable(f, "u", NC_FLOAT, 2, all);
  sample_variable(f, "v", NC_FLOAT, 2, all);
  sample_end(f);
  refuse(f, "only one dimension in space");
  sample_begin(f, 0);
  all[0] = sample_dimension(f, "time", 2);
  all[1] = sample_axis(f, "lat", ROWS, LATITUDES, "degrees_north");
  all[2] = sample_axis(f, "lon", ROWS, LATITUDES, "degrees_east");
  sample_variable(f, "u", NC_FLOAT, 3, all);
  sample_variable(f, "v", NC_FLOAT, 2, all + 1);
  sample_end(f);
  refuse(f, "'u' is 2 x 3 x 3, 'v' is 3 x 3 samples");
  assert_null(strstr(fg_context_message(f->context), "staggered"));
}

/* A file of a few kilobytes that declares gigabytes must cost neither time nor memory. */
static void grids_that_no_file_can_hold_are_refused(void **state)
{
  sample_file *f = *state;
  static const size_t side[] = {40000, 2000000000};
  static const char *const reason[] = {"but the file has only", "are more than the"};
  for (int k = 0; k < 2; ++k) {
    sample_begin(f, NC_NETCDF4);
    const int all[2] = {sample_dimension(f, "y", side[k]),
                        sample_dimension(f, "x", side[k])};
    const size_t chunk[2] = {1000, 1000};
    for (int component = 0; component < 2; ++component) {
      const int id = sample_variable(f, component == 0 ? "u" : "v", NC_FLOAT, 2, all);
      nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
    }
    sample_end(f);
    refuse(f, reason[k]);
  }
}

/* Nor are declared values read to compare the components' places. */
static void coordinates_that_no_file_can_hold_are_not_compared(void **state)
{
  sample_file *f = *state;
  sample_begin(f, NC_NETCDF4);
  int all[2][3];
  const size_t chunk[3] = {1000, ROWS, ROWS};
  for (int c = 0; c < 2; ++c) {
    all[c][0] = sample_dimension(f, c == 0 ? "upper" : "lower", 2000000000);
    const int id = sample_variable(f, c == 0 ? "upper" : "lower", NC_DOUBLE, 1, all[c]);
    nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
  }
  all[0][1] = all[1][1] = sample_axis(f, "lat", ROWS, LATITUDES, "degrees_north");
  all[0][2] = all[1][2] = sample_axis(f, "lon", ROWS, LATITUDES, "degrees_east");
  for (int c = 0; c < 2; ++c) {
    const int id = sample_variable(f, c == 0 ? "u" : "v", NC_FLOAT, 3, all[c]);
    nc_must(nc_def_var_chunking(f->id, id, NC_CHUNKED, chunk));
  }
  sample_end(f);
  refuse(f, "'u' runs along 'upper', 'v' along 'lower'");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(a_closed_circle_is_periodic),
      CASE(a_region_is_not_periodic),
      CASE(repeated_columns_are_dropped),
      CASE(longitudes_that_jump_go_on),
      CASE(axes_out_of_order_are_refused),
      CASE(grids_in_disguise_are_recognised),
      CASE(curvilinear_grids_need_a_frame),
      CASE(swaths_run_along_time),
      CASE(components_must_run_along_the_axes),
      CASE(a_rotated_pole_alone_is_a_plane),
      CASE(bare_arrays_are_read_on_their_indices),
      CASE(dimensions_that_fit_nothing_are_refused),
      CASE(grids_that_no_file_can_hold_are_refused),
      CASE(coordinates_that_no_file_can_hold_are_not_compared),
  };
  return cmocka_run_group_tests_name("read/netcdf/axes", tests, NULL, NULL);
}
