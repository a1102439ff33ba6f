/* Speeds and directions: their components are those that a file of components has, on
 * every kind of grid. */
#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

#include <math.h>

#define RADIANS 0.017453292519943295

enum { NX = 5, NY = 4, COUNT = NX * NY, NO_SPEED = 7, NO_DIRECTION = 12 };

typedef enum places { ON_AXES, ON_A_CURVED_GRID, AT_POINTS } places;

/* How a file writes a flow: a direction in `unit` radians to where it goes (sense 1) or
 * from where it comes (-1); 0: as components. */
typedef struct written {
  places at;
  int sense;
  double unit;
  const char *units, *speed, *direction; /* and standard names */
} written;

static const char WIND[] = "wind_speed", FROM[] = "wind_from_direction";

/* The flow turns through all quarters, and is slow at one place. */
static void flow_of(double out[2], int n)
{
  static const double east[] = {3.0, -2.0, -4.0, 5.0, 0.25, 0.0},
                      north[] = {2.0, 6.0, -1.5, -3.0, 0.5, -2.0, 7.0};
  out[0] = east[n % 6] + 0.125 * n;
  out[1] = north[n % 7];
}

static double direction_of(const double flow[2], const written *how)
{
  double turn = atan2(how->sense * flow[0], how->sense * flow[1]);
  turn += turn < 0.0 ? 2.0 * acos(-1.0) : 0.0;
  return turn / how->unit;
}

static void define_places(sample_file *f, places at, int dimension[2])
{
  double x[COUNT], y[COUNT];
  for (int n = 0; n < COUNT; ++n) {
    const double i = n % NX, j = NY - 1 - n / NX; /* latitudes descend */
    const double bend = at == ON_A_CURVED_GRID ? 0.3 : 0.0;
    x[n] = 10.0 + i + bend * j;
    y[n] = 50.0 + j - bend * i;
  }
  if (at == ON_AXES) {
    for (int j = 0; j < NY; ++j)
      y[j] = y[NX * j];
    dimension[0] = sample_axis(f, "lat", NY, y, "degrees_north");
    dimension[1] = sample_axis(f, "lon", NX, x, "degrees_east");
    return;
  }
  dimension[0] = sample_dimension(f, at == AT_POINTS ? "station" : "j",
                                  at == AT_POINTS ? COUNT : NY);
  if (at != AT_POINTS)
    dimension[1] = sample_dimension(f, "i", NX);
  for (int k = 0; k < 2; ++k) {
    const int id = sample_variable(f, k == 0 ? "lon" : "lat", NC_DOUBLE,
                                   at == AT_POINTS ? 1 : 2, dimension);
    sample_text(f, id, "units", k == 0 ? "degrees_east" : "degrees_north");
    sample_put(f, id, k == 0 ? x : y);
  }
}

static int add_variable(sample_file *f, const written *how, const int *dimension, int k)
{
  static const char *const components[] = {"eastward_wind", "northward_wind"};
  const char *standard = how->sense == 0 ? components[k]
                         : k == 0        ? how->speed
                                         : how->direction;
  const int id = sample_variable(f,
                                 how->sense == 0 ? (k == 0 ? "u" : "v")
                                 : k == 0        ? "ws"
                                                 : "wd",
                                 NC_DOUBLE, how->at == AT_POINTS ? 1 : 2, dimension);
  sample_text(f, id, "units", how->sense != 0 && k == 1 ? how->units : "m s-1");
  sample_text(f, id, "coordinates", "lon lat");
  sample_number(f, id, "_FillValue", NC_DOUBLE, -9999.0);
  if (standard)
    sample_text(f, id, "standard_name", standard);
  return id;
}

static void add_flow(sample_file *f, const written *how, const int *dimension)
{
  double value[2][COUNT];
  for (int n = 0; n < COUNT; ++n) {
    double flow[2];
    flow_of(flow, n);
    value[0][n] = how->sense ? hypot(flow[0], flow[1]) : flow[0];
    value[1][n] = how->sense ? direction_of(flow, how) : flow[1];
  }
  value[0][NO_SPEED] = value[1][NO_DIRECTION] = -9999.0;
  for (int k = 0; k < 2; ++k)
    sample_put(f, add_variable(f, how, dimension, k), value[k]);
}

static void write_file(sample_file *f, const written *how)
{
  int dimension[2];
  sample_begin(f, NC_NETCDF4);
  define_places(f, how->at, dimension);
  add_flow(f, how, dimension);
  sample_end(f);
}

