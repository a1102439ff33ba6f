/* Components and axes of which a file says one thing twice: by names, standard names,
 * long names and units. They are read where all agree, and refused or doubted where not.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "read/netcdf/sample_example.h"

enum { ROWS = 6, COLUMNS = 8 };

typedef struct statement {
  const char *what;
  const char *dimension[2];           /* of rows and columns */
  const char *axis[2], *units[2];     /* coordinates along them; NULL: none */
  const char *axis_name[2];           /* their standard names */
  const char *name[2];                /* of the components */
  const char *standard[2], *words[2]; /* their standard and long names */
  const char *beside[3]; /* a speed or direction: its name, units and standard name */
  double value;          /* at all samples */
  double spacing;        /* which the file states as dx; 0: it has places elsewhere */
  const char *vars;
  const char *refused, *doubt; /* words of the message, of the doubts */
} statement;

#define GLOBE                                                                            \
  .dimension = {"lat", "lon"}, .axis = {"lat", "lon"},                                   \
  .units = {"degrees_north", "degrees_east"}

#define WIND .name = {"ua", "va"}, .standard = {"eastward_wind", "northward_wind"}

static const statement STATEMENTS[] = {
    {"all agree", GLOBE, .name = {"u", "v"},
     .standard = {"eastward_wind", "northward_wind"},
     .words = {"zonal wind", "meridional wind"}},
    {"names and standard names are crossed", GLOBE, .name = {"u", "v"},
     .standard = {"northward_wind", "eastward_wind"},
     .refused = "is the component to the north by its name"},
    {"the same, as named", GLOBE, .name = {"u", "v"},
     .standard = {"northward_wind", "eastward_wind"}, .vars = "v,u"},
    {"names and long names are crossed", GLOBE, .name = {"uwnd", "vwnd"},
     .words = {"Meridional wind", "Zonal wind"},
     .refused = "is the component to the east by its name, and to the north by its long"},
    {"one is counted to the west", GLOBE, .name = {"u", "v"},
     .words = {"westward wind", "northward wind"},
     .refused = "'u' is counted to the west or south: long name 'westward wind'"},
    {"the other is counted to the south", GLOBE, .name = {"uo", "vo"},
     .standard = {NULL, "southward_sea_water_velocity"},
     .refused = "'vo' is counted to the west or south: standard name"},
    {"the same, as named", GLOBE, .name = {"uo", "vo"},
     .standard = {NULL, "southward_sea_water_velocity"}, .vars = "uo,vo"},
    {"the other is positive to the south", GLOBE, .name = {"u", "v"},
     .words = {"zonal velocity", "meridional velocity, positive southward"},
     .refused = "'v' is counted to the west or south: long name"},
    {"a direction from and toward", GLOBE, .name = {"wind_speed", "wind_dir"},
     .standard = {"wind_speed", "wind_from_direction"},
     .words = {NULL, "direction that the wind blows to"},
     .refused = "'wind_dir' is the direction from where it comes by its name "
                "'wind_from_direction'"},
    {"the same, as its standard name says", GLOBE, .name = {"wind_speed", "wind_dir"},
     .standard = {"wind_speed", "wind_from_direction"},
     .words = {NULL, "direction that the wind blows to"}, .vars = "wind_speed,wind_dir"},
    {"words that name both ways", GLOBE, .name = {"u", "v"},
     .words = {"wind, eastward positive, westward negative", NULL}},
    {"stresses counted up and down", GLOBE, .name = {"fx", "fy"},
     .standard = {"surface_upward_eastward_stress", "surface_downward_northward_stress"},
     .refused = "one component is counted upward, the other downward"},
    {"components, and the direction that they have", GLOBE, WIND,
     .beside = {"dir", "degree", "wind_from_direction"}, .value = 290.0},
    {"the same toward", GLOBE, WIND, .beside = {"dir", "degree", "wind_to_direction"},
     .value = 110.0},
    {"another one", GLOBE, WIND, .beside = {"dir", "degree", "wind_from_direction"},
     .value = 110.0,
     .refused = "'ua' and 'va' are more than 45 degrees off the direction "
                "'dir', at 48 of 48 samples compared"},
    {"the same, as named", GLOBE, WIND,
     .beside = {"dir", "degree", "wind_from_direction"}, .value = 110.0, .vars = "ua,va"},
    {"a direction of the wind, beside what may be one", GLOBE, .name = {"u", "v"},
     .beside = {"wind_dir", "degT"}, .value = 110.0,
     .doubt = "'u' and 'v' are more than 45 degrees off the direction 'wind_dir'"},
    {"a direction of the wind, beside a current", GLOBE, .name = {"uo", "vo"},
     .standard = {"eastward_sea_water_velocity", "northward_sea_water_velocity"},
     .beside = {"dir", "degree", "wind_from_direction"}, .value = 110.0},
    {"components, and their speed in knots", GLOBE, WIND,
     .beside = {"ws", "kt", "wind_speed"}, .value = 6.1},
    {"a smaller one", GLOBE, WIND, .beside = {"ws", "m/s", "wind_speed"}, .value = 2.0,
     .refused = "are more than half as fast again as the speed 'ws'"},
    {"a larger one", GLOBE, WIND, .beside = {"ws", "m/s", "wind_speed"}, .value = 6.5,
     .doubt = "'ua' and 'va' are less than half as fast as the speed 'ws'"},
    {"components, and a third that is called a velocity", GLOBE, WIND,
     .beside = {"vertical_velocity", "m/s", "upward_air_velocity"}, .value = 0.01},
    {"components, and a speed of sound", GLOBE, WIND,
     .beside = {"c", "m/s", "speed_of_sound_in_air"}, .value = 340.0},
    {"both to the east by their standard names", GLOBE, .name = {"u", "v"},
     .standard = {"eastward_wind", "eastward_wind"},
     .refused = "'v' is the component to the north by its name, and to the east by its"},
    {"units of a longitude on a latitude", .dimension = {"y", "x"}, .axis = {"y", "x"},
     .units = {"degrees_east", "degrees_north"}, .axis_name = {"latitude", "longitude"},
     .name = {"u", "v"}, .refused = "by its standard name, and a l"},
    {"the same by their names", .dimension = {"lat", "lon"}, .axis = {"lat", "lon"},
     .units = {"degrees_east", "degrees_north"}, .name = {"u", "v"},
     .refused = "by its name, and a l"},
    {"coordinates that no dimension is called after", .dimension = {"r", "c"},
     .axis = {"lat", "lon"}, .name = {"u", "v"}},
    {"the same in a plane", .dimension = {"ny", "nx"}, .axis = {"y", "x"},
     .name = {"vx", "vy"}},
    {"places along other dimensions", .dimension = {"r", "c"}, .name = {"u", "v"},
     .doubt = "axes count the samples of 'u': 'XG' and 'YG' do not lie there"},
    {"a distance of samples that the file states", .dimension = {"r", "c"},
     .name = {"u", "v"}, .spacing = 4000.0,
     .doubt = "axes count the samples of 'u': the attribute 'dx' is not applied"},
};

