/* Messages as variables along time, level, member and their grid, as cfgrib has them. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a variable is: fg__variable.place; its `id` is an axis, a grid or a kind. */
typedef enum content {
  AXIS,
  STARTED, /* the times at which forecasts began, along an axis of time */
  GRID_X,
  GRID_Y,
  POSITION_X, /* of a mesh's nodes */
  POSITION_Y,
  COSINE, /* of the angle between east and the rows, at a mesh's nodes */
  SINE,
  FACES,
  DESCRIPTION, /* of a projection or mesh: without a value */
  FIELD
} content;

/* What a variable says of itself; NULL: nothing. */
typedef struct words {
  const char *name, *text;
} words;

static fg_status add_words(fg__variable *v, const words *all, size_t count)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i)
    if (all[i].text && all[i].text[0])
      status = fg__variable_add_text(v, all[i].name, all[i].text, strlen(all[i].text));
  return status;
}

#define ADD_WORDS(v, ...)                                                                \
  add_words(v, (const words[]){__VA_ARGS__},                                             \
            sizeof((const words[]){__VA_ARGS__}) / sizeof(words))

static fg__grib_file *file_of(const fg__dataset *data)
{
  return data->file[data->files - 1].state;
}

/* A variable along some of the dataset's dimensions. */
static fg__variable *add_variable(fg__dataset *data, content what, size_t id,
                                  const char *name, int rank, const int *dimension)
{
  fg__variable *v = fg__dataset_add_variable(data, "", name);
  if (!v)
    return NULL;
  v->place = (int)what;
  v->id = (int)id;
  v->type = FG__TYPE_FLOAT64;
  v->rank = rank;
  v->fits_file = true;
  for (int k = 0; k < rank; ++k)
    v->dimension[k] = dimension[k];
  return v;
}

static int add_dimension(fg__dataset *data, const char *name, size_t length)
{
  return fg__dataset_add_dimension(data, name, length) ? (int)data->dimension_count - 1
                                                       : -1;
}

/* "name", "name_2" of the second of that name, ... */
static void number_name(char out[2 * FG__GRIB_WORD], const char *name, size_t before)
{
  if (before == 0)
    snprintf(out, 2 * FG__GRIB_WORD, "%s", name);
  else
    snprintf(out, 2 * FG__GRIB_WORD, "%s_%zu", name, before + 1);
}

/* ---- time, level and member ---- */

static int compare_longs(int64_t a, int64_t b)
{
  return (a > b) - (a < b);
}

/* Compares what the samples along an axis are told by. */
static int compare_along(int axis, const fg__grib_field *a, const fg__grib_field *b)
{
  if (axis == FG__GRIB_LEVEL)
    return (a->level > b->level) - (a->level < b->level);
  if (axis == FG__GRIB_MEMBER)
    return compare_longs(a->member, b->member);
  const int by_time = compare_longs(a->time, b->time);
  return by_time ? by_time : compare_longs(a->started, b->started);
}

static int compare_places(const fg__grib_field *a, const fg__grib_field *b)
{
  int order = compare_longs(a->kind, b->kind);
  for (int axis = FG__GRIB_TIME; axis <= FG__GRIB_MEMBER && order == 0; ++axis)
    order = compare_along(axis, a, b);
  return order;
}

static int by_place(const void *one, const void *other)
{
  const fg__grib_field *const *a = one, *const *b = other;
  const int order = compare_places(*a, *b);
  return order ? order : (*a > *b) - (*a < *b);
}

static int by_time(const void *one, const void *other)
{
  return compare_along(FG__GRIB_TIME, *(const fg__grib_field *const *)one,
                       *(const fg__grib_field *const *)other);
}

static int by_level(const void *one, const void *other)
{
  return compare_along(FG__GRIB_LEVEL, *(const fg__grib_field *const *)one,
                       *(const fg__grib_field *const *)other);
}

