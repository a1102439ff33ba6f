/* Fields whose parts lie in two files. */
#include "read/netcdf/plain_test.h"

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

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(the_other_component_may_lie_in_a_second_file),
      CASE(a_second_file_is_of_use_or_refused),
      CASE(axes_may_lie_in_a_file_of_the_mesh),
  };
  return cmocka_run_group_tests_name("read/netcdf/files", tests, NULL, NULL);
}
