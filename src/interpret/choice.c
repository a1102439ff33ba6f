/* Selects the pair to read: the one that the options name, or the only one of best
 * rank. */
#include "base/memory.h"
#include "base/names.h"
#include "interpret/interpret.h"
#include "terms/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct candidates {
  fg__pair *pair;
  size_t count;
} candidates;

/* Writes "u,v", or "u,v,w" of a volume, or the name of a vector variable. */
static int write_names(char *out, size_t size, const fg__pair *pair, bool volume)
{
  if (pair->component[0]->element)
    return snprintf(out, size, "%s", pair->component[0]->name);
  return snprintf(out, size, "%s,%s%s%s", pair->component[0]->name,
                  pair->component[1]->name, volume ? "," : "",
                  volume ? pair->component[2]->name : "");
}

/* Lists pairs as "u,v; u10,v10": all, or those whose dimension is not 0. */
static fg__names list_pairs(const candidates *all, const int *dimension)
{
  char pair[3 * FG__NAME_BYTES];
  fg__names names = {0};
  for (size_t i = 0; i < all->count; ++i) {
    if (dimension && dimension[i] == 0)
      continue;
    write_names(pair, sizeof pair, &all->pair[i], dimension && dimension[i] == 3);
    fg__names_add(&names, "; ", "%s", pair);
  }
  return names;
}

/* The only variable that GRIB calls so, as "10u" is called u10 too; NULL: none. */
static const fg__variable *find_alias(const fg__dataset *data, const char *name, int file)
{
  static const char *const words[] = {"GRIB_shortName", "GRIB_cfVarName"};
  const fg__variable *found = NULL;
  char text[FG__TEXT_BYTES];
  for (size_t i = 0; i < data->variable_count; ++i)
    for (int k = 0; k < 2; ++k) {
      const fg__variable *v = &data->variables[i];
      if (v->file != file || !fg__attribute_text(v, words[k], text, sizeof text) ||
          strcmp(text, name) != 0)
        continue;
      if (found && found != v)
        return NULL;
      found = v;
    }
  return found;
}

/* Whether a text is a column's name, in any letters, perhaps with its units behind it, as
 * in "Wind Speed (kt)". */
static bool is_column(const char *name, const char *text)
{
  char one[FG__TEXT_BYTES], other[FG__TEXT_BYTES], word[FG__TEXT_BYTES];
  const size_t length = strcspn(text, "([");
  fg__plain_name(one, sizeof one, name);
  fg__plain_name(other, sizeof other, text);
  if (one[0] && strcmp(one, other) == 0)
    return true;
  snprintf(word, sizeof word, "%.*s", (int)length, text);
  fg__plain_name(other, sizeof other, word);
  return one[0] && strcmp(one, other) == 0;
}

/* The variable of a number from 1, as columns are counted; NULL: it is none. */
static const fg__variable *find_numbered(const fg__dataset *data, const char *text)
{
  char *end;
  const unsigned long number = strtoul(text, &end, 10);
  return fg__is_digit(*text) && !*end && number >= 1 && number <= data->variable_count
             ? &data->variables[number - 1]
             : NULL;
}

/* A name may begin with the slash of the root group, and be one of a column. */
static const fg__variable *find_named(const fg__dataset *data, const char *name,
                                      int preferred)
{
  name += name[0] == '/';
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->file == preferred &&
        (strcmp(v->name, name) == 0 || strcmp(v->plain_name, name) == 0))
      return v;
  }
  const fg__variable *found = fg__dataset_find(data, name);
  for (size_t i = 0; i < data->variable_count && !found; ++i)
    if (is_column(data->variables[i].plain_name, name))
      found = &data->variables[i];
  found = found ? found : find_alias(data, name, preferred);
  return found ? found : find_numbered(data, name);
}

/* The first direction among the variables of two dimensions or more; NULL: none. */
static const fg__variable *find_direction(const fg__dataset *data)
{
  fg__polar ignored;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__term term = fg__term_of(&data->variables[i]);
    if (data->variables[i].rank >= 2 && fg__direction_read(&ignored, &term))
      return &data->variables[i];
  }
  return NULL;
}

/* Lists variables as "u, lat, lon", possible components first, but no axes in space,
 * which are none of the file's. */
