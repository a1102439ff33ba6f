/* GRIB, editions 1 and 2, through ecCodes. */
#include "read/grib/grib.h"
#include "terms/units.h"

#include "base/memory.h"
#include "field/slab.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fg_status close_file(fg__grib_file *file, fg_status status)
{
  if (file->count > 1)
    status = fg__source_close(&file->source[1], file->context, status);
  free(file->field);
  free(file->about);
  free(file->kind);
  return status;
}

static fg_status open_second(fg__grib_file *file, const char *path)
{
  fg_status status = fg__source_open(&file->source[1], file->context, path);
  if (status != FG_STATUS_OK)
    return status;
  file->count = 2;
  file->path[1] = path;
  if (!fg__is_grib(file->source[1].bytes, file->source[1].size))
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: is no GRIB file like the first one", path);
  return FG_STATUS_OK;
}

/* To be closed even after a failure. */
static fg_status open_file(fg__grib_file *file, fg_context *context,
                           const fg__source *source, const char *second)
{
  memset(file, 0, sizeof *file);
  file->context = context;
  file->source[0] = *source;
  file->path[0] = source->path;
  file->count = 1;
  fg_status status = second ? open_second(file, second) : FG_STATUS_OK;
  for (int k = 0; k < file->count && status == FG_STATUS_OK; ++k)
    status = fg__grib_scan(file, k);
  return status == FG_STATUS_OK ? fg__grib_tell_all(file) : status;
}

static fg_scale scale_of(const fg__grib_grid *grid)
{
  return grid->layout == FG__GRIB_PLANE ? FG_SCALE_MAP : FG_SCALE_GEO;
}

static fg_status check_grid(const fg__grib_file *file, const fg__grib_pair *pair,
                            const fg__grib_grid *grid, fg_scale scale)
{
  if (grid->unusable[0])
    return fg__fail(file->context, FG_STATUS_UNSUPPORTED, "%s: %s,%s: %s", file->path[0],
                    pair->name[0], pair->name[1], grid->unusable);
  if (scale == FG_SCALE_AUTO || scale == FG_SCALE_PLAIN || scale == scale_of(grid))
    return FG_STATUS_OK;
  fg_status status = fg__fail(
      file->context, FG_STATUS_ARGUMENT, "%s: its grid is %s, not %s", file->path[0],
      scale_of(grid) == FG_SCALE_GEO ? "on the globe" : "on a map",
      scale == FG_SCALE_GEO ? "on the globe" : "on a map");
  fg__hint(file->context, "leave out --scale");
  return status;
}

/* A field that is zero or missing outside the domain, on the grid of the components. */
static fg_status find_mask(const fg__grib_field **out, const fg__grib_file *file,
                           const fg__grib_kind *own, const char *name)
{
  for (size_t i = 0; i < file->fields; ++i) {
    const fg__grib_kind *kind = &file->kind[file->about[file->field[i].about].kind];
    if (kind->grid == own->grid && fg__grib_is_named(kind, name)) {
      *out = &file->field[i];
      return FG_STATUS_OK;
    }
  }
  return fg__fail(file->context, FG_STATUS_ARGUMENT,
                  "%s: has no field '%s' on the grid of %s for a mask", file->path[0],
                  name, own->name);
}

static fg_status use_mask(float *u, float *work, const fg__grib_file *file,
                          const fg__grib_field *mask, const fg__grib_grid *grid)
{
  fg_status status = fg__grib_values(work, file, mask, grid);
  for (size_t n = 0; n < grid->points && status == FG_STATUS_OK; ++n)
    if (!(work[n] > 0.0F))
      u[n] = NAN;
  return status;
}

/* Of a point: both components, and one while it is unpacked. */
static const double VALUE_BYTES = 2.0 * sizeof(float) + sizeof(double);

