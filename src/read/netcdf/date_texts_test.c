/* Dates as text, as WRF, FVCOM and MPAS write them. */
#include <math.h>

#include "read/netcdf/plain_example.h"

enum { TIMES = 3, LETTERS = 27 };

/* A pair with a date for each of three times, padded with spaces. */
static void make_timed(sample_file *f, int mode, const char *name,
                       const char *const text[TIMES])
{
  double values[TIMES * COUNT];
  char letters[TIMES * LETTERS];
  for (int t = 0; t < TIMES; ++t) {
    memset(letters + t * LETTERS, ' ', LETTERS);
    memcpy(letters + t * LETTERS, text[t], strlen(text[t]));
    for (int n = 0; n < COUNT; ++n)
      values[t * COUNT + n] = t + 1.0;
  }
  sample_begin(f, mode);
  const int time = sample_dimension(f, "Time", NC_UNLIMITED);
  const int letter = sample_dimension(f, "DateStrLen", LETTERS);
  const int y = sample_axis(f, "y", NY, Y, "km"), x = sample_axis(f, "x", NX, X, "km");
  const int dates[2] = {time, letter}, all[3] = {time, y, x};
  const bool strings = mode == NC_NETCDF4 && strcmp(name, "Times") != 0;
  const int text_id = strings ? sample_variable(f, name, NC_STRING, 1, &time)
                              : sample_variable(f, name, NC_CHAR, 2, dates);
  const int pair[2] = {sample_variable(f, "u", NC_FLOAT, 3, all),
                       sample_variable(f, "v", NC_FLOAT, 3, all)};
  sample_write(f);
  const size_t start[3] = {0}, count[3] = {TIMES, NY, NX}, of_text[2] = {TIMES, LETTERS};
  if (strings)
    nc_must(nc_put_vara_string(f->id, text_id, start, of_text,
                               (const char **)(uintptr_t)text));
  else
    nc_must(nc_put_vara_text(f->id, text_id, start, of_text, letters));
  for (int k = 0; k < 2; ++k)
    nc_must(nc_put_vara_double(f->id, pair[k], start, count, values));
  sample_end(f);
}

static void assert_time(sample_file *f, int time, const char *words)
{
  const fg_read_options options = {.time = time};
  fg_field *field = read_with(f, &options);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_string_equal(a->time, words);
  assert_true(a->velocity[0][0] == (float)time + 1.0f);
  fg_field_destroy(field);
}

/* FVCOM's modified Julian days in single precision are minutes off. */
static void texts_go_before_days_in_float(void **state)
{
  static const char *const texts[TIMES] = {"2014-12-09T00:00:00", "2014-12-09T01:00:00",
                                           "2014-12-09T02:00:00"};
  static const double days[TIMES] = {57000.0, 57000.0 + 1.0 / 24.0, 57000.0 + 2.0 / 24.0};
  static const char *const words[] = {"2014-12-09 01:00", "2014-12-09 01:30"};
  sample_file *f = *state;
  for (int exact = 0; exact < 2; ++exact) {
    int dimension;
    make_timed(f, NC_NETCDF4, "Times", texts);
    nc_must(nc_open(f->path, NC_WRITE, &f->id));
    nc_must(nc_inq_dimid(f->id, "Time", &dimension));
    const int id =
        sample_variable(f, "Time", exact ? NC_DOUBLE : NC_FLOAT, 1, &dimension);
    sample_text(f, id, "units",
                exact ? "days since 1858-11-17 00:30" : "days since 1858-11-17");
    sample_put(f, id, days);
    sample_end(f);
    assert_time(f, 1, words[exact]);
  }
}

