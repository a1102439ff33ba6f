/* Dimensions, coordinates and fields of a file, in CF's words. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SINCE[] = "hours since 1970-01-01", CALENDAR[] = "proleptic_gregorian";

/* What a variable says of itself: texts that are not empty, and numbers. */
typedef struct attribute {
  const char *name, *text;
  const double *number;
} attribute;

static bool add_attributes(fg__variable *v, const attribute *all)
{
  fg_status status = FG_STATUS_OK;
  for (; all->name && status == FG_STATUS_OK; ++all)
    if (all->number)
      status = fg__variable_add_numbers(v, all->name, all->number, 1, false);
    else if (all->text && all->text[0])
      status = fg__variable_add_text(v, all->name, all->text, strlen(all->text));
  return status == FG_STATUS_OK;
}

/* Adds a variable along dimensions, unless one of these is -1; NULL: no memory. */
static fg__variable *add_variable(fg__dataset *data, fg__grib_content what, size_t id,
                                  const char *name, int rank, const int *dimension,
                                  const attribute *attributes)
{
  for (int k = 0; k < rank; ++k)
    if (dimension[k] < 0)
      return NULL;
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
  return add_attributes(v, attributes) ? v : NULL;
}

#define TEXT(name, text)                                                                 \
  {                                                                                      \
    name, text, NULL                                                                     \
  }
#define NUMBER(name, number)                                                             \
  {                                                                                      \
    name, NULL, number                                                                   \
  }
#define ADD(data, what, id, name, rank, dimension, ...)                                  \
  (add_variable(data, what, id, name, rank, dimension,                                   \
                (const attribute[]){__VA_ARGS__, {NULL, NULL, NULL}})                    \
       ? FG_STATUS_OK                                                                    \
       : FG_STATUS_MEMORY)

static int add_dimension(fg__dataset *data, const char *name, size_t length)
{
  return fg__dataset_add_dimension(data, name, length) ? (int)data->dimension_count - 1
                                                       : -1;
}

/* "name", "name_2" of the second of that name, ... */
static char *number_name(char out[2 * FG__GRIB_WORD], const char *name, size_t before)
{
  if (before == 0)
    snprintf(out, 2 * FG__GRIB_WORD, "%s", name);
  else
    snprintf(out, 2 * FG__GRIB_WORD, "%s_%zu", name, before + 1);
  return out;
}

/* ---- time, level and member ---- */

int fg__grib_compare(fg__grib_along along, const fg__grib_field *a,
                     const fg__grib_field *b)
{
  const int by_level = (a->level > b->level) - (a->level < b->level);
  const int by_member = (a->member > b->member) - (a->member < b->member);
  const int by_start = (a->started > b->started) - (a->started < b->started);
  const int by_time = a->time == b->time ? by_start : a->time < b->time ? -1 : 1;
  switch (along) {
  case FG__GRIB_TIME:
    return by_time;
  case FG__GRIB_LEVEL:
    return by_level;
  case FG__GRIB_MEMBER:
    return by_member;
  default:
    return a->kind != b->kind ? a->kind - b->kind
           : by_time          ? by_time
           : by_level         ? by_level
                              : by_member;
  }
}

int fg__grib_by_place(const void *one, const void *other)
{
  const fg__grib_field *const *a = one, *const *b = other;
  const int order = fg__grib_compare(FG__GRIB_PLACE, *a, *b);
  return order ? order : (*a > *b) - (*a < *b);
}

static int by_level(const void *one, const void *other)
{
  const fg__grib_field *const *a = one, *const *b = other;
  return fg__grib_compare(FG__GRIB_LEVEL, *a, *b);
}

static int by_member(const void *one, const void *other)
{
  const fg__grib_field *const *a = one, *const *b = other;
  return fg__grib_compare(FG__GRIB_MEMBER, *a, *b);
}

