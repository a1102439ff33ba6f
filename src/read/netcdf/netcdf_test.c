#include <math.h>

#include "read/netcdf/plain_example.h"

enum { NT = 3, NZ = 2 };

/* Fills the variables; the letters of `order` are the roles of the dimensions, as
 * "tzyx". */
static void put_ordered(const sample_file *f, int u, int v, const char *order,
                        const double *x, const double *y)
{
  double values[2][COUNT * NT * NZ];
  const int length[4] = {NT, NZ, NY, NX};
  const size_t rank = strlen(order);
  int index[4] = {0, 0, 0, 0};
  size_t n = 0;
  for (;;) {
    values[0][n] = u_of(x[index[3]], y[index[2]], index[0], index[1]);
    values[1][n++] = v_of(x[index[3]], y[index[2]], index[0], index[1]);
    size_t k = rank;
    while (k > 0) {
      const size_t role = (size_t)(strchr("tzyx", order[k - 1]) - "tzyx");
      if (++index[role] < length[role])
        break;
      index[role] = 0;
      --k;
    }
    if (k == 0)
      break;
  }
  sample_write(f);
  nc_must(nc_put_var_double(f->id, u, values[0]));
  nc_must(nc_put_var_double(f->id, v, values[1]));
}

static void every_kind_of_file_reads_the_same(void **state)
{
  sample_file *f = *state;
  static const int mode[] = {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4,
                             NC_NETCDF4 | NC_CLASSIC_MODEL};
  for (size_t i = 0; i < sizeof mode / sizeof *mode; ++i) {
    int id[2];
    make_plain(f, mode[i], i % 2 == 0 ? NC_FLOAT : NC_DOUBLE, id);
    sample_end(f);
    fg_field *field = read_with(f, NULL);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->size[0], NX);
    assert_int_equal(a->size[1], NY);
    assert_memory_equal(a->axis[0], X, sizeof X);
    assert_memory_equal(a->axis[1], Y, sizeof Y);
    assert_int_equal(a->scale, FG_SCALE_MAP);
    assert_string_equal(a->axis_units[0], "km");
    assert_null(a->time);
    assert_null(a->level);
    assert_samples(field, 0, 0);
    fg_field_destroy(field);
  }
}

/* Any order of the dimensions, and axes that descend. */
static void any_order_of_dimensions_is_read(void **state)
{
  sample_file *f = *state;
  static const char *const orders[] = {"tzyx", "tzxy", "xyzt", "ytxz", "yx", "xy", "txy"};
  for (size_t o = 0; o < sizeof orders / sizeof *orders; ++o)
    for (int descending = 0; descending < 4; ++descending) {
      const double t[NT] = {6.0, 12.0, 18.0};
      const double z[NZ] = {850.0, 500.0};
      double x[NX];
      double y[NY];
      for (int i = 0; i < NX; ++i)
        x[i] = X[descending & 1 ? NX - 1 - i : i];
      for (int j = 0; j < NY; ++j)
        y[j] = Y[descending & 2 ? NY - 1 - j : j];
      sample_begin(f, 0);
      int dimension[4];
      dimension[3] = sample_axis(f, "lon", NX, x, "degrees_east");
      dimension[0] = sample_axis(f, "time", NT, t, "hours since 2001-02-28 12:00");
      dimension[1] = sample_axis(f, "lev", NZ, z, "hPa");
      dimension[2] = sample_axis(f, "lat", NY, y, "degrees_north");
      int all[4];
      const size_t rank = strlen(orders[o]);
      for (size_t k = 0; k < rank; ++k)
        all[k] = dimension[strchr("tzyx", orders[o][k]) - "tzyx"];
      const int u = sample_variable(f, "u", NC_FLOAT, (int)rank, all);
      const int v = sample_variable(f, "v", NC_FLOAT, (int)rank, all);
      put_ordered(f, u, v, orders[o], x, y);
      sample_end(f);
      const bool timed = strchr(orders[o], 't');
      const bool levelled = strchr(orders[o], 'z');
      const fg_read_options options = {.time = timed ? 2 : 0, .level = levelled ? 1 : 0};
      fg_field *field = read_with(f, &options);
      const fg_field_arrays *a = fg_field_contents(field);
      assert_memory_equal(a->axis[0], X, sizeof X);
      assert_memory_equal(a->axis[1], Y, sizeof Y);
      assert_int_equal(a->scale, FG_SCALE_GEO);
      assert_samples(field, options.time, options.level);
      if (timed)
        assert_string_equal(a->time, "2001-03-01 06:00");
      if (levelled)
        assert_string_equal(a->level, "500 hPa");
      fg_field_destroy(field);
      fg_read_options beyond = options;
      beyond.time = timed ? 3 : 1;
      refuse_with(f, &beyond, FG_STATUS_ARGUMENT, timed ? "0 to 2" : "no time axis");
      beyond = options;
      beyond.level = -1;
      refuse_with(f, &beyond, FG_STATUS_ARGUMENT, "level -1");
    }
}