static int by_member(const void *one, const void *other)
{
  return compare_along(FG__GRIB_MEMBER, *(const fg__grib_field *const *)one,
                       *(const fg__grib_field *const *)other);
}

/* Sorts fields by kind and place; of those at one place the first of the file stays. */
static fg_status sort_places(fg__grib_file *file)
{
  size_t kept = 0;
  file->place = fg__allocate(file->fields, sizeof *file->place);
  file->places = fg__allocate(file->kinds, sizeof *file->places);
  if (!file->place || !file->places)
    return fg__fail_memory(file->context, "a list of fields",
                           file->fields * sizeof *file->place);
  for (size_t i = 0; i < file->fields; ++i)
    file->place[i] = &file->field[i];
  if (file->fields > 0)
    qsort(file->place, file->fields, sizeof *file->place, by_place);
  for (size_t i = 0; i < file->fields; ++i) {
    const fg__grib_field *field = file->place[i];
    if (kept > 0 && compare_places(file->place[kept - 1], field) == 0)
      continue;
    fg__grib_range *range = &file->places[field->kind];
    if (range->count++ == 0)
      range->first = kept;
    file->place[kept++] = field;
  }
  return FG_STATUS_OK;
}

/* The samples of a kind along an axis. */
static fg_status list_samples(fg__grib_axis *out, const fg__grib_file *file, size_t kind,
                              int axis)
{
  static int (*const order[])(const void *, const void *) = {by_time, by_level, by_member};
  const fg__grib_range range = file->places[kind];
  *out = (fg__grib_axis){.at = fg__allocate(range.count, sizeof *out->at)};
  if (!out->at)
    return fg__fail_memory(file->context, "times and levels",
                           range.count * sizeof *out->at);
  memcpy(out->at, file->place + range.first, range.count * sizeof *out->at);
  if (axis != FG__GRIB_TIME) /* places are sorted by time */
    qsort(out->at, range.count, sizeof *out->at, order[axis]);
  for (size_t i = 0; i < range.count; ++i)
    if (i == 0 || compare_along(axis, out->at[out->count - 1], out->at[i]) != 0)
      out->at[out->count++] = out->at[i];
  return FG_STATUS_OK;
}

static bool is_same_axis(const fg__grib_axis *a, const fg__grib_axis *b)
{
  bool same = a->kind == b->kind && a->count == b->count && strcmp(a->name, b->name) == 0;
  for (size_t i = 0; i < a->count && same; ++i)
    same = compare_along((int)a->kind, a->at[i], b->at[i]) == 0;
  return same;
}

/* Forecasts of one time that began at different ones are told apart by these. */
static fg_status add_started(fg__dataset *data, size_t id, const char *name,
                             const int *dimension)
{
  char of_time[3 * FG__GRIB_WORD];
  const fg__grib_axis *axis = &file_of(data)->axis[id];
  size_t n = 1;
  while (n < axis->count && axis->at[n]->time != axis->at[n - 1]->time)
    ++n;
  if (n >= axis->count)
    return FG_STATUS_OK;
  snprintf(of_time, sizeof of_time, "reference_%s", name);
  fg__variable *v = add_variable(data, STARTED, id, of_time, 1, dimension);
  return v ? ADD_WORDS(v, {"standard_name", "forecast_reference_time"},
                       {"units", "hours since 1970-01-01"},
                       {"calendar", "proleptic_gregorian"})
           : FG_STATUS_MEMORY;
}

static fg_status describe_levels(fg__variable *v, const fg__grib_axis *axis)
{
  const fg__grib_levels *known = fg__grib_levels_of(axis->name);
  fg_status status = ADD_WORDS(v, {"axis", "Z"}, {"units", known ? known->units : "1"},
                               {"standard_name", known ? known->standard_name : NULL},
                               {"positive", known ? known->positive : NULL});
  if (known || axis->count > 1 || status != FG_STATUS_OK)
    return status;
  /* the number of a surface says nothing */
  status = fg__variable_add_numbers(v, "flag_values", &axis->at[0]->level, 1, true);
  return status == FG_STATUS_OK ? ADD_WORDS(v, {"flag_meanings", axis->name}) : status;
}