/* A field of each sample of a kind along an axis. */
static fg_status list_samples(fg__grib_axis *out, const fg__grib_file *file, size_t which,
                              fg__grib_along along)
{
  const size_t first = file->first[which], count = file->first[which + 1] - first;
  *out = (fg__grib_axis){.along = along, .at = fg__allocate(count, sizeof *out->at)};
  if (!out->at)
    return fg__fail_memory(file->context, "times and levels", count * sizeof *out->at);
  memcpy(out->at, file->place + first, count * sizeof *out->at);
  if (along != FG__GRIB_TIME) /* places are sorted by time */
    qsort(out->at, count, sizeof *out->at,
          along == FG__GRIB_LEVEL ? by_level : by_member);
  for (size_t i = 0; i < count; ++i)
    if (i == 0 || fg__grib_compare(along, out->at[out->count - 1], out->at[i]) != 0)
      out->at[out->count++] = out->at[i];
  return FG_STATUS_OK;
}

static bool is_same_axis(const fg__grib_axis *a, const fg__grib_axis *b)
{
  bool same =
      a->along == b->along && a->count == b->count && strcmp(a->name, b->name) == 0;
  for (size_t i = 0; i < a->count && same; ++i)
    same = fg__grib_compare(a->along, a->at[i], b->at[i]) == 0;
  return same;
}

static fg_status add_times(fg__dataset *data, const fg__grib_axis *axis, size_t id,
                           const char *name)
{
  char started[3 * FG__GRIB_WORD];
  size_t n = 1;
  while (n < axis->count && axis->at[n]->time != axis->at[n - 1]->time)
    ++n;
  snprintf(started, sizeof started, "reference_%s", name);
  const fg_status status = ADD(data, FG__GRIB_SAMPLES, id, name, 1, &axis->dimension,
                               TEXT("axis", "T"), TEXT("standard_name", "time"),
                               TEXT("units", SINCE), TEXT("calendar", CALENDAR));
  if (n == axis->count || status != FG_STATUS_OK)
    return status;
  /* forecasts of one time are told apart by when they began */
  return ADD(data, FG__GRIB_STARTED, id, started, 1, &axis->dimension,
             TEXT("standard_name", "forecast_reference_time"), TEXT("units", SINCE),
             TEXT("calendar", CALENDAR));
}

/* Of a single surface the number says nothing. */
static fg_status add_levels(fg__dataset *data, const fg__grib_axis *axis, size_t id,
                            const char *name)
{
  static const fg__grib_levels none = {.units = "1"};
  const fg__grib_levels *known = fg__grib_levels_of(axis->name);
  const bool flagged = !known && axis->count == 1;
  known = known ? known : &none;
  return ADD(data, FG__GRIB_SAMPLES, id, name, 1, &axis->dimension, TEXT("axis", "Z"),
             TEXT("units", known->units), TEXT("standard_name", known->standard_name),
             TEXT("positive", known->positive),
             NUMBER("flag_values", flagged ? &axis->at[0]->level : NULL),
             TEXT("flag_meanings", flagged ? axis->name : NULL));
}

/* Finds an axis among the file's, or adds it. */
static fg_status intern_axis(size_t *out, fg__dataset *data, fg__grib_file *file,
                             fg__grib_axis *axis)
{
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
  axis->dimension =
      add_dimension(data, number_name(name, axis->name, before), axis->count);
  file->axis[file->axes++] = *axis;
  return axis->along == FG__GRIB_TIME ? add_times(data, axis, *out, name)
         : axis->along == FG__GRIB_LEVEL
             ? add_levels(data, axis, *out, name)
             : ADD(data, FG__GRIB_SAMPLES, *out, name, 1, &axis->dimension,
                   TEXT("standard_name", "realization"), TEXT("units", "1"));
}

/* The axes of a kind in the order of its dimensions, without members where it is of no
 * ensemble. */
static fg_status find_axes(fg__grib_kind *kind, fg__dataset *data, fg__grib_file *file,
                           size_t which)
{
  const char *const names[] = {"time", kind->level_type[0] ? kind->level_type : "level",
                               "number"};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 3 && status == FG_STATUS_OK; ++k) {
    fg__grib_axis axis;
    status = list_samples(&axis, file, which, (fg__grib_along)k);
    if (status == FG_STATUS_OK && k == FG__GRIB_MEMBER && axis.count == 1 &&
        axis.at[0]->member == FG__GRIB_NO_MEMBER) {
      free(axis.at);
      return FG_STATUS_OK;
    }
    snprintf(axis.name, sizeof axis.name, "%s", names[k]);
    if (status == FG_STATUS_OK)
      status = intern_axis(&kind->axis[k], data, file, &axis);
    kind->axes = k + 1;
  }
  return status;
}