static void put_variable(const sample_file *f, const char *name, const int *dimension,
                         int rank, double first, const char *const attribute[3])
{
  static const char *const called[] = {"units", "standard_name", "long_name"};
  double values[ROWS * COLUMNS];
  for (int n = 0; n < ROWS * COLUMNS; ++n)
    values[n] = first + (rank == 1 ? 2.0 * n : 0.0);
  const int variable = sample_variable(f, name, NC_DOUBLE, rank, dimension);
  for (int k = 0; k < 3; ++k)
    if (attribute[k])
      sample_text(f, variable, called[k], attribute[k]);
  sample_put(f, variable, values);
}

static void write_statement(sample_file *f, const statement *s)
{
  static const size_t length[] = {ROWS, COLUMNS};
  static const char *const unused[] = {"XG", "YG"};
  static const char *const of_unused[2][3] = {{"degrees_east"}, {"degrees_north"}};
  int dimension[2];
  sample_begin(f, NC_CLASSIC_MODEL);
  for (int k = 0; k < 2; ++k)
    dimension[k] = sample_dimension(f, s->dimension[k], length[k]);
  for (int k = 0; k < 2; ++k) {
    const char *const of_axis[] = {s->units[k], s->axis_name[k], NULL};
    const char *const of_component[] = {strstr(s->name[k], "_dir") ? "degrees" : "m/s",
                                        s->standard[k], s->words[k]};
    if (s->axis[k])
      put_variable(f, s->axis[k], &dimension[k], 1, 10.0, of_axis);
    put_variable(f, s->name[k], dimension, 2, k == 0 ? 3.0 : -1.0, of_component);
  }
  if (s->beside[0]) {
    const int beside = sample_variable(f, s->beside[0], NC_DOUBLE, 2, dimension);
    double values[ROWS * COLUMNS];
    for (int n = 0; n < ROWS * COLUMNS; ++n)
      values[n] = s->value;
    sample_text(f, beside, "units", s->beside[1]);
    if (s->beside[2])
      sample_text(f, beside, "standard_name", s->beside[2]);
    sample_put(f, beside, values);
  }
  if (s->spacing > 0.0) {
    sample_number(f, NC_GLOBAL, "dx", NC_DOUBLE, s->spacing);
  } else if (!s->axis[0]) {
    const int corners = sample_dimension(f, "corners", ROWS + 1);
    for (int k = 0; k < 2; ++k)
      put_variable(f, unused[k], &corners, 1, 10.0, of_unused[k]);
  }
  sample_end(f);
}

static void what_is_said_twice_agrees(void **state)
{
  sample_file *f = *state;
  for (size_t n = 0; n < sizeof STATEMENTS / sizeof *STATEMENTS; ++n) {
    const statement *s = &STATEMENTS[n];
    const fg_read_options options = {.vars = s->vars};
    fg_field *field = NULL;
    write_statement(f, s);
    const fg_status status = fg_field_read(&field, f->context, f->path, &options);
    const char *message = fg_context_message(f->context);
    if (s->refused) {
      if (status == FG_STATUS_OK || !strstr(message, s->refused))
        fail_msg("%s: %d, %s", s->what, (int)status, message);
    } else {
      if (status != FG_STATUS_OK)
        fail_msg("%s: %s", s->what, message);
      const fg_field_arrays *a = fg_field_contents(field);
      const char *doubts = a->doubts ? a->doubts : "";
      if (s->doubt ? !strstr(doubts, s->doubt) : *doubts)
        fail_msg("%s: doubts: '%s'", s->what, doubts);
      const bool turned = s->vars && s->vars[0] == 'v';
      if (strstr(s->name[1], "_dir")) /* 3 m/s from -1 degree: to the south */
        assert_true((double)a->velocity[1][0] < -2.99);
      else
        assert_true((double)a->velocity[turned][0] == 3.0);
      assert_true(a->axis[0][0] == (s->axis[0] ? 10.0 : 0.0));
      assert_true(a->axis[1][1] - a->axis[1][0] == (s->axis[0] ? 2.0 : 1.0));
    }
    fg_field_destroy(field);
    fg_context_clear(f->context);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(what_is_said_twice_agrees, sample_set_up,
                                      sample_tear_down),
  };
  return cmocka_run_group_tests_name("read/netcdf/said_twice", tests, NULL, NULL);
}