/* u / cos latitude, as stored and as a tangent vector. */
static void winds_on_the_sphere_are_recognised(void **state)
{
  sample_file *f = *state;
  const double lon[NX] = {0.0, 1.0, 2.0, 3.0, 4.0};
  const double lat[NY] = {59.0, 60.0, 61.0, 62.0};
  double values[COUNT];
  sample_begin(f, 0);
  const int y = sample_axis(f, "rows", NY, lat, "degrees_north");
  const int x = sample_axis(f, "columns", NX, lon, "degrees_east");
  const int all[2] = {y, x};
  const int u = sample_variable(f, "abc", NC_FLOAT, 2, all);
  const int v = sample_variable(f, "xyz", NC_FLOAT, 2, all);
  sample_text(f, u, "standard_name", "eastward_wind");
  sample_text(f, v, "standard_name", "northward_wind");
  sample_text(f, u, "units", "m s-1");
  sample_text(f, v, "units", "m.s**-1");
  sample_text(f, u, "long_name", "10 metre U wind component");
  sample_text(f, v, "long_name", "10 metre V wind component");
  for (int i = 0; i < COUNT; ++i)
    values[i] = 3.0;
  sample_put(f, u, values);
  for (int i = 0; i < COUNT; ++i)
    values[i] = 8.0;
  sample_put(f, v, values);
  sample_end(f);
  double tangent[2];
  fg_field *field = read_with(f, NULL);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->scale, FG_SCALE_GEO);
  assert_string_equal(a->velocity_units, "m/s");
  assert_string_equal(a->axis_name[0], "longitude");
  assert_string_equal(a->axis_units[0], "°E");
  assert_string_equal(a->axis_units[1], "°N");
  assert_string_equal(a->title, "10 metre wind");
  assert_true(fg_field_tangent(field, (double[]){1.3, 60.0}, tangent));
  assert_true(fabs(tangent[0] - 6.0) < 1e-9 && fabs(tangent[1] - 8.0) < 1e-9);
  fg_field_destroy(field);
  const fg_read_options plain = {.scale = FG_SCALE_PLAIN};
  field = read_with(f, &plain);
  assert_true(fg_field_tangent(field, (double[]){1.3, 60.0}, tangent));
  assert_true(fabs(tangent[0] - 3.0) < 1e-9);
  fg_field_destroy(field);
}

static void groups_are_searched(void **state)
{
  sample_file *f = *state;
  int group;
  int id[2];
  int dimension[2];
  double stored[COUNT];
  sample_begin(f, NC_NETCDF4);
  dimension[0] = sample_axis(f, "y", NY, Y, "m");
  dimension[1] = sample_axis(f, "x", NX, X, "m");
  nc_must(nc_def_grp(f->id, "ocean", &group));
  nc_must(nc_def_var(group, "uo", NC_FLOAT, 2, dimension, &id[0]));
  nc_must(nc_def_var(group, "vo", NC_FLOAT, 2, dimension, &id[1]));
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < COUNT; ++i)
      stored[i] = (k == 0 ? u_of : v_of)(X[i % NX], Y[i / NX], 0, 0);
    nc_must(nc_put_var_double(group, id[k], stored));
  }
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  assert_samples(field, 0, 0);
  assert_string_equal(fg_field_contents(field)->velocity_name[0], "ocean/uo");
  fg_field_destroy(field);
  const fg_read_options options = {.vars = "uo,ocean/vo"};
  field = read_with(f, &options);
  fg_field_destroy(field);
}

