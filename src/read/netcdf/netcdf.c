/* NetCDF files: classic, 64-bit offset, CDF-5 and NetCDF-4, through NetCDF-C. */
#include "field/slab.h"
#include "map/project.h"
#include "read/mesh/mesh.h"
#include "read/unstructured/unstructured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_netcdf(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

/* Whether positions of a curvilinear grid, its angle or its mask are in a file. */
static bool uses_file(const fg__nc_mesh *mesh, int number)
{
  const fg__nc_variable *all[] = {mesh->centre.variable, mesh->part[0].longitude,
                                  mesh->part[1].longitude, mesh->angle[0], mesh->mask};
  for (size_t n = 0; n < sizeof all / sizeof *all; ++n)
    if (all[n] && all[n]->file == number)
      return true;
  return false;
}

/* A further file of which neither a component, the mesh nor the mask is used is refused
 * as the wrong one. */
static fg_status check_used(const fg__nc_file *file, int number, const fg__nc_pair *pair,
                            const fg__nc_grid *grid, const char *mask)
{
  const fg__nc_variable *masked = mask ? fg__nc_find(file, mask) : NULL;
  const bool mesh = number >= file->component_files;
  bool used =
      (masked && masked->file == number) || (mesh && file->was_read[number]) ||
      (grid->mesh && uses_file(grid->mesh, number)) ||
      (grid->unstructured && fg__nc_unstructured_file(grid->unstructured) == number);
  for (int k = 0; k < 2; ++k)
    used = used || pair->component[k]->file == number;
  used = used || (pair->component[2] && pair->component[2]->file == number);
  if (used)
    return FG_STATUS_OK;
  fg__fail(file->context, FG_STATUS_ARGUMENT,
           mesh ? "%s: gives no position: '%.200s' and '%.200s' lie on the grid of %s"
                : "%s: gives no component: '%.200s' and '%.200s' are both of %s",
           file->paths[number], pair->component[0]->name, pair->component[1]->name,
           pair->component[0]->path);
  fg__hint(file->context,
           mesh ? "leave out --mesh-from"
                : "name one of its variables with --vars, or leave out --vars-from");
  return FG_STATUS_ARGUMENT;
}

static fg_status check_index(const fg__nc_file *file, const char *what, int index,
                             int position, size_t count, const char *name)
{
  if (index >= 0 && (size_t)index < count)
    return FG_STATUS_OK;
  if (position < 0)
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: %s %d asked for, but the field has no %s axis", file->paths[0],
                    what, index, what);
  fg__fail(file->context, FG_STATUS_ARGUMENT,
           "%s: %s %d asked for, but '%s' has %zu: 0 to %zu", file->paths[0], what, index,
           name, count, count - 1);
  fg__hint(file->context,
           "a whole number is an index, from 0; a value has its unit or a point: %s",
           strcmp(what, "time") == 0 ? "1982-07-16, 2.5" : "850hPa, 850.");
  return FG_STATUS_ARGUMENT;
}

static fg_status check_missing(const fg__nc_file *file, const fg__nc_variable *v,
                               const fg__nc_missing *missing, size_t samples)
{
  if (missing->fill + missing->range + missing->not_a_number < samples)
    return FG_STATUS_OK;
  return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                  "%s: all %zu samples of '%s' are missing (%zu fill values, %zu outside "
                  "the valid range, %zu not a number)",
                  v->path, samples, v->name, missing->fill, missing->range,
                  missing->not_a_number);
}

/* Records the missing samples of a slab; whether all are missing is known once all slabs
 * are read. */
static void keep_missing(const fg_field *field, const fg__nc_samples *read)
{
  fg__field_slab *slab = field->slab;
  slab->has_reasons = true;
  for (int k = 0; k < field->contents.dimension; ++k) {
    slab->counts.by_reason[k][0] = read->missing[k].fill;
    slab->counts.by_reason[k][1] = read->missing[k].range;
    slab->counts.by_reason[k][2] = read->missing[k].not_a_number;
  }
}

