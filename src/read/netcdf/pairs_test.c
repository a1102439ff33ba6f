#include "interpret/interpret.h"
#include "read/netcdf/sample_example.h"

/* A variable of a file: name, standard name, units. */
typedef struct declared {
  const char *name, *standard_name, *units;
} declared;

enum { NX = 3, NY = 2 };

static void make(sample_file *f, const declared *variables, size_t count)
{
  static const double axis[NX] = {1.0, 2.0, 3.0};
  static const double values[NX * NY] = {1.0, 2.0, 3.0, 4.0, 5.0, 7.0};
  int all[2];
  sample_begin(f, NC_NETCDF4);
  all[0] = sample_axis(f, "lat", NY, axis, "degrees_north");
  all[1] = sample_axis(f, "lon", NX, axis, "degrees_east");
  for (size_t i = 0; i < count; ++i) {
    const int id = sample_variable(f, variables[i].name, NC_FLOAT, 2, all);
    if (variables[i].standard_name)
      sample_text(f, id, "standard_name", variables[i].standard_name);
    if (variables[i].units)
      sample_text(f, id, "units", variables[i].units);
    sample_put(f, id, values);
  }
  sample_end(f);
}

/* Reads the file's pairs as "u,v u10,v10". */
static void list(sample_file *f, char *out, size_t size)
{
  fg_inventory *inventory = NULL;
  if (fg_inventory_read(&inventory, f->context, f->path) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  size_t n = 0;
  out[0] = '\0';
  for (int i = 0; i < fg_inventory_vector_count(inventory) && n < size; ++i) {
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, i);
    n += (size_t)snprintf(out + n, size - n, "%s%s,%s", n > 0 ? " " : "", v->name[0],
                          v->name[1]);
  }
  fg_inventory_destroy(inventory);
}

static void assert_pairs(sample_file *f, const declared *variables, size_t count,
                         const char *wanted)
{
  char found[2048];
  make(f, variables, count);
  list(f, found, sizeof found);
  assert_string_equal(found, wanted);
}

static void what_only_resembles_a_vector_is_not_one(void **state)
{
  static const declared variables[] = {
      {"u_err", NULL, "1"},
      {"v_err", NULL, "1"},
      {"uerr", NULL, "m/s"},
      {"verr", NULL, "m/s"},
      {"ulon", NULL, "degrees_east"},
      {"vlon", NULL, "degrees_east"},
      {"x", NULL, "m"},
      {"y", NULL, "m"},
      {"dx", NULL, "m"},
      {"dy", NULL, "m"},
      {"pm", "inverse_of_cell_x_size", "meter-1"},
      {"pn", "inverse_of_cell_y_size", "meter-1"},
      {"a", "projection_x_coordinate", "m"},
      {"b", "projection_y_coordinate", "m"},
      {"q1", "eastward_wind status_flag", "1"},
      {"q2", "northward_wind status_flag", "1"},
      {"u2", NULL, NULL},
      {"w2", NULL, NULL},
  };
  assert_pairs(*state, variables, sizeof variables / sizeof *variables, "");
}

static void standard_names_are_paired(void **state)
{
  static const char *const names[][2] = {
      {"eastward_wind", "northward_wind"},
      {"x_wind", "y_wind"},
      {"grid_eastward_wind", "grid_northward_wind"},
      {"eastward_sea_water_velocity", "northward_sea_water_velocity"},
      {"sea_water_x_velocity", "sea_water_y_velocity"},
      {"sea_water_x_velocity_at_u_location", "sea_water_y_velocity_at_v_location"},
      {"surface_eastward_sea_water_velocity", "surface_northward_sea_water_velocity"},
      {"barotropic_eastward_sea_water_velocity",
       "barotropic_northward_sea_water_velocity"},
      {"surface_geostrophic_eastward_sea_water_velocity",
       "surface_geostrophic_northward_sea_water_velocity"},
      {"sea_surface_wave_stokes_drift_x_velocity",
       "sea_surface_wave_stokes_drift_y_velocity"},
      {"eastward_sea_ice_velocity", "northward_sea_ice_velocity"},
      {"sea_ice_x_velocity", "sea_ice_y_velocity"},
      {"surface_downward_eastward_stress", "surface_downward_northward_stress"},
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    const declared variables[] = {{"beta", names[i][1], "m/s"},
                                  {"alpha", names[i][0], "m/s"}};
    assert_pairs(*state, variables, 2, "alpha,beta");
  }
  /* lengths, which otherwise are places */
  static const declared drift[] = {{"dX", "sea_ice_x_displacement", "km"},
                                   {"dY", "sea_ice_y_displacement", "km"}};
  assert_pairs(*state, drift, 2, "dX,dY");
}

