/* Which columns are places and velocities, by their names. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/names.h"
#include "read/table/table.h"

/* Names of coordinates, parted by |. */
static const char *const PLACES[3] = {
    "|x|xc|x_coordinate|x_coord|x_position|x_pos|xpos|pos_x|position_x|px|points_0|"
    "coordinates_0|easting|x_0|",
    "|y|yc|y_coordinate|y_coord|y_position|y_pos|ypos|pos_y|position_y|py|points_1|"
    "coordinates_1|northing|y_0|",
    "|z|zc|z_coordinate|z_coord|z_position|z_pos|zpos|pos_z|position_z|pz|points_2|"
    "coordinates_2|altitude|z_0|"};
static const char *const GLOBE[2] = {
    "|lon|long|longitude|lng|nav_lon|xlong|glon|lon_deg|longitude_deg|lon_e|"
    "degrees_east|lon_dd|",
    "|lat|latitude|nav_lat|xlat|glat|lat_deg|latitude_deg|lat_n|degrees_north|lat_dd|"};

/* Velocities that go by these names alone, before others. */
static const char *const VELOCITY_NAMES[][3] = {
    {"u", "v", "w"},         {"vx", "vy", "vz"}, {"ux", "uy", "uz"},
    {"east", "north", "up"}, {"ve", "vn", "vu"}, {"e", "n", "u"}};

/* What stands for one component in another's place in a name. */
static const char *const WORDS[][3] = {
    {"u", "v", "w"},         {"x", "y", "z"},
    {"east", "north", "up"}, {"zonal", "meridional", "vertical"},
    {"0", "1", "2"},         {"e", "n", "u"},
    {"i", "j", "k"}};

/* Words of names that are no velocity. */
static const char *const OTHER[] = {
    "err",    "error", "std",   "sigma", "unc",      "rms",        "var",
    "qc",     "flag",  "count", "pos",   "position", "coord",      "stress",
    "points", "flux",  "sd",    "se",    "variance", "uncertainty"};

/* Of planes one above another. */
static const char LEVELS[] =
    "|z|zc|z_coordinate|z_coord|z_position|z_pos|pos_z|position_z|points_2|"
    "coordinates_2|altitude|height|depth|level|lev|plane|";

static bool is_one_of(const char *list, const char *name)
{
  char word[FG__TABLE_NAME + 2];
  snprintf(word, sizeof word, "|%s|", name);
  return name[0] && strstr(list, word) != NULL;
}

static int find_listed(const fg__table *table, const char *list)
{
  for (int c = 0; c < table->columns; ++c)
    if (is_one_of(list, table->column[c].plain))
      return c;
  return -1;
}

/* A coordinate by its listed names, or one with its unit: x_mm, x_px. */
static int find_place(const fg__table *table, int axis)
{
  int found = find_listed(table, PLACES[axis]);
  for (int c = 0; c < table->columns && found < 0; ++c) {
    const char *plain = table->column[c].plain;
    if (plain[0] == "xyz"[axis] && plain[1] == '_' && fg__table_is_unit(plain + 2))
      found = c;
  }
  return found;
}

int fg__table_find_plain(const fg__table *table, const char *plain)
{
  for (int c = 0; c < table->columns; ++c)
    if (strcmp(table->column[c].plain, plain) == 0)
      return c;
  return -1;
}

bool fg__table_has_word(const char *plain, const char *word)
{
  const size_t length = strlen(word);
  for (const char *at = plain; (at = strstr(at, word)) != NULL; ++at)
    if ((at == plain || at[-1] == '_') && (at[length] == '\0' || at[length] == '_'))
      return true;
  return false;
}

static bool is_other(const char *plain)
{
  for (size_t i = 0; i < sizeof OTHER / sizeof *OTHER; ++i)
    if (fg__table_has_word(plain, OTHER[i]))
      return true;
  return false;
}

/* Whether a word at `at` may be a component's: a long one anywhere, a letter at the
 * beginning or end of a part of a longer name. */
static bool may_stand(const char *plain, const char *at, size_t length)
{
  const bool starts = at == plain || at[-1] == '_';
  const bool ends = at[length] == '\0' || at[length] == '_';
  return length > 1 || (plain[1] && (starts || ends));
}

