/* Fields whose parts lie in two files. */
#include "read/netcdf/plain_example.h"

static void the_other_component_may_lie_in_a_second_file(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  int id[2];
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  make_plain(&second, NC_NETCDF4, NC_FLOAT, id);
  nc_must(nc_redef(second.id));
  nc_must(nc_rename_var(second.id, id[0], "salt"));
  sample_end(&second);
  make_plain(f, 0, NC_FLOAT, id);
  nc_must(nc_redef(f->id));
  nc_must(nc_rename_var(f->id, id[1], "temperature"));
  sample_end(f);
  refuse_with(f, NULL, FG_STATUS_UNSUPPORTED, "no vectors");
  const char *const vars[] = {NULL, "u,v"};
  for (int k = 0; k < 2; ++k) {
    const fg_read_options options = {.vars = vars[k], .vars_from = second.path};
    fg_field *field = read_with(f, &options);
    assert_samples(field, 0, 0);
    fg_field_destroy(field);
  }
  const fg_read_options nowhere = {.vars_from = "/nonexistent.nc"};
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, &nowhere),
                   FG_STATUS_FILE_ACCESS);
  unlink(second.path);
}

static void a_second_file_is_of_use_or_refused(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  double inside[COUNT];
  int id[2];
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  sample_begin(&second, 0);
  const int all[2] = {sample_axis(&second, "y", NY, Y, "km"),
                      sample_axis(&second, "x", NX, X, "km")};
  for (int i = 0; i < COUNT; ++i)
    inside[i] = i % 5 > 0;
  sample_put(&second, sample_variable(&second, "sea", NC_FLOAT, 2, all), inside);
  sample_end(&second);
  make_plain(f, 0, NC_FLOAT, id);
  sample_end(f);
  fg_read_options options = {.vars = "u,v", .vars_from = second.path};
  fg_field *field = NULL;
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, &options),
                   FG_STATUS_ARGUMENT);
  assert_null(field);
  assert_non_null(strstr(fg_context_message(f->context), "second.nc: gives no comp"));
  const fg_read_options twice = {.vars = "u,v", .vars_from = f->path};
  fg_context_clear(f->context);
  assert_int_equal(fg_field_read(&field, f->context, f->path, &twice),
                   FG_STATUS_ARGUMENT);
  assert_non_null(strstr(fg_context_message(f->context), "sample.nc: is given twice"));
  options.mask = "sea";
  field = read_with(f, &options);
  assert_int_equal(fg_field_contents(field)->valid[5], 0);
  fg_field_destroy(field);
  unlink(second.path);
}

/* Coordinates of the axes, along them or in a plane that they span, in a file for the
 * mesh. */
static void axes_may_lie_in_a_file_of_the_mesh(void **state)
{
  static const char *const names[] = {"lat", "lon"}, *const axes[] = {"y", "x"};
  static const char *const units[] = {"degrees_north", "degrees_east"};
  sample_file *f = *state;
  for (int plane = 0; plane < 2; ++plane) {
    double values[2][COUNT];
    sample_file other = *f;
    snprintf(other.path, sizeof other.path, "%s/mesh.nc", f->folder);
    sample_begin(&other, 0);
    int all[2] = {sample_dimension(&other, "y", NY), sample_dimension(&other, "x", NX)};
    for (int k = 0; k < 2; ++k) {
      const int id = sample_variable(&other, plane ? names[k] : axes[k], NC_DOUBLE,
                                     plane ? 2 : 1, plane ? all : &all[k]);
      sample_text(&other, id, "units", units[k]);
      for (int i = 0; i < COUNT; ++i)
        values[k][i] = k ? X[i % NX] : Y[plane ? i / NX : i % NY];
      sample_put(&other, id, values[k]);
    }
    sample_end(&other);
    sample_begin(f, 0);
    all[0] = sample_dimension(f, "y", NY);
    all[1] = sample_dimension(f, "x", NX);
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < COUNT; ++i)
        values[k][i] = (k ? v_of : u_of)(X[i % NX], Y[i / NX], 0, 0);
      sample_put(f, sample_variable(f, k ? "v" : "u", NC_FLOAT, 2, all), values[k]);
    }
    sample_end(f);
    fg_field *field = read_with(f, &(fg_read_options){.mesh_from = other.path});
    assert_int_equal(fg_field_contents(field)->scale, FG_SCALE_GEO);
    assert_memory_equal(fg_field_contents(field)->axis[0], X, sizeof X);
    assert_memory_equal(fg_field_contents(field)->axis[1], Y, sizeof Y);
    assert_samples(field, 0, 0);
    fg_field_destroy(field);
    unlink(other.path);
  }
}