static fg_status describe_axis(fg__dataset *data, size_t id, const char *name)
{
  fg__grib_axis *axis = &file_of(data)->axis[id];
  axis->dimension = add_dimension(data, name, axis->count);
  fg__variable *v = axis->dimension >= 0
                        ? add_variable(data, AXIS, id, name, 1, &axis->dimension)
                        : NULL;
  if (!v)
    return FG_STATUS_MEMORY;
  if (axis->kind == FG__GRIB_LEVEL)
    return describe_levels(v, axis);
  if (axis->kind == FG__GRIB_MEMBER)
    return ADD_WORDS(v, {"standard_name", "realization"}, {"units", "1"});
  const fg_status status =
      ADD_WORDS(v, {"axis", "T"}, {"standard_name", "time"},
                {"units", "hours since 1970-01-01"}, {"calendar", "proleptic_gregorian"});
  return status == FG_STATUS_OK ? add_started(data, id, name, &axis->dimension) : status;
}

/* Finds an axis among the file's, or adds it. */
static fg_status intern_axis(size_t *out, fg__dataset *data, fg__grib_axis *axis)
{
  fg__grib_file *file = file_of(data);
  char name[2 * FG__GRIB_WORD];
  size_t before = 0;
  for (*out = 0; *out < file->axes; ++*out) {
    if (is_same_axis(&file->axis[*out], axis)) {
      free(axis->at);
      return FG_STATUS_OK;
    }
    before += strcmp(file->axis[*out].name, axis->name) == 0;
  }
  void *axes = file->axis;
  if (!fg__grow(&axes, &file->axis_capacity, file->axes + 1, sizeof *axis)) {
    free(axis->at);
    return fg__fail_memory(file->context, "times and levels", sizeof *axis);
  }
  file->axis = axes;
  file->axis[file->axes++] = *axis;
  number_name(name, axis->name, before);
  return describe_axis(data, *out, name);
}

/* The axes of a kind in the order of its dimensions; an ensemble of none has no members.
 */
static fg_status find_axes(fg__grib_kind *kind, fg__dataset *data, size_t which)
{
  fg__grib_file *file = file_of(data);
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    fg__grib_axis axis;
    status = list_samples(&axis, file, which, k);
    if (status != FG_STATUS_OK)
      return status;
    if (k == FG__GRIB_MEMBER && axis.count == 1 &&
        axis.at[0]->member == FG__GRIB_NO_MEMBER) {
      free(axis.at);
      return FG_STATUS_OK;
    }
    axis.kind = (unsigned)k;
    snprintf(axis.name, sizeof axis.name, "%s",
             k == FG__GRIB_TIME    ? "time"
             : k == FG__GRIB_LEVEL ? (kind->level_type[0] ? kind->level_type : "level")
                                   : "number");
    status = intern_axis(&kind->axis[k], data, &axis);
    kind->axes = k + 1;
  }
  return status;
}

/* ---- grids ---- */

static fg_status add_lines(fg__dataset *data, size_t id)
{
  static const struct {
    const char *name, *standard_name, *units;
  } known[2][2] = {{{"longitude", "longitude", "degrees_east"},
                    {"latitude", "latitude", "degrees_north"}},
                   {{"x", "projection_x_coordinate", "m"},
                    {"y", "projection_y_coordinate", "m"}}};
  fg__grib_grid *grid = &file_of(data)->grid[id];
  char name[2 * FG__GRIB_WORD];
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    const bool plane = grid->layout == FG__GRIB_PLANE;
    number_name(name, known[plane][k].name, id);
    grid->dimension[k] = add_dimension(data, name, grid->size[k]);
    fg__variable *v = grid->dimension[k] >= 0
                          ? add_variable(data, k == 0 ? GRID_X : GRID_Y, id, name, 1,
                                         &grid->dimension[k])
                          : NULL;
    status = v ? ADD_WORDS(v, {"standard_name", known[plane][k].standard_name},
                           {"units", known[plane][k].units})
               : FG_STATUS_MEMORY;
  }
  number_name(name, "projection", id);
  if (status != FG_STATUS_OK || grid->layout != FG__GRIB_PLANE)
    return status;
  fg__variable *v = add_variable(data, DESCRIPTION, id, name, 0, NULL);
  return v ? fg__grib_plane_add(v, grid) : FG_STATUS_MEMORY;
}