static const char *projection_of(const fg__nc_grid *grid)
{
  return grid->dimension == 2 && grid->projection[0] ? grid->projection : NULL;
}

static fg_status make_field(fg_field **out, const fg__nc_file *file,
                            const fg__nc_pair *pair, const fg__nc_grid *grid,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg__nc_words words;
  fg__nc_samples read = {0};
  char plane[FG__NC_TEXT]; /* of the model whose grid has axes in degrees */
  const fg__nc_axis *last = &grid->axis[grid->dimension - 1];
  if (last->period > 0.0)
    slab = (fg__slab_index){0, 1};
  const fg__rows rows = fg__rows_of(&slab, (int)last->size, false);
  fg_status status = fg__nc_words_find(&words, file, pair, grid, options);
  if (status == FG_STATUS_OK)
    status = fg__nc_samples_read(&read, file, pair, grid, &rows, (size_t)options->time,
                                 (size_t)options->level, options->mask);
  if (status == FG_STATUS_OK && grid->dimension == 2)
    status = fg__nc_projection_turn(read.velocity, file, grid, &rows);
  for (int k = 0; k < grid->dimension && status == FG_STATUS_OK && slab.count == 1; ++k)
    status = check_missing(file, pair->component[k], &read.missing[k], grid->samples);
  if (status == FG_STATUS_OK) {
    fg_field_arrays arrays = {.dimension = grid->dimension,
                              .valid = read.valid,
                              .scale = grid->scale,
                              .projection = projection_of(grid),
                              .velocity_units = words.units,
                              .title = words.title,
                              .time = words.time[0] ? words.time : NULL,
                              .level = words.level[0] ? words.level : NULL};
    if (!arrays.projection && fg__map_is_asked(options->map))
      arrays.projection = fg__nc_axes_plane(plane, file, pair->component[0], grid);
    for (int k = 0; k < grid->dimension; ++k) {
      arrays.size[k] = (int)grid->axis[k].size;
      arrays.axis[k] = grid->axis[k].coordinate;
      arrays.period[k] = grid->axis[k].period;
      arrays.velocity[k] = read.velocity[k];
      arrays.velocity_name[k] = fg__nc_component_name(pair, k);
      arrays.axis_name[k] = grid->axis[k].name;
      arrays.axis_units[k] = grid->axis[k].units;
    }
    status = fg__field_of_rows(out, file->context, &arrays, read.velocity, &slab);
    if (status == FG_STATUS_OK && slab.count > 1)
      keep_missing(*out, &read);
  }
  fg__nc_samples_clear(&read);
  return status;
}

/* An opened source, and the pair that options choose in it. */
typedef struct choice {
  fg__nc_file file;
  fg__nc_pair pair;
  fg__nc_grid grid;
} choice;

static fg_status choose(void *data, fg_context *context, const fg__source *source,
                        const fg_read_options *options)
{
  choice *c = data;
  fg__nc_file *file = &c->file;
  fg_status status = fg__nc_file_open(file, context, source);
  if (status == FG_STATUS_OK && options->vars_from) {
    status = fg__nc_file_add(file, options->vars_from);
    file->component_files = 2;
  }
  if (status == FG_STATUS_OK && options->mesh_from)
    status = fg__nc_file_add(file, options->mesh_from);
  if (status == FG_STATUS_OK && options->at)
    status = fg__nc_choose_samples(file, options->at);
  if (status == FG_STATUS_OK)
    status = fg__nc_choose(&c->pair, &c->grid, file, options);
  if (status == FG_STATUS_OK)
    status = fg__nc_check_choices(file, &c->pair);
  for (int n = 1; n < file->root_count && status == FG_STATUS_OK; ++n)
    status = check_used(file, n, &c->pair, &c->grid, options->mask);
  return fg__nc_status(file, status);
}

static void end_choice(void *data)
{
  choice *c = data;
  fg__nc_grid_clear(&c->grid);
  fg__nc_file_close(&c->file);
}

static const fg__opener CHOICE = {sizeof(choice), choose, end_choice};

