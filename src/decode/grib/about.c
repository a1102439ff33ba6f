/* What each field is of: parameter, level, time, member, grid. Most fields of a file
 * differ in their time alone, so ecCodes decodes once what the others share. */
#include "base/memory.h"
#include "base/mix.h"
#include "decode/grib/grib.h"
#include "terms/dates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Steps of a forecast: ecCodes goes to its date by single days. */
enum { MOST_STEPS = 1000000000 };

/* Bytes of a section that say a time; they do not tell fields apart. */
typedef struct time_bytes {
  size_t first, count;
} time_bytes;

static uint64_t mix_bytes(uint64_t key, const unsigned char *bytes, size_t size,
                          const time_bytes *left_out, int count)
{
  for (size_t i = 0; i < size; ++i) {
    bool is_time = false;
    for (int k = 0; k < count; ++k)
      is_time = is_time ||
                (i >= left_out[k].first && i < left_out[k].first + left_out[k].count);
    if (!is_time)
      key = fg__mix(key ^ bytes[i]);
  }
  return fg__mix(key ^ size);
}

/* Minutes of a unit of time; 0: it is none that has always as many. */
static int64_t minutes_of(unsigned unit)
{
  static const short minutes[] = {
      [0] = 1, [1] = 60, [2] = 24 * 60, [10] = 3 * 60, [11] = 6 * 60, [12] = 12 * 60};
  return unit < sizeof minutes / sizeof *minutes ? minutes[unit] : 0;
}

/* Whether a date can be one; ecCodes judges others. */
static bool tell_start(int64_t *out, int64_t year, const unsigned char clock[4])
{
  *out = (fg__day_number(year, clock[0], clock[1]) * 24 + clock[2]) * 60 + clock[3];
  return clock[0] >= 1 && clock[0] <= 12 && clock[1] >= 1 && clock[1] <= 31 &&
         clock[2] < 24 && clock[3] < 60;
}

/* The times of a field at one instant; false: it is of another kind. */
static bool tell_first_edition(fg__grib_field *field, const unsigned char *one)
{
  const int64_t unit = minutes_of(one[17]);
  const unsigned char range = one[20];
  const int64_t steps = range == 10  ? (int64_t)fg__grib_number(one + 18, 2)
                        : range == 0 ? one[18]
                                     : 0;
  const int64_t year = ((int64_t)one[24] - 1) * 100 + one[12];
  field->time = 0;
  if (unit == 0 || (range != 0 && range != 1 && range != 10) || one[24] == 0 ||
      one[12] > 100 || !tell_start(&field->started, year, one + 13))
    return false;
  field->time = field->started + steps * unit;
  return true;
}

static bool tell_second_edition(fg__grib_field *field, const unsigned char *one,
                                const unsigned char *four, size_t size)
{
  const uint64_t template = fg__grib_number(four + 7, 2);
  field->time = 0;
  if (size < 34 || template > 2 || minutes_of(four[17]) == 0 || four[18] & 128 ||
      one[18] != 0 ||
      !tell_start(&field->started, (int64_t)fg__grib_number(one + 12, 2), one + 14))
    return false;
  field->time =
      field->started + (int64_t)fg__grib_number(four + 18, 4) * minutes_of(four[17]);
  return true;
}

/* The key of what a field shares with others. *timed: its times are told, too. */
static uint64_t key_of(fg__grib_field *field, bool *timed)
{
  static const time_bytes first_date[] = {{12, 5}, {18, 2}, {24, 1}, {26, 2}};
  static const time_bytes second_date[] = {{12, 7}}, second_step[] = {{18, 4}};
  size_t one_size, four_size, grid_size;
  const unsigned char *one = fg__grib_section(field, 1, &one_size);
  uint64_t key = fg__mix(field->edition);
  if (field->edition == 1) {
    const unsigned char *grid = fg__grib_section(field, 2, &grid_size);
    *timed = tell_first_edition(field, one);
    key = mix_bytes(key, one, one_size, first_date, *timed ? 4 : 0);
    return mix_bytes(key, grid, grid_size, NULL, 0);
  }
  const unsigned char *four = fg__grib_section(field, 4, &four_size),
                      *grid = fg__grib_section(field, 3, &grid_size);
  *timed = tell_second_edition(field, one, four, four_size);
  key = fg__mix(key ^ field->message[6]);
  key = mix_bytes(key, one, one_size, second_date, *timed ? 1 : 0);
  key = mix_bytes(key, grid, grid_size, NULL, 0);
  return mix_bytes(key, four, four_size, second_step, *timed ? 1 : 0);
}

static uint64_t grid_key(const fg__grib_field *field)
{
  size_t size;
  const unsigned char *grid = fg__grib_section(field, field->edition == 1 ? 2 : 3, &size);
  return mix_bytes(field->edition, grid, size, NULL, 0);
}