/* Positions of the nodes, and of turned rows their directions. */
static fg_status add_nodes(fg__dataset *data, size_t id,
                           char name[][2 * FG__GRIB_WORD])
{
  static const struct {
    content what;
    const char *name, *standard_name, *units;
  } known[] = {{POSITION_X, "longitude", "longitude", "degrees_east"},
               {POSITION_Y, "latitude", "latitude", "degrees_north"},
               {COSINE, "cosrot", NULL, "1"},
               {SINE, "sinrot", NULL, "1"}};
  const fg__grib_grid *grid = &file_of(data)->grid[id];
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < (grid->rotated ? 4 : 2) && status == FG_STATUS_OK; ++k) {
    number_name(name[k], known[k].name, id);
    fg__variable *v =
        add_variable(data, known[k].what, id, name[k], 1, grid->dimension);
    status = v ? ADD_WORDS(v, {"standard_name", known[k].standard_name},
                           {"units", known[k].units})
               : FG_STATUS_MEMORY;
  }
  return status;
}

/* Rows as a mesh that UGRID's words describe. */
static fg_status add_mesh(fg__dataset *data, size_t id)
{
  fg__grib_grid *grid = &file_of(data)->grid[id];
  char name[4][2 * FG__GRIB_WORD], text[2 * FG__GRIB_WORD], nodes[4 * FG__GRIB_WORD + 1],
      turns[4 * FG__GRIB_WORD + 1] = "";
  const double none = -1.0, first = 0.0, two = 2.0, poles = (double)grid->mesh.poles;
  number_name(text, "values", id);
  grid->dimension[0] = add_dimension(data, text, grid->mesh.nodes);
  fg_status status =
      grid->dimension[0] >= 0 ? add_nodes(data, id, name) : FG_STATUS_MEMORY;
  if (status != FG_STATUS_OK)
    return status;
  snprintf(nodes, sizeof nodes, "%s %s", name[0], name[1]);
  if (grid->rotated)
    snprintf(turns, sizeof turns, "%s %s", name[2], name[3]);
  const int face[2] = {add_dimension(data, "faces", grid->mesh.faces),
                       add_dimension(data, "corners", 4)};
  number_name(text, "face_nodes", id);
  fg__variable *v =
      face[0] >= 0 && face[1] >= 0 ? add_variable(data, FACES, id, text, 2, face) : NULL;
  if (!v)
    return FG_STATUS_MEMORY;
  status = fg__variable_add_numbers(v, "_FillValue", &none, 1, false);
  if (status == FG_STATUS_OK)
    status = fg__variable_add_numbers(v, "start_index", &first, 1, false);
  number_name(name[0], "rows", id);
  v = status == FG_STATUS_OK ? add_variable(data, DESCRIPTION, id, name[0], 0, NULL)
                             : NULL;
  if (!v)
    return status == FG_STATUS_OK ? FG_STATUS_MEMORY : status;
  status = fg__variable_add_numbers(v, "topology_dimension", &two, 1, false);
  if (status == FG_STATUS_OK)
    status = fg__variable_add_numbers(v, "pole_nodes", &poles, 1, false);
  return status == FG_STATUS_OK
             ? ADD_WORDS(v, {"cf_role", "mesh_topology"}, {"node_coordinates", nodes},
                         {"face_node_connectivity", text}, {"node_rotation", turns})
             : status;
}

