/* Messages as variables along time, level, member and their grid, as cfgrib has them. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sorts fields by kind and place; of those at one place the first of the file stays. */
static fg_status sort_places(fg__grib_file *file)
{
  size_t kept = 0;
  file->place = fg__allocate(file->fields, sizeof *file->place);
  file->first = fg__allocate(file->kinds + 1, sizeof *file->first);
  if (!file->place || !file->first)
    return fg__fail_memory(file->context, "a list of fields",
                           file->fields * sizeof *file->place);
  for (size_t i = 0; i < file->fields; ++i)
    file->place[i] = &file->field[i];
  qsort(file->place, file->fields, sizeof *file->place, fg__grib_by_place);
  for (size_t i = 0; i < file->fields; ++i) {
    const fg__grib_field *field = file->place[i];
    if (kept == 0 || fg__grib_compare(FG__GRIB_PLACE, file->place[kept - 1], field) != 0)
      file->place[kept++] = field;
    file->first[field->kind + 1] = kept;
  }
  return FG_STATUS_OK;
}

/* The field at indices along the axes of a kind; NULL: the file has none there. */
static const fg__grib_field *find_field(const fg__grib_file *file, size_t which,
                                        const size_t *index)
{
  const fg__grib_kind *kind = &file->kind[which];
  size_t low = file->first[which], high = file->first[which + 1];
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
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    const int order = fg__grib_compare(FG__GRIB_PLACE, file->place[middle], &at);
    if (order == 0)
      return file->place[middle];
    low = order < 0 ? middle + 1 : low;
    high = order < 0 ? high : middle;
  }
  return NULL;
}

static bool has_field(const fg__variable *v, const size_t *index)
{
  const fg__grib_file *file = v->owner->file[v->file].state;
  return v->place != FG__GRIB_FIELD || find_field(file, (size_t)v->id, index);
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

/* Values at one place along the axes; what a file does not have is missing. */
static fg_status fetch_field(const fg__variable *v, fg__grib_file *file,
                             const size_t *start, const size_t *count, double *out)
{
  const fg__grib_kind *kind = &file->kind[v->id];
  const fg__grib_grid *grid = &file->grid[kind->grid];
  const fg__grib_field *field = find_field(file, (size_t)v->id, start);
  const bool lines = fg__grib_has_lines(grid);
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

static double value_along(const fg__grib_axis *axis, fg__grib_content what, size_t n)
{
  const fg__grib_field *at = axis->at[n];
  return axis->along == FG__GRIB_LEVEL    ? at->level
         : axis->along == FG__GRIB_MEMBER ? (double)at->member
         : what == FG__GRIB_STARTED       ? (double)at->started / 60.0
                                          : (double)at->time / 60.0;
}

static fg_status fetch_mesh(const fg__variable *v, fg__grib_file *file,
                            const size_t *start, const size_t *count, double *out)
{
  fg__grib_grid *grid = &file->grid[v->id];
  const fg_status status =
      grid->mesh.corner ? FG_STATUS_OK : fg__grib_mesh_make(grid, file->context);
  const fg__grib_mesh *mesh = &grid->mesh;
  const double *const of[] = {mesh->position[0], mesh->position[1], mesh->turn[0],
                              mesh->turn[1]};
  for (size_t n = 0; n < count[0] && status == FG_STATUS_OK; ++n) {
    if (v->place != FG__GRIB_FACES)
      out[n] = of[v->place - FG__GRIB_POSITION_X][start[0] + n];
    for (size_t c = 0; v->place == FG__GRIB_FACES && c < count[1]; ++c)
      out[n * count[1] + c] = (double)mesh->corner[4 * (start[0] + n) + start[1] + c];
  }
  return status;
}

static fg_status fetch(const fg__variable *v, const size_t *start, const size_t *count,
                       double *out)
{
  fg__grib_file *file = v->owner->file[v->file].state;
  const fg__grib_content what = (fg__grib_content)v->place;
  if (what == FG__GRIB_FIELD)
    return fetch_field(v, file, start, count, out);
  if (what >= FG__GRIB_POSITION_X && what <= FG__GRIB_FACES)
    return fetch_mesh(v, file, start, count, out);
  for (size_t n = 0; n < (v->rank > 0 ? count[0] : 1); ++n)
    out[n] = what == FG__GRIB_DESCRIPTION ? 0.0
             : what <= FG__GRIB_STARTED
                 ? value_along(&file->axis[v->id], what, start[0] + n)
                 : file->grid[v->id].axis[what - FG__GRIB_GRID_X][start[0] + n];
  return FG_STATUS_OK;
}

static void close_file(void *state)
{
  fg__grib_file *file = state;
  if (file->owns_source)
    fg__source_close(&file->source, NULL, FG_STATUS_OK);
  for (size_t i = 0; i < file->grids; ++i)
    fg__grib_grid_clear(&file->grid[i]);
  for (size_t i = 0; i < file->axes; ++i)
    free(file->axis[i].at);
  free(file->field);
  free(file->kind);
  free(file->grid);
  free(file->axis);
  free(file->place);
  free(file->first);
  free(file->value);
}

static const fg__decoder DECODER = {.fetch = fetch,
                                    .state_bytes = sizeof(fg__grib_file),
                                    .close = close_file,
                                    .has = has_field};

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
  return status == FG_STATUS_OK ? fg__grib_describe(data, file) : status;
}

fg_status fg__grib_open(fg__dataset *dataset, fg_context *context,
                        const fg__source *source, const fg_read_options *options)
{
  (void)options;
  const bool further = dataset->files > 0;
  fg_status status =
      fg__dataset_begin(dataset, context, source->path, source->size, &DECODER);
  if (status != FG_STATUS_OK)
    return status;
  fg__grib_file *file = dataset->file[dataset->files - 1].state;
  *file = (fg__grib_file){.context = context,
                          .path = dataset->file[dataset->files - 1].path,
                          .source = *source,
                          .owns_source = further}; /* it is closed before it is read */
  if (further)
    status = fg__source_open(&file->source, context, file->path);
  if (status == FG_STATUS_OK && !fg__dataset_add_group(dataset))
    status = FG_STATUS_MEMORY;
  return status == FG_STATUS_OK ? read_file(dataset, file) : status;
}