typedef struct telling {
  const fg__grib_field *field;
  fg__grib_kind kind;
  double level;
  long member;
  long dates[4]; /* date and time of the start, and of when it is valid */
  int error;
} telling;

/* A parameter that ecCodes does not know has its numbers for a name, and the words of
 * WMO's table; what else a message gave would be its bytes. */
static void name_by_numbers(fg__grib_kind *kind, codes_handle *handle,
                            const fg__grib_field *field)
{
  size_t size;
  const unsigned char *at = fg__grib_section(field, field->edition == 1 ? 1 : 4, &size);
  if (field->edition == 1)
    snprintf(kind->name, sizeof kind->name, "%d.%d", at[3], at[8]);
  else
    snprintf(kind->name, sizeof kind->name, "%d.%d.%d", field->message[6], at[9], at[10]);
  kind->other_name[0] = '\0';
  fg__grib_word(handle, "parameterName", kind->title, sizeof kind->title);
  fg__grib_word(handle, "parameterUnits", kind->units, sizeof kind->units);
  if (strspn(kind->title, "0123456789") == strlen(kind->title)) /* not in it */
    kind->title[0] = kind->units[0] = '\0';
}

/* ecCodes' name of CF, or what a title says; of components along a grid they do not point
 * east. */
static void name_standard(fg__grib_kind *kind, codes_handle *handle)
{
  char *name = kind->standard_name;
  fg__grib_word(handle, "cfName", name, sizeof kind->standard_name);
  if (!name[0] || strcmp(name, "unknown") == 0)
    snprintf(name, sizeof kind->standard_name, "%s", fg__grib_standard_name(kind->title));
}

/* Units of time whose length ecCodes knows; it looks beyond a table for that of others.
 */
static bool is_unit(long unit, int edition)
{
  return (unit >= 0 && unit <= 3) || (unit >= 10 && unit <= 13) ||
         (edition == 1 && (unit == 14 || unit == 254));
}

static bool has_wild_steps(codes_handle *handle, int edition)
{
  long unit, step;
  if (codes_get_long(handle, "indicatorOfUnitOfTimeRange", &unit) == CODES_SUCCESS &&
      !is_unit(unit, edition))
    return true;
  return codes_get_long(handle, "endStep", &step) == CODES_SUCCESS &&
         (step > MOST_STEPS || step < -MOST_STEPS);
}

static void tell(codes_handle *handle, void *data)
{
  static const char *const dates[] = {"dataDate", "dataTime", "validityDate",
                                      "validityTime"};
  telling *t = data;
  fg__grib_kind *kind = &t->kind;
  t->error = handle ? CODES_SUCCESS : CODES_INVALID_MESSAGE;
  if (handle && has_wild_steps(handle, t->field->edition))
    t->error = CODES_OUT_OF_RANGE;
  if (t->error)
    return;
  fg__grib_word(handle, "shortName", kind->name, sizeof kind->name);
  fg__grib_word(handle, "cfVarName", kind->other_name, sizeof kind->other_name);
  fg__grib_word(handle, "name", kind->title, sizeof kind->title);
  fg__grib_word(handle, "units", kind->units, sizeof kind->units);
  fg__grib_word(handle, "typeOfLevel", kind->level_type, sizeof kind->level_type);
  fg__grib_word(handle, "stepType", kind->step_type, sizeof kind->step_type);
  if (!kind->name[0] || strcmp(kind->name, "unknown") == 0 || kind->name[0] == '~')
    name_by_numbers(kind, handle, t->field);
  name_standard(kind, handle);
  if (codes_get_long(handle, "perturbationNumber", &t->member) != CODES_SUCCESS)
    t->member = FG__GRIB_NO_MEMBER;
  if (codes_get_double(handle, "level", &t->level) != CODES_SUCCESS ||
      !isfinite(t->level))
    t->level = 0.0;
  for (int k = 0; k < 4; ++k) /* an image has no forecast, and is valid when it began */
    if (codes_get_long(handle, dates[k], &t->dates[k]) != CODES_SUCCESS)
      t->dates[k] = k < 2 ? 0 : t->dates[k - 2];
}

/* 20140131 and 1830 */
static int64_t minutes_at(long date, long clock)
{
  if (date < 0 || date > 99999999 || clock < 0 || clock > 9999)
    return 0;
  return (fg__day_number(date / 10000, date / 100 % 100, date % 100) * 24 + clock / 100) *
             60 +
         clock % 100;
}

