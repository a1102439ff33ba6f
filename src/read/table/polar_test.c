/* Columns of speed and direction: found, named in any order, and refused by halves. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "read/table/tables_test.h"

enum { NX = 3, NY = 2 };

/* Columns whose direction turns with longitude and latitude; "from" in the names' sense.
 */
static double degrees_at(int i, int j)
{
  return 20.0 + 100.0 * i + 37.0 * j;
}

static double speed_at(int i, int j)
{
  return 1.0 + i + 0.5 * j;
}

/* Rows of longitude 10 to 12, latitude 50 to 51, speed, direction and a temperature. */
static const char *write_rows(char text[2048], const char *head)
{
  size_t used = (size_t)snprintf(text, 2048, "%s\n", head);
  for (int n = 0; n < NX * NY; ++n) {
    const int i = n % NX, j = n / NX;
    used += (size_t)snprintf(text + used, 2048 - used, "%d,%d,%g,%g,280\n", 10 + i,
                             50 + j, speed_at(i, j), degrees_at(i, j));
  }
  return text;
}

/* Sign is -1 where the direction is that from which it blows. */
static void check_turned(fg_field *field, double sign)
{
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->scale, FG_SCALE_GEO);
  assert_true(f->size[0] == NX && f->size[1] == NY);
  for (int n = 0; n < NX * NY; ++n) {
    const int i = n % NX, j = n / NX;
    const double angle = degrees_at(i, j) * acos(-1.0) / 180.0;
    const double along = sign * speed_at(i, j);
    assert_true(fabs((double)f->velocity[0][n] - along * sin(angle)) < 1e-6);
    assert_true(fabs((double)f->velocity[1][n] - along * cos(angle)) < 1e-6);
  }
  fg_field_destroy(field);
}

static void named_speeds_and_directions_are_turned(void **state)
{
  static const struct {
    const char *head, *vars;
    double sign;
  } same[] = {
      {"lon,lat,wind_speed,wind_direction,t2", NULL, -1.0},
      {"lon,lat,wind_speed,wind_direction,t2", "wind_speed,wind_direction", -1.0},
      {"lon,lat,wind_speed,wind_direction,t2", "wind_direction,wind_speed", -1.0},
      {"lon,lat,wind_speed,wind_direction,t2", "3,4", -1.0},
      {"Lon,Lat,Wind Speed (kt),Wind Dir (deg),T",
       "Lon,Lat,Wind Speed (kt),Wind Dir (deg)", -1.0},
      {"Lon,Lat,Wind Speed (kt),Wind Dir (deg),T", "Wind Speed,Wind Dir", -1.0},
      {"lon,lat,current_speed,current_direction,t2", "current_speed,current_direction",
       1.0},
      {"lon,lat,wind_gust,wind_dir,t2", "wind_gust,wind_dir", -1.0},
      {"lon,lat,wind_speed_10m,wind_direction_10m,t2", NULL, -1.0},
      {"lon,lat,ff,dd,t2", NULL, -1.0},
      {"lon,lat,ff,dd,t2", "dd,ff", -1.0},
      {"lon,lat,wave_height,wave_dir,t2", "wave_height,wave_dir", -1.0},
      {"lon,lat,swh,theta (deg),t2", "theta,swh", 1.0},
  };
  char text[2048];
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i)
    check_turned(read_with(*state, write_rows(text, same[i].head),
                           &(fg_read_options){.vars = same[i].vars}),
                 same[i].sign);
}

/* Units are the speed's, whichever stands first. */
static void units_are_those_of_the_speed(void **state)
{
  char text[2048];
  fg_field *field =
      read_with(*state, write_rows(text, "lon,lat,wind speed (kt),wind dir (deg),t2"),
                &(fg_read_options){.vars = "wind dir,wind speed"});
  assert_string_equal(fg_field_contents(field)->velocity_units, "kn");
  check_turned(field, -1.0);
}

/* A direction's unit is the one in brackets or in its name. */
static void directions_may_be_in_radians(void **state)
{
  static const char *const same[][2] = {
      {"lon,lat,wind_speed,wind_dir [rad],t2", NULL},
      {"lon,lat,wind speed (m/s),wind direction (Radians),t2", NULL},
      {"lon,lat,wind_speed,wind_dir_rad,t2", "wind_speed,wind_dir_rad"},
  };
  char text[2048];
  for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
    size_t used = (size_t)snprintf(text, sizeof text, "%s\n", same[i][0]);
    for (int n = 0; n < NX * NY; ++n)
      used += (size_t)snprintf(text + used, sizeof text - used, "%d,%d,%g,%.15g,280\n",
                               10 + n % NX, 50 + n / NX, speed_at(n % NX, n / NX),
                               degrees_at(n % NX, n / NX) * acos(-1.0) / 180.0);
    check_turned(read_with(*state, text, &(fg_read_options){.vars = same[i][1]}), -1.0);
  }
}

