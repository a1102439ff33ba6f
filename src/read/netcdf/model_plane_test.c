/* The plane of a WRF grid, computed here by the projections' formulas: wind towards true
 * east, stored along the grid, must be read with the angle that they give to the plane's
 * axes. */
#include <math.h>

#include "base/context_test.h"
#include "map/map.h"
#include "read/netcdf/sample_example.h"

#define RADIANS 0.017453292519943295

enum { COLUMNS = 31, ROWS = 23, POINTS = COLUMNS * ROWS };

static const double SPEED = 10.0, SPACING = 40.0; /* km */

typedef struct model {
  int kind; /* MAP_PROJ */
  double parallel, meridian, latitude;
  const char *projection;
  const char *name;
  double cone; /* angle of east from x is cone * (longitude - meridian) */
} model;

static const model MODELS[] = {
    {1, 35.0, 100.0, 38.0,
     "+proj=lcc +lat_1=35 +lat_2=35 +lat_0=38 +lon_0=100 +R=6370000 +units=km",
     "+proj=lcc", 0.573576436351046},
    {1, -30.0, -60.0, -28.0,
     "+proj=lcc +lat_1=-30 +lat_2=-30 +lat_0=-28 +lon_0=-60 +R=6370000 +units=km",
     "+proj=lcc", -0.5},
    {2, 60.0, -45.0, 71.0,
     "+proj=stere +lat_0=90 +lat_ts=60 +lon_0=-45 +R=6370000 +units=km", "+proj=stere",
     1.0},
    {3, 20.0, 178.0, 24.0, "+proj=merc +lat_ts=20 +lon_0=178 +R=6370000 +units=km",
     "+proj=merc", 0.0},
};

static void put_variable(const sample_file *f, const char *name, const int dimensions[2],
                         const double *values, const char *units)
{
  const int id = sample_variable(f, name, NC_DOUBLE, 2, dimensions);
  sample_text(f, id, "units", units);
  sample_put(f, id, values);
}

static void put_number(const sample_file *f, const char *name, double value)
{
  nc_must(nc_put_att_double(f->id, NC_GLOBAL, name, NC_DOUBLE, 1, &value));
}

/* stand_lon: the attribute STAND_LON. */
static void write_model(sample_file *f, const model *m, double stand_lon)
{
  static double value[6][POINTS];
  static const char *const names[] = {"XLONG", "XLAT",     "U10",
                                      "V10",   "COSALPHA", "SINALPHA"};
  static const char *const units[] = {
      "degree_east", "degree_north", "m s-1", "m s-1", "", ""};
  fg__map *map;
  double middle[2];
  assert_int_equal(fg__map_create(&map, NULL, m->projection), FG_STATUS_OK);
  fg__map_forward(map, 1, &m->meridian, &m->latitude, &middle[0], &middle[1]);
  for (int n = 0; n < POINTS; ++n) {
    const double x = middle[0] + SPACING * (n % COLUMNS - 11);
    const double y = middle[1] + SPACING * (n / COLUMNS - 9);
    fg__map_inverse(map, 1, &x, &y, &value[0][n], &value[1][n]);
    const double off = m->cone * remainder(value[0][n] - m->meridian, 360.0) * RADIANS;
    value[2][n] = SPEED * cos(off);
    value[3][n] = SPEED * sin(off);
    value[4][n] = cos(off);
    value[5][n] = -sin(off);
    value[0][n] = remainder(value[0][n], 360.0);
  }
  fg__map_destroy(map);
  sample_begin(f, NC_CLASSIC_MODEL);
  const int plane[2] = {sample_dimension(f, "south_north", ROWS),
                        sample_dimension(f, "west_east", COLUMNS)};
  put_number(f, "MAP_PROJ", m->kind);
  put_number(f, "TRUELAT1", m->parallel);
  put_number(f, "TRUELAT2", m->parallel);
  put_number(f, "STAND_LON", stand_lon);
  put_number(f, "MOAD_CEN_LAT", m->latitude);
  for (int k = 0; k < 6; ++k)
    put_variable(f, names[k], plane, value[k], units[k]);
  sample_end(f);
}

static fg_field *read_on(const sample_file *f, const fg_map_options *map)
{
  fg_field *field;
  const fg_read_options options = {.map = map};
  assert_int_equal(fg_field_read(&field, f->context, f->path, &options), FG_STATUS_OK);
  return field;
}

static bool is_own(const fg_field *field)
{
  const char *projection = fg_field_contents(field)->projection;
  return projection && strstr(projection, "+R=6370000");
}