static fg__names list_variables(const fg__dataset *data)
{
  fg__names names = {0};
  for (int turn = 0; turn < 2; ++turn)
    for (size_t i = 0; i < data->variable_count; ++i) {
      const fg__variable *v = &data->variables[i];
      const bool is_field = v->location || (v->rank >= 2 && v->type != FG__TYPE_LETTERS);
      if (is_field == (turn == 0) && v->element < 2 &&
          (v->location || !data->space.is_there))
        fg__names_add(&names, ", ", "%s", v->name);
    }
  return names;
}

fg_status fg__fail_unknown(const fg__dataset *data, const char *name)
{
  const fg__names names = list_variables(data);
  fg_status status =
      fg__fail(data->context, FG_STATUS_ARGUMENT, "%s: has no variable '%s'",
               data->file[data->component_files - 1].path, name);
  if (names.count > 0)
    fg__hint(data->context, "its variables: %s", names.text);
  return status;
}

static fg_status fail_unknown_name(const fg__dataset *data, const candidates *all,
                                   const char *name)
{
  const fg__names list = list_pairs(all, NULL);
  if (list.count == 0)
    return fg__fail_unknown(data, name);
  const fg_status status =
      fg__fail(data->context, FG_STATUS_ARGUMENT, "%s: has no variable '%s'",
               data->file[data->component_files - 1].path, name);
  fg__hint(data->context, "pairs in it: %s", list.text);
  return status;
}

static fg_status fail_names(const fg__dataset *data, const candidates *all,
                            const char *vars)
{
  const fg__names list = list_pairs(all, NULL);
  fg__fail(
      data->context, FG_STATUS_ARGUMENT,
      strchr(vars, ',')
          ? "%s: '%s' is not two or three names with commas between, nor four or six "
            "with the coordinates first"
          : "%s: '%s' is one variable, and a velocity has two or three components",
      data->file[0].path, vars);
  if (list.count > 0)
    fg__hint(data->context, "pairs in it: %s", list.text);
  else
    fg__hint(data->context, "name two variables: --vars U,V; or three: --vars U,V,W");
  return FG_STATUS_ARGUMENT;
}

enum { MOST_NAMED = 6 };

/* Splits "u,v" or "u,v,w", or "x,y,u,v" or "x,y,z,u,v,w"; returns the number of names, 0
 * for anything else. */
static int split_names(char name[MOST_NAMED][FG__NAME_BYTES], const char *vars)
{
  int count = 0;
  while (count < MOST_NAMED) {
    const size_t length = strcspn(vars, ",");
    if (length == 0 || length >= FG__NAME_BYTES)
      return 0;
    memcpy(name[count], vars, length);
    name[count++][length] = '\0';
    if (!vars[length])
      return count > 1 && count != 5 ? count : 0;
    vars += length + 1;
  }
  return 0;
}

/* Refuses "v,u" of a pair whose standard names are those of u and v. */
static fg_status check_order(const fg__dataset *data, const candidates *all,
                             const fg__pair *pair)
{
  for (size_t i = 0; i < all->count; ++i) {
    const fg__pair *known = &all->pair[i];
    if (known->component[0] != pair->component[1] ||
        known->component[1] != pair->component[0] ||
        strcmp(known->found_by, "standard_name") != 0)
      continue;
    char names[2 * FG__NAME_BYTES];
    write_names(names, sizeof names, known, false);
    fg__fail(
        data->context, FG_STATUS_ARGUMENT,
        "%s: by their standard names '%s' is the second component, and '%s' the first",
        data->file[0].path, pair->component[0]->name, pair->component[1]->name);
    fg__hint(data->context, "--vars %s", names);
    return FG_STATUS_ARGUMENT;
  }
  return FG_STATUS_OK;
}

/* The first element of the vector variable that is called so; NULL: none. */
static const fg__variable *find_vector(const fg__dataset *data, const char *name)
{
  const fg__variable *v = find_named(data, name, 0);
  const bool is_last = v && v == &data->variables[data->variable_count - 1];
  if (v && v->element == 0 && !is_last && strcmp(v->name, v[1].name) == 0)
    ++v; /* which is also there as a whole */
  return v && v->element == 1 ? v : NULL;
}

static fg_status choose_elements(fg__pair *out, const fg__dataset *data,
                                 const fg__variable *vector)
{
  if (vector->components > 3)
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: '%s' has %d components, not 2 or 3", data->file[0].path,
                    vector->name, vector->components);
  *out = fg__pair_of_elements(vector);
  out->found_by = "request";
  return FG_STATUS_OK;
}

