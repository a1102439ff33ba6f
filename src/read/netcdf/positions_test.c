/* Points of a grid that have no position. */
#include "read/netcdf/model_example.h"

#include "flowgrain/inventory.h"

enum { LEFT_OUT = 8 };

/* NEMO leaves out subdomains that are land all over: positions and components are 0
 * there. */
static void repeated_positions_are_none(void **state)
{
  static const struct {
    const char *name, *attribute, *value;
    quantity what;
  } variables[] = {{"nav_lon", "units", "degrees_east", LONGITUDE},
                   {"nav_lat", "units", "degrees_north", LATITUDE},
                   {"uo", "standard_name", "eastward_sea_water_velocity", EAST},
                   {"vo", "standard_name", "northward_sea_water_velocity", NORTH}};
  sample_file *f = *state;
  sample_begin(f, 0);
  const int plane[2] = {sample_dimension(f, "y", ROWS),
                        sample_dimension(f, "x", COLUMNS)};
  for (int k = 0; k < 4; ++k) {
    double values[ROWS * COLUMNS];
    const int id = sample_variable(f, variables[k].name, NC_DOUBLE, 2, plane);
    sample_text(f, id, variables[k].attribute, variables[k].value);
    for (int n = 0; n < ROWS * COLUMNS; ++n)
      values[n] = n % COLUMNS < LEFT_OUT && n / COLUMNS < LEFT_OUT
                      ? 0.0
                      : value_of(variables[k].what, n % COLUMNS, n / COLUMNS);
    sample_put(f, id, values);
  }
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  assert_flow(field, 200);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_true(a->axis[1][0] > 30.0); /* the least latitude of the others */
  fg_field_destroy(field);
  fg_inventory *inventory;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_float_equal(fg_inventory_vector_at(inventory, 0)->missing_share,
                     (double)(LEFT_OUT * LEFT_OUT) / (ROWS * COLUMNS), 1e-6);
  fg_inventory_destroy(inventory);
}

/* A file cut out of COSMO's or CORDEX', without the rotated pole: the longitudes and
 * latitudes of the points tell where they are. */
static void positions_stand_for_a_rotated_pole(void **state)
{
  static const struct {
    const char *name, *attribute, *value;
    quantity what;
  } variables[] = {{"lon", "units", "degrees_east", LONGITUDE},
                   {"lat", "units", "degrees_north", LATITUDE},
                   {"U_10M", "units", "m s-1", ALONG_I},
                   {"V_10M", "units", "m s-1", ALONG_J}};
  sample_file *f = *state;
  for (int named = 0; named < 2; ++named) {
    double axis[ROWS + COLUMNS];
    for (int n = 0; n < ROWS + COLUMNS; ++n)
      axis[n] = STEP * (n - 10);
    sample_begin(f, 0);
    const int plane[2] = {sample_axis(f, "rlat", ROWS, axis, "degrees"),
                          sample_axis(f, "rlon", COLUMNS, axis, "degrees")};
    for (int k = 0; k < 2 && named; ++k) {
      int id;
      nc_must(nc_inq_varid(f->id, k ? "rlon" : "rlat", &id));
      sample_text(f, id, "standard_name", k ? "grid_longitude" : "grid_latitude");
    }
    for (int k = 0; k < 4; ++k) {
      double values[ROWS * COLUMNS];
      const int id = sample_variable(f, variables[k].name, NC_DOUBLE, 2, plane);
      sample_text(f, id, variables[k].attribute, variables[k].value);
      for (int n = 0; n < ROWS * COLUMNS; ++n)
        values[n] = value_of(variables[k].what, n % COLUMNS, n / COLUMNS);
      sample_put(f, id, values);
    }
    sample_end(f);
    assert_frame(f, "along the grid, turned by its positions (its axes are a plane's)");
    fg_field *field = read_with(f, NULL);
    assert_flow(field, 200);
    fg_field_destroy(field);
  }
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {CASE(repeated_positions_are_none),
                                     CASE(positions_stand_for_a_rotated_pole)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
