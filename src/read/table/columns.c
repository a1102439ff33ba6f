/* Which columns are places and velocities, by their names. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "read/table/table.h"
#include "terms/coordinates.h"
#include "terms/units.h"
#include "terms/vectors.h"

/* The column that has a use by its name, or else may have it; -1: none. */
static int find_column(const fg__table *table, fg__column_use use)
{
  for (int least = 2; least > 0; --least)
    for (int c = 0; c < table->columns; ++c)
      if (fg__column_fits(table->column[c].name, use) >= least)
        return c;
  return -1;
}

int fg__table_find_plain(const fg__table *table, const char *plain)
{
  for (int c = 0; c < table->columns; ++c)
    if (strcmp(table->column[c].plain, plain) == 0)
      return c;
  return -1;
}

/* The places of points; the first two or three columns where none have names. */
void fg__table_places(fg__table_vector *out, const fg__table *table)
{
  const int lon = find_column(table, FG__COLUMN_LONGITUDE),
            lat = find_column(table, FG__COLUMN_LATITUDE);
  out->geographic = lon >= 0 && lat >= 0;
  out->position[0] = out->geographic ? lon : find_column(table, FG__COLUMN_X);
  out->position[1] = out->geographic ? lat : find_column(table, FG__COLUMN_Y);
  out->position[2] = out->geographic ? -1 : find_column(table, FG__COLUMN_Z);
}

/* Finds the columns of the time and level of rows, and those that mark rows without a
 * measurement (rows.c has which values do). */
static void find_time_and_validity(fg__table_vector *out, const fg__table *table)
{
  out->valid[0] = find_column(table, FG__COLUMN_VALIDITY);
  out->valid[1] = out->mask = -1;
  if (fg__table_find_plain(table, "flags") >= 0 || table->columns == 5)
    out->valid[1] = fg__table_find_plain(table, "mask");
  out->time = find_column(table, FG__COLUMN_TIME);
  if (out->time >= 0 && strcmp(table->column[out->time].name, "T") == 0)
    out->time = -1; /* a temperature */
  out->level = table->named ? find_column(table, FG__COLUMN_LEVEL) : -1;
}

/* A level's column has no other use. */
static void settle_level(fg__table_vector *v)
{
  for (int k = 0; k < 3; ++k)
    if (v->dimension == 3 || v->level == v->position[k] || v->level == v->velocity[k])
      v->level = -1;
}

/* A vector in a plane of x and z, or of y and z, where the third axis has no columns at
 * all; false: there is none. */
static bool set_upright(fg__table_vector *v, const int velocity[3])
{
  int axis[3], axes = 0;
  for (int k = 0; k < 3; ++k) {
    if ((velocity[k] >= 0) != (v->position[k] >= 0))
      return false;
    if (velocity[k] >= 0)
      axis[axes++] = k;
  }
  v->dimension = 2;
  for (int k = 0; k < 2 && axes == 2; ++k) {
    v->position[k] = v->position[axis[k]]; /* axis[k] is k or larger */
    v->velocity[k] = velocity[axis[k]];
  }
  return axes == 2;
}

/* Whether columns are those of places, and no others can be. */
static bool are_taken(const fg__table_vector *v, const fg__table *table,
                      const int velocity[3], int dimension)
{
  for (int k = 0; k < dimension; ++k)
    for (int d = 0; d < 3; ++d)
      if (velocity[k] == v->position[d] &&
          (!table->placeless || fg__names_coordinate(table->column[velocity[k]].name)))
        return true;
  return false;
}

/* A vector in a plane or in space; false where its columns have another use. */
static bool set_components(fg__table_vector *v, const fg__table *table,
                           const int velocity[3])
{
  const bool placed = v->position[0] >= 0 && v->position[1] >= 0;
  if (!placed && !table->placeless)
    return false;
  v->dimension = velocity[2] >= 0 && (v->position[2] >= 0 || !placed) ? 3 : 2;
  if (are_taken(v, table, velocity, v->dimension))
    return false;
  for (int k = 0; k < v->dimension; ++k) {
    v->velocity[k] = velocity[k];
    for (int d = 0; d < 3; ++d)
      if (velocity[k] == v->position[d]) /* px and py alone are a momentum */
        v->position[0] = v->position[1] = v->position[2] = -1;
  }
  return true;
}

/* Where a direction counts from is known on the globe, or said. */
static bool set_vector(fg__table_vector *out, const fg__table *table,
                       const fg__vector *found)
{
  *out = (fg__table_vector){
      .found_by = found->found_by, .polar = found->polar, .velocity = {-1, -1, -1}};
  fg__table_places(out, table);
  find_time_and_validity(out, table);
  if ((found->polar.sense != 0 && !out->geographic && !found->polar.from_east) ||
      !(found->is_upright ? set_upright(out, found->component)
                          : set_components(out, table, found->component)))
    return false;
  if (out->dimension == 2)
    out->position[2] = -1;
  settle_level(out);
  return true;
}

fg__term fg__table_term(const fg__table *table, int column)
{
  return (fg__term){.name = table->column[column].name,
                    .units = table->column[column].units,
                    .file = -1};
}