/* The column named like `plain` but for one word. */
static int find_like(const fg__table *table, const char *plain, const char *at,
                     const char *word, const char *other)
{
  char name[2 * FG__TABLE_NAME];
  snprintf(name, sizeof name, "%.*s%s%s", (int)(at - plain), plain, other,
           at + strlen(word));
  return fg__table_find_plain(table, name);
}

/* The places of points; the first two or three columns where none have names. */
void fg__table_places(fg__table_vector *out, const fg__table *table)
{
  const int lon = find_listed(table, GLOBE[0]), lat = find_listed(table, GLOBE[1]);
  out->geographic = lon >= 0 && lat >= 0;
  out->position[0] = out->geographic ? lon : find_place(table, 0);
  out->position[1] = out->geographic ? lat : find_place(table, 1);
  out->position[2] = out->geographic ? -1 : find_place(table, 2);
}

/* Finds the columns of the time and level of rows, and those that mark rows without a
 * measurement (rows.c has which values do). */
static void find_time_and_validity(fg__table_vector *out, const fg__table *table)
{
  out->valid[0] = out->valid[1] = out->mask = -1;
  out->valid[0] = find_listed(table, "|chc|vector_type|isvalid|is_valid|flags|");
  if (fg__table_find_plain(table, "flags") >= 0 || table->columns == 5)
    out->valid[1] = fg__table_find_plain(table, "mask");
  out->time =
      find_listed(table, "|time|t|time_s|timestep|time_step|step|snapshot|date|"
                         "datetime|date_time|timestamp|time_utc|date_utc|valid_time|");
  if (out->time >= 0 && strcmp(table->column[out->time].name, "T") == 0)
    out->time = -1; /* a temperature */
  out->level = table->named ? find_listed(table, LEVELS) : -1;
}

/* A level's column has no other use. */
static void settle_level(fg__table_vector *v)
{
  for (int k = 0; k < 3; ++k)
    if (v->dimension == 3 || v->level == v->position[k] || v->level == v->velocity[k])
      v->level = -1;
}

static void add(fg__table_vector *list, int *count, const fg__table *table,
                const int velocity[3], const char *found_by)
{
  fg__table_vector v = {.found_by = found_by};
  fg__table_places(&v, table);
  find_time_and_validity(&v, table);
  const bool placed = v.position[0] >= 0 && v.position[1] >= 0;
  if (*count == FG__TABLE_VECTORS || (!placed && !table->placeless))
    return;
  v.dimension = velocity[2] >= 0 && (v.position[2] >= 0 || !placed) ? 3 : 2;
  for (int k = 0; k < 3; ++k) {
    v.velocity[k] = k < v.dimension ? velocity[k] : -1;
    for (int d = 0; d < 3; ++d)
      if (k < v.dimension && velocity[k] >= 0 && velocity[k] == v.position[d])
        return;
  }
  if (v.dimension == 2)
    v.position[2] = -1;
  settle_level(&v);
  list[(*count)++] = v;
}

/* A plane of x and z, or of y and z, where the third axis has no columns at all. */
static void add_upright(fg__table_vector *list, int *count, const fg__table *table,
                        const int velocity[3])
{
  fg__table_vector v = {.found_by = "names", .dimension = 2};
  int axis[3], axes = 0;
  fg__table_places(&v, table);
  find_time_and_validity(&v, table);
  for (int k = 0; k < 3; ++k) {
    if ((velocity[k] >= 0) != (v.position[k] >= 0))
      return;
    if (velocity[k] >= 0)
      axis[axes++] = k;
  }
  if (axes != 2 || *count == FG__TABLE_VECTORS)
    return;
  const int place[2] = {v.position[axis[0]], v.position[axis[1]]};
  for (int k = 0; k < 3; ++k) {
    v.position[k] = k < 2 ? place[k] : -1;
    v.velocity[k] = k < 2 ? velocity[axis[k]] : -1;
  }
  settle_level(&v);
  list[(*count)++] = v;
}

