/* What a pair is called, from what its components' attributes share. */
#include "read/netcdf/plain_example.h"

typedef struct naming {
  const char *attribute, *of_u, *of_v;
  const char *expected;
} naming;

static void assert_title(sample_file *f, const naming *n)
{
  const double values[COUNT] = {1.0, 2.0, 3.0};
  sample_begin(f, 0);
  const int plane[2] = {sample_axis(f, "y", NY, Y, "km"),
                        sample_axis(f, "x", NX, X, "km")};
  const int u = sample_variable(f, "u", NC_FLOAT, 2, plane);
  const int v = sample_variable(f, "v", NC_FLOAT, 2, plane);
  sample_text(f, u, n->attribute, n->of_u);
  sample_text(f, v, n->attribute, n->of_v);
  sample_text(f, NC_GLOBAL, "title", "the file");
  sample_put(f, u, values);
  sample_put(f, v, values);
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  if (strcmp(fg_field_contents(field)->title, n->expected) != 0)
    fail_msg("\"%s\" for \"%s\"", fg_field_contents(field)->title, n->of_u);
  fg_field_destroy(field);
}

/* As NEMO, MPAS-Ocean, FVCOM, WRF, POP, ROMS and altimetry's products write them. */
static void titles_are_without_directions(void **state)
{
  static const naming cases[] = {
      {"long_name", "Ocean current along i-axis", "Ocean current along j-axis",
       "Ocean current"},
      {"long_name", "component of horizontal velocity in the eastward direction",
       "component of horizontal velocity in the northward direction",
       "horizontal velocity"},
      {"long_name", "Vertically Averaged x-velocity", "Vertically Averaged y-velocity",
       "Vertically Averaged velocity"},
      {"description", "x-wind component", "y-wind component", "wind"},
      {"description", "U at 10 M", "V at 10 M", "the file"},
      {"long_name", "Velocity in grid-x direction", "Velocity in grid-y direction",
       "Velocity"},
      {"long_name", "u-momentum component", "v-momentum component", "the file"},
      {"long_name", "vertically integrated u-momentum component",
       "vertically integrated v-momentum component", "vertically integrated momentum"},
      {"long_name", "Absolute geostrophic velocity: zonal component",
       "Absolute geostrophic velocity: meridian component",
       "Absolute geostrophic velocity"},
      {"standard_name", "grid_eastward_wind", "grid_northward_wind", "wind"},
      {"long_name", "Wind speed to the east", "Wind speed to the north", "Wind speed"}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
    assert_title(*state, &cases[n]);
}

/* Numbers that stand for dates differ in their last digits; the unit "level" (CESM) tells
 * nothing. */
static void numbers_of_times_and_levels(void **state)
{
  static const double day[] = {19900101.0}, lev[] = {992.5};
  const double values[COUNT] = {1.0, 2.0, 3.0};
  sample_file *f = *state;
  sample_begin(f, 0);
  const int all[4] = {sample_axis(f, "time", 1, day, "yyyymmdd"),
                      sample_axis(f, "lev", 1, lev, "level"),
                      sample_axis(f, "y", NY, Y, "km"), sample_axis(f, "x", NX, X, "km")};
  for (int k = 0; k < 2; ++k)
    sample_put(f, sample_variable(f, k ? "v" : "u", NC_FLOAT, 4, all), values);
  sample_end(f);
  fg_field *field = read_with(f, NULL);
  assert_string_equal(fg_field_contents(field)->time, "time 19900101 yyyymmdd");
  assert_string_equal(fg_field_contents(field)->level, "lev 992.5");
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {CASE(titles_are_without_directions),
                                     CASE(numbers_of_times_and_levels)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