/* *out is NULL after a failure. */
static fg_status enter_choice(choice **out, fg_context *context, const fg__source *source,
                              const fg_read_options *options)
{
  void *data;
  const fg_status status = fg__source_enter(&data, context, source, options, &CHOICE);
  *out = data;
  if (*out)
    (*out)->file.context = context;
  return status;
}

/* c may be NULL. */
static fg_status leave_choice(choice *c, const fg__source *source, fg_status status)
{
  if (c) {
    status = fg__nc_status(&c->file, status);
    c->file.exhausted = false;
  }
  fg__source_leave(c, source, &CHOICE);
  return status;
}

static fg_status check_level(const fg__nc_file *file, const fg__nc_grid *grid, int level)
{
  if (grid->dimension == 2)
    return check_index(file, "level", level, grid->level, grid->levels, grid->level_name);
  if (level == 0)
    return FG_STATUS_OK;
  fg__fail(
      file->context, FG_STATUS_ARGUMENT,
      "%s: level %d asked for, but the field has three components and all %zu levels",
      file->paths[0], level, grid->levels);
  fg__hint(file->context, "name two components, --vars U,V, for the plane of one level");
  return FG_STATUS_ARGUMENT;
}

static fg_status check_places(const choice *c, const fg_read_options *options)
{
  const fg__nc_grid *grid = &c->grid;
  const fg_status status = check_index(&c->file, "time", options->time, grid->time,
                                       grid->times, grid->time_name);
  return status == FG_STATUS_OK ? check_level(&c->file, grid, options->level) : status;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  choice *c;
  fg__sphere *sphere = NULL;
  fg_status status = enter_choice(&c, context, source, options);
  if (status == FG_STATUS_OK)
    status = check_places(c, options);
  if (status == FG_STATUS_OK && c->grid.mesh) {
    status = fg__nc_sphere_read(&sphere, &c->file, &c->pair, &c->grid, options);
    if (status == FG_STATUS_OK)
      status = fg__globe_field(out, context, sphere, slab);
  } else if (status == FG_STATUS_OK && c->grid.unstructured) {
    status = fg__nc_unstructured_field(out, &c->file, &c->pair, &c->grid, options, slab);
  } else if (status == FG_STATUS_OK) {
    status = make_field(out, &c->file, &c->pair, &c->grid, options, slab);
  }
  fg__sphere_destroy(sphere);
  return leave_choice(c, source, status);
}

static fg_status read_sphere(fg__sphere **out, fg_context *context,
                             const fg__source *source, const fg_read_options *options)
{
  choice *c;
  fg_status status = enter_choice(&c, context, source, options);
  if (status == FG_STATUS_OK)
    status = check_places(c, options);
  if (status == FG_STATUS_OK && c->grid.mesh)
    status = fg__nc_sphere_read(out, &c->file, &c->pair, &c->grid, options);
  else if (status == FG_STATUS_OK && c->grid.unstructured)
    status = fg__nc_unstructured_sphere(out, &c->file, &c->pair, &c->grid, options);
  return leave_choice(c, source, status);
}

/* Samples in memory at a time while an inventory counts missing values. */
enum { COUNTED_AT_ONCE = 1 << 22 };

static fg_status count_missing(fg_inventory_vector *vector, const fg__nc_file *file,
                               const fg__nc_pair *pair, const fg__nc_grid *grid)
{
  const size_t all = grid->axis[grid->dimension - 1].size, row = grid->samples / all;
  const size_t most = row < COUNTED_AT_ONCE ? COUNTED_AT_ONCE / row : 1;
  size_t count = 0;
  fg_status status = FG_STATUS_OK;
  for (size_t first = 0; first < all && status == FG_STATUS_OK; first += most) {
    const int own = (int)(all - first < most ? all - first : most);
    const fg__rows rows = {(int)first, own, own};
    fg__nc_samples read = {0};
    status = fg__nc_samples_read(&read, file, pair, grid, &rows, 0, 0, NULL);
    for (size_t i = 0; i < row * (size_t)own && status == FG_STATUS_OK; ++i) {
      bool missing = false;
      for (int k = 0; k < grid->dimension; ++k)
        missing = missing || !isfinite(read.velocity[k][i]);
      count += missing;
    }
    fg__nc_samples_clear(&read);
  }
  if (status == FG_STATUS_OK)
    vector->missing_share = (double)count / (double)grid->samples;
  return status;
}

