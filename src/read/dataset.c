/* Fields, spheres and inventories of datasets of any format. */
#include "read/vector_choice.h"

#include "field/slab.h"
#include "map/project.h"
#include "sample/curvilinear/points.h"
#include "sample/gap_lines.h"
#include "sample/layers.h"
#include "sample/missing.h"
#include "sample/space/space.h"
#include "sample/unstructured/mesh.h"
#include "sample/velocity.h"
#include "terms/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fg_status check_index(const fg__dataset *data, const char *what, int index,
                             int position, size_t count, const char *name)
{
  if (index >= 0 && (size_t)index < count)
    return FG_STATUS_OK;
  if (position < 0 && count < 2)
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: %s %d asked for, but the field has no %s axis",
                    data->file[0].path, what, index, what);
  fg__fail(data->context, FG_STATUS_ARGUMENT,
           "%s: %s %d asked for, but '%s' has %zu: 0 to %zu", data->file[0].path, what,
           index, name, count, count - 1);
  fg__hint(data->context,
           "a whole number is an index, from 0; a value has its unit or a point: %s",
           strcmp(what, "time") == 0 ? "1982-07-16, 2.5" : "850hPa, 850.");
  return FG_STATUS_ARGUMENT;
}

/* Records the missing samples of a slab; whether all are missing is known once all slabs
 * are read. */
static void keep_missing(const fg_field *field, const fg__velocity_samples *read)
{
  fg__field_slab *slab = field->slab;
  slab->has_reasons = true;
  for (int k = 0; k < field->contents.dimension; ++k) {
    slab->counts.by_reason[k][0] = read->missing[k].fill;
    slab->counts.by_reason[k][1] = read->missing[k].range;
    slab->counts.by_reason[k][2] = read->missing[k].not_a_number;
  }
}

static bool has_two_layers(const fg__grid *grid)
{
  return grid->dimension == 3 &&
         (grid->axis[0].size == 2 || grid->axis[1].size == 2 || grid->axis[2].size == 2);
}

/* Says how many gaps there are along the axes of a grid; returns that. */
static size_t name_gaps(char doubts[FG__REASON_BYTES], const fg__grid *grid)
{
  size_t gaps = 0;
  for (int k = 0; k < grid->dimension; ++k)
    if (grid->axis[k].coordinate)
      gaps += fg__axis_gaps(grid->axis[k].coordinate, grid->axis[k].size);
  if (gaps > 0)
    fg__doubt(
        doubts,
        "nothing is interpolated over %zu gap%s along its axes, more than 4.5 times as "
        "wide as the intervals beside",
        gaps, gaps > 1 ? "s" : "");
  return gaps;
}

/* The part of a grid that the dataset's region needs, where the field goes on no map and
 * its axes are plain ones; else all of it. */
static fg_status find_part(fg__grid *out, const fg__dataset *data, const fg__pair *pair,
                           const fg__grid *grid)
{
  char plane[FG__TEXT_BYTES];
  bool plain =
      data->region.axes > 0 && data->region.axes <= grid->dimension &&
      grid->scale != FG_SCALE_GEO && !has_two_layers(grid) &&
      (grid->scale != FG_SCALE_MAP ||
       !(grid->projection[0] || fg__axes_plane(plane, pair->component[0], grid)));
  for (int k = 0; k < grid->dimension; ++k)
    plain = plain && !(grid->axis[k].period > 0.0) &&
            fg__axis_gaps(grid->axis[k].coordinate, grid->axis[k].size) == 0;
  *out = *grid;
  if (!plain)
    return FG_STATUS_OK;
  out->whole = grid;
  out->samples = 1;
  for (int k = 0; k < grid->dimension; ++k) {
    fg__grid_axis *axis = &out->axis[k];
    fg__region_range part;
    const fg_status status =
        fg__region_find(&part, data->context, data->file[0].path, &data->region, k,
                        axis->name, axis->units, axis->coordinate, axis->size);
    if (status != FG_STATUS_OK)
      return status;
    axis->first += axis->reversed ? axis->size - part.first - part.count : part.first;
    axis->coordinate += part.first;
    if (out->rate && k == 1)
      out->rate += part.first;
    axis->size = part.count;
    out->samples *= part.count;
  }
  return FG_STATUS_OK;
}