/* ecCodes divides by the length of a unit of time, and by zero where it knows none. */
static fg_status check_unit(const fg__grib_file *file, const fg__grib_field *field)
{
  size_t size;
  const unsigned char *at = fg__grib_section(field, field->edition == 1 ? 1 : 4, &size);
  if (field->edition == 2 && (size < 22 || fg__grib_number(at + 7, 2) > 15))
    return FG_STATUS_OK;
  const unsigned unit = at[17];
  if (is_unit(unit, field->edition))
    return FG_STATUS_OK;
  return fg__fail(file->context, FG_STATUS_UNSUPPORTED,
                  "%s: message %zu counts time in units of a kind that is not known, %u",
                  file->path, field->number, unit);
}

static fg_status ask(telling *t, const fg__grib_file *file, const fg__grib_field *field)
{
  memset(t, 0, sizeof *t);
  t->field = field;
  fg_status status = check_unit(file, field);
  if (status == FG_STATUS_OK)
    status = fg__grib_guard(file, field, tell, t);
  if (status == FG_STATUS_OK && t->error)
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: message %zu does not say what it is of: %s", file->path,
                    field->number, codes_get_error_message(t->error));
  return status;
}

/* Finds the grid of a field among the file's, or adds it. */
static fg_status intern_grid(int *out, fg__grib_file *file, const fg__grib_field *field)
{
  const uint64_t key = grid_key(field);
  for (size_t i = 0; i < file->grids; ++i)
    if (file->grid[i].key == key) {
      *out = (int)i;
      return FG_STATUS_OK;
    }
  void *grids = file->grid;
  if (!fg__grow(&grids, &file->grid_capacity, file->grids + 1, sizeof *file->grid))
    return fg__fail_memory(file->context, "grids",
                           (file->grids + 1) * sizeof *file->grid);
  file->grid = grids;
  fg__grib_grid *grid = &file->grid[file->grids];
  *out = (int)file->grids++;
  const fg_status status = fg__grib_grid_find(grid, file, field);
  grid->key = key;
  return status;
}

static fg_status intern_kind(int *out, fg__grib_file *file, const fg__grib_kind *kind)
{
  for (size_t i = file->kinds; i-- > 0;) {
    const fg__grib_kind *k = &file->kind[i];
    if (k->grid == kind->grid && strcmp(k->name, kind->name) == 0 &&
        strcmp(k->level_type, kind->level_type) == 0 &&
        strcmp(k->step_type, kind->step_type) == 0 &&
        strcmp(k->units, kind->units) == 0) {
      *out = (int)i;
      return FG_STATUS_OK;
    }
  }
  void *kinds = file->kind;
  if (!fg__grow(&kinds, &file->kind_capacity, file->kinds + 1, sizeof *kind))
    return fg__fail_memory(file->context, "kinds of fields",
                           (file->kinds + 1) * sizeof *kind);
  file->kind = kinds;
  file->kind[file->kinds] = *kind;
  *out = (int)file->kinds++;
  return FG_STATUS_OK;
}

/* What fields have in common but for their time: that of the first of them. */
typedef struct about {
  uint64_t key; /* of the bytes that say it */
  const fg__grib_field *of;
} about;

/* An open hash of keys. */
typedef struct key_table {
  about *slot;
  size_t size; /* a power of two */
} key_table;

static about *find_slot(const key_table *table, uint64_t key)
{
  size_t at = (size_t)key & (table->size - 1);
  while (table->slot[at].of && table->slot[at].key != key)
    at = (at + 1) & (table->size - 1);
  return &table->slot[at];
}

static fg_status tell_field(fg__grib_file *file, const key_table *table,
                            fg__grib_field *field)
{
  bool timed;
  telling t;
  const uint64_t key = key_of(field, &timed);
  about *known = find_slot(table, key);
  fg_status status = FG_STATUS_OK;
  if (!known->of || !timed)
    status = ask(&t, file, field);
  if (status == FG_STATUS_OK && !timed) {
    field->started = minutes_at(t.dates[0], t.dates[1]);
    field->time = minutes_at(t.dates[2], t.dates[3]);
  }
  if (status != FG_STATUS_OK)
    return status;
  if (known->of) {
    field->kind = known->of->kind;
    field->level = known->of->level;
    field->member = known->of->member;
    return FG_STATUS_OK;
  }
  field->level = t.level;
  field->member = t.member;
  *known = (about){key, field};
  status = intern_grid(&t.kind.grid, file, field);
  return status == FG_STATUS_OK ? intern_kind(&field->kind, file, &t.kind) : status;
}

fg_status fg__grib_tell_all(fg__grib_file *file)
{
  key_table table = {.size = 16};
  while (table.size < 2 * file->fields)
    table.size *= 2;
  table.slot = fg__allocate(table.size, sizeof *table.slot);
  if (!table.slot)
    return fg__fail_memory(file->context, "a table of fields",
                           table.size * sizeof *table.slot);
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < file->fields && status == FG_STATUS_OK; ++i) {
    status = tell_field(file, &table, &file->field[i]);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(file->context);
  }
  free(table.slot);
  return status;
}