/* Adds a vector with its times and levels. */
static fg_status add_vector(fg_inventory *inventory, fg_inventory_vector *vector,
                            const fg__nc_file *file, const fg__nc_grid *grid)
{
  fg_axis_value *times = NULL, *levels = NULL;
  char *time_text = NULL, *level_text = NULL;
  fg_status status = FG_STATUS_OK;
  if (!vector->unusable)
    status = fg__nc_axis_values(&times, &time_text, file, grid->time_variable,
                                (size_t)vector->times);
  if (!vector->unusable && grid->dimension == 2 && status == FG_STATUS_OK)
    status = fg__nc_axis_values(&levels, &level_text, file, grid->level_variable,
                                (size_t)vector->levels);
  vector->time_value = times;
  vector->level_value = levels;
  if (status == FG_STATUS_OK)
    status = fg__inventory_add(inventory, file->context, vector);
  free(times);
  free(levels);
  free(time_text);
  free(level_text);
  return status;
}

/* Texts that a vector of the inventory points to. */
typedef struct vector_texts {
  char units[FG__NC_TEXT], plane[FG__NC_TEXT], chosen[FG__NC_TEXT];
  char polar[FG__NC_TEXT];
  char frame[3 * FG__NC_TEXT + 4];    /* a projection, and its directions */
  char unusable[3 * FG__NC_TEXT + 2]; /* the reason and the hint */
} vector_texts;

static const char *describe_frame(char *out, size_t size, const fg__nc_grid *grid)
{
  if (grid->mesh)
    return grid->mesh->rule;
  if (!grid->projection[0])
    return grid->faces.used ? "along the axes (a staggered grid)" : NULL;
  snprintf(out, size, "%s of %s",
           grid->points_east ? "east and north, turned to the axes" : "along the axes",
           grid->projection);
  return out;
}

/* A mesh has it in its rule. */
static const char *describe_polar(vector_texts *texts, const fg__nc_pair *pair,
                                  const fg__nc_grid *grid)
{
  fg__nc_polar_words(texts->polar, sizeof texts->polar, pair);
  snprintf(texts->frame, sizeof texts->frame, "%s (%s)",
           grid->unstructured ? grid->unstructured->rule : "east and north",
           texts->polar);
  return texts->frame;
}

static void describe_axes(fg_inventory_vector *vector, const fg__nc_grid *grid)
{
  for (int k = 0; k < grid->dimension; ++k) {
    const fg__nc_axis *axis = &grid->axis[k];
    vector->size[k] = (int)axis->size;
    if (axis->coordinate) {
      vector->bounds[2 * k] = axis->coordinate[0];
      vector->bounds[2 * k + 1] = axis->coordinate[axis->size - 1];
    }
  }
}

/* Fills in what requires reading the mesh or all samples. */
static fg_status describe_samples(fg_inventory_vector *vector, const fg__nc_file *file,
                                  const fg__nc_pair *pair, const fg__nc_grid *grid)
{
  if (grid->mesh)
    return fg__nc_mesh_describe(vector, file, pair, grid);
  if (grid->unstructured)
    return fg__nc_unstructured_describe(vector, file, pair, grid);
  return count_missing(vector, file, pair, grid);
}

/* Adds the vector of a pair to the inventory. reads: the mesh or all samples may be
 * read. */