static void only_possible_requests_are_met(void **state)
{
  sample_file *f = *state;
  int id[2];
  int dimension[2];
  make_plain(f, NC_NETCDF4, NC_FLOAT, id);
  nc_must(nc_inq_dimid(f->id, "y", &dimension[0]));
  nc_must(nc_inq_dimid(f->id, "x", &dimension[1]));
  sample_variable(f, "letters", NC_CHAR, 2, dimension);
  sample_variable(f, "words", NC_STRING, 2, dimension);
  sample_variable(f, "line", NC_FLOAT, 1, dimension);
  sample_text(f, id[0], "units", "m/s");
  const int slow = sample_variable(f, "slow", NC_FLOAT, 2, dimension);
  sample_text(f, slow, "units", "cm/s");
  sample_end(f);
  refuse_with(f, &(fg_read_options){.vars = "u"}, FG_STATUS_ARGUMENT,
              "'u' is one variable, and a velocity has two or three components");
  assert_non_null(strstr(fg_context_hint(f->context), "pairs in it: u,v"));
  refuse_with(f, &(fg_read_options){.vars = "u,v,w"}, FG_STATUS_ARGUMENT, "'w'");
  refuse_with(f, &(fg_read_options){.vars = ",v"}, FG_STATUS_ARGUMENT, "two");
  refuse_with(f, &(fg_read_options){.vars = "u,u"}, FG_STATUS_ARGUMENT, "both");
  refuse_with(f, &(fg_read_options){.vars = "u,w"}, FG_STATUS_ARGUMENT, "'w'");
  refuse_with(f, &(fg_read_options){.vars = "u,letters"}, FG_STATUS_UNSUPPORTED, "text");
  refuse_with(f, &(fg_read_options){.vars = "u,words"}, FG_STATUS_UNSUPPORTED, "text");
  refuse_with(f, &(fg_read_options){.vars = "u,line"}, FG_STATUS_UNSUPPORTED,
              "'line' has 1 dimension");
  refuse_with(f, &(fg_read_options){.vars = "u,slow"}, FG_STATUS_UNSUPPORTED,
              "'u' is in m/s, 'slow' in cm/s");
  refuse_with(f, &(fg_read_options){.scale = FG_SCALE_GEO}, FG_STATUS_UNSUPPORTED,
              "'x' is in km");
  fg_field *field = read_with(f, &(fg_read_options){.vars = "v,u"});
  assert_string_equal(fg_field_contents(field)->velocity_name[0], "v");
  fg_field_destroy(field);
}

static void files_without_vectors_say_so(void **state)
{
  sample_file *f = *state;
  sample_begin(f, 0);
  const int x = sample_axis(f, "x", NX, X, "m");
  sample_variable(f, "temperature", NC_FLOAT, 1, &x);
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED,
              "no vectors found among its 2 variables: x, temperature");
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 0);
  fg_inventory_destroy(inventory);
}

static void inventories_tell_what_reading_gives(void **state)
{
  sample_file *f = *state;
  int id[2];
  double stored[COUNT];
  for (int i = 0; i < COUNT; ++i)
    stored[i] = i % 4 == 1 ? NC_FILL_DOUBLE : 2.5;
  make_plain(f, NC_64BIT_OFFSET, NC_DOUBLE, id);
  sample_put(f, id[1], stored);
  sample_end(f);
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_string_equal(fg_inventory_format(inventory), "NetCDF");
  assert_int_equal(fg_inventory_vector_count(inventory), 1);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(v->name[0], "u");
  assert_string_equal(v->name[1], "v");
  assert_string_equal(v->found_by, "names");
  assert_true(v->missing_share == 0.25);
  assert_int_equal(v->size[0], NX);
  assert_int_equal(v->size[1], NY);
  assert_int_equal(v->times, 1);
  assert_int_equal(v->scale, FG_SCALE_MAP);
  assert_true(v->bounds[0] == 1.5 && v->bounds[1] == 7.0);
  assert_true(v->bounds[2] == -3.0 && v->bounds[3] == 0.75);
  assert_false(v->periodic[0]);
  assert_null(v->unusable);
  assert_null(fg_inventory_vector_at(inventory, 1));
  fg_inventory_destroy(inventory);
}