static bool has_lines(const fg__grib_grid *grid)
{
  return !grid->unusable[0] &&
         (grid->layout == FG__GRIB_LONLAT || grid->layout == FG__GRIB_PLANE);
}

static fg_status add_grid(fg__dataset *data, size_t id)
{
  fg__grib_grid *grid = &file_of(data)->grid[id];
  if (has_lines(grid))
    return add_lines(data, id);
  if (!grid->unusable[0])
    return add_mesh(data, id);
  grid->dimension[0] = add_dimension(data, "values", 1);
  return grid->dimension[0] >= 0 ? FG_STATUS_OK : FG_STATUS_MEMORY;
}

/* ---- fields ---- */

static void add_word(char *name, size_t size, const char *word)
{
  const size_t used = strlen(name);
  snprintf(name + used, size - used, "@%s", word);
}

/* The name, and what tells the kind from others of that name: "u@hybrid". */
static void name_kind(char *out, size_t size, const fg__grib_file *file,
                      const fg__grib_kind *own)
{
  bool level = false, step = false, grid = false;
  for (size_t i = 0; i < file->kinds; ++i) {
    const fg__grib_kind *other = &file->kind[i];
    if (strcmp(other->name, own->name) != 0)
      continue;
    level = level || strcmp(other->level_type, own->level_type) != 0;
    step = step || strcmp(other->step_type, own->step_type) != 0;
    grid = grid || other->grid != own->grid;
  }
  char number[FG__GRIB_WORD];
  snprintf(out, size, "%s", own->name);
  snprintf(number, sizeof number, "grid%d", own->grid + 1);
  if (level)
    add_word(out, size, own->level_type);
  if (step)
    add_word(out, size, own->step_type);
  if (grid)
    add_word(out, size, number);
}

/* Words of a field's frame: cfgrib's word of its flag, and in CF's names what does not
 * point east is along x. */
static fg_status add_frame(fg__variable *v, const fg__grib_kind *kind,
                           const fg__grib_grid *grid)
{
  static const char *const turned[][2] = {{"eastward_", "x_"}, {"northward_", "y_"}};
  const double flag = grid->relative;
  const bool bent = grid->layout == FG__GRIB_PLANE || grid->rotated;
  char name[FG__TEXT_BYTES + 4];
  snprintf(name, sizeof name, "%s", kind->standard_name);
  for (int k = 0; k < 2 && bent && grid->relative; ++k) {
    const size_t length = strlen(turned[k][0]);
    if (strncmp(kind->standard_name, turned[k][0], length) == 0)
      snprintf(name, sizeof name, "%s%s", turned[k][1], kind->standard_name + length);
  }
  const fg_status status = ADD_WORDS(v, {"standard_name", name});
  return bent && status == FG_STATUS_OK
             ? fg__variable_add_numbers(v, "GRIB_uvRelativeToGrid", &flag, 1, false)
             : status;
}

static fg_status add_field(fg__dataset *data, size_t which)
{
  fg__grib_file *file = file_of(data);
  fg__grib_kind *kind = &file->kind[which];
  const fg__grib_grid *grid = &file->grid[kind->grid];
  fg_status status = find_axes(kind, data, which);
  if (status != FG_STATUS_OK)
    return status;
  char name[FG__TEXT_BYTES], words_of_grid[2 * FG__GRIB_WORD] = "";
  const bool lines = has_lines(grid);
  int dimension[FG__RANK], rank = 0;
  for (int k = 0; k < kind->axes; ++k)
    dimension[rank++] = file->axis[kind->axis[k]].dimension;
  if (lines)
    dimension[rank++] = grid->dimension[1];
  dimension[rank++] = grid->dimension[0];
  name_kind(name, sizeof name, file, kind);
  if (grid->layout == FG__GRIB_PLANE || !lines)
    number_name(words_of_grid, lines ? "projection" : "rows", (size_t)kind->grid);
  fg__variable *v = add_variable(data, FIELD, which, name, rank, dimension);
  if (!v)
    return FG_STATUS_MEMORY;
  v->unusable = grid->unusable[0] ? grid->unusable : NULL;
  status = ADD_WORDS(v, {"long_name", kind->title}, {"units", kind->units},
                     {"GRIB_shortName", kind->name}, {"GRIB_cfVarName", kind->other_name},
                     {lines ? "grid_mapping" : "mesh",
                      grid->unusable[0] ? NULL : words_of_grid});
  return status == FG_STATUS_OK ? add_frame(v, kind, grid) : status;
}

