#include <string.h>

#include "base/context_test.h"
#include "read/title.h"

typedef struct title_case {
  const char *given, *path, *vars_from, *expected;
  bool by_itself; /* not on disk */
} title_case;

static void check(const title_case *wanted, const char *const name[2],
                  fg_context *context)
{
  static const double x[2] = {0.0, 1.0};
  static const float v[4] = {1.0F, 2.0F, 3.0F, 4.0F};
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {2, 2},
                                  .axis = {x, x},
                                  .velocity = {v, v},
                                  .velocity_name = {name[0], name[1]},
                                  .title = wanted->given};
  const fg__source source = {.path = wanted->path, .on_disk = !wanted->by_itself};
  const fg_read_options options = {.vars_from = wanted->vars_from};
  fg_field *field;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  assert_int_equal(fg__title_from_file(field, context, &source, &options), FG_STATUS_OK);
  assert_string_equal(fg_field_contents(field)->title, wanted->expected);
  fg_field_destroy(field);
}

static void a_title_that_tells_stays(void **state)
{
  static const char *const titles[] = {"Wind at 10 m", "velocity", "V850", "uvic",
                                       "VWND, UWND"};
  static const char *const names[2] = {"UWND", "VWND"};
  for (size_t k = 0; k < sizeof titles / sizeof *titles; ++k)
    check(&(title_case){titles[k], "storm.nc", NULL, titles[k], false}, names, *state);
}

/* What tells nothing gives way to the file's name. */
static void else_the_file_gives_one(void **state)
{
  static const title_case cases[] = {
      {"", "a.b/storm.nc", NULL, "storm", false},
      {NULL, "storm", NULL, "storm", false},
      {"U", "cavity_t2.5.vti", NULL, "cavity_t2.5", false},
      {"uvw", "cavity_t2.5", NULL, "cavity_t2.5", false},
      {"Vectors", "/data/.hidden", NULL, ".hidden", false},
      {"unknown", "/data/office.binary.vtk", NULL, "office.binary", false},
      {"UWND, VWND", "wind.geojson", NULL, "wind", false},
      {"UWND, VWND", "Ustorm.cdf", "more/Vstorm.cdf", "storm", false},
      {"UWND, VWND", "storm_u.nc", "storm_v.nc", "storm", false},
      {"UWND, VWND", "u-2016_a.nc", "v-2016_a.nc", "2016_a", false},
      {"UWND, VWND", "u.nc", "v.nc", "u", false},
      {"UWND, VWND", "ship.nc", "mesh.nc", "ship", false},
      {"UWND, VWND", "standard input", NULL, "UWND, VWND", true},
  };
  static const char *const names[2] = {"UWND", "VWND"};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    check(&cases[k], names, *state);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_title_that_tells_stays, context_set_up,
                                      context_tear_down),
      cmocka_unit_test_setup_teardown(else_the_file_gives_one, context_set_up,
                                      context_tear_down),
  };
  return cmocka_run_group_tests_name("read/title", tests, NULL, NULL);
}
