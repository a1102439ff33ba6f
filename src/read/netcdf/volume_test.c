/* Fields in 3D from NetCDF, and pairs that stay a plane. */
#include <math.h>

#include "read/netcdf/sample_example.h"

enum { NX = 5, NY = 4, NZ = 3, NT = 2, COUNT = NX * NY * NZ };

static const double X[NX] = {1.5, 2.0, 4.0, 4.5, 7.0};
static const double Y[NY] = {-3.0, -1.0, 0.5, 0.75};
static const double Z[NZ] = {10.0, 10.5, 12.0};
static const char *const NAMES[3] = {"u", "v", "w"};

/* Different for every index, so that swapped indices show. */
static double value_of(int component, double x, double y, double z, int t)
{
  return 1.0 + component + (component + 1) * x - 0.5 * y + 20.0 * z * (component - 1) +
         1000.0 * t;
}

typedef struct description {
  const char *names[3];
  const char *axis_names[3];
  const char *axis_units[3];
  const char *units;
  int order[3]; /* the axes from slow to fast */
  bool down;    /* z descends */
  const char *positive;
} description;

static const description PLAIN = {.names = {"u", "v", "w"},
                                  .axis_names = {"x", "y", "z"},
                                  .axis_units = {"m", "m", "m"},
                                  .units = "m/s",
                                  .order = {2, 1, 0}};

static void write_values(const sample_file *f, int variable, int component,
                         const description *d)
{
  static const int size[3] = {NX, NY, NZ};
  double values[NT * COUNT];
  size_t n = 0;
  int at[3];
  for (int t = 0; t < NT; ++t)
    for (int a = 0; a < size[d->order[0]]; ++a)
      for (int b = 0; b < size[d->order[1]]; ++b)
        for (int c = 0; c < size[d->order[2]]; ++c) {
          at[d->order[0]] = a;
          at[d->order[1]] = b;
          at[d->order[2]] = c;
          double z = Z[d->down ? NZ - 1 - at[2] : at[2]];
          values[n++] = value_of(component, X[at[0]], Y[at[1]], z, t);
        }
  sample_put(f, variable, values);
}

/* variables[k] are the ids of the components. */
static void write_file(sample_file *f, const description *d, int variables[3])
{
  static const int size[3] = {NX, NY, NZ};
  const double descending[NZ] = {Z[2], Z[1], Z[0]};
  const double *coordinate[3] = {X, Y, d->down ? descending : Z};
  int dimension[4], axis[3];
  sample_begin(f, NC_NETCDF4 | NC_CLASSIC_MODEL);
  dimension[0] = sample_axis(f, "time", NT, (const double[]){0.0, 6.0},
                             "hours since 2014-01-31 00:00");
  for (int k = 0; k < 3; ++k)
    axis[k] = sample_axis(f, d->axis_names[k], (size_t)size[k], coordinate[k],
                          d->axis_units[k]);
  if (d->positive) {
    int id;
    nc_must(nc_inq_varid(f->id, d->axis_names[2], &id));
    sample_text(f, id, "positive", d->positive);
  }
  for (int k = 0; k < 3; ++k)
    dimension[k + 1] = axis[d->order[k]];
  for (int k = 0; k < 3 && d->names[k]; ++k) {
    variables[k] = sample_variable(f, d->names[k], NC_FLOAT, 4, dimension);
    if (d->units)
      sample_text(f, variables[k], "units", d->units);
    sample_number(f, variables[k], "_FillValue", NC_FLOAT, -999.0);
    write_values(f, variables[k], k, d);
  }
}

static void make_file(sample_file *f, const description *d)
{
  int variables[3] = {0};
  write_file(f, d, variables);
  sample_end(f);
}

static void assert_volume(const fg_field *field, int t)
{
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->dimension, 3);
  assert_true(a->size[0] == NX && a->size[1] == NY && a->size[2] == NZ);
  assert_memory_equal(a->axis[0], X, sizeof X);
  assert_memory_equal(a->axis[1], Y, sizeof Y);
  assert_memory_equal(a->axis[2], Z, sizeof Z);
  for (int n = 0; n < COUNT; ++n)
    for (int c = 0; c < 3; ++c) {
      double v = value_of(c, X[n % NX], Y[n / NX % NY], Z[n / NX / NY], t);
      assert_true(fabs((double)a->velocity[c][n] - v) < 1e-3);
    }
}