/* Both components at a place, in the order of the axes and along them. */
static fg_status read_values(float *velocity[2], const fg__grib_file *file,
                             const fg__grib_pair *pair, const fg__grib_place *place,
                             const fg__grib_grid *grid, const char *mask)
{
  const fg__grib_field *field = NULL;
  fg_status status =
      fg__check_memory(file->context, file->path[0], (double)grid->points, VALUE_BYTES);
  if (status == FG_STATUS_OK && mask)
    status = find_mask(&field, file, pair->kind[0], mask);
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    velocity[k] = fg__allocate(grid->points, sizeof *velocity[k]);
    if (!velocity[k])
      return fg__fail_memory(file->context, "the velocity",
                             grid->points * sizeof *velocity[k]);
  }
  if (status == FG_STATUS_OK)
    status = fg__grib_values(velocity[0], file, place->component[0], grid);
  if (status == FG_STATUS_OK && field)
    status = use_mask(velocity[0], velocity[1], file, field, grid);
  if (status == FG_STATUS_OK)
    status = fg__grib_values(velocity[1], file, place->component[1], grid);
  if (status == FG_STATUS_OK)
    status = fg__polar_turn_all(file->context, velocity, grid->points, &pair->polar,
                                file->path[0], pair->name[1]);
  if (status == FG_STATUS_OK)
    fg__grib_turn(velocity[0], velocity[1], grid);
  return status;
}

/* Columns that repeat the first ones 360 degrees on are left out. */
static size_t count_columns(const fg__grib_grid *grid, double *period)
{
  const double *x = grid->axis[0];
  size_t n = grid->size[0];
  const double step = (x[n - 1] - x[0]) / (double)(n - 1);
  *period = 0.0;
  if (grid->layout != FG__GRIB_LONLAT)
    return n;
  while (n > 2 && x[n - 1] - x[0] >= 360.0 - 0.01 * step)
    --n;
  if (grid->period > 0.0 || n < grid->size[0])
    *period = 360.0;
  return n;
}

/* Keeps of each component the slab's rows and so many columns. */
static void keep_rows(float *velocity[2], const fg__grib_grid *grid, size_t columns,
                      const fg__rows *rows)
{
  for (int k = 0; k < 2; ++k)
    for (size_t j = 0; j < (size_t)rows->held; ++j)
      memmove(velocity[k] + j * columns,
              velocity[k] + ((size_t)rows->first + j) * grid->size[0],
              columns * sizeof(float));
}

/* What a field says of itself. */
typedef struct captions {
  char title[FG__GRIB_TEXT], units[FG__GRIB_TEXT], time[FG__GRIB_TEXT],
      level[FG__GRIB_TEXT];
} captions;

static void write_captions(captions *out, fg_field_arrays *arrays,
                           const fg__grib_pair *pair, const fg_read_options *options)
{
  fg__grib_title(pair, out->title, sizeof out->title);
  fg__units_read(pair->kind[0]->units, out->units, sizeof out->units);
  fg__grib_time_words(pair, (size_t)options->time, out->time, sizeof out->time);
  fg__grib_level_words(pair, pair->level[options->level], out->level, sizeof out->level);
  arrays->title = out->title;
  arrays->velocity_units = out->units;
  arrays->time = out->time;
  arrays->level = out->level[0] ? out->level : NULL;
  for (int k = 0; k < 2 && pair->polar.sense == 0; ++k)
    arrays->velocity_name[k] = pair->name[k];
}

static fg_status make_field(fg_field **out, const fg__grib_file *file,
                            const fg__grib_pair *pair, const fg__grib_grid *grid,
                            float *velocity[3], const fg_read_options *options,
                            fg__slab_index slab)
{
  static const char *const names[][2] = {{"longitude", "latitude"}, {"x", "y"}};
  static const char *const units[][2] = {{"°E", "°N"}, {"m", "m"}};
  const bool plane = grid->layout == FG__GRIB_PLANE;
  captions words;
  fg_field_arrays arrays = {.dimension = 2};
  const size_t columns = count_columns(grid, &arrays.period[0]);
  const fg__rows rows = fg__rows_of(&slab, (int)grid->size[1], false);
  keep_rows(velocity, grid, columns, &rows);
  write_captions(&words, &arrays, pair, options);
  arrays.scale = options->scale == FG_SCALE_PLAIN ? FG_SCALE_PLAIN : scale_of(grid);
  if (arrays.scale == FG_SCALE_MAP)
    arrays.projection = grid->projection;
  arrays.size[0] = (int)columns;
  arrays.size[1] = (int)grid->size[1];
  for (int k = 0; k < 2; ++k) {
    arrays.axis[k] = grid->axis[k];
    arrays.velocity[k] = velocity[k];
    arrays.axis_name[k] = names[plane][k];
    arrays.axis_units[k] = units[plane][k];
  }
  return fg__field_of_rows(out, file->context, &arrays, velocity, &slab);
}

