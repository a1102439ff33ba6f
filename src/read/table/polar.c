/* Which columns are a speed and a direction, by their names. */
#include <stdio.h>
#include <string.h>

#include "base/angle.h"
#include "read/table/table.h"

/* Where a name's word for a direction is; NULL: none. */
static const char *find_direction(const char *plain)
{
  const char *at = strstr(plain, "dir");
  if (!at)
    at = strstr(plain, "drct"); /* as METAR archives have it */
  const bool is_word =
      at && (at == plain || at[-1] == '_' || strncmp(plain, "wdir", 4) == 0 ||
             strncmp(plain, "winddir", 7) == 0);
  return is_word ? at : NULL;
}

/* Synoptic tables call the wind's direction dd and its speed ff. */
static bool is_synoptic(const char *plain)
{
  return strcmp(plain, "dd") == 0;
}

bool fg__table_is_direction(const fg__table *table, int column)
{
  const char *plain = table->column[column].plain;
  return is_synoptic(plain) ? fg__table_find_plain(table, "ff") >= 0
                            : find_direction(plain) != NULL;
}

int fg__table_speed_of(const fg__table *table, int direction)
{
  static const char *const speeds[] = {"speed", "spd", "vel", "velocity", "sknt"};
  const char *plain = table->column[direction].plain;
  if (is_synoptic(plain))
    return fg__table_find_plain(table, "ff");
  const char *at = find_direction(plain);
  if (!at)
    return -1;
  /* wind_direction_10m is that of wind_speed_10m, wind_dir_deg that of wind_speed */
  const char *const ends[] = {at + strcspn(at, "_"), ""};
  for (size_t e = 0; e < sizeof ends / sizeof *ends; ++e)
    for (size_t s = 0; s < sizeof speeds / sizeof *speeds; ++s) {
      char name[2 * FG__TABLE_NAME];
      snprintf(name, sizeof name, "%.*s%s%s", (int)(at - plain), plain, speeds[s],
               ends[e]);
      const int speed = fg__table_find_plain(table, name);
      if (speed >= 0)
        return speed;
    }
  return -1;
}

void fg__table_set_polar(fg__table_vector *vector, const fg__table *table)
{
  const char *plain = table->column[vector->velocity[1]].plain;
  const char *units = table->column[vector->velocity[1]].units;
  vector->polar.sense = fg__polar_sense(plain, "");
  vector->polar.unit = units[0]                           ? fg__polar_unit(units)
                       : fg__table_has_word(plain, "rad") ? 1.0
                                                          : FG__RADIANS;
}

/* A direction that has this speed; -1: none. */
static int direction_of(const fg__table *table, int speed)
{
  for (int c = 0; c < table->columns; ++c)
    if (fg__table_is_direction(table, c) && fg__table_speed_of(table, c) == speed)
      return c;
  return -1;
}

/* Whether a name has a word for a speed, perhaps with another before it: wspd. */
static bool is_speed(const fg__table *table, int column)
{
  static const char *const ends[] = {"speed", "spd", "sknt", "gust"};
  const char *plain = table->column[column].plain;
  for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i)
    for (const char *at = plain; (at = strstr(at, ends[i])) != NULL; ++at) {
      const char after = at[strlen(ends[i])];
      if (after == '\0' || after == '_')
        return true;
    }
  return fg__table_has_word(plain, "vel") || fg__table_has_word(plain, "velocity") ||
         direction_of(table, column) >= 0;
}

/* A direction beside what is no speed, or the other way round. */
static fg_status fail_half(const fg__table *table, int half, int other, bool direction)
{
  const int missing =
      direction ? fg__table_speed_of(table, half) : direction_of(table, half);
  const int speed = direction ? missing : half, way = direction ? half : missing;
  fg__fail(table->context, FG_STATUS_ARGUMENT, "%s: %s is a %s, and %s is no %s",
           table->path, table->column[half].name, direction ? "direction" : "speed",
           table->column[other].name, direction ? "speed" : "direction");
  if (missing >= 0)
    fg__hint(table->context, "name a speed and its direction: --vars %s,%s",
             table->column[speed].name, table->column[way].name);
  else
    fg__hint(table->context, "name a speed and its direction, or two components");
  return FG_STATUS_ARGUMENT;
}

fg_status fg__table_settle_polar(fg__table_vector *vector, const fg__table *table,
                                 bool on_globe)
{
  int *pair = vector->velocity;
  if (vector->dimension != 2 || !table->named)
    return FG_STATUS_OK;
  const bool way[2] = {fg__table_is_direction(table, pair[0]),
                       fg__table_is_direction(table, pair[1])};
  if (way[0] == way[1]) {
    for (int k = 0; k < 2 && !way[0]; ++k)
      if (direction_of(table, pair[k]) >= 0 && !is_speed(table, pair[1 - k]))
        return fail_half(table, pair[k], pair[1 - k], false);
    return FG_STATUS_OK;
  }
  const int direction = pair[way[0] ? 0 : 1], speed = pair[way[0] ? 1 : 0];
  if (!is_speed(table, speed))
    return fail_half(table, direction, speed, true);
  if (!on_globe) {
    fg__fail(table->context, FG_STATUS_UNSUPPORTED,
             "%s: %s and %s are a speed and a direction, which are read with longitude "
             "and latitude only",
             table->path, table->column[speed].name, table->column[direction].name);
    fg__hint(table->context,
             "write components u and v first: whether the direction turns from north or "
             "from x is not known");
    return FG_STATUS_UNSUPPORTED;
  }
  pair[0] = speed;
  pair[1] = direction;
  fg__table_set_polar(vector, table);
  return FG_STATUS_OK;
}