static fg_status make_field(fg_field **out, const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *whole, const fg_read_options *options,
                            fg__slab_index slab)
{
  fg__grid part;
  const fg__grid *grid = &part;
  fg_status status = find_part(&part, data, pair, whole);
  if (status != FG_STATUS_OK)
    return status;
  fg__vector_words words;
  fg__velocity_samples read = {0};
  char plane[FG__TEXT_BYTES]; /* of the model whose grid has axes in degrees */
  const fg__grid_axis *last = &grid->axis[grid->dimension - 1];
  double *axis[3] = {NULL, NULL, NULL}; /* with lines in gaps */
  const bool gaps = !grid->whole && name_gaps(part.doubts, grid) > 0;
  const bool layers = !grid->whole && has_two_layers(grid);
  if (last->period > 0.0 || layers || gaps)
    slab = (fg__slab_index){0, 1};
  const fg__rows rows = fg__rows_of(&slab, (int)last->size, false);
  status = fg__vector_words_find(&words, data, pair, grid, options);
  if (status == FG_STATUS_OK)
    status =
        fg__velocity_samples_read(&read, data, pair, grid, &rows, (size_t)options->time,
                                  (size_t)options->level, options->mask);
  if (status == FG_STATUS_OK && grid->dimension == 2)
    status = fg__projection_turn(read.velocity, data, grid, &rows);
  const bool all = slab.count == 1 && !grid->whole;
  for (int k = 0; k < grid->dimension && status == FG_STATUS_OK && all; ++k)
    status = fg__check_any(pair->component[k], &read.missing[k], grid->samples);
  if (status == FG_STATUS_OK) {
    fg_field_arrays arrays = fg__vector_texts(&words, pair, grid);
    arrays.dimension = grid->dimension;
    arrays.valid = read.valid;
    arrays.scale = grid->scale;
    if (grid->dimension == 2 && grid->projection[0])
      arrays.projection = grid->projection;
    if (!arrays.projection && fg__map_is_asked(options->map))
      arrays.projection = fg__axes_plane(plane, pair->component[0], grid);
    for (int k = 0; k < grid->dimension; ++k) {
      arrays.size[k] = (int)grid->axis[k].size;
      arrays.axis[k] = grid->axis[k].coordinate;
      arrays.period[k] = grid->axis[k].period;
      arrays.velocity[k] = read.velocity[k];
      arrays.axis_name[k] = grid->axis[k].name;
      arrays.axis_units[k] = grid->axis[k].units;
    }
    if (gaps)
      status =
          fg__gap_lines_insert(&arrays, read.velocity, &read.valid, axis, data->context);
    if (status == FG_STATUS_OK)
      status = fg__field_of_rows(out, data->context, &arrays, read.velocity, &slab);
    if (status == FG_STATUS_OK && slab.count > 1)
      keep_missing(*out, &read);
  }
  fg__velocity_samples_clear(&read);
  for (int k = 0; k < 3; ++k)
    free(axis[k]);
  return status == FG_STATUS_OK && layers ? fg__drop_layer(out, data->context) : status;
}

static fg_status check_level(const fg__dataset *data, const fg__grid *grid, int level)
{
  if (grid->dimension == 2)
    return check_index(data, "level", level, grid->level, grid->levels, grid->level_name);
  if (level == 0)
    return FG_STATUS_OK;
  fg__fail(data->context, FG_STATUS_ARGUMENT,
           "%s: level %d asked for, but it has three components and all %zu levels",
           data->file[0].path, level, grid->levels);
  fg__hint(data->context, "name two components, --vars U,V, for the plane of one level");
  return FG_STATUS_ARGUMENT;
}