enum { FACE_COLUMNS = 16, FACE_ROWS = 14, FACES = FACE_COLUMNS * FACE_ROWS };

/* A component of a solid rotation about 5 west, 47 north on a grid of 2 degrees, where
 * its sample (i, j) lies at (i + right, j + up) from 21 west, 33 north. */
typedef enum coordinates { LINES, PLANE, CURVED } coordinates;

static void make_component(sample_file *f, int k, double right, double up,
                           coordinates kind)
{
  const bool plane = kind != LINES;
  const double bend = kind == CURVED ? 0.5 : 0.0;
  static const char *const names[2][2] = {{"nav_lat", "nav_lon"}, {"y", "x"}};
  static const char *const units[] = {"degrees_north", "degrees_east"};
  static const char *const standard[] = {"sea_water_x_velocity", "sea_water_y_velocity"};
  double at[2][FACES], line[2][FACES], speed[FACES];
  for (int n = 0; n < FACES; ++n) {
    const double i = n % FACE_COLUMNS + right, j = n / FACE_COLUMNS + up;
    at[0][n] = 33.0 + 2.0 * j - bend * i;
    at[1][n] = -21.0 + 2.0 * i + bend * j;
    line[0][n] = 33.0 + 2.0 * (n + up);
    line[1][n] = -21.0 + 2.0 * (n + right);
    speed[n] = k == 0 ? -0.05 * (at[0][n] - 47.0) : 0.05 * (at[1][n] + 5.0);
  }
  sample_begin(f, 0);
  const int all[2] = {sample_dimension(f, "y", FACE_ROWS),
                      sample_dimension(f, "x", FACE_COLUMNS)};
  for (int c = 0; c < 2; ++c) {
    const int id = sample_variable(f, names[plane ? 0 : 1][c], NC_DOUBLE, plane ? 2 : 1,
                                   plane ? all : &all[c]);
    sample_text(f, id, "units", units[c]);
    sample_put(f, id, plane ? at[c] : line[c]);
  }
  const int id = sample_variable(f, k == 0 ? "uo" : "vo", NC_DOUBLE, 2, all);
  sample_text(f, id, "units", "m/s");
  sample_text(f, id, "standard_name", standard[k]);
  if (plane)
    sample_text(f, id, "coordinates", "nav_lat nav_lon");
  sample_put(f, id, speed);
  sample_end(f);
}

/* The rotation's components are linear in the coordinates, so what differs from them is
 * at a wrong place: half a cell is 0.05. */
static void assert_rotation(const fg_field *field, double tolerance)
{
  const fg_field_arrays *a = fg_field_contents(field);
  int found = 0;
  assert_int_equal(a->scale, FG_SCALE_GEO);
  for (int j = 0; j < a->size[1]; ++j)
    for (int i = 0; i < a->size[0]; ++i) {
      const int n = j * a->size[0] + i;
      if (isnan(a->velocity[0][n]))
        continue;
      ++found;
      const double u = -0.05 * (a->axis[1][j] - 47.0), v = 0.05 * (a->axis[0][i] + 5.0);
      assert_true(fabs((double)a->velocity[0][n] - u) < tolerance);
      assert_true(fabs((double)a->velocity[1][n] - v) < tolerance);
    }
  assert_true(found > FACES / 2);
}

/* NEMO's grid_U and grid_V on a regular grid: longitudes and latitudes could be axes, but
 * each component has those of its own faces. */
