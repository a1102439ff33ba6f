/* What has no names in a file: dimensions of arrays in HDF5 and NumPy's files, which get
 * the names of the coordinates that fit them, and the columns of a table without a
 * header. */
#include "interpret/interpret.h"
#include "terms/coordinates.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPACE = 3 };

/* Whether names are numbers in a row, "1", "2", ...; or "arr_0", "arr_1", ... as
 * numpy.savez gives them. */
static bool is_number(const fg__variable *v, const char *before, int first, int *number)
{
  char *end;
  const size_t length = strlen(before);
  if (strncmp(v->name, before, length) != 0 || v->name[length] < '0' ||
      v->name[length] > '9')
    return false;
  *number = (int)strtol(v->name + length, &end, 10) - first;
  return *end == '\0' && *number >= 0;
}

/* Four variables of one file that have numbers for names are x, y, u, v, and six x, y, z,
 * u, v, w. */
static void name_variables(fg__dataset *data, const char *before, int first)
{
  static const char *const plane[] = {"x", "y", "u", "v"}, *const space[] = {"x", "y",
                                                                             "z", "u",
                                                                             "v", "w"};
  fg__variable *found[6];
  int count = 0, number;
  for (size_t i = 0; i < data->variable_count && !data->lost_names; ++i) {
    fg__variable *v = &data->variables[i];
    if (v->file != data->files - 1 || v->element != 0 ||
        !is_number(v, before, first, &number))
      continue;
    if (number != count || count == 6)
      return;
    found[count++] = v;
  }
  for (int k = 0; (count == 4 || count == 6) && k < count; ++k)
    found[k]->plain_name = count == 4 ? plane[k] : space[k];
}

/* The file's coordinate of that use along a dimension of its own, or NULL. */
static fg__variable *find_coordinate(const fg__dataset *data, fg__column_use use)
{
  fg__variable *best = NULL;
  int fits = 0;
  for (size_t i = 0; i < data->variable_count; ++i) {
    fg__variable *v = &data->variables[i];
    if (v->file != data->files - 1 || v->rank != 1 || v->element != 0 ||
        !fg__is_number(v) || fg__column_fits(v->plain_name, use) <= fits)
      continue;
    best = v;
    fits = fg__column_fits(v->plain_name, use);
  }
  return best;
}

static size_t length_along(const fg__dataset *data, const fg__variable *v, int k)
{
  return data->dimensions[v->dimension[k]].length;
}

/* Whether a coordinate may lie along dimension k of a variable. */
static bool fits(const fg__dataset *data, const fg__variable *v, int k,
                 const fg__variable *coordinate)
{
  return coordinate && k >= 0 && data->dimensions[v->dimension[k]].is_nameless &&
         length_along(data, v, k) == length_along(data, coordinate, 0);
}

/* Makes dimension k of a variable the coordinate's, which has its name from then on. */
static bool join(fg__dataset *data, fg__variable *v, int k, fg__variable *coordinate)
{
  if (data->dimensions[coordinate->dimension[0]].is_nameless) {
    const size_t length = length_along(data, coordinate, 0);
    fg__dimension *d = fg__dataset_add_dimension(data, coordinate->plain_name, length);
    if (!d)
      return false;
    d->file = coordinate->file;
    coordinate->dimension[0] = (int)data->dimension_count - 1;
  }
  v->dimension[k] = coordinate->dimension[0];
  return true;
}

/* Coordinates of a plane or a volume: x, y, z. */
typedef struct axes {
  fg__variable *at[SPACE];
} axes;

/* Names the last dimensions y, x of a variable, or x, y where lengths tell, and one
 * before them z or time. */
static bool name_dimensions(bool *done, fg__dataset *data, fg__variable *v,
                            const axes *of, fg__variable *time)
{
  const int last = v->rank - 1;
  const bool straight =
      fits(data, v, last, of->at[0]) && fits(data, v, last - 1, of->at[1]);
  const bool turned =
      !straight && fits(data, v, last - 1, of->at[0]) && fits(data, v, last, of->at[1]);
  *done = straight || turned;
  if (!*done)
    return true;
  bool memory = join(data, v, turned ? last - 1 : last, of->at[0]) &&
                join(data, v, turned ? last : last - 1, of->at[1]);
  int before = last - 2;
  if (memory && fits(data, v, before, of->at[2]))
    memory = join(data, v, before--, of->at[2]);
  if (memory && fits(data, v, before, time))
    memory = join(data, v, before, time);
  return memory;
}