static void wind_is_turned_to_the_models_plane(void **state)
{
  static const fg_map_options automatic = {.samples = 120};
  sample_file *f = *state;
  for (size_t k = 0; k < sizeof MODELS / sizeof *MODELS; ++k) {
    const model *m = &MODELS[k];
    write_model(f, m, m->meridian);
    fg_field *field = read_on(f, &automatic);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_int_equal(a->scale, FG_SCALE_MAP);
    if (!is_own(field) || !strstr(a->projection, m->name))
      fail_msg("%s for %s", a->projection ? a->projection : "none", m->projection);
    /* the rectangle is the grid's */
    for (int i = 0; i < 2; ++i)
      assert_true(fabs(a->axis[i][a->size[i] - 1] - a->axis[i][0] -
                       SPACING * ((i ? ROWS : COLUMNS) - 1)) <
                  1.5 * (a->axis[i][1] - a->axis[i][0]));
    fg__map *map;
    int found = 0;
    assert_int_equal(fg__map_create(&map, NULL, a->projection), FG_STATUS_OK);
    for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
      double longitude, latitude;
      if (isnan(a->velocity[0][n]))
        continue;
      fg__map_inverse(map, 1, &a->axis[0][n % a->size[0]], &a->axis[1][n / a->size[0]],
                      &longitude, &latitude);
      const double off = m->cone * remainder(longitude - m->meridian, 360.0) * RADIANS;
      if (fabs(latitude) > 89.0) /* east is undefined at the pole */
        continue;
      ++found;
      assert_true(fabs((double)a->velocity[0][n] - SPEED * cos(off)) < 0.02 * SPEED);
      assert_true(fabs((double)a->velocity[1][n] - SPEED * sin(off)) < 0.02 * SPEED);
    }
    assert_true(found > 0.95 * a->size[0] * a->size[1]);
    fg_inventory *inventory;
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    assert_non_null(strstr(fg_map_auto(fg_inventory_vector_at(inventory, 0)), m->name));
    fg_inventory_destroy(inventory);
    fg__map_destroy(map);
    fg_field_destroy(field);
  }
}

static void codes_of_missing_data_are_refused(void **state)
{
  static const double code = -9999.0;
  static const size_t at[2] = {4, 7};
  sample_file *f = *state;
  write_model(f, &MODELS[0], MODELS[0].meridian);
  int id, variable;
  nc_must(nc_open(f->path, NC_WRITE, &id));
  for (int k = 0; k < 2; ++k) {
    nc_must(nc_inq_varid(id, k ? "V10" : "U10", &variable));
    nc_must(nc_put_var1_double(id, variable, at, &code));
  }
  nc_must(nc_close(id));
  refuse_with(f, NULL, FG_STATUS_FILE_FORMAT, "both components are -9999");
}

static void a_third_component_is_none_of_a_plane(void **state)
{
  sample_file *f = *state;
  write_model(f, &MODELS[0], MODELS[0].meridian);
  refuse_with(f, &(fg_read_options){.vars = "U10,V10,COSALPHA"}, FG_STATUS_UNSUPPORTED,
              "'COSALPHA' cannot be read with them");
}

/* The options of a centre, another projection or no map take precedence; a region cuts
 * the plane. */
static void other_maps_may_be_chosen(void **state)
{
  static const fg_map_options centred = {
      .has_center = true, .center = {95.0}, .samples = 40};
  static const fg_map_options named = {.projection = "laea", .samples = 40};
  static const fg_map_options none = {.projection = "none"};
  static const fg_map_options region = {
      .has_region = true, .region = {98.0, 104.0, 36.0, 40.0}, .samples = 40};
  sample_file *f = *state;
  write_model(f, &MODELS[0], MODELS[0].meridian);
  fg_field *field = read_on(f, &centred);
  assert_false(is_own(field));
  assert_non_null(strstr(fg_field_contents(field)->projection, "+lon_0=95"));
  fg_field_destroy(field);
  field = read_on(f, &named);
  assert_non_null(strstr(fg_field_contents(field)->projection, "+proj=laea"));
  fg_field_destroy(field);
  field = read_on(f, &none);
  assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_GEO);
  assert_null(fg_field_contents(field)->projection);
  fg_field_destroy(field);
  field = read_on(f, &region);
  assert_true(is_own(field));
  assert_true(fg_field_contents(field)->axis[0][0] > -4.0 * SPACING * 11.0);
  fg_field_destroy(field);
}

/* Attributes that contradict the positions, as in files joined from others, are
 * ignored. */
static void other_grids_planes_are_not_taken(void **state)
{
  static const fg_map_options automatic = {.samples = 40};
  sample_file *f = *state;
  for (size_t k = 0; k < 3; ++k) {
    write_model(f, &MODELS[k], MODELS[k].meridian + 12.0);
    fg_field *field = read_on(f, &automatic);
    assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_MAP);
    assert_false(is_own(field));
    fg_field_destroy(field);
  }
  model flat = MODELS[0];
  flat.kind = 6;
  write_model(f, &flat, flat.meridian);
  fg_field *field = read_on(f, &automatic);
  assert_false(is_own(field));
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(wind_is_turned_to_the_models_plane),
      CASE(other_maps_may_be_chosen),
      CASE(other_grids_planes_are_not_taken),
      CASE(a_third_component_is_none_of_a_plane),
      CASE(codes_of_missing_data_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