static void components_on_faces_in_two_files_meet_at_the_centres(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  for (int plane = 0; plane < 2; ++plane)
    for (int side = -1; side <= 1; side += 2) {
      const fg_read_options options = {.vars = "uo,vo", .vars_from = second.path};
      make_component(f, 0, 0.5 * side, 0.0, plane ? PLANE : LINES);
      make_component(&second, 1, 0.0, 0.5 * side, plane ? PLANE : LINES);
      fg_field *field = read_with(f, &options);
      assert_rotation(field, 5e-3);
      fg_field_destroy(field);
      fg_inventory *inventory;
      assert_int_equal(
          fg_inventory_read_chosen(&inventory, f->context, f->path, &options),
          FG_STATUS_OK);
      const char *frame = fg_inventory_vector_at(inventory, 0)->frame;
      assert_non_null(frame);
      assert_non_null(strstr(frame, "along the grid, turned by its positions"));
      fg_inventory_destroy(inventory);
    }
  unlink(second.path);
}

/* Where both have the same places, up to rounding, these are axes. */
static void components_at_the_same_places_in_two_files_stay_on_axes(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  const fg_read_options options = {.vars = "uo,vo", .vars_from = second.path};
  make_component(f, 0, 0.0, 0.0, PLANE);
  make_component(&second, 1, 1e-6, -1e-6, PLANE);
  fg_field *field = read_with(f, &options);
  assert_int_equal(fg_field_contents(field)->size[0], FACE_COLUMNS);
  assert_int_equal(fg_field_contents(field)->size[1], FACE_ROWS);
  assert_rotation(field, 1e-6);
  fg_field_destroy(field);
  unlink(second.path);
}

/* Half a cell apart is a staggered grid; more are two grids. */
static void components_of_different_regions_are_refused(void **state)
{
  static const double off[][2] = {{0.0, 0.0}, {30.0, 0.0}, {0.0, -12.0}, {1.5, 1.0}};
  sample_file *f = *state;
  sample_file second = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  const fg_read_options options = {.vars = "uo,vo", .vars_from = second.path};
  for (int kind = LINES; kind <= CURVED; ++kind)
    for (size_t n = 0; n < sizeof off / sizeof *off; ++n) {
      make_component(f, 0, 0.5, 0.0, (coordinates)kind);
      make_component(&second, 1, off[n][0], 0.5 + off[n][1], (coordinates)kind);
      if (n == 0)
        fg_field_destroy(read_with(f, &options));
      else
        refuse_with(f, &options, FG_STATUS_UNSUPPORTED,
                    "second.nc lie more than half a cell apart");
    }
  unlink(second.path);
}

/* The same in a plane whose axes are no degrees. */
static void faces_of_different_regions_are_refused(void **state)
{
  sample_file *f = *state;
  sample_file second = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  const fg_read_options options = {.vars = "u,v", .vars_from = second.path};
  for (int far = 0; far < 2; ++far) {
    sample_file *const file[] = {f, &second};
    for (int k = 0; k < 2; ++k) {
      double x[FACE_COLUMNS], y[FACE_ROWS];
      for (int n = 0; n < FACE_COLUMNS; ++n)
        x[n] = n + (k == 0 ? 0.5 : 40.0 * far);
      for (int n = 0; n < FACE_ROWS; ++n)
        y[n] = n + (k == 1 ? 0.5 : 0.0);
      sample_begin(file[k], 0);
      const int all[2] = {sample_axis(file[k], "y", FACE_ROWS, y, "km"),
                          sample_axis(file[k], "x", FACE_COLUMNS, x, "km")};
      double speed[FACES];
      for (int n = 0; n < FACES; ++n)
        speed[n] = 1.0 + k;
      sample_put(file[k], sample_variable(file[k], k ? "v" : "u", NC_DOUBLE, 2, all),
                 speed);
      sample_end(file[k]);
    }
    if (far)
      refuse_with(f, &options, FG_STATUS_UNSUPPORTED,
                  "second.nc lie more than half a cell apart");
    else
      fg_field_destroy(read_with(f, &options));
  }
  unlink(second.path);
}

enum { LEVELS = 3 };

/* NEMO's grid_U and grid_V at depths: each file has a name of its own for these. Speeds
 * are 1 + level; v's are doubled. */
