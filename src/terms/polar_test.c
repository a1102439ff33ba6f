/* What is a direction, how it is counted, and which speed is its own. */
#include "terms/polar.h"

#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "base/context_test.h"

/* The sense by a name and a description. */
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
      {"wd_10m", "", -1},
      {"drct", "", -1},
      {"dir", "direction of the wind", -1},
      {"dirfrom", "", -1},
      {"current_direction", "direction from where it comes", -1},
      {"current_direction", "direction, clockwise from north", 1},
      {"current_direction", "direction, clockwise from true north", 1},
      {"current_dir", "", 1},
      {"direction", "relative to true north", 1},
      {"wind_to_direction", "", 1},
      {"wdir_to", "", 1},
      {"wind_dir", "direction towards which it blows", 1},
      {"total_dir", "", 1},
      {"tower_wind_dir", "", -1},
      {"mwd", "mean wave direction", -1},
      {"swell_dir", "", -1},
      {"cdir", "Current direction derived from u and v", 1},
      {"cdir", "current direction, clockwise from magnetic north", 1},
      {"dir", "ice drift direction from SAR", 1},
      {"water_dir", "flow direction", 1},
      {"WCDIR", "current direction", 1},
      {"dir", "wind-driven surface current direction", 1},
      {"dir", "wave-induced current direction", 1},
      {"mwd", "mean wave direction in shallow water", -1},
      {"tau_dir", "direction of the wind stress vector", 1},
      {"wind_dir", "Wind direction (to)", 1},
      {"wind_dir", "Wind direction from", -1},
      {"wdir", "direction the waves are going to", 1},
      {"wdir", "wind direction (oceanographic)", 1},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg__term term = {.name = cases[n].name, .long_name = cases[n].more};
    fg__polar polar;
    fg__direction_read(&polar, &term);
    if (polar.sense != cases[n].sense)
      fail_msg("%s, '%s'", cases[n].name, cases[n].more);
  }
}

/* A standard name outside of CF says no sense. */
static void standard_names_have_a_sense(void **state)
{
  static const struct {
    const char *standard;
    int sense;
  } cases[] = {{"wind_to_direction", 1},
               {"wind_from_direction", -1},
               {"sea_water_velocity_from_direction", -1},
               {"direction_of_sea_ice_velocity", 1},
               {"wind_direction", -1},
               {"dominant_wave_direction", -1}};
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg__term term = {.name = n < 4 ? "wdir" : "dp",
                           .standard_name = cases[n].standard,
                           .long_name = n < 4 ? "wind direction" : NULL};
    fg__polar polar;
    assert_true(fg__direction_read(&polar, &term));
    if (polar.sense != cases[n].sense)
      fail_msg("%s", cases[n].standard);
  }
}

/* A convention may stand in a comment alone, whose other words say nothing. */
static void comments_name_conventions(void **state)
{
  static const struct {
    const char *name, *comment;
    int sense;
    bool from_east;
  } cases[] = {
      {"wind_direction", "oceanographic convention, clockwise from north", 1, false},
      {"wind_dir", "the direction to which it blows, clockwise from north", 1, false},
      {"current_dir", "meteorological convention", -1, false},
      {"current_dir", "direction from which the current flows", -1, false},
      {"current_dir", "derived from the components", 1, false},
      {"current_dir", "data coming from a buoy from which drifters are released", 1,
       false},
      {"wind_dir", "sensor moved to the new mast", -1, false},
      {"wind_dir", "measured from north toward east", -1, false},
      {"wind_dir", "the meteorological convention, not the oceanographic convention", -1,
       false},
      {"direction", "mathematical convention: counterclockwise from east", 1, true},
      {"direction", "counterclockwise rotation of the mast was removed", 1, false},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const fg__term term = {.name = cases[n].name, .comment = cases[n].comment};
    fg__polar polar;
    fg__direction_read(&polar, &term);
    if (polar.sense != cases[n].sense || polar.from_east != cases[n].from_east)
      fail_msg("%s, '%s'", cases[n].name, cases[n].comment);
  }
}

/* Words that name the other convention are found; others that only sound like it are not.
 */
static void opposite_conventions_are_found(void **state)
{
  static const struct {
    fg__term term;
    const char *opposite;
  } cases[] = {
      {{.name = "a", .standard_name = "wind_from_direction", .comment = "blows toward"},
       "blows toward"},
      {{.name = "b",
        .standard_name = "sea_water_velocity_to_direction",
        .long_name = "direction from which the current flows"},
       "direction from which the current flows"},
      {{.name = "wdir_to", .comment = "meteorological convention"},
       "meteorological convention"},
      {{.name = "wdir",
        .long_name = "wind from direction",
        .comment = "oceanographic convention"},
       "oceanographic convention"},
      {{.name = "c",
        .standard_name = "sea_water_velocity_to_direction",
        .long_name = "direction of the current from HF radar"},
       NULL},
      {{.name = "d",
        .standard_name = "wind_from_direction",
        .comment = "clockwise from north toward east"},
       NULL},
      {{.name = "e",
        .standard_name = "wind_from_direction",
        .long_name = "direction from which the wind blows"},
       NULL},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    const char *found = fg__opposite_sense(&cases[n].term);
    if (found ? !cases[n].opposite || strcmp(found, cases[n].opposite) != 0
              : cases[n].opposite != NULL)
      fail_msg("%s: %s", cases[n].term.name, found ? found : "nothing");
  }
}