/* With a second pair of one time and level, to test that the chosen pair is read. */
static void inventories_tell_times_and_levels(void **state)
{
  sample_file *f = *state;
  static const double t[] = {0.0, 6.0, 12.008333}, z[] = {85000.0, 30000.0};
  sample_begin(f, 0);
  const int dimension[] = {sample_axis(f, "time", NT, t, "hours since 2001-02-28 12:00"),
                           sample_axis(f, "lev", NZ, z, "Pa"),
                           sample_axis(f, "y", NY, Y, "km"),
                           sample_axis(f, "x", NX, X, "km")};
  sample_variable(f, "u", NC_FLOAT, 4, dimension);
  sample_variable(f, "v", NC_FLOAT, 4, dimension);
  sample_variable(f, "u10", NC_FLOAT, 2, dimension + 2);
  sample_variable(f, "v10", NC_FLOAT, 2, dimension + 2);
  sample_end(f);
  fg_inventory *inventory = NULL;
  fg_read_options options = {.vars = "u,v"};
  assert_int_equal(fg_inventory_read_chosen(&inventory, f->context, f->path, &options),
                   FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 1);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  assert_int_equal(v->times, NT);
  assert_int_equal(v->levels, NZ);
  assert_string_equal(v->time_value[1].words, "2001-02-28 18:00");
  assert_string_equal(v->time_value[2].words, "2001-03-01 00:00:30");
  assert_true(v->time_value[1].value == 6.0);
  assert_string_equal(v->level_value[1].words, "300 hPa");
  assert_string_equal(v->level_value[1].units, "Pa");
  fg_selection found;
  assert_int_equal(
      fg_selection_find(&found, f->context, "level", "300hPa", v->level_value, v->levels),
      FG_STATUS_OK);
  assert_int_equal(found.index[0], 1);
  fg_selection_clear(&found);
  fg_inventory_destroy(inventory);
  options.vars = "v10,u10";
  assert_int_equal(fg_inventory_read_chosen(&inventory, f->context, f->path, &options),
                   FG_STATUS_OK);
  v = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(v->name[0], "v10");
  assert_null(v->time_value);
  fg_inventory_destroy(inventory);
}

/* As xarray writes what it has chosen: one time and one level are no dimensions, but
 * coordinates that the components, or the file, name. */
static void single_coordinates_tell_time_and_level(void **state)
{
  static const double hours[] = {0.0, 6.0}, height[] = {10.0};
  static const double flow[NX * NY] = {1.0, 2.0};
  sample_file *f = *state;
  for (int of_file = 0; of_file < 2; ++of_file) {
    sample_begin(f, 0);
    const int plane[2] = {sample_dimension(f, "ny", NY), sample_dimension(f, "nx", NX)};
    static const char *const names[] = {"start", "valid", "height", "u", "v"};
    static const char *const words[] = {"forecast_reference_time", "time", "height",
                                        "eastward_wind", "northward_wind"};
    static const char *const units[] = {"hours since 2023-05-01",
                                        "hours since 2023-05-01", "m", "m/s", "m/s"};
    for (int k = 0; k < 5; ++k) {
      const int id = sample_variable(f, names[k], k < 3 ? NC_DOUBLE : NC_FLOAT,
                                     k < 3 ? 0 : 2, plane);
      sample_text(f, id, "standard_name", words[k]);
      sample_text(f, id, "units", units[k]);
      if (k == 3 || of_file)
        sample_text(f, of_file ? NC_GLOBAL : id, "coordinates", "start valid height");
      sample_put(f, id, k < 2 ? &hours[k] : k == 2 ? height : flow);
    }
    sample_end(f);
    fg_field *field = read_with(f, NULL);
    assert_string_equal(fg_field_contents(field)->time, "2023-05-01 06:00");
    assert_string_equal(fg_field_contents(field)->level, "height 10 m");
    fg_field_destroy(field);
    fg_inventory *inventory;
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
    assert_int_equal(v->times, 1);
    assert_string_equal(v->time_value[0].words, "2023-05-01 06:00");
    assert_string_equal(v->level_value[0].words, "height 10 m");
    fg_inventory_destroy(inventory);
  }
}