/* Both are missing at the same samples and have the same vectors elsewhere. */
static void assert_alike(const fg_field *field, const fg_field *other)
{
  const fg_field_arrays *a = fg_field_contents(field), *b = fg_field_contents(other);
  size_t known = 0;
  assert_int_equal(a->scale, FG_SCALE_GEO);
  assert_true(a->size[0] == b->size[0] && a->size[1] == b->size[1]);
  for (int n = 0; n < a->size[0] * a->size[1]; ++n) {
    assert_true(!a->valid == !b->valid && (!a->valid || a->valid[n] == b->valid[n]));
    for (int k = 0; k < 2 && (!a->valid || a->valid[n]); ++k, ++known)
      if (!(fabsf(a->velocity[k][n] - b->velocity[k][n]) < 1e-5f))
        fail_msg("%d: %g instead of %g", n, (double)a->velocity[k][n],
                 (double)b->velocity[k][n]);
  }
  assert_true(known > 2 * (COUNT / 2));
}

static void they_are_read_as_components(void **state)
{
  static const struct {
    written how;
    const char *vars;
  } same[] = {
      {{ON_AXES, -1, RADIANS, "degree", WIND, FROM}, NULL},
      {{ON_AXES, -1, RADIANS, "degrees", WIND, FROM}, "wd,ws"},
      {{ON_AXES, 1, RADIANS, "degree", WIND, "wind_to_direction"}, NULL},
      {{ON_AXES, 1, 1.0, "radian", "sea_water_speed", "sea_water_velocity_to_direction"},
       NULL},
      {{ON_AXES, -1, 1.0, "rad", "sea_water_speed", "sea_water_velocity_from_direction"},
       NULL},
      {{ON_AXES, 1, RADIANS, "degree", "sea_water_speed",
        "direction_of_sea_water_velocity"},
       "ws,wd"},
      {{ON_AXES, -1, RADIANS, "degrees true", NULL, NULL}, NULL},
      {{ON_AXES, -1, 1.0, "radians", NULL, NULL}, "wd,ws"},
      {{ON_AXES, -1, RADIANS, "degree", "sea_surface_wave_significant_height",
        "sea_surface_wave_from_direction"},
       "ws,wd"},
      {{ON_A_CURVED_GRID, -1, RADIANS, "degree", WIND, FROM}, NULL},
      {{ON_A_CURVED_GRID, 1, 1.0, "rad", WIND, "wind_to_direction"}, "ws,wd"},
      {{AT_POINTS, -1, RADIANS, "degree", WIND, FROM}, NULL},
      {{AT_POINTS, 1, 1.0, "rad", WIND, "wind_to_direction"}, "ws,wd"},
  };
  sample_file *f = *state;
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    write_file(f, &(written){.at = same[i].how.at});
    fg_field *components = read_with(f, NULL);
    write_file(f, &same[i].how);
    fg_field *field = read_with(f, &(fg_read_options){.vars = same[i].vars});
    assert_alike(field, components);
    assert_string_equal(fg_field_contents(field)->velocity_units, "m/s");
    fg_field_destroy(components);
    fg_field_destroy(field);
  }
}

/* The speed may lie in one file, the direction in another. */
static void they_may_lie_in_two_files(void **state)
{
  static const written how = {ON_AXES, -1, RADIANS, "degree", WIND, FROM};
  sample_file *f = *state;
  sample_file second = *f;
  write_file(f, &(written){.at = ON_AXES});
  fg_field *components = read_with(f, NULL);
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  write_file(&second, &how);
  nc_must(nc_open(second.path, NC_WRITE, &second.id));
  nc_must(nc_redef(second.id));
  nc_must(nc_rename_var(second.id, 2, "other"));
  nc_must(nc_del_att(second.id, 2, "standard_name"));
  sample_end(&second);
  write_file(f, &how);
  nc_must(nc_open(f->path, NC_WRITE, &f->id));
  nc_must(nc_redef(f->id));
  nc_must(nc_rename_var(f->id, 3, "other"));
  nc_must(nc_del_att(f->id, 3, "standard_name"));
  sample_end(f);
  fg_field *field = read_with(f, &(fg_read_options){.vars_from = second.path});
  assert_alike(field, components);
  fg_field_destroy(components);
  fg_field_destroy(field);
  unlink(second.path);
}

static void assert_first(sample_file *f, int count, const char *name, const char *frame)
{
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), count);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(v->name[0], name);
  if (frame && (!v->frame || !strstr(v->frame, frame)))
    fail_msg("\"%s\" lacks \"%s\"", v->frame ? v->frame : "", frame);
  fg_inventory_destroy(inventory);
}