static fg_status choose_named(fg__pair *out, const fg__dataset *data,
                              const candidates *all, const char *vars)
{
  char name[MOST_NAMED][FG__NAME_BYTES];
  const fg__variable *vector = find_vector(data, vars);
  if (vector && vector->location)
    return choose_elements(out, data, vector);
  if (vector) {
    *out = (fg__pair){.component = {vector, vector + 1, fg__third_element(vector)},
                      .found_by = "request"};
    return FG_STATUS_OK;
  }
  const int names = split_names(name, vars), places = names > 3 ? names / 2 : 0;
  const int count = names - places;
  if (names == 0 || (places > 0 && data->space.is_there))
    return fail_names(data, all, vars);
  *out = (fg__pair){.found_by = "request", .volume = count == 3};
  for (int k = 0; k < names; ++k) {
    const fg__variable *v =
        find_named(data, name[k], k > places ? data->component_files - 1 : 0);
    if (!v)
      return fail_unknown_name(data, all, name[k]);
    if (v->location && v->element)
      return fg__fail(data->context, FG_STATUS_ARGUMENT,
                      "%s: '%s' has %d components; one of several variables must have "
                      "one",
                      data->file[0].path, name[k], v->components);
    if (k < places)
      out->position[k] = v;
    else
      out->component[k - places] = v;
  }
  for (int k = 0; k < count; ++k)
    if (out->component[k] == out->component[(k + 1) % count])
      return fg__fail(data->context, FG_STATUS_ARGUMENT, "%s: %s components are '%s'",
                      data->file[0].path, count == 2 ? "both" : "two", name[places + k]);
  const fg_status status =
      count == 2 && !data->space.is_there ? fg__settle_polar(out, data) : FG_STATUS_OK;
  return status == FG_STATUS_OK ? check_order(data, all, out) : status;
}

static fg_status fail_unusable(const fg__dataset *data, const fg__pair *pair,
                               const fg__grid *grid)
{
  char names[3 * FG__NAME_BYTES];
  write_names(names, sizeof names, pair, pair->volume);
  fg_status status = fg__fail(data->context, FG_STATUS_UNSUPPORTED, "%s: %s: %s",
                              data->file[0].path, names, grid->unusable);
  if (grid->hint[0])
    fg__hint(data->context, "%s", grid->hint);
  return status;
}

/* Three components were named of what is read as a plane. */
static fg_status fail_flat(const fg__dataset *data, const fg__pair *pair)
{
  char names[2 * FG__NAME_BYTES];
  write_names(names, sizeof names, pair, false);
  fg__fail(data->context, FG_STATUS_UNSUPPORTED,
           "%s: %s lie on a grid that is no volume: '%s' cannot be read with them",
           data->file[0].path, names, pair->component[2]->name);
  fg__hint(data->context, "--vars %s reads the plane of one level", names);
  return FG_STATUS_UNSUPPORTED;
}

/* Coordinates that are named are those of points, or of the axes. */
static fg_status check_places(const fg__dataset *data, const fg__pair *pair,
                              const fg__grid *grid)
{
  bool used = grid->unstructured != NULL;
  if (!pair->position[0] || used)
    return FG_STATUS_OK;
  used = true;
  for (int k = 0; k < 2; ++k)
    used =
        used && grid->axis[k].coordinate &&
        pair->position[k] == fg__grid_axis_coordinate(data, grid, pair->component[0], k);
  if (used)
    return FG_STATUS_OK;
  return fg__fail(data->context, FG_STATUS_ARGUMENT,
                  "%s: '%.120s' and '%.120s' are no coordinates of '%.120s'",
                  data->file[0].path, pair->position[0]->name, pair->position[1]->name,
                  pair->component[0]->name);
}

static bool all_are_columns(const fg__dataset *data)
{
  for (size_t i = 0; i < data->variable_count; ++i)
    if (data->variables[i].rank != 1 ||
        !data->dimensions[data->variables[i].dimension[0]].is_nameless)
      return false;
  return true;
}