/* The vectors of the best rank that has one. */
static fg_status find_vectors(fg__table_vector out[FG__TABLE_VECTORS], int *count,
                              const fg__table *table)
{
  static const fg__vector_rules rules = {.at_points = true};
  fg__term *term = fg__allocate((size_t)table->columns, sizeof *term);
  fg__vector *found = NULL;
  size_t all = 0;
  for (int c = 0; c < table->columns && term; ++c)
    term[c] = fg__table_term(table, c);
  const bool memory =
      term && fg__vectors_find(&found, &all, term, (size_t)table->columns, &rules);
  int rank = 0;
  for (size_t i = 0; i < all && *count < FG__TABLE_VECTORS; ++i) {
    if (*count > 0 && found[i].rank > rank)
      break;
    rank = found[i].rank;
    *count += set_vector(&out[*count], table, &found[i]);
  }
  free(found);
  free(term);
  return memory ? FG_STATUS_OK : fg__fail_memory(table->context, "vectors", 0);
}

fg_status fg__table_vectors(fg__table_vector out[FG__TABLE_VECTORS], int *count,
                            const fg__table *table)
{
  *count = 0;
  if (table->named)
    return find_vectors(out, count, table);
  if (table->columns != 4 && table->columns != 6)
    return FG_STATUS_OK;
  const int dimension = table->columns / 2;
  out[0] = (fg__table_vector){.dimension = dimension, .found_by = "columns"};
  find_time_and_validity(&out[0], table);
  for (int k = 0; k < 3; ++k) {
    out[0].velocity[k] = k < dimension ? dimension + k : -1;
    out[0].position[k] = k < dimension ? k : -1;
  }
  *count = 1;
  return FG_STATUS_OK;
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

static void list_names(char *out, size_t size, const fg__table *table)
{
  size_t used = 0;
  out[0] = '\0';
  for (int c = 0; c < table->columns && used + FG__TABLE_NAME + 8 < size; ++c)
    used += (size_t)snprintf(out + used, size - used, "%s%s", c ? ", " : "",
                             table->column[c].name);
}

static fg_status fail_unknown(const fg__table *table, const char *name)
{
  char names[512];
  list_names(names, sizeof names, table);
  fg__fail(table->context, FG_STATUS_ARGUMENT, "%s: no column \"%.100s\"", table->path,
           name);
  fg__hint(table->context, "its columns: %s; or their numbers from 1", names);
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
    out->geographic =
        fg__column_fits(table->column[column[0]].name, FG__COLUMN_LONGITUDE) &&
        fg__column_fits(table->column[column[1]].name, FG__COLUMN_LATITUDE);
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
  char all[1024] = "";
  size_t used = 0;
  for (int i = 0; i < count && used + 2 * FG__TABLE_NAME + 8 < sizeof all; ++i)
    used += (size_t)snprintf(all + used, sizeof all - used, "%s%s,%s", i ? " | " : "",
                             table->column[vectors[i].velocity[0]].name,
                             table->column[vectors[i].velocity[1]].name);
  fg__fail(table->context, FG_STATUS_ARGUMENT, "%s: %d vectors could be meant: %s",
           table->path, count, all);
  fg__hint(table->context, "choose one: --vars %s,%s",
           table->column[vectors[0].velocity[0]].name,
           table->column[vectors[0].velocity[1]].name);
  return FG_STATUS_ARGUMENT;
}

/* Refuses a vector of two units. */
static fg_status check_units(const fg__table *table, const fg__table_vector *v)
{
  const fg__table_column *u = &table->column[v->velocity[0]];
  for (int k = 1; k < v->dimension && v->polar.sense == 0; ++k) {
    const fg__table_column *other = &table->column[v->velocity[k]];
    if (fg__units_differ(u->units, other->units))
      return fg__fail(table->context, FG_STATUS_UNSUPPORTED, "%s: %s is in %s, %s in %s",
                      table->path, u->name, u->units, other->name, other->units);
  }
  return FG_STATUS_OK;
}

fg_status fg__table_choose(fg__table_vector *out, const fg__table *table,
                           const fg_read_options *options)
{
  fg__table_vector found[FG__TABLE_VECTORS];
  fg_status status = FG_STATUS_OK;
  if (options->vars) {
    status = choose_named(out, table, options);
  } else {
    int count;
    char names[512];
    list_names(names, sizeof names, table);
    status = fg__table_vectors(found, &count, table);
    if (status == FG_STATUS_OK && count == 0) {
      status = fg__fail(table->context, FG_STATUS_UNSUPPORTED,
                        "%s: %d columns%s %s: which are x, y, u and v?", table->path,
                        table->columns, table->named ? "," : " without names,", names);
      fg__hint(table->context,
               "name them: --vars X,Y,U,V, or by numbers: --vars 1,2,3,4");
    } else if (count > 1) {
      status = fail_ambiguous(table, found, count);
    } else if (status == FG_STATUS_OK) {
      *out = found[0];
    }
  }
  if (status == FG_STATUS_OK)
    status = check_units(table, out);
  if (status == FG_STATUS_OK && options->mask) {
    out->mask = fg__table_find(table, options->mask);
    if (out->mask < 0)
      status = fail_unknown(table, options->mask);
  }
  if (status == FG_STATUS_OK && options->scale != FG_SCALE_AUTO)
    out->geographic = options->scale == FG_SCALE_GEO;
  return status;
}