/* An inventory tells the rule; components of a velocity in the same file go first. */
static void components_go_first(void **state)
{
  static const char *const rules[] = {
      "from where it comes, in degrees clockwise from north: standard_name "
      "wind_from_direction",
      "to where it goes, in radians clockwise from north: standard_name "
      "wind_to_direction"};
  sample_file *f = *state;
  for (int at = ON_AXES; at <= AT_POINTS; ++at)
    for (int goes = 0; goes < 2; ++goes) {
      const written how = {.at = (places)at,
                           .sense = goes ? 1 : -1,
                           .unit = goes ? 1.0 : RADIANS,
                           .units = goes ? "rad" : "degree",
                           .speed = WIND,
                           .direction = goes ? "wind_to_direction" : FROM};
      int dimension[2];
      write_file(f, &how);
      assert_first(f, 1, "ws", rules[goes]);
      sample_begin(f, NC_NETCDF4);
      define_places(f, how.at, dimension);
      add_flow(f, &how, dimension);
      add_flow(f, &(written){.at = how.at}, dimension);
      sample_end(f);
      assert_first(f, 2, "u", NULL);
      fg_field *field = read_with(f, NULL);
      assert_string_equal(fg_field_contents(field)->velocity_name[0], "u");
      fg_field_destroy(field);
    }
}

/* Winds at several heights: names with the same number belong together. */
static void heights_are_told_apart(void **state)
{
  static const char *const names[][2] = {{"ws10", "wd10"}, {"ws100", "wd100"}};
  sample_file *f = *state;
  int dimension[2];
  char found[128] = "";
  sample_begin(f, 0);
  define_places(f, ON_AXES, dimension);
  for (int k = 0; k < 2; ++k)
    for (int n = 0; n < 2; ++n) {
      const int height = k == 0 ? 1 - n : n;
      const int id = sample_variable(f, names[height][k], NC_FLOAT, 2, dimension);
      sample_text(f, id, "units", k == 0 ? "m s-1" : "degree");
      sample_text(f, id, "standard_name", k == 0 ? WIND : FROM);
    }
  sample_end(f);
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  for (int i = 0; i < fg_inventory_vector_count(inventory); ++i) {
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, i);
    snprintf(found + strlen(found), sizeof found - strlen(found), "%s,%s;", v->name[0],
             v->name[1]);
  }
  fg_inventory_destroy(inventory);
  assert_string_equal(found, "ws100,wd100;ws10,wd10;");
}

static void what_cannot_be_turned_is_refused(void **state)
{
  static const written degrees = {ON_AXES, -1, RADIANS, "degree", WIND, FROM},
                       gon = {ON_AXES, -1, RADIANS, "gon", WIND, FROM},
                       unnamed = {ON_AXES, -1, RADIANS, "degree", NULL, NULL};
  sample_file *f = *state;
  int dimension[2];
  write_file(f, &gon);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED,
              "the direction 'wd' is not in degrees or radians");
  write_file(f, &degrees);
  refuse_with(f, &(fg_read_options){.frame = FG_FRAME_GRID}, FG_STATUS_UNSUPPORTED,
              "'wd' is a direction from north, not from the grid's lines");
  sample_begin(f, 0);
  define_places(f, ON_AXES, dimension);
  add_variable(f, &unnamed, dimension, 1);
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "no vectors found");
  assert_string_equal(fg_context_hint(f->context),
                      "name the speed with its direction: --vars SPEED,wd");
  for (int rotated = 1; rotated >= 0; --rotated) {
    const char *units = rotated ? "degrees" : "km";
    sample_begin(f, 0);
    dimension[0] = sample_axis(f, "y", NY, (double[]){0, 1, 2, 3}, units);
    dimension[1] = sample_axis(f, "x", NX, (double[]){0, 1, 2, 3, 4}, units);
    for (int k = 0; k < 2 && rotated; ++k)
      sample_text(f, k, "standard_name", k == 0 ? "grid_latitude" : "grid_longitude");
    add_flow(f, &degrees, dimension);
    const int height = sample_variable(f, "hs", NC_FLOAT, 2, dimension);
    sample_text(f, height, "units", "m");
    sample_end(f);
    refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "where north lies on its grid is not");
  }
  refuse_with(f, &(fg_read_options){.vars = "hs,wd"}, FG_STATUS_UNSUPPORTED,
              "where north lies on its grid is not");
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(they_are_read_as_components),
      CASE(they_may_lie_in_two_files),
      CASE(components_go_first),
      CASE(heights_are_told_apart),
      CASE(what_cannot_be_turned_is_refused),
  };
  return cmocka_run_group_tests_name("read/netcdf/polar", tests, NULL, NULL);
}