static fg_status fail_no_vectors(const fg__dataset *data)
{
  const fg__names names = list_variables(data);
  const size_t count = data->space.is_there ? (size_t)names.count : data->variable_count;
  fg_status status =
      fg__fail(data->context, FG_STATUS_UNSUPPORTED,
               "%s: no vectors found among its %zu variable%s%s%s", data->file[0].path,
               count, count == 1 ? "" : "s", names.count > 0 ? ": " : "", names.text);
  const fg__variable *direction = find_direction(data);
  if (direction)
    fg__hint(data->context, "name the speed with its direction: --vars SPEED,%s",
             direction->name);
  else if (all_are_columns(data))
    fg__hint(data->context, "name coordinates and components, or their numbers from 1: "
                            "--vars X,Y,U,V or --vars 1,2,3,4");
  else if (data->component_files == 1 && !data->space.is_there)
    fg__hint(data->context, "name the components with --vars U,V; when the other one is "
                            "in a second file, add --vars-from FILE");
  else
    fg__hint(data->context, "name the components with --vars U,V");
  return status;
}

static fg_status fail_ambiguous(const fg__dataset *data, const candidates *all,
                                const int *usable, int count)
{
  const fg__names list = list_pairs(all, usable);
  fg_status status =
      fg__fail(data->context, FG_STATUS_ARGUMENT,
               "%s: holds %d vectors, and it is not clear which is meant: %s",
               data->file[0].path, count, list.text);
  char one[3 * FG__NAME_BYTES];
  int first = 0;
  while (usable[first] == 0)
    ++first;
  write_names(one, sizeof one, &all->pair[first], usable[first] == 3);
  fg__hint(data->context, "choose one, for example with --vars %s", one);
  return status;
}

/* The only usable pair of the best rank that has one, with its grid. */
static fg_status choose_best(fg__pair *out, fg__grid *grid, const fg__dataset *data,
                             const candidates *all, const fg_read_options *options)
{
  if (all->count == 0)
    return fail_no_vectors(data);
  int *usable = fg__allocate(all->count, sizeof *usable);
  if (!usable)
    return fg__fail_memory(data->context, "a choice", all->count * sizeof *usable);
  fg_status status = FG_STATUS_OK;
  fg__grid first_unusable = {0};
  int count = 0;
  for (size_t i = 0; i < all->count && status == FG_STATUS_OK; ++i) {
    /* an unusable velocity is an error; another kind of vector does not replace it */
    if (all->pair[0].is_velocity && !all->pair[i].is_velocity)
      break;
    if (count > 0 && all->pair[i].rank > out->rank)
      break;
    fg__grid found;
    status = fg__grid_find(&found, data, &all->pair[i], options);
    usable[i] = status == FG_STATUS_OK && !found.unusable[0] ? found.dimension : 0;
    if (i == 0)
      memcpy(&first_unusable, &found, sizeof found);
    if (usable[i] > 0 && count++ == 0) {
      *out = all->pair[i];
      *grid = found;
    } else {
      fg__grid_clear(&found);
    }
  }
  if (status == FG_STATUS_OK && count == 0)
    status = fail_unusable(data, &all->pair[0], &first_unusable);
  else if (status == FG_STATUS_OK && count > 1)
    status = fail_ambiguous(data, all, usable, count);
  free(usable);
  return status;
}

fg_status fg__choose_vector(fg__pair *pair, fg__grid *grid, const fg__dataset *data,
                            const fg_read_options *options)
{
  candidates all = {0};
  fg_status status = fg__pairs_find(&all.pair, &all.count, data);
  if (status == FG_STATUS_OK && options->vars) {
    status = choose_named(pair, data, &all, options->vars);
    if (status == FG_STATUS_OK)
      status = fg__grid_find(grid, data, pair, options);
    if (status == FG_STATUS_OK)
      status = check_places(data, pair, grid);
    if (status == FG_STATUS_OK && grid->unusable[0])
      status = fail_unusable(data, pair, grid);
    else if (status == FG_STATUS_OK && pair->volume && grid->dimension != 3 &&
             !grid->domain)
      status = fail_flat(data, pair);
  } else if (status == FG_STATUS_OK) {
    status = choose_best(pair, grid, data, &all, options);
    if (status == FG_STATUS_OK)
      status = fg__check_polar_beside(grid, data, pair, options);
    if (status == FG_STATUS_OK && grid->unusable[0])
      status = fail_unusable(data, pair, grid);
  }
  free(all.pair);
  return status;
}