static fg_status describe_grid(fg_inventory *inventory, const fg__nc_file *file,
                               const fg__nc_pair *pair, const fg__nc_grid *grid,
                               const fg_read_options *options, bool reads)
{
  vector_texts texts;
  fg_read_defaults defaults;
  fg_status status = fg__nc_defaults(&defaults, file, pair, grid, options);
  fg__nc_velocity_units(texts.units, sizeof texts.units, pair);
  texts.chosen[0] = '\0';
  for (int of_time = 0; of_time < 2 && status == FG_STATUS_OK; ++of_time)
    status = fg__nc_chosen_words(file, pair->component[0], of_time == 1, texts.chosen,
                                 sizeof texts.chosen);
  fg_inventory_vector vector = {
      .components = grid->dimension,
      .name = {pair->component[0]->name,
               pair->component[0]->element ? NULL : pair->component[1]->name,
               grid->dimension == 3 ? pair->component[2]->name : NULL},
      .units = texts.units,
      .found_by = pair->found_by,
      .dimension = grid->dimension,
      .size = {0, 0, 1},
      .times = (int)grid->times,
      .levels = grid->dimension == 3 ? 1 : (int)grid->levels,
      .scale = grid->scale,
      .frame = describe_frame(texts.frame, sizeof texts.frame, grid),
      .usual_level = defaults.level,
      .absent = defaults.absent[0] ? defaults.absent : NULL,
      .chosen = texts.chosen[0] ? texts.chosen : NULL,
      .periodic = {grid->axis[0].period > 0.0}};
  const bool on_axes = !grid->mesh && !grid->unstructured;
  if (on_axes)
    describe_axes(&vector, grid);
  if (grid->unusable[0]) {
    snprintf(texts.unusable, sizeof texts.unusable, "%s%s%s", grid->unusable,
             grid->hint[0] ? "; " : "", grid->hint);
    vector.unusable = texts.unusable;
  } else {
    if (on_axes && !grid->projection[0])
      vector.plane = fg__nc_axes_plane(texts.plane, file, pair->component[0], grid);
    if (status == FG_STATUS_OK && reads)
      status = describe_samples(&vector, file, pair, grid);
  }
  if (pair->polar.sense != 0 && !grid->mesh)
    vector.frame = describe_polar(&texts, pair, grid);
  return status == FG_STATUS_OK ? add_vector(inventory, &vector, file, grid) : status;
}

static fg_status describe_pair(fg_inventory *inventory, const fg__nc_file *file,
                               const fg__nc_pair *pair)
{
  static const fg_read_options defaults = {0};
  fg__nc_grid grid;
  fg_status status = fg__nc_grid_find(&grid, file, pair, &defaults);
  if (status == FG_STATUS_OK)
    status = describe_grid(inventory, file, pair, &grid, &defaults, true);
  fg__nc_grid_clear(&grid);
  return status;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  fg__nc_file file = {0};
  fg__nc_pair *pairs = NULL;
  size_t count = 0;
  fg_status status = fg__nc_file_open(&file, context, source);
  if (status == FG_STATUS_OK)
    status = fg__nc_pairs(&pairs, &count, &file);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i)
    status = describe_pair(inventory, &file, &pairs[i]);
  status = fg__nc_status(&file, status);
  free(pairs);
  fg__nc_file_close(&file);
  return status;
}

static fg_status describe_chosen(fg_inventory *inventory, fg_context *context,
                                 const fg__source *source, const fg_read_options *options)
{
  choice *c;
  fg_status status = enter_choice(&c, context, source, options);
  if (status == FG_STATUS_OK)
    status = describe_grid(inventory, &c->file, &c->pair, &c->grid, options, false);
  return leave_choice(c, source, status);
}

static fg_status find_defaults(fg_read_defaults *out, fg_context *context,
                               const fg__source *source, const fg_read_options *options)
{
  choice *c;
  fg_status status = enter_choice(&c, context, source, options);
  if (status == FG_STATUS_OK)
    status = fg__nc_defaults(out, &c->file, &c->pair, &c->grid, options);
  return leave_choice(c, source, status);
}

const fg__format fg__format_netcdf = {
    .name = "NetCDF",
    .has_dimensions = true,
    .files = "NetCDF (classic, 64-bit offset, CDF-5, NetCDF-4)",
    .is_mine = is_netcdf,
    .inventory = describe,
    .inventory_chosen = describe_chosen,
    .defaults = find_defaults,
    .sphere = read_sphere,
    .read = read_field};
