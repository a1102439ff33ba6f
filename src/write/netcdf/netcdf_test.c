/* A volume written as NetCDF is read again with the same velocity. */
#include <math.h>

#include "read/netcdf/sample_example.h"

static void what_is_written_comes_back(void **state)
{
  sample_file *f = *state;
  static const char *const names[] = {"vortex3d", "abc"};
  for (int i = 0; i < 2; ++i) {
    fg_field *field = NULL;
    assert_int_equal(fg_field_create_analytic(&field, f->context, names[i], 9),
                     FG_STATUS_OK);
    assert_int_equal(fg_field_write(f->context, f->path, field), FG_STATUS_OK);
    fg_field *back = read_with(f, NULL);
    assert_int_equal(fg_field_contents(back)->size[2], 9);
    for (int n = 0; n < 60; ++n) {
      const double at[3] = {fmod(0.37 * n, 1.0), fmod(0.53 * n, 1.0), n / 59.0};
      double v[3] = {0.0}, w[3] = {0.0};
      assert_true(fg_field_velocity(field, at, v) && fg_field_velocity(back, at, w));
      for (int k = 0; k < 3; ++k)
        assert_true(fabs(v[k] - w[k]) < 1e-6);
    }
    fg_field_destroy(back);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(
      what_is_written_comes_back, sample_set_up, sample_tear_down)};
  return cmocka_run_group_tests_name("write/netcdf", tests, NULL, NULL);
}