static fg_status check_places(const fg__vector_choice *c, const fg_read_options *options)
{
  const fg__grid *grid = &c->grid;
  fg_status status = check_index(&c->data, "time", options->time, grid->time, grid->times,
                                 grid->time_name);
  if (status == FG_STATUS_OK)
    status = check_level(&c->data, grid, options->level);
  return status == FG_STATUS_OK ? fg__check_samples(&c->data, &c->pair, &c->grid, options)
                                : status;
}

fg_status fg__dataset_read(fg_field **out, fg_context *context, const fg__format *format,
                           const fg__source *source, const fg_read_options *options,
                           fg__slab_index slab)
{
  fg__vector_choice *c;
  fg__sphere *sphere = NULL;
  fg_status status = fg__vector_choice_enter(&c, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = check_places(c, options);
  if (status == FG_STATUS_OK && c->grid.mesh) {
    status = fg__sphere_read(&sphere, &c->data, &c->pair, &c->grid, options);
    if (status == FG_STATUS_OK)
      status = fg__globe_field(out, context, sphere, slab);
  } else if (status == FG_STATUS_OK && c->grid.unstructured) {
    status = fg__unstructured_field(out, &c->data, &c->pair, &c->grid, options, slab);
  } else if (status == FG_STATUS_OK && c->grid.domain) {
    status = fg__space_field(out, &c->data, &c->pair, &c->grid, options, slab);
  } else if (status == FG_STATUS_OK) {
    status = make_field(out, &c->data, &c->pair, &c->grid, options, slab);
  }
  fg__sphere_destroy(sphere);
  return fg__vector_choice_leave(c, status);
}

fg_status fg__dataset_sphere(fg__sphere **out, fg_context *context,
                             const fg__format *format, const fg__source *source,
                             const fg_read_options *options)
{
  fg__vector_choice *c;
  fg_status status = fg__vector_choice_enter(&c, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = check_places(c, options);
  if (status == FG_STATUS_OK && c->grid.mesh)
    status = fg__sphere_read(out, &c->data, &c->pair, &c->grid, options);
  else if (status == FG_STATUS_OK && c->grid.unstructured)
    status = fg__unstructured_sphere(out, &c->data, &c->pair, &c->grid, options);
  return fg__vector_choice_leave(c, status);
}

/* Two layers of a volume may be a plane. */
static void describe_layers(fg_inventory_vector *vector, char name[3][FG__TEXT_BYTES],
                            const fg__dataset *data, const fg__pair *pair,
                            const fg__grid *grid)
{
  const fg_read_options first = fg__first_samples(pair, grid);
  fg_field *field = NULL;
  if (make_field(&field, data, pair, grid, &first, (fg__slab_index){0, 1}))
    fg_context_clear(data->context);
  if (field && fg_field_contents(field)->dimension == 2)
    fg__describe_field(vector, name, field);
  fg_field_destroy(field);
}

/* Adds a vector with its times and levels. */
static fg_status add_vector(fg_inventory *inventory, fg_inventory_vector *vector,
                            const fg__dataset *data, const fg__grid *grid)
{
  fg_axis_value *times = NULL, *levels = NULL;
  char *time_text = NULL, *level_text = NULL;
  fg_status status = FG_STATUS_OK;
  if (!vector->unusable && grid->domain)
    status = fg__space_times(&times, &time_text, data);
  else if (!vector->unusable)
    status = fg__index_values(&times, &time_text, data, grid, true);
  if (!vector->unusable && grid->dimension == 2 && status == FG_STATUS_OK)
    status = fg__index_values(&levels, &level_text, data, grid, false);
  vector->time_value = times;
  vector->level_value = levels;
  if (status == FG_STATUS_OK)
    status = fg__inventory_add(inventory, data->context, vector);
  free(times);
  free(levels);
  free(time_text);
  free(level_text);
  return status;
}

/* Texts that a vector of the inventory points to. */
typedef struct vector_texts {
  char units[FG__TEXT_BYTES], plane[FG__TEXT_BYTES], chosen[FG__TEXT_BYTES];
  char polar[FG__TEXT_BYTES], axis_name[3][FG__TEXT_BYTES];
  char frame[3 * FG__TEXT_BYTES + 4];    /* a projection, and its directions */
  char unusable[3 * FG__TEXT_BYTES + 2]; /* the reason and the hint */
} vector_texts;

static const char *describe_frame(char *out, size_t size, const fg__grid *grid)
{
  if (grid->mesh)
    return grid->mesh->rule;
  if (grid->rate) {
    snprintf(out, size, "in a vertical section%s%s", grid->section[0] ? ", " : "",
             grid->section);
    return out;
  }
  if (!grid->projection[0])
    return grid->faces.used ? "along the axes (a staggered grid)" : NULL;
  snprintf(out, size, "%s of %s",
           grid->points_east ? "east and north, turned to the axes" : "along the axes",
           grid->projection);
  return out;
}

/* A mesh has it in its rule. */
static const char *describe_polar(vector_texts *texts, const fg__pair *pair,
                                  const fg__grid *grid)
{
  fg__pair_polar_words(texts->polar, sizeof texts->polar, pair);
  snprintf(texts->frame, sizeof texts->frame, "%s (%s)",
           grid->unstructured ? grid->unstructured->rule : "east and north",
           texts->polar);
  return texts->frame;
}

/* Of the part in the dataset's region, which ends at the region's bounds. */
static void describe_axes(fg_inventory_vector *vector, const fg__grid *grid,
                          const fg__field_region *region)
{
  for (int k = 0; k < grid->dimension; ++k) {
    const fg__grid_axis *axis = &grid->axis[k];
    double *bounds = &vector->bounds[2 * k];
    const fg__measure measure = fg__measure_of(axis->units);
    vector->size[k] = (int)axis->size;
    vector->axis_name[k] = axis->name;
    if (axis->coordinate) {
      bounds[0] = axis->coordinate[0];
      bounds[1] = axis->coordinate[axis->size - 1];
    }
    if (grid->whole)
      fg__region_clip(&bounds[0], &bounds[1], NULL, "", region, k, "", axis->units);
    for (int end = 0; end < 2 && axis->coordinate; ++end)
      bounds[end] = fg__measure_value(&measure, bounds[end]);
  }
}

/* Fills in what requires reading the mesh or all samples. */
static fg_status describe_samples(fg_inventory_vector *vector, vector_texts *texts,
                                  const fg__dataset *data, const fg__pair *pair,
                                  fg__grid *grid)
{
  if (grid->mesh)
    return fg__curvilinear_describe(vector, data, pair, grid);
  if (grid->unstructured)
    return fg__unstructured_describe(vector, data, pair, grid);
  if (grid->domain)
    return fg__space_count(vector, data, pair, grid);
  if (has_two_layers(grid))
    describe_layers(vector, texts->axis_name, data, pair, grid);
  return fg__velocity_missing(&vector->missing_share, data, pair, grid);
}

/* Takes the message of a refusal, without the file's name, and its hint. */
static void take_refusal(char *out, size_t size, const fg__dataset *data)
{
  const char *message = fg_context_message(data->context);
  const size_t path = strlen(data->file[0].path);
  if (strncmp(message, data->file[0].path, path) == 0 && message[path] == ':')
    message += path + 1 + (message[path + 1] == ' ');
  snprintf(out, size, "%s; %s", message, fg_context_hint(data->context));
  fg_context_clear(data->context);
}

/* Adds the vector of a pair to the inventory. reads: the mesh or all samples may be
 * read. */
static fg_status describe_grid(fg_inventory *inventory, const fg__dataset *data,
                               const fg__pair *pair, fg__grid *grid,
                               const fg_read_options *options, bool reads)
{
  vector_texts texts = {.chosen = ""};
  fg_read_defaults defaults;
  fg_status status = fg__defaults_find(&defaults, data, pair, grid, options);
  fg__velocity_units(texts.units, sizeof texts.units, pair);
  for (int of_time = 0; of_time < 2 && status == FG_STATUS_OK; ++of_time)
    status = fg__chosen_words(data, pair->component[0], of_time == 1, texts.chosen,
                              sizeof texts.chosen);
  fg_inventory_vector vector = {
      .components = grid->dimension,
      .name = {pair->component[0]->name,
               pair->component[0]->element ? NULL : pair->component[1]->name,
               grid->dimension == 3 && pair->component[2] ? pair->component[2]->name
                                                          : NULL},
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
  const bool on_axes = !grid->mesh && !grid->unstructured && !grid->domain;
  fg__grid part = *grid; /* whose names the vector points to */
  if (on_axes) {
    if (status == FG_STATUS_OK && !grid->unusable[0])
      status = find_part(&part, data, pair, grid);
    if (status != FG_STATUS_OK)
      return status;
    describe_axes(&vector, &part, &data->region);
    name_gaps(grid->doubts, grid);
  }
  if (grid->domain && status == FG_STATUS_OK)
    status = fg__space_describe(&vector, data, pair, grid);
  if (grid->unusable[0]) {
    snprintf(texts.unusable, sizeof texts.unusable, "%s%s%s", grid->unusable,
             grid->hint[0] ? "; " : "", grid->hint);
    vector.unusable = texts.unusable;
  } else {
    if (on_axes && !grid->projection[0])
      vector.plane = fg__axes_plane(texts.plane, pair->component[0], grid);
    if (status == FG_STATUS_OK && reads)
      status = describe_samples(&vector, &texts, data, pair, grid);
    if (status == FG_STATUS_ARGUMENT) { /* an option decides */
      status = FG_STATUS_OK;
      take_refusal(texts.unusable, sizeof texts.unusable, data);
      vector.unusable = texts.unusable;
    }
  }
  vector.doubts = grid->doubts[0] ? grid->doubts : NULL;
  if (pair->polar.sense != 0 && !grid->mesh)
    vector.frame = describe_polar(&texts, pair, grid);
  return status == FG_STATUS_OK ? add_vector(inventory, &vector, data, grid) : status;
}

static fg_status describe_pair(fg_inventory *inventory, const fg__dataset *data,
                               const fg__pair *pair)
{
  static const fg_read_options defaults = {0};
  fg__grid grid;
  fg_status status = fg__grid_find(&grid, data, pair, &defaults);
  if (status == FG_STATUS_OK)
    status = describe_grid(inventory, data, pair, &grid, &defaults, true);
  fg__grid_clear(&grid);
  return status;
}

static fg_status describe_all(fg_inventory *inventory, fg_context *context,
                              const fg__format *format, const fg__source *source)
{
  fg__dataset data = {0};
  fg__pair *pairs = NULL;
  size_t count = 0;
  fg_status status = fg__dataset_open(&data, context, format, source, NULL);
  if (status == FG_STATUS_OK)
    status = fg__pairs_find(&pairs, &count, &data);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i)
    status = describe_pair(inventory, &data, &pairs[i]);
  free(pairs);
  return fg__dataset_end(&data, status);
}

fg_status fg__dataset_inventory(fg_inventory *inventory, fg_context *context,
                                const fg__format *format, const fg__source *source,
                                const fg_read_options *options)
{
  fg__vector_choice *c;
  if (!options)
    return describe_all(inventory, context, format, source);
  fg_status status = fg__vector_choice_enter(&c, context, format, source, options);
  if (status == FG_STATUS_OK)
    status = describe_grid(inventory, &c->data, &c->pair, &c->grid, options, false);
  return fg__vector_choice_leave(c, status);
}