/* Pairs of names that differ by one word. */
static void find_pairs(fg__table_vector *list, int *count, const fg__table *table)
{
  for (int c = 0; c < table->columns; ++c) {
    const char *plain = table->column[c].plain;
    int found = -1;
    for (size_t w = 0; w < sizeof WORDS / sizeof *WORDS && found < 0; ++w) {
      const size_t length = strlen(WORDS[w][0]);
      for (const char *at = plain; (at = strstr(at, WORDS[w][0])) != NULL && found < 0;
           ++at) {
        if (is_other(plain) || !may_stand(plain, at, length))
          continue;
        found = find_like(table, plain, at, WORDS[w][0], WORDS[w][1]);
        if (found >= 0) {
          const int velocity[3] = {c, found,
                                   find_like(table, plain, at, WORDS[w][0], WORDS[w][2])};
          add(list, count, table, velocity, "names");
        }
      }
    }
  }
}

/* Speed and direction, clockwise from north: where the wind comes from, where anything
 * else goes to. */
static void find_polar(fg__table_vector *list, int *count, const fg__table *table)
{
  for (int c = 0; c < table->columns; ++c) {
    const int speed =
        fg__table_is_direction(table, c) ? fg__table_speed_of(table, c) : -1;
    const int velocity[3] = {speed, c, -1}, before = *count;
    if (speed >= 0)
      add(list, count, table, velocity, "speed and direction");
    if (*count > before && !list[before].geographic)
      *count = before; /* clockwise from north, or against it from x: who knows */
    else if (*count > before)
      fg__table_set_polar(&list[before], table);
  }
}

int fg__table_vectors(fg__table_vector out[FG__TABLE_VECTORS], const fg__table *table)
{
  int count = 0;
  if (!table->named && (table->columns == 4 || table->columns == 6)) {
    const int dimension = table->columns / 2;
    out[0] = (fg__table_vector){.dimension = dimension, .found_by = "columns"};
    find_time_and_validity(&out[0], table);
    for (int k = 0; k < 3; ++k) {
      out[0].velocity[k] = k < dimension ? dimension + k : -1;
      out[0].position[k] = k < dimension ? k : -1;
    }
    return 1;
  }
  for (size_t i = 0; i < sizeof VELOCITY_NAMES / sizeof *VELOCITY_NAMES && count == 0;
       ++i) {
    const int velocity[3] = {fg__table_find_plain(table, VELOCITY_NAMES[i][0]),
                             fg__table_find_plain(table, VELOCITY_NAMES[i][1]),
                             fg__table_find_plain(table, VELOCITY_NAMES[i][2])};
    if (velocity[0] >= 0 && velocity[1] >= 0)
      add(out, &count, table, velocity, "names");
    else
      add_upright(out, &count, table, velocity);
  }
  if (count == 0)
    find_pairs(out, &count, table);
  if (count == 0)
    find_polar(out, &count, table);
  return count;
}

int fg__table_find(const fg__table *table, const char *name)
{
  fg__table_column wanted;
  fg__table_name(&wanted, name, strlen(name));
  for (int c = 0; c < table->columns; ++c)
    if (strcmp(table->column[c].name, name) == 0)
      return c;
  const int plain = wanted.plain[0] ? fg__table_find_plain(table, wanted.plain) : -1;
  char *end;
  const long number = strtol(name, &end, 10);
  if (plain < 0 && *end == '\0' && number >= 1 && number <= table->columns)
    return (int)number - 1;
  return plain;
}

static fg__names list_names(const fg__table *table)
{
  fg__names names = {0};
  for (int c = 0; c < table->columns; ++c)
    fg__names_add(&names, ", ", "%s", table->column[c].name);
  return names;
}

static fg_status fail_unknown(const fg__table *table, const char *name)
{
  fg__fail(table->context, FG_STATUS_ARGUMENT, "%s: no column \"%.100s\"", table->path,
           name);
  fg__hint(table->context, "its columns: %s; or their numbers from 1",
           list_names(table).text);
  return FG_STATUS_ARGUMENT;
}

enum { MOST_NAMED = 6 };

/* The columns that vars names; *count of them, of which MOST_NAMED are kept. */
static fg_status find_named(int column[MOST_NAMED], int *count, const fg__table *table,
                            const char *vars)
{
  char *copy = fg__copy_text(vars);
  *count = 0;
  if (!copy)
    return fg__fail_memory(table->context, "names of columns", strlen(vars) + 1);
  fg_status status = FG_STATUS_OK;
  for (char *at = copy; at && status == FG_STATUS_OK;) {
    char *comma = strchr(at, ',');
    if (comma)
      *comma++ = '\0';
    const int found = fg__table_find(table, at);
    if (found < 0)
      status = fail_unknown(table, at);
    else if ((*count)++ < MOST_NAMED)
      column[*count - 1] = found;
    at = comma;
  }
  free(copy);
  return status;
}