/* ---- grids ---- */

bool fg__grib_has_lines(const fg__grib_grid *grid)
{
  return !grid->unusable[0] &&
         (grid->layout == FG__GRIB_LONLAT || grid->layout == FG__GRIB_PLANE);
}

static fg_status add_lines(fg__dataset *data, fg__grib_grid *grid, size_t id)
{
  static const char *const known[2][2][3] = {
      {{"longitude", "longitude", "degrees_east"},
       {"latitude", "latitude", "degrees_north"}},
      {{"x", "projection_x_coordinate", "m"}, {"y", "projection_y_coordinate", "m"}}};
  const bool plane = grid->layout == FG__GRIB_PLANE;
  char name[2 * FG__GRIB_WORD];
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    number_name(name, known[plane][k][0], id);
    grid->dimension[k] = add_dimension(data, name, grid->size[k]);
    status = ADD(data, k == 0 ? FG__GRIB_GRID_X : FG__GRIB_GRID_Y, id, name, 1,
                 &grid->dimension[k], TEXT("standard_name", known[plane][k][1]),
                 TEXT("units", known[plane][k][2]));
  }
  if (status != FG_STATUS_OK || !plane)
    return status;
  fg__variable *v =
      add_variable(data, FG__GRIB_DESCRIPTION, id, number_name(name, "projection", id), 0,
                   NULL, (const attribute[]){{NULL, NULL, NULL}});
  return v ? fg__grib_plane_add(v, grid) : FG_STATUS_MEMORY;
}

/* Rows as a mesh that UGRID's words describe; of turned rows their directions, too. */
static fg_status add_mesh(fg__dataset *data, fg__grib_grid *grid, size_t id)
{
  static const char *const known[4][3] = {{"longitude", "longitude", "degrees_east"},
                                          {"latitude", "latitude", "degrees_north"},
                                          {"cosrot", NULL, "1"},
                                          {"sinrot", NULL, "1"}};
  const double none = -1.0, zero = 0.0, two = 2.0, poles = (double)grid->mesh.poles;
  char name[4][2 * FG__GRIB_WORD], text[2 * FG__GRIB_WORD];
  char pair[2][4 * FG__GRIB_WORD + 1] = {"", ""};
  fg_status status = FG_STATUS_OK;
  grid->dimension[0] =
      add_dimension(data, number_name(text, "values", id), grid->mesh.nodes);
  for (int k = 0; k < (grid->rotated ? 4 : 2) && status == FG_STATUS_OK; ++k) {
    number_name(name[k], known[k][0], id);
    status = ADD(data, (fg__grib_content)(FG__GRIB_POSITION_X + k), id, name[k], 1,
                 grid->dimension, TEXT("standard_name", known[k][1]),
                 TEXT("units", known[k][2]));
    if (k % 2 == 1)
      snprintf(pair[k / 2], sizeof pair[0], "%.127s %.127s", name[k - 1], name[k]);
  }
  const int face[2] = {add_dimension(data, "faces", grid->mesh.faces),
                       add_dimension(data, "corners", 4)};
  number_name(text, "face_nodes", id);
  if (status == FG_STATUS_OK)
    status = ADD(data, FG__GRIB_FACES, id, text, 2, face, NUMBER("_FillValue", &none),
                 NUMBER("start_index", &zero));
  return status != FG_STATUS_OK
             ? status
             : ADD(data, FG__GRIB_DESCRIPTION, id, number_name(name[0], "rows", id), 0,
                   NULL, TEXT("cf_role", "mesh_topology"),
                   NUMBER("topology_dimension", &two), TEXT("node_coordinates", pair[0]),
                   TEXT("face_node_connectivity", text), TEXT("node_rotation", pair[1]),
                   NUMBER("pole_nodes", &poles));
}

static fg_status add_grid(fg__dataset *data, fg__grib_grid *grid, size_t id)
{
  if (fg__grib_has_lines(grid))
    return add_lines(data, grid, id);
  if (!grid->unusable[0])
    return add_mesh(data, grid, id);
  grid->dimension[0] = add_dimension(data, "values", 1);
  return grid->dimension[0] >= 0 ? FG_STATUS_OK : FG_STATUS_MEMORY;
}