static void make_layers(sample_file *f, int k, const double *depth)
{
  static const char *const names[] = {"depthu", "depthv"};
  static const char *const standard[] = {"sea_water_x_velocity", "sea_water_y_velocity"};
  double x[FACE_COLUMNS], y[FACE_ROWS], speed[LEVELS * FACES];
  for (int n = 0; n < FACE_COLUMNS; ++n)
    x[n] = -21.0 + 2.0 * (n + (k == 0 ? 0.5 : 0.0));
  for (int n = 0; n < FACE_ROWS; ++n)
    y[n] = 33.0 + 2.0 * (n + (k == 1 ? 0.5 : 0.0));
  for (int n = 0; n < LEVELS * FACES; ++n)
    speed[n] = (1.0 + k) * (1.0 + n / FACES);
  sample_begin(f, 0);
  const int all[3] = {sample_axis(f, names[k], LEVELS, depth, "m"),
                      sample_axis(f, "y", FACE_ROWS, y, "degrees_north"),
                      sample_axis(f, "x", FACE_COLUMNS, x, "degrees_east")};
  const int id = sample_variable(f, k == 0 ? "uo" : "vo", NC_DOUBLE, 3, all);
  sample_text(f, id, "units", "m/s");
  sample_text(f, id, "standard_name", standard[k]);
  sample_put(f, id, speed);
  sample_end(f);
}

/* The level of the options, or the sample of one's dimension, is that of both. */
static void levels_of_two_names_are_joined(void **state)
{
  static const double depth[LEVELS] = {0.5, 10.0, 100.0}, other[] = {0.5, 12.0, 100.0},
                      turned[] = {100.0, 10.0, 0.5};
  static const char *const at[] = {NULL,         "depthu=2",         "depthu=100m",
                                   "depthv=2",   "depthv=100.0",     "depthu=2,depthv=2",
                                   "depthu=1 m", "depthu=0,depthv=2"};
  enum { JOINED = 6, CHOICES = sizeof at / sizeof *at };
  sample_file *f = *state;
  sample_file second = *f;
  snprintf(second.path, sizeof second.path, "%s/second.nc", f->folder);
  make_layers(f, 0, depth);
  make_layers(&second, 1, depth);
  for (int n = 0; n < CHOICES; ++n) {
    const fg_read_options options = {
        .vars_from = second.path, .at = at[n], .level = at[n] ? 0 : 2};
    if (n >= JOINED) {
      refuse_with(f, &options, n == JOINED ? FG_STATUS_ARGUMENT : FG_STATUS_UNSUPPORTED,
                  n == JOINED ? "'depthu=1 m' is not there"
                              : "'depthu' of 'uo' and 'depthv' of 'vo' have different");
      continue;
    }
    fg_field *field = read_with(f, &options);
    const fg_field_arrays *a = fg_field_contents(field);
    const int middle = a->size[0] * (a->size[1] / 2) + a->size[0] / 2;
    assert_string_equal(a->level, "depth 100 m");
    const double u = (double)a->velocity[0][middle], v = (double)a->velocity[1][middle];
    assert_true(fabs(hypot(u, v) - 3.0 * sqrt(5.0)) < 1e-5);
    fg_field_destroy(field);
  }
  make_layers(&second, 1, turned);
  const fg_read_options by_value = {.vars_from = second.path, .at = "depthu=100m"};
  fg_field_destroy(read_with(f, &by_value));
  make_layers(&second, 1, other);
  refuse_with(f, &(fg_read_options){.vars_from = second.path}, FG_STATUS_UNSUPPORTED,
              "'depthu' of 'uo' and 'depthv' of 'vo' have different values");
  unlink(second.path);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(the_other_component_may_lie_in_a_second_file),
      CASE(a_second_file_is_of_use_or_refused),
      CASE(axes_may_lie_in_a_file_of_the_mesh),
      CASE(components_on_faces_in_two_files_meet_at_the_centres),
      CASE(components_at_the_same_places_in_two_files_stay_on_axes),
      CASE(components_of_different_regions_are_refused),
      CASE(faces_of_different_regions_are_refused),
      CASE(levels_of_two_names_are_joined),
  };
  return cmocka_run_group_tests_name("read/netcdf/files", tests, NULL, NULL);
}