/* The defaults of a field of 3 levels whose coordinate has these attributes; "" none. */
static fg_read_defaults defaults_of(sample_file *f, const char *name,
                                    const char *positive, const char *units,
                                    const double levels[3])
{
  int id[3];
  sample_begin(f, 0);
  id[0] = sample_dimension(f, "level", 3);
  const int level = sample_variable(f, "level", NC_DOUBLE, 1, id);
  if (*name)
    sample_text(f, level, "standard_name", name);
  if (*positive)
    sample_text(f, level, "positive", positive);
  if (*units)
    sample_text(f, level, "units", units);
  id[1] = sample_dimension(f, "ny", NY);
  id[2] = sample_dimension(f, "nx", NX);
  for (int k = 0; k < 2; ++k) {
    const int component = sample_variable(f, k ? "v" : "u", NC_FLOAT, 3, id);
    sample_text(f, component, "units", "m/s");
    sample_text(f, component, "coordinates", "level glat glon");
  }
  sample_put(f, level, levels);
  sample_end(f);
  fg_read_defaults defaults;
  assert_int_equal(fg_read_defaults_find(&defaults, f->context, f->path, NULL),
                   FG_STATUS_OK);
  return defaults;
}

/* In the ocean the surface; in the air, or without attributes, the first level. */
static void the_usual_level_is_the_seas_surface(void **state)
{
  static const double rising[] = {-90.0, -5.0, -40.0}, depths[] = {40.0, 5.0, 90.0};
  static const struct {
    const char *name, *positive, *units;
    const double *levels;
    int level;
  } cases[] = {{"ocean_s_coordinate_g2", "up", "", rising, 1},
               {"ocean_sigma_coordinate", "", "", rising, 1},
               {"depth", "", "m", depths, 1},
               {"", "down", "m", depths, 1},
               {"depth", "down", "m", rising, 1},
               {"", "down", "m", rising, 1},
               {"", "up", "m", rising, 1},
               {"", "up", "m", depths, 0},
               {"height", "up", "m", rising, 0},
               {"air_pressure", "down", "hPa", depths, 0}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg_read_defaults defaults = defaults_of(
        *state, cases[n].name, cases[n].positive, cases[n].units, cases[n].levels);
    assert_int_equal(defaults.level, cases[n].level);
    assert_string_equal(defaults.absent, "glat, glon");
  }
}

/* The file of the demonstration: 65160 packed global samples, none missing. */
static void the_demonstration_file_is_read(void **state)
{
  sample_file *f = *state;
  fg_field *field = NULL;
  assert_int_equal(fg_field_read(&field, f->context,
                                 FLOWGRAIN_SOURCE_DIR "/data/gfs_20140131.nc", NULL),
                   FG_STATUS_OK);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->size[0], 360);
  assert_int_equal(a->size[1], 181);
  assert_true(a->period[0] == 360.0 && a->axis[1][0] == -90.0 && a->axis[1][180] == 90.0);
  assert_null(a->valid);
  assert_int_equal(a->scale, FG_SCALE_GEO);
  assert_string_equal(a->velocity_units, "m/s");
  double across[2];
  assert_true(fg_field_velocity(field, (double[]){-0.5, 45.5}, across));
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(every_kind_of_file_reads_the_same),
      CASE(any_order_of_dimensions_is_read),
      CASE(winds_on_the_sphere_are_recognised),
      CASE(groups_are_searched),
      CASE(only_possible_requests_are_met),
      CASE(files_without_vectors_say_so),
      CASE(inventories_tell_what_reading_gives),
      CASE(inventories_tell_times_and_levels),
      CASE(the_usual_level_is_the_seas_surface),
      CASE(single_coordinates_tell_time_and_level),
      CASE(the_demonstration_file_is_read),
  };
  return cmocka_run_group_tests_name("read/netcdf/netcdf", tests, NULL, NULL);
}