static void dates_are_read_as_they_are_written(void **state)
{
  sample_file *f = *state;
  static const char *const texts[][TIMES] = {
      {"2010-07-15_12:00:00", "2010-07-16_00:00:00", "2010-07-16_00:00:30"},
      {"2010-07-15T12:00:00Z", "2010-07-16T00:00:00.000000", "2010-07-16 00:00:30.5"}};
  static const char *const words[TIMES] = {"2010-07-15 12:00", "2010-07-16",
                                           "2010-07-16 00:00:30"};
  static const char *const names[] = {"Times", "xtime", "Time", "valid_time"};
  for (int n = 0; n < 16; ++n) {
    make_timed(f, n & 8 ? NC_NETCDF4 : 0, names[n & 3], texts[n >> 2 & 1]);
    for (int t = 0; t < TIMES; ++t)
      assert_time(f, t, words[t]);
    fg_inventory *inventory = NULL;
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
    assert_non_null(v->time_value);
    for (int t = 0; t < TIMES; ++t) {
      assert_string_equal(v->time_value[t].words, words[t]);
      assert_string_equal(v->time_value[t].units, "");
      assert_true(isnan(v->time_value[t].value));
    }
    fg_selection chosen;
    assert_int_equal(fg_selection_find(&chosen, f->context, "time", "2010-07-16",
                                       v->time_value, v->times),
                     FG_STATUS_OK);
    assert_true(chosen.count == 1 && chosen.index[0] == 1 && !chosen.nearest);
    fg_selection_clear(&chosen);
    fg_inventory_destroy(inventory);
  }
}

static void texts_that_are_no_dates_are_passed_over(void **state)
{
  sample_file *f = *state;
  static const char *const bad[] = {
      "",
      "yesterday",
      "2010-13-15_12:00:00",
      "2010-07-32_12:00:00",
      "2010-07-15_24:00:00",
      "2010-07-15_12:61:00",
      "2010-07-15_12:00:00 noon",
      "----------",
  };
  for (size_t n = 0; n < sizeof bad / sizeof *bad; ++n) {
    const char *const text[TIMES] = {"2010-07-15_12:00:00", bad[n],
                                     "2010-07-16_00:00:30"};
    make_timed(f, 0, "Times", text);
    assert_time(f, 0, "2010-07-15 12:00");
    assert_time(f, 1, "Time 1");
    fg_inventory *inventory = NULL;
    assert_int_equal(fg_inventory_read(&inventory, f->context, f->path), FG_STATUS_OK);
    const fg_inventory_vector *v = fg_inventory_vector_at(inventory, 0);
    assert_null(v->time_value);
    assert_int_equal(v->times, TIMES);
    fg_inventory_destroy(inventory);
  }
}

/* The steps of a forecast (cfgrib) have dates beside them; the levels of a reanalysis are
 * air pressure, of which the first is read. */
static void dates_stand_beside_steps(void **state)
{
  enum { STEPS = 2, LEVELS = 3 };
  static const double hours[STEPS] = {0.0, 6.0}, pressure[LEVELS] = {1000, 500, 250};
  static double values[STEPS * LEVELS * COUNT];
  sample_file *f = *state;
  for (int n = 0; n < STEPS * LEVELS * COUNT; ++n)
    values[n] = n / (LEVELS * COUNT) + 1.0;
  sample_begin(f, 0);
  const int step = sample_axis(f, "step", STEPS, hours, "hours");
  const int level = sample_axis(f, "level", LEVELS, pressure, "millibar");
  const int y = sample_axis(f, "y", NY, Y, "km"), x = sample_axis(f, "x", NX, X, "km");
  const int all[4] = {step, level, y, x};
  const int date = sample_variable(f, "valid_time", NC_DOUBLE, 1, &step);
  sample_text(f, date, "units", "hours since 2024-05-01");
  int level_variable;
  nc_must(nc_inq_varid(f->id, "level", &level_variable));
  sample_text(f, level_variable, "positive", "down");
  const int u = sample_variable(f, "u", NC_FLOAT, 4, all);
  const int v = sample_variable(f, "v", NC_FLOAT, 4, all);
  sample_put(f, date, hours);
  sample_put(f, u, values);
  sample_put(f, v, values);
  sample_end(f);
  assert_time(f, 1, "2024-05-01 06:00");
  fg_read_defaults defaults;
  assert_int_equal(fg_read_defaults_find(&defaults, f->context, f->path, NULL),
                   FG_STATUS_OK);
  assert_int_equal(defaults.level, 0);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, sample_set_up, sample_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(dates_are_read_as_they_are_written),
      CASE(texts_go_before_days_in_float),
      CASE(texts_that_are_no_dates_are_passed_over),
      CASE(dates_stand_beside_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