static void three_components_are_a_volume(void **state)
{
  sample_file *f = *state;
  make_file(f, &PLAIN);
  fg_field *field = read_with(f, &(fg_read_options){.time = 1});
  assert_volume(field, 1);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_string_equal(a->velocity_name[2], "w");
  assert_string_equal(a->velocity_units, "m/s");
  assert_string_equal(a->axis_name[2], "z");
  assert_string_equal(a->axis_units[2], "m");
  assert_non_null(a->time);
  assert_null(a->level);
  assert_true(a->scale == FG_SCALE_MAP);
  fg_field_destroy(field);
}

static void any_order_of_axes_is_read(void **state)
{
  static const int orders[][3] = {{2, 1, 0}, {2, 0, 1}, {1, 2, 0},
                                  {0, 1, 2}, {1, 0, 2}, {0, 2, 1}};
  for (size_t i = 0; i < 6; ++i)
    for (int down = 0; down < 2; ++down) {
      description d = PLAIN;
      memcpy(d.order, orders[i], sizeof d.order);
      d.down = down;
      make_file(*state, &d);
      fg_field *field = read_with(*state, NULL);
      assert_volume(field, 0);
      fg_field_destroy(field);
    }
}

static void names_of_three_are_known(void **state)
{
  static const char *const names[][3] = {{"vx", "vy", "vz"},
                                         {"U_x", "U_y", "U_z"},
                                         {"UWND", "VWND", "WWND"},
                                         {"velocity_u", "velocity_v", "velocity_w"}};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    description d = PLAIN;
    memcpy(d.names, names[i], sizeof d.names);
    make_file(*state, &d);
    fg_field *field = read_with(*state, NULL);
    assert_volume(field, 0);
    fg_field_destroy(field);
  }
}

static void an_upward_velocity_is_the_third(void **state)
{
  sample_file *f = *state;
  description d = PLAIN;
  int variables[3] = {0};
  d.names[2] = "lift";
  write_file(f, &d, variables);
  sample_text(f, variables[2], "standard_name", "upward_air_velocity");
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  assert_volume(field, 0);
  fg_field_destroy(field);
}

/* The plane of one level, as a file with two components gives it. */
static void assert_plane(sample_file *f, const fg_read_options *options, int level)
{
  fg_field *field = read_with(f, options);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_int_equal(a->dimension, 2);
  for (int n = 0; n < NX * NY; ++n)
    for (int c = 0; c < 2; ++c) {
      double v = value_of(c, X[n % NX], Y[n / NX], Z[level], 0);
      assert_true(fabs((double)a->velocity[c][n] - v) < 1e-3);
    }
  fg_field_destroy(field);
}

static void what_leaves_a_doubt_stays_a_plane(void **state)
{
  static const char *const no_names[3] = {"u", "v", "q"};
  static const char *const degrees[3] = {"degrees_east", "degrees_north", "m"};
  static const char *const pressure[3] = {"m", "m", "hPa"};
  description d[5] = {PLAIN, PLAIN, PLAIN, PLAIN, PLAIN};
  memcpy(d[0].names, no_names, sizeof no_names);
  d[1].names[2] = NULL;
  memcpy(d[2].axis_units, degrees, sizeof degrees);
  memcpy(d[3].axis_units, pressure, sizeof pressure);
  d[4].positive = "down";
  for (int i = 0; i < 5; ++i) {
    make_file(*state, &d[i]);
    assert_plane(*state, &(fg_read_options){.level = 2}, 2);
    assert_plane(*state, NULL, 0);
  }
}

static void a_map_is_read_by_levels(void **state)
{
  sample_file *f = *state;
  int variables[3] = {0}, id;
  write_file(f, &PLAIN, variables);
  nc_must(nc_inq_varid(f->id, "x", &id));
  sample_text(f, id, "standard_name", "projection_x_coordinate");
  sample_end(f);
  assert_plane(f, &(fg_read_options){.level = 1}, 1);
  fg_field *field = read_with(f, &(fg_read_options){.vars = "u,v,w"});
  assert_volume(field, 0);
  fg_field_destroy(field);
}

static void a_third_of_other_units_or_places_is_none(void **state)
{
  sample_file *f = *state;
  description d = PLAIN;
  int variables[3] = {0}, dimension[4] = {0};
  write_file(f, &d, variables);
  sample_text(f, variables[2], "units", "Pa/s");
  sample_end(f);
  assert_plane(f, &(fg_read_options){.level = 1}, 1);
  refuse_with(f, &(fg_read_options){.vars = "u,v,w"}, FG_STATUS_UNSUPPORTED,
              "'u' and 'w' differ in units");

  d.names[2] = NULL;
  write_file(f, &d, variables);
  nc_must(nc_inq_vardimid(f->id, variables[0], dimension));
  dimension[1] =
      sample_axis(f, "z_w", NZ + 1, (const double[]){9.0, 10.2, 11.0, 13.0}, "m");
  variables[2] = sample_variable(f, "w", NC_FLOAT, 4, dimension);
  sample_text(f, variables[2], "units", "m/s");
  sample_end(f);
  assert_plane(f, NULL, 0);
  refuse_with(f, &(fg_read_options){.vars = "u,v,w"}, FG_STATUS_UNSUPPORTED,
              "a staggered grid");
}