static void heights_of_one_standard_name_are_told_apart(void **state)
{
  static const declared variables[] = {{"u10", "eastward_wind", "m/s"},
                                       {"v10", "northward_wind", "m/s"},
                                       {"u100", "eastward_wind", "m/s"},
                                       {"v100", "northward_wind", "m/s"}};
  sample_file *f = *state;
  fg_field *field = NULL;
  assert_pairs(f, variables, 4, "u10,v10 u100,v100");
  assert_int_equal(fg_field_read(&field, f->context, f->path, NULL), FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), "u10,v10; u100,v100"));
  assert_non_null(strstr(fg_context_hint(f->context), "--vars"));
  fg_context_clear(f->context);
  const fg_read_options options = {.vars = "u100,v100"};
  assert_int_equal(fg_field_read(&field, f->context, f->path, &options), FG_STATUS_OK);
  assert_string_equal(fg_field_contents(field)->velocity_name[1], "v100");
  fg_field_destroy(field);
  const fg_read_options turned = {.vars = "v100,u100"};
  assert_int_equal(fg_field_read(&field, f->context, f->path, &turned),
                   FG_STATUS_ARGUMENT);
  assert_non_null(
      strstr(fg_context_message(f->context), "'v100' is the second component"));
  assert_string_equal(fg_context_hint(f->context), "--vars u100,v100");
}

static void read_first_name(sample_file *f, char *out, size_t size)
{
  fg_field *field = NULL;
  fg_context_clear(f->context);
  if (fg_field_read(&field, f->context, f->path, NULL) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(f->context));
  snprintf(out, size, "%s", fg_field_contents(field)->velocity_name[0]);
  fg_field_destroy(field);
}

/* Standard names take precedence over names, velocities over other vectors. */
static void the_better_evidence_wins(void **state)
{
  static const declared standard[] = {{"u", NULL, "m/s"},
                                      {"v", NULL, "m/s"},
                                      {"p", "eastward_wind", "m/s"},
                                      {"q", "northward_wind", "m/s"}};
  static const declared stress[] = {{"p", "surface_downward_eastward_stress", "Pa"},
                                    {"q", "surface_downward_northward_stress", "Pa"},
                                    {"u", NULL, "m/s"},
                                    {"v", NULL, "m/s"}};
  static const declared units[] = {{"tx", NULL, "N m-2"},
                                   {"ty", NULL, "N m-2"},
                                   {"u", NULL, "m/s"},
                                   {"v", NULL, "m/s"}};
  char name[32];
  make(*state, standard, 4);
  read_first_name(*state, name, sizeof name);
  assert_string_equal(name, "p");
  make(*state, stress, 4);
  read_first_name(*state, name, sizeof name);
  assert_string_equal(name, "u");
  make(*state, units, 4);
  read_first_name(*state, name, sizeof name);
  assert_string_equal(name, "u");
}

/* Arakawa's C grid: listed with the reason, and no other kind of vector replaces it. */
static void staggered_pairs_are_listed_as_unusable(void **state)
{
  sample_file *f = *state;
  static const double axis[4] = {1.0, 2.0, 3.0, 4.0};
  sample_begin(f, 0);
  const int y = sample_axis(f, "y", 3, axis, "m");
  const int y_v = sample_axis(f, "yv", 2, axis, "m");
  const int x = sample_axis(f, "x", 4, axis, "m");
  const int x_u = sample_axis(f, "xu", 3, axis, "m");
  sample_variable(f, "u", NC_FLOAT, 2, (int[]){y, x_u});
  sample_variable(f, "v", NC_FLOAT, 2, (int[]){y_v, x});
  const int stress[2] = {sample_variable(f, "taux", NC_FLOAT, 2, (int[]){y, x}),
                         sample_variable(f, "tauy", NC_FLOAT, 2, (int[]){y, x})};
  sample_text(f, stress[0], "units", "Pa m");
  sample_text(f, stress[1], "units", "Pa m");
  sample_end(f);
  fg_inventory *inventory = NULL;
  assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
  assert_int_equal(fg_inventory_vector_count(inventory), 2);
  const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
  assert_string_equal(v->name[0], "u");
  assert_non_null(v->unusable);
  assert_non_null(strstr(v->unusable, "'u' is 3 x 3, 'v' is 2 x 4"));
  assert_null(fg_inventory_vector_at(inventory, 1)->unusable);
  fg_inventory_destroy(inventory);
  fg_field *field = NULL;
  assert_int_equal(fg_field_read(&field, f->context, f->path, NULL),
                   FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(f->context), "staggered"));
}

/* Equal sizes at different places. */
static void places_matter_not_only_sizes(void **state)
{
  sample_file *f = *state;
  static const double axis[3] = {1.0, 2.0, 3.0};
  static const double shifted[3] = {1.5, 2.5, 3.5};
  sample_begin(f, 0);
  const int y = sample_axis(f, "y", 3, axis, "m");
  const int x = sample_axis(f, "x", 3, axis, "m");
  const int x_u = sample_axis(f, "xu", 3, shifted, "m");
  sample_variable(f, "u", NC_FLOAT, 2, (int[]){y, x_u});
  sample_variable(f, "v", NC_FLOAT, 2, (int[]){y, x});
  sample_end(f);
  fg_field *field = NULL;
  assert_int_equal(fg_field_read(&field, f->context, f->path, NULL),
                   FG_STATUS_UNSUPPORTED);
  assert_non_null(strstr(fg_context_message(f->context), "'xu'"));
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(what_only_resembles_a_vector_is_not_one),
      CASE(standard_names_are_paired),
      CASE(heights_of_one_standard_name_are_told_apart),
      CASE(the_better_evidence_wins),
      CASE(staggered_pairs_are_listed_as_unusable),
      CASE(places_matter_not_only_sizes),
  };
  return cmocka_run_group_tests_name("read/netcdf/pairs", tests, NULL, NULL);
}