/* Directions are from north whatever components are along. */
static fg_status find_grid(fg__grib_grid *out, const fg__grib_file *file,
                           const fg__grib_pair *pair, const fg__grib_place *place)
{
  const fg_status status = fg__grib_grid_find(out, file, place->component[0]);
  out->relative = out->relative && pair->polar.sense == 0;
  return status;
}

typedef struct opened {
  fg__grib_file file;
  fg__grib_pairs pairs;
  fg__grib_grid grid;
  const fg__grib_place *place;
} opened;

/* Finds the pair, place and grid that are asked for; to be closed even after a failure.
 */
static fg_status open_pair(opened *o, fg_context *context, const fg__source *source,
                           const fg_read_options *options)
{
  memset(o, 0, sizeof *o);
  fg_status status = open_file(&o->file, context, source, options->vars_from);
  if (status == FG_STATUS_OK)
    status = fg__grib_choose(&o->pairs, &o->file, options);
  if (status == FG_STATUS_OK)
    status = fg__grib_find_place(&o->place, &o->file, o->pairs.pair, options);
  if (status == FG_STATUS_OK)
    status = find_grid(&o->grid, &o->file, o->pairs.pair, o->place);
  if (status == FG_STATUS_OK)
    status = check_grid(&o->file, o->pairs.pair, &o->grid, options->scale);
  return status;
}

static fg_status close_pair(opened *o, fg_status status)
{
  fg__grib_grid_clear(&o->grid);
  fg__grib_pairs_clear(&o->pairs);
  return close_file(&o->file, status);
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  opened o;
  float *velocity[3] = {NULL, NULL, NULL};
  *out = NULL;
  fg_status status = open_pair(&o, context, source, options);
  if (status == FG_STATUS_OK && o.grid.layout != FG__GRIB_LONLAT &&
      o.grid.layout != FG__GRIB_PLANE)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: its grid is of type '%s', whose rows are not along the axes",
                      source->path, o.grid.type);
  if (status == FG_STATUS_OK)
    status =
        read_values(velocity, &o.file, o.pairs.pair, o.place, &o.grid, options->mask);
  if (status == FG_STATUS_OK)
    status = make_field(out, &o.file, o.pairs.pair, &o.grid, velocity, options, slab);
  free(velocity[0]);
  free(velocity[1]);
  return close_pair(&o, status);
}

/* Grids whose rows are along no axes; *out stays NULL for others. */
static fg_status read_sphere(fg__sphere **out, fg_context *context,
                             const fg__source *source, const fg_read_options *options)
{
  opened o;
  float *velocity[2] = {NULL, NULL};
  fg__sphere_cells cells = {0};
  captions words;
  fg_field_arrays arrays = {.dimension = 2};
  *out = NULL;
  fg_status status = open_pair(&o, context, source, options);
  const bool mine = o.grid.layout == FG__GRIB_ROWS || o.grid.layout == FG__GRIB_REDUCED;
  if (status == FG_STATUS_OK && mine && options->scale == FG_SCALE_PLAIN)
    status = fg__fail(context, FG_STATUS_UNSUPPORTED,
                      "%s: its grid is of type '%s', whose rows are not along the axes",
                      source->path, o.grid.type);
  if (status == FG_STATUS_OK && mine)
    status =
        read_values(velocity, &o.file, o.pairs.pair, o.place, &o.grid, options->mask);
  if (status == FG_STATUS_OK && mine) {
    const float *const both[2] = {velocity[0], velocity[1]};
    write_captions(&words, &arrays, o.pairs.pair, options);
    status = fg__grib_cells(&cells, context, &o.grid, both);
  }
  cells.words = &arrays;
  if (status == FG_STATUS_OK && mine)
    status = fg__sphere_of_cells(out, context, &cells);
  free(velocity[0]);
  free(velocity[1]);
  return close_pair(&o, status);
}