static void names_choose_between_plane_and_volume(void **state)
{
  sample_file *f = *state;
  make_file(f, &PLAIN);
  assert_plane(f, &(fg_read_options){.vars = "u,v", .level = 1}, 1);
  refuse_with(f, &(fg_read_options){.level = 1}, FG_STATUS_ARGUMENT,
              "three components and all 3 levels");
  assert_non_null(strstr(fg_context_hint(f->context), "--vars U,V"));
  refuse_with(f, &(fg_read_options){.vars = "u,v,u"}, FG_STATUS_ARGUMENT,
              "two components are 'u'");
  refuse_with(f, &(fg_read_options){.vars = "u,v,omega"}, FG_STATUS_ARGUMENT, "omega");
  static const char *const wrong[] = {"u", "u,", ",v", "u,v,", "u,,w", "u,v,w,x,y", ","};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i)
    refuse_with(f, &(fg_read_options){.vars = wrong[i]}, FG_STATUS_ARGUMENT,
                "two or three ");
}

static void spheres_have_no_volume_yet(void **state)
{
  sample_file *f = *state;
  description d = PLAIN;
  d.axis_units[0] = "degrees_east";
  d.axis_units[1] = "degrees_north";
  make_file(f, &d);
  refuse_with(f, &(fg_read_options){.vars = "u,v,w"}, FG_STATUS_UNSUPPORTED,
              "longitude, latitude and height");
  assert_non_null(strstr(fg_context_hint(f->context), "--scale plain"));
  fg_field *field =
      read_with(f, &(fg_read_options){.vars = "u,v,w", .scale = FG_SCALE_PLAIN});
  assert_volume(field, 0);
  fg_field_destroy(field);
}

static void holes_and_masks_cut_the_volume(void **state)
{
  sample_file *f = *state;
  int variables[3] = {0}, dimension[4] = {0};
  write_file(f, &PLAIN, variables);
  sample_write(f);
  const size_t at[4] = {0, 1, 2, 3};
  nc_must(nc_put_var1_double(f->id, variables[2], at, &(double){-999.0}));
  nc_must(nc_inq_vardimid(f->id, variables[0], dimension));
  int mask = sample_variable(f, "sea", NC_BYTE, 2, dimension + 2);
  double inside[NX * NY];
  for (int n = 0; n < NX * NY; ++n)
    inside[n] = n != 4;
  sample_put(f, mask, inside);
  sample_end(f);
  fg_field *field = read_with(f, &(fg_read_options){.mask = "sea"});
  const fg_field_arrays *a = fg_field_contents(field);
  for (int n = 0; n < COUNT; ++n) {
    bool missing = n % (NX * NY) == 4 || n == (1 * NY + 2) * NX + 3;
    for (int c = 0; c < 3; ++c)
      assert_true(isnan(a->velocity[c][n]) == missing);
  }
  fg_field_destroy(field);
}

static void an_inventory_tells_of_the_volume(void **state)
{
  sample_file *f = *state;
  fg_inventory *inventory = NULL;
  make_file(f, &PLAIN);
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 1);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  assert_int_equal(v->dimension, 3);
  assert_int_equal(v->components, 3);
  for (int k = 0; k < 3; ++k)
    assert_string_equal(v->name[k], NAMES[k]);
  assert_true(v->size[0] == NX && v->size[1] == NY && v->size[2] == NZ);
  assert_true(v->bounds[4] == 10.0 && v->bounds[5] == 12.0);
  assert_int_equal(v->times, NT);
  assert_int_equal(v->levels, 1);
  fg_inventory_destroy(inventory);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(three_components_are_a_volume),
      CASE(any_order_of_axes_is_read),
      CASE(names_of_three_are_known),
      CASE(an_upward_velocity_is_the_third),
      CASE(what_leaves_a_doubt_stays_a_plane),
      CASE(a_map_is_read_by_levels),
      CASE(a_third_of_other_units_or_places_is_none),
      CASE(names_choose_between_plane_and_volume),
      CASE(spheres_have_no_volume_yet),
      CASE(holes_and_masks_cut_the_volume),
      CASE(an_inventory_tells_of_the_volume),
  };
  return cmocka_run_group_tests_name("read/netcdf/volume", tests, NULL, NULL);
}