/* ---- values ---- */

/* The field at places along the axes of a kind; NULL: the file has none there. */
static const fg__grib_field *find_field(const fg__grib_file *file, size_t which,
                                        const size_t *index)
{
  const fg__grib_kind *kind = &file->kind[which];
  const fg__grib_range range = file->places[which];
  fg__grib_field at = {.kind = (int)which, .member = FG__GRIB_NO_MEMBER};
  for (int k = 0; k < kind->axes; ++k) {
    const fg__grib_field *sample = file->axis[kind->axis[k]].at[index[k]];
    if (k == FG__GRIB_TIME) {
      at.time = sample->time;
      at.started = sample->started;
    } else if (k == FG__GRIB_LEVEL) {
      at.level = sample->level;
    } else {
      at.member = sample->member;
    }
  }
  size_t low = range.first, high = range.first + range.count;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    const int order = compare_places(file->place[middle], &at);
    if (order == 0)
      return file->place[middle];
    if (order < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return NULL;
}

static bool has_field(const fg__variable *v, const size_t *index)
{
  const fg__grib_file *file = v->owner->file[v->file].state;
  return v->place != FIELD || find_field(file, (size_t)v->id, index);
}

/* All values of a field, which stay until those of another are asked for. */
static fg_status unpack(fg__grib_file *file, const fg__grib_field *field,
                        const fg__grib_grid *grid)
{
  if (file->unpacked == field)
    return FG_STATUS_OK;
  free(file->value);
  file->unpacked = NULL;
  file->value = fg__allocate(grid->points, sizeof *file->value);
  if (!file->value)
    return fg__fail_memory(file->context, "values", grid->points * sizeof *file->value);
  const fg_status status = fg__grib_values(file->value, file, field, grid);
  file->unpacked = status == FG_STATUS_OK ? field : NULL;
  return status;
}

/* Fields of one place along the axes; what a file does not have is missing. */
static fg_status fetch_field(const fg__variable *v, fg__grib_file *file,
                             const size_t *start, const size_t *count, double *out)
{
  const fg__grib_kind *kind = &file->kind[v->id];
  const fg__grib_grid *grid = &file->grid[kind->grid];
  const fg__grib_field *field = find_field(file, (size_t)v->id, start);
  const bool lines = has_lines(grid);
  const int k = kind->axes;
  const size_t rows = lines ? count[k] : 1, columns = count[k + lines];
  const size_t first = lines ? start[k] * grid->size[0] + start[k + 1] : start[k];
  const fg_status status = field ? unpack(file, field, grid) : FG_STATUS_OK;
  for (size_t j = 0; j < rows && status == FG_STATUS_OK; ++j)
    for (size_t i = 0; i < columns; ++i) {
      const size_t n = first + j * grid->size[0] + i;
      out[j * columns + i] = field && n < grid->points ? file->value[n] : (double)NAN;
    }
  return status;
}

static double value_along(const fg__grib_axis *axis, content what, size_t n)
{
  const fg__grib_field *at = axis->at[n];
  return axis->kind == FG__GRIB_LEVEL    ? at->level
         : axis->kind == FG__GRIB_MEMBER ? (double)at->member
         : what == STARTED               ? (double)at->started / 60.0
                                         : (double)at->time / 60.0;
}

static fg_status fetch_mesh(const fg__variable *v, fg__grib_file *file,
                            const size_t *start, const size_t *count, double *out)
{
  fg__grib_grid *grid = &file->grid[v->id];
  fg_status status = grid->mesh.corner ? FG_STATUS_OK
                                       : fg__grib_mesh_make(grid, file->context);
  const fg__grib_mesh *mesh = &grid->mesh;
  const double *const of[] = {mesh->position[0], mesh->position[1], mesh->turn[0],
                              mesh->turn[1]};
  for (size_t n = 0; n < count[0] && status == FG_STATUS_OK; ++n) {
    if (v->place != FACES)
      out[n] = of[v->place - POSITION_X][start[0] + n];
    for (size_t c = 0; v->place == FACES && c < count[1]; ++c)
      out[n * count[1] + c] = (double)mesh->corner[4 * (start[0] + n) + start[1] + c];
  }
  return status;
}

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  fg__grib_file *file = v->owner->file[v->file].state;
  const content what = (content)v->place;
  if (what == FIELD)
    return fetch_field(v, file, start, count, out);
  if (what >= POSITION_X && what <= FACES)
    return fetch_mesh(v, file, start, count, out);
  for (size_t n = 0; n < (v->rank > 0 ? count[0] : 1); ++n)
    out[n] = what == DESCRIPTION ? 0.0
             : what <= STARTED   ? value_along(&file->axis[v->id], what, start[0] + n)
                                 : file->grid[v->id].axis[what - GRID_X][start[0] + n];
  return FG_STATUS_OK;
}