/* Where points on the sphere lie, longitudes within a turn round the first one. */
static fg_status find_bounds(fg_inventory_vector *vector, fg_context *context,
                             const fg__grib_grid *grid, const float *const velocity[2])
{
  fg__sphere_cells cells;
  fg_status status = fg__grib_cells(&cells, context, grid, velocity);
  double *bounds = vector->bounds;
  if (status != FG_STATUS_OK)
    return status;
  vector->cells = cells.count;
  for (size_t n = 0; n < cells.points; ++n) {
    const double x =
        cells.longitude[0] + remainder(cells.longitude[n] - cells.longitude[0], 360.0);
    const double y = cells.latitude[n];
    bounds[0] = n == 0 ? x : fmin(bounds[0], x);
    bounds[1] = n == 0 ? x : fmax(bounds[1], x);
    bounds[2] = n == 0 ? y : fmin(bounds[2], y);
    bounds[3] = n == 0 ? y : fmax(bounds[3], y);
  }
  fg__sphere_cells_clear(&cells);
  return FG_STATUS_OK;
}

static fg_status count_missing(fg_inventory_vector *vector, const fg__grib_file *file,
                               const fg__grib_pair *pair, const fg__grib_grid *grid)
{
  float *velocity[2] = {NULL, NULL};
  size_t missing = 0;
  fg_status status = read_values(velocity, file, pair, &pair->place[0], grid, NULL);
  for (size_t n = 0; n < grid->points && status == FG_STATUS_OK; ++n)
    missing += !isfinite(velocity[0][n]) || !isfinite(velocity[1][n]);
  if (status == FG_STATUS_OK)
    vector->missing_share = (double)missing / (double)grid->points;
  const float *const both[2] = {velocity[0], velocity[1]};
  if (status == FG_STATUS_OK &&
      (grid->layout == FG__GRIB_ROWS || grid->layout == FG__GRIB_REDUCED))
    status = find_bounds(vector, file->context, grid, both);
  free(velocity[0]);
  free(velocity[1]);
  return status;
}

/* Times and levels by value. */
typedef struct axis_values {
  fg_axis_value *value;
  char *text; /* FG__GRIB_TEXT bytes each */
} axis_values;

static fg_status make_values(axis_values *out, fg_context *context, size_t count)
{
  out->value = fg__allocate(count, sizeof *out->value);
  out->text = fg__allocate(count, FG__GRIB_TEXT);
  if (!out->value || !out->text)
    return fg__fail_memory(context, "times and levels", count * FG__GRIB_TEXT);
  for (size_t n = 0; n < count; ++n)
    out->value[n].words = out->text + n * FG__GRIB_TEXT;
  return FG_STATUS_OK;
}

static fg_status list_values(axis_values out[2], fg_context *context,
                             const fg__grib_pair *pair)
{
  fg_status status = make_values(&out[0], context, pair->times);
  if (status == FG_STATUS_OK)
    status = make_values(&out[1], context, pair->levels);
  for (size_t n = 0; n < pair->times && status == FG_STATUS_OK; ++n) {
    out[0].value[n].value = (double)pair->time[n].time / 60.0;
    out[0].value[n].units = "hours since 1970-01-01";
    fg__grib_time_words(pair, n, out[0].text + n * FG__GRIB_TEXT, FG__GRIB_TEXT);
  }
  for (size_t n = 0; n < pair->levels && status == FG_STATUS_OK; ++n) {
    out[1].value[n].value = pair->level[n];
    out[1].value[n].units = fg__grib_level_units(pair);
    fg__grib_level_words(pair, pair->level[n], out[1].text + n * FG__GRIB_TEXT,
                         FG__GRIB_TEXT);
  }
  return status;
}

