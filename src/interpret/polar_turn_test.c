/* What a direction's name says of it. */
#include "interpret/polar.h"

#include "base/context_test.h"

static void names_have_a_sense(void **state)
{
  static const struct {
    const char *name, *more;
    int sense;
  } cases[] = {
      {"wind_direction", "", -1},
      {"WDIR", "", -1},
      {"wd10", "", -1},
      {"dd", "", -1},
      {"drct", "", -1},
      {"dir", "direction of the wind", -1},
      {"dirfrom", "", -1},
      {"current_direction", "direction from where it comes", -1},
      {"current_dir", "", 1},
      {"direction", "relative to true north", 1},
      {"wind_to_direction", "", 1},
      {"wdir_to", "", 1},
      {"wind_dir", "direction towards which it blows", 1},
      {"total_dir", "", 1},
      {"tower_wind_dir", "", -1},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
    if (fg__polar_sense(cases[n].name, cases[n].more) != cases[n].sense)
      fail_msg("%s, '%s'", cases[n].name, cases[n].more);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_have_a_sense)};
  return cmocka_run_group_tests_name("read/polar", tests, NULL, NULL);
}