static void close_file(void *state)
{
  fg__grib_file *file = state;
  if (file->owns_source)
    fg__source_close(&file->source);
  for (size_t i = 0; i < file->grids; ++i)
    fg__grib_grid_clear(&file->grid[i]);
  for (size_t i = 0; i < file->axes; ++i)
    free(file->axis[i].at);
  free(file->field);
  free(file->kind);
  free(file->grid);
  free(file->axis);
  free(file->place);
  free(file->places);
  free(file->value);
  free(file);
}

static const fg__decoder DECODER = {.fetch = fetch, .has = has_field, .close = close_file};

static fg_status read_file(fg__dataset *data, fg__grib_file *file)
{
  fg_status status = fg__grib_scan(file);
  if (status == FG_STATUS_OK && file->fields == 0)
    status = fg__fail(file->context, FG_STATUS_UNSUPPORTED,
                      "%s: its %zu messages do not say their grids, but numbers of a "
                      "catalogue",
                      file->path, file->without_grid);
  if (status == FG_STATUS_OK)
    status = fg__grib_tell_all(file);
  if (status == FG_STATUS_OK)
    status = sort_places(file);
  for (size_t i = 0; i < file->grids && status == FG_STATUS_OK; ++i)
    status = add_grid(data, i);
  for (size_t i = 0; i < file->kinds && status == FG_STATUS_OK; ++i)
    status = add_field(data, i);
  return status;
}

fg_status fg__grib_open(fg__dataset *dataset, fg_context *context,
                        const fg__source *source)
{
  const bool further = dataset->files > 0;
  fg_status status =
      fg__dataset_begin(dataset, context, source->path, source->size, &DECODER);
  fg__grib_file *file =
      status == FG_STATUS_OK ? fg__allocate(1, sizeof *file) : NULL;
  if (!file)
    return status == FG_STATUS_OK ? fg__fail_memory(context, "a file", sizeof *file)
                                  : status;
  dataset->file[dataset->files - 1].state = file;
  file->context = context;
  file->path = dataset->file[dataset->files - 1].path;
  file->source = *source;
  file->owns_source = further; /* a further one is closed before it is read */
  if (further)
    status = fg__source_open(&file->source, context, file->path);
  if (status == FG_STATUS_OK && !fg__dataset_add_group(dataset))
    status = FG_STATUS_MEMORY;
  return status == FG_STATUS_OK ? read_file(dataset, file) : status;
}