static bool is_nameless(const fg__dataset *data, const fg__variable *v)
{
  return v->file == data->files - 1 && v->rank >= 2 && v->rank <= FG__RANK &&
         data->dimensions[v->dimension[v->rank - 1]].is_nameless;
}

/* Longitude and latitude before x and y; planes of x and z, or y and z, have no third. */
static int list_axes(axes out[4], const fg__dataset *data)
{
  static const fg__column_use uses[4][SPACE] = {
      {FG__COLUMN_LONGITUDE, FG__COLUMN_LATITUDE, FG__COLUMN_Z},
      {FG__COLUMN_X, FG__COLUMN_Y, FG__COLUMN_Z},
      {FG__COLUMN_X, FG__COLUMN_Z, FG__COLUMN_Y},
      {FG__COLUMN_Y, FG__COLUMN_Z, FG__COLUMN_X}};
  int count = 0;
  for (int i = 0; i < 4; ++i) {
    axes a;
    for (int k = 0; k < SPACE; ++k)
      a.at[k] = find_coordinate(data, uses[i][k]);
    if (a.at[0] && a.at[1] && (i < 2 || !a.at[2]))
      out[count++] = a;
  }
  return count;
}

fg_status fg__settle_names(fg__dataset *data)
{
  axes known[4];
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__term term = fg__term_of(&data->variables[i]);
    data->variables[i].geographic = fg__geographic_role(&term);
  }
  name_variables(data, "", 1);
  name_variables(data, "arr_", 0);
  const int count = list_axes(known, data);
  fg__variable *time = find_coordinate(data, FG__COLUMN_TIME);
  for (size_t i = 0; i < data->variable_count; ++i) {
    bool done = !is_nameless(data, &data->variables[i]);
    for (int n = 0; n < count && !done; ++n)
      if (!name_dimensions(&done, data, &data->variables[i], &known[n], time))
        return FG_STATUS_MEMORY;
  }
  return FG_STATUS_OK;
}

/* An array of booleans called mask, as numpy.ma has them. */
static const fg__variable *find_hidden(const fg__dataset *data, const fg__grid *grid,
                                       const fg__variable *component)
{
  char type[FG__TEXT_BYTES];
  const fg__variable *v = fg__dataset_find(data, "mask");
  return v && fg__attribute_text(v, "dtype", type, sizeof type) &&
                 strcmp(type, "bool") == 0 && fg__lies_on(data, v, grid, component)
             ? v
             : NULL;
}

void fg__check_nameless(fg__grid *grid, const fg__dataset *data, const fg__variable *v)
{
  axes known[4];
  grid->hidden = find_hidden(data, grid, v);
  if (!is_nameless(data, v) || list_axes(known, data) == 0)
    return;
  const fg__variable *x = known[0].at[0], *y = known[0].at[1];
  fg__set_unusable(grid->unusable,
                   "'%.60s' has %zu and '%.60s' %zu numbers, which do not fit the %zu x "
                   "%zu samples of '%.60s'",
                   x->plain_name, length_along(data, x, 0), y->plain_name,
                   length_along(data, y, 0), length_along(data, v, v->rank - 1),
                   length_along(data, v, v->rank - 2), v->plain_name);
  snprintf(grid->hint, sizeof grid->hint,
           "give the coordinates of the samples, or leave them out");
}

/* A first dimension that neither has a name nor makes a volume is time. */
void fg__nameless_time(fg__grid *grid, const fg__dataset *data, const fg__variable *v)
{
  if (grid->level < 0 || grid->time >= 0 ||
      !data->dimensions[v->dimension[grid->level]].is_nameless)
    return;
  grid->time = grid->level;
  grid->level = -1;
  fg__set_index_axes(grid, data, v);
  snprintf(grid->time_name, sizeof grid->time_name, "time");
}
