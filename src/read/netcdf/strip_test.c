/* The longitude-latitude grid to which samples of a thin mesh are interpolated. */
#include "base/context_test.h"
#include "read/netcdf/sample_example.h"

enum { SIDE = 5, POINTS = SIDE * SIDE };

/* A grid of points in 2 degrees of longitude and a given height of latitude. */
static fg_field *read_strip(sample_file *f, double height)
{
  double values[4][POINTS];
  for (int n = 0; n < POINTS; ++n) {
    values[0][n] = 0.5 * (n % SIDE) + 0.01 * (n / SIDE);
    values[1][n] = height * (n / SIDE);
    values[2][n] = 1.0 + n;
    values[3][n] = -2.0;
  }
  static const char *const words[][3] = {
      {"lon", "units", "degrees_east"},
      {"lat", "units", "degrees_north"},
      {"uo", "standard_name", "eastward_sea_water_velocity"},
      {"vo", "standard_name", "northward_sea_water_velocity"}};
  sample_begin(f, 0);
  const int plane[2] = {sample_dimension(f, "nj", SIDE), sample_dimension(f, "ni", SIDE)};
  for (int k = 0; k < 4; ++k) {
    const int id = sample_variable(f, words[k][0], NC_DOUBLE, 2, plane);
    sample_text(f, id, words[k][1], words[k][2]);
    sample_put(f, id, values[k]);
  }
  sample_end(f);
  return read_with(f, NULL);
}

/* The spacing of samples along the strip does not follow its width, which would give any
 * number of them. */
static void a_thin_strip_has_few_samples(void **state)
{
  static const double heights[] = {0.5, 1e-3, 1e-5, 1e-8};
  for (size_t h = 0; h < sizeof heights / sizeof *heights; ++h) {
    fg_field *field = read_strip(*state, heights[h]);
    const fg_field_arrays *a = fg_field_contents(field);
    assert_true(a->size[0] >= SIDE && a->size[1] >= 2);
    assert_true(a->size[0] * a->size[1] <= 40 * POINTS);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(
      a_thin_strip_has_few_samples, sample_set_up, sample_tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