/* ---- fields ---- */

static void add_word(char name[FG__TEXT_BYTES], bool wanted, const char *word)
{
  const size_t used = strlen(name);
  if (wanted)
    snprintf(name + used, FG__TEXT_BYTES - used, "@%s", word);
}

/* The name, and what tells the kind from others of that name: "u@hybrid". */
static void name_kind(char out[FG__TEXT_BYTES], const fg__grib_file *file,
                      const fg__grib_kind *own)
{
  bool level = false, step = false, grid = false;
  char number[FG__GRIB_WORD];
  for (size_t i = 0; i < file->kinds; ++i) {
    const fg__grib_kind *other = &file->kind[i];
    if (strcmp(other->name, own->name) != 0)
      continue;
    level = level || strcmp(other->level_type, own->level_type) != 0;
    step = step || strcmp(other->step_type, own->step_type) != 0;
    grid = grid || other->grid != own->grid;
  }
  snprintf(number, sizeof number, "grid%d", own->grid + 1);
  snprintf(out, FG__TEXT_BYTES, "%s", own->name);
  add_word(out, level, own->level_type);
  add_word(out, step, own->step_type);
  add_word(out, grid, number);
}

/* CF's name of a component; where rows bend and it is along them it does not point east.
 */
static void write_standard_name(char out[FG__TEXT_BYTES + 8], const fg__grib_kind *kind,
                                bool along)
{
  static const char *const turned[][2] = {{"eastward_", "x_"}, {"northward_", "y_"}};
  const char *name = kind->standard_name;
  const char *start = "";
  for (int k = 0; k < 2 && along; ++k)
    if (strncmp(name, turned[k][0], strlen(turned[k][0])) == 0) {
      name += strlen(turned[k][0]);
      start = turned[k][1];
      break;
    }
  snprintf(out, FG__TEXT_BYTES + 8, "%s%s", start, name);
}

static fg_status add_field(fg__dataset *data, fg__grib_file *file, size_t which)
{
  fg__grib_kind *kind = &file->kind[which];
  const fg__grib_grid *grid = &file->grid[kind->grid];
  const bool lines = fg__grib_has_lines(grid), plane = grid->layout == FG__GRIB_PLANE;
  const bool bent = plane || grid->rotated;
  const bool named = !grid->unusable[0] && (plane || !lines);
  /* along Mercator's axes, too */
  const double along =
      grid->relative || (plane && grid->projection.kind == FG__GRIB_MERCATOR);
  char name[FG__TEXT_BYTES], standard[FG__TEXT_BYTES + 8], of_grid[2 * FG__GRIB_WORD];
  int dimension[FG__RANK], rank = 0;
  const fg_status status = find_axes(kind, data, file, which);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < kind->axes; ++k)
    dimension[rank++] = file->axis[kind->axis[k]].dimension;
  if (lines)
    dimension[rank++] = grid->dimension[1];
  dimension[rank++] = grid->dimension[0];
  name_kind(name, file, kind);
  write_standard_name(standard, kind, bent && along > 0.0);
  number_name(of_grid, lines ? "projection" : "rows", (size_t)kind->grid);
  const attribute attributes[] = {
      TEXT("standard_name", standard),
      TEXT("long_name", kind->title),
      TEXT("units", kind->units),
      TEXT("GRIB_shortName", kind->name),
      TEXT("GRIB_cfVarName", kind->other_name),
      TEXT(lines ? "grid_mapping" : "mesh", named ? of_grid : NULL),
      NUMBER("GRIB_uvRelativeToGrid", bent ? &along : NULL),
      {NULL, NULL, NULL}};
  fg__variable *v =
      add_variable(data, FG__GRIB_FIELD, which, name, rank, dimension, attributes);
  if (v && grid->unusable[0])
    v->unusable = grid->unusable;
  return v ? FG_STATUS_OK : FG_STATUS_MEMORY;
}

fg_status fg__grib_describe(fg__dataset *data, fg__grib_file *file)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < file->grids && status == FG_STATUS_OK; ++i)
    status = add_grid(data, &file->grid[i], i);
  for (size_t i = 0; i < file->kinds && status == FG_STATUS_OK; ++i)
    status = add_field(data, file, i);
  return status;
}