static void describe_grid(fg_inventory_vector *vector, const fg__grib_grid *grid)
{
  double period = grid->period;
  vector->size[0] = (int)grid->size[0];
  vector->size[1] = (int)grid->size[1];
  if (grid->axis[0])
    vector->size[0] = (int)count_columns(grid, &period);
  vector->periodic[0] = period > 0.0;
  for (int k = 0; k < 2 && !grid->row && !grid->rotated; ++k)
    if (grid->axis[k]) {
      vector->bounds[2 * k] = grid->axis[k][0];
      vector->bounds[2 * k + 1] = grid->axis[k][vector->size[k] - 1];
    }
}

static fg_status describe_pair(fg_inventory *inventory, const fg__grib_file *file,
                               const fg__grib_pair *pair, bool counted)
{
  fg__grib_grid grid;
  axis_values values[2] = {{NULL, NULL}, {NULL, NULL}};
  char units[FG__GRIB_TEXT], polar[FG__GRIB_TEXT], frame[FG__GRIB_TEXT + 32];
  fg_status status = find_grid(&grid, file, pair, &pair->place[0]);
  fg__units_read(pair->kind[0]->units, units, sizeof units);
  fg_inventory_vector vector = {.components = 2,
                                .name = {pair->name[0], pair->name[1]},
                                .units = units,
                                .found_by = "parameters",
                                .dimension = 2,
                                .size = {0, 0, 1},
                                .times = (int)pair->times,
                                .levels = (int)pair->levels,
                                .scale = scale_of(&grid)};
  fg__polar_words(polar, sizeof polar, &pair->polar, pair->kind[1]->title);
  snprintf(frame, sizeof frame, "east and north (%s)", polar);
  vector.frame = pair->polar.sense != 0 ? frame : NULL;
  if (status == FG_STATUS_OK)
    status = list_values(values, file->context, pair);
  vector.time_value = values[0].value;
  vector.level_value = values[1].value;
  if (grid.unusable[0])
    vector.unusable = grid.unusable;
  else if (status == FG_STATUS_OK)
    describe_grid(&vector, &grid);
  if (status == FG_STATUS_OK && counted && !vector.unusable)
    status = count_missing(&vector, file, pair, &grid);
  if (status == FG_STATUS_OK)
    status = fg__inventory_add(inventory, file->context, &vector);
  for (int k = 0; k < 2; ++k) {
    free(values[k].value);
    free(values[k].text);
  }
  fg__grib_grid_clear(&grid);
  return status;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  fg__grib_file file;
  fg__grib_pairs pairs = {0};
  fg_status status = open_file(&file, context, source, NULL);
  if (status == FG_STATUS_OK)
    status = fg__grib_pairs_find(&pairs, &file);
  for (size_t i = 0; i < pairs.count && status == FG_STATUS_OK; ++i) {
    status = describe_pair(inventory, &file, &pairs.pair[i], true);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(context);
  }
  fg__grib_pairs_clear(&pairs);
  return close_file(&file, status);
}

static fg_status describe_chosen(fg_inventory *inventory, fg_context *context,
                                 const fg__source *source, const fg_read_options *options)
{
  fg__grib_file file;
  fg__grib_pairs pairs = {0};
  fg_status status = open_file(&file, context, source, options->vars_from);
  if (status == FG_STATUS_OK)
    status = fg__grib_choose(&pairs, &file, options);
  if (status == FG_STATUS_OK)
    status = describe_pair(inventory, &file, pairs.pair, false);
  fg__grib_pairs_clear(&pairs);
  return close_file(&file, status);
}

const fg__format fg__format_grib = {.name = "GRIB",
                                    .files = "GRIB (editions 1 and 2)",
                                    .is_mine = fg__is_grib,
                                    .inventory = describe,
                                    .inventory_chosen = describe_chosen,
                                    .read = read_field,
                                    .sphere = read_sphere};