static fg_status choose_named(fg__table_vector *out, const fg__table *table,
                              const fg_read_options *options)
{
  int column[MOST_NAMED] = {0}, count;
  fg_status status = find_named(column, &count, table, options->vars);
  if (status != FG_STATUS_OK)
    return status;
  if (count < 2 || count > MOST_NAMED || count == 5)
    return fg__fail(table->context, FG_STATUS_ARGUMENT,
                    "%s: %d columns named; 2 or 3 are a velocity, 4 or 6 places and "
                    "velocity",
                    table->path, count);
  const bool with_places = count > 3;
  *out = (fg__table_vector){.dimension = with_places ? count / 2 : count,
                            .found_by = "vars"};
  fg__table_places(out, table);
  find_time_and_validity(out, table);
  for (int k = 0; k < 3; ++k) {
    const int at = with_places ? out->dimension + k : k;
    out->velocity[k] = k < out->dimension ? column[at] : -1;
    if (with_places)
      out->position[k] = k < out->dimension ? column[k] : -1;
    else if (!table->named)
      out->position[k] = k < out->dimension ? k : -1;
  }
  if (with_places)
    out->geographic = is_one_of(GLOBE[0], table->column[column[0]].plain) &&
                      is_one_of(GLOBE[1], table->column[column[1]].plain);
  settle_level(out);
  status = fg__table_settle_polar(out, table,
                                  out->geographic || options->scale == FG_SCALE_GEO);
  if (status != FG_STATUS_OK)
    return status;
  if (table->placeless || (out->position[0] >= 0 && out->position[1] >= 0 &&
                           (out->dimension == 2 || out->position[2] >= 0)))
    return FG_STATUS_OK;
  fg__fail(table->context, FG_STATUS_ARGUMENT,
           "%s: no column is known to have the points' coordinates", table->path);
  fg__hint(table->context, "name them first: --vars X,Y,U,V");
  return FG_STATUS_ARGUMENT;
}

static fg_status fail_ambiguous(const fg__table *table, const fg__table_vector *vectors,
                                int count)
{
  fg__names all = {0};
  for (int i = 0; i < count; ++i)
    fg__names_add(&all, " | ", "%s,%s", table->column[vectors[i].velocity[0]].name,
                  table->column[vectors[i].velocity[1]].name);
  fg__fail(table->context, FG_STATUS_ARGUMENT, "%s: %d vectors could be meant: %s",
           table->path, count, all.text);
  fg__hint(table->context, "choose one: --vars %s,%s",
           table->column[vectors[0].velocity[0]].name,
           table->column[vectors[0].velocity[1]].name);
  return FG_STATUS_ARGUMENT;
}

fg_status fg__table_choose(fg__table_vector *out, const fg__table *table,
                           const fg_read_options *options)
{
  fg__table_vector found[FG__TABLE_VECTORS];
  fg_status status = FG_STATUS_OK;
  if (options->vars) {
    status = choose_named(out, table, options);
  } else {
    const int count = fg__table_vectors(found, table);
    if (count == 0) {
      status = fg__fail(table->context, FG_STATUS_UNSUPPORTED,
                        "%s: %d columns%s %s: which are x, y, u and v?", table->path,
                        table->columns, table->named ? "," : " without names,",
                        list_names(table).text);
      fg__hint(table->context,
               "name them: --vars X,Y,U,V, or by numbers: --vars 1,2,3,4");
    } else if (count > 1) {
      status = fail_ambiguous(table, found, count);
    } else {
      *out = found[0];
    }
  }
  if (status == FG_STATUS_OK && options->mask) {
    out->mask = fg__table_find(table, options->mask);
    if (out->mask < 0)
      status = fail_unknown(table, options->mask);
  }
  if (status == FG_STATUS_OK && options->scale != FG_SCALE_AUTO)
    out->geographic = options->scale == FG_SCALE_GEO;
  return status;
}