static void directions_are_known_by_names_and_units(void **state)
{
  static const struct {
    fg__term term;
    bool is_direction;
    fg__polar polar;
  } cases[] = {
      {{.name = "VMDR",
        .standard_name = "sea_surface_wave_from_direction",
        .units = "degree"},
       true,
       {-1, FG__RADIANS, false}},
      {{.name = "a", .standard_name = "wind_to_direction", .units = "radian"},
       true,
       {1, 1.0, false}},
      {{.name = "a", .standard_name = "wind_speed", .units = "deg"}, false, {0}},
      {{.name = "wd", .units = "degrees true"}, true, {-1, FG__RADIANS, false}},
      {{.name = "wind_dir_rad"}, true, {-1, 1.0, false}},
      {{.name = "wind_dir", .units = "10s deg"}, true, {-1, 0.0, false}},
      {{.name = "flow_dir",
        .long_name = "counterclockwise from east",
        .units = "degrees"},
       true,
       {1, FG__RADIANS, true}},
      {{.name = "theta", .units = "rad ccw"}, true, {1, 1.0, true}},
      {{.name = "direct_radiation", .units = "W m-2"}, false, {0}},
      {{.name = "lon2d", .units = "degrees"}, false, {0}},
      {{.name = "a", .units = "degrees_east"}, false, {0}},
      {{.name = "u", .units = "m/s"}, false, {0}},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    fg__polar found;
    const fg__polar *wanted = &cases[n].polar;
    const bool is_direction = fg__direction_read(&found, &cases[n].term);
    if (is_direction != cases[n].is_direction ||
        (is_direction &&
         (found.sense != wanted->sense || fabs(found.unit - wanted->unit) > 1e-12 ||
          found.from_east != wanted->from_east)))
      fail_msg("%s, case %zu", cases[n].term.name, n);
  }
}

static void components_are_those_of_the_angle(void **state)
{
  static const struct {
    fg__polar polar;
    double angle, east, north;
  } cases[] = {
      {{1, FG__RADIANS, false}, 90.0, 2.0, 0.0},
      {{-1, FG__RADIANS, false}, 90.0, -2.0, 0.0},
      {{1, FG__RADIANS, true}, 90.0, 0.0, 2.0},
      {{-1, 1.0, true}, 0.0, -2.0, 0.0},
  };
  (void)state;
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    double vector[2] = {2.0, cases[n].angle};
    fg__polar_turn(vector, &cases[n].polar);
    assert_true(fabs(vector[0] - cases[n].east) + fabs(vector[1] - cases[n].north) <
                1e-12);
  }
}

/* Numbers from `least` to `most` in `unit`; words: the refusal. */
static void numbers_and_units_are_compared(void **state)
{
  static const struct {
    double unit, least, most;
    const char *words;
  } cases[] = {
      {1.0, 0.0, 359.0, "is in radians, but its numbers, 0 to 359, are degrees"},
      {1.0, 0.0, 6.28, NULL},
      {1.0, -3.14, 3.14, NULL},
      {FG__RADIANS, 0.0, 6.28, "is in degrees, but its numbers, 0 to 6.28, are radians"},
      {FG__RADIANS, -3.14, 3.14, "are radians"},
      {FG__RADIANS, 0.0, 4.0, NULL}, /* a steady wind */
      {FG__RADIANS, -180.0, 180.0, NULL},
      {FG__RADIANS, 2.0, 7.5, NULL},
      {FG__RADIANS, -180.0, 360.0, NULL},
      {FG__RADIANS, -327.68, 327.67, "goes from -327.68 to 327.67 degrees, more than a"},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    enum { COUNT = 12 };
    const fg__polar polar = {1, cases[n].unit, false};
    float length[COUNT], angle[COUNT], *const vector[2] = {length, angle};
    for (int i = 0; i < COUNT; ++i) {
      length[i] = 1.0f;
      angle[i] =
          (float)(cases[n].least + (cases[n].most - cases[n].least) * i / (COUNT - 1));
    }
    angle[3] = 9999.0f; /* a code */
    const fg_status status =
        fg__polar_turn_all(*state, vector, COUNT, &polar, "a.nc", "wd");
    assert_int_equal(status, cases[n].words ? FG_STATUS_ARGUMENT : FG_STATUS_OK);
    if (cases[n].words && !strstr(fg_context_message(*state), cases[n].words))
      fail_msg("%s", fg_context_message(*state));
    fg_context_clear(*state);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_have_a_sense),
      cmocka_unit_test(standard_names_have_a_sense),
      cmocka_unit_test(comments_name_conventions),
      cmocka_unit_test(opposite_conventions_are_found),
      cmocka_unit_test(directions_are_known_by_names_and_units),
      cmocka_unit_test(components_are_those_of_the_angle),
      cmocka_unit_test(numbers_and_units_are_compared),
  };
  return cmocka_run_group_tests_name("terms/polar", tests, context_set_up,
                                     context_tear_down);
}