/* Two directions, or dd without ff, are components as they are named. */
static void other_pairs_are_components(void **state)
{
  static const char *const as_named[][2] = {
      {"lon,lat,x_dir,y_dir,t2", "x_dir,y_dir"},
      {"lon,lat,x_vel,y_vel,t2", "x_vel,y_vel"},
      {"lon,lat,cc,dd,t2", "cc,dd"},
  };
  char text[2048];
  for (size_t i = 0; i < sizeof as_named / sizeof *as_named; ++i) {
    fg_field *field = read_with(*state, write_rows(text, as_named[i][0]),
                                &(fg_read_options){.vars = as_named[i][1]});
    const fg_field_arrays *f = fg_field_contents(field);
    for (int n = 0; n < NX * NY; ++n) {
      assert_true(f->velocity[0][n] == (float)speed_at(n % NX, n / NX));
      assert_true(f->velocity[1][n] == (float)degrees_at(n % NX, n / NX));
    }
    fg_field_destroy(field);
  }
}

/* A calm needs no direction; a code is none, and neither is a speed below 0. */
static void codes_are_no_directions(void **state)
{
  static const char text[] = "lon,lat,ff,dd\n10,50,0,\n11,50,2,-999\n12,50,2,990\n"
                             "13,50,-999,90\n10,51,2,90\n11,51,2,360\n12,51,2,-90\n"
                             "13,51,2,180\n10,52,2,90\n11,52,2,90\n12,52,2,90\n"
                             "13,52,2,90\n";
  static const float u[] = {0, NAN, NAN, NAN, -2, 0, 2, 0},
                     v[] = {0, NAN, NAN, NAN, 0, -2, 0, 2};
  fg_field *field = read_text(*state, text);
  const fg_field_arrays *f = fg_field_contents(field);
  assert_true(f->size[0] == 4 && f->size[1] == 3);
  for (int n = 0; n < 8; ++n) {
    assert_int_equal(f->valid == NULL || f->valid[n] != 0, !isnan(u[n]));
    assert_true(isnan(u[n]) || fabsf(f->velocity[0][n] - u[n]) < 1e-6f);
    assert_true(isnan(v[n]) || fabsf(f->velocity[1][n] - v[n]) < 1e-6f);
  }
  fg_field_destroy(field);
}

static void halves_are_refused(void **state)
{
  static const struct {
    const char *head, *vars;
    fg_status status;
    const char *words, *hint;
  } refused[] = {
      {"lon,lat,wind_speed,wind_direction,t2", "t2,wind_speed", FG_STATUS_ARGUMENT,
       "'wind_speed' is a speed, and 't2' is no direction",
       "--vars wind_speed,wind_direction"},
      {"x,y,speed,direction,t2", "speed,direction", FG_STATUS_UNSUPPORTED,
       "'direction' is a direction from north, and where north lies on its grid is not "
       "known",
       "read with longitude and latitude"},
      {"lon,lat,wind_speed,wind_dir (10s deg),t2", "wind_speed,wind_dir",
       FG_STATUS_UNSUPPORTED, "the direction 'wind_dir' is not in degrees or radians",
       ""},
  };
  char text[2048];
  for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
    const fg__source source = source_of(write_rows(text, refused[i].head));
    const fg_read_options options = {.vars = refused[i].vars};
    fg_field *field = NULL;
    assert_int_equal(fg__dataset_read(&field, *state, &fg__format_table, &source,
                                      &options, (fg__slab_index){0, 1}),
                     refused[i].status);
    assert_null(field);
    if (!strstr(fg_context_message(*state), refused[i].words) ||
        !strstr(fg_context_hint(*state), refused[i].hint))
      fail_msg("\"%s\", \"%s\"", fg_context_message(*state), fg_context_hint(*state));
    fg_context_clear(*state);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(named_speeds_and_directions_are_turned),
      cmocka_unit_test(units_are_those_of_the_speed),
      cmocka_unit_test(directions_may_be_in_radians),
      cmocka_unit_test(other_pairs_are_components),
      cmocka_unit_test(codes_are_no_directions),
      cmocka_unit_test(halves_are_refused),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
