/* VTK grids along the axes as fields, and VTK XML files as a format. */
#include "base/memory.h"
#include "field/field.h"
#include "read/vtk/vtk.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  DESCRIBED_SAMPLES = 64,    /* vectors whose missing share an inventory counts */
  COUNTED_AT_ONCE = 1 << 22, /* samples that are in memory for that */
  NAME_BYTES = 256
};

static const char LETTERS[] = "xyz";

/* Copies the time in words, that of FieldData's TimeValue where none was chosen; `out`
 * stays empty without. */
static fg_status read_time(char out[FG__VTK_TEXT], const fg__vtk *vtk)
{
  const fg__vtk *file = vtk->file_count > 0 ? vtk->files[0].vtk : vtk;
  const fg__vtk_array *array = fg__vtk_find(file, 0, FG__VTK_FIELD, "TimeValue");
  if (!array && !vtk->document) /* VisIt's name for it in legacy files */
    array = fg__vtk_find(file, 0, FG__VTK_FIELD, "TIME");
  snprintf(out, FG__VTK_TEXT, "%s", vtk->time);
  if (out[0])
    return FG_STATUS_OK;
  if (!array)
    return FG_STATUS_OK;
  fg__vtk_values values;
  fg_status status = fg__vtk_values_create(&values, file, array, 1);
  if (status != FG_STATUS_OK)
    return status;
  status = fg__time_write(out, vtk->context, fg__vtk_value(&values, 0));
  fg__vtk_values_clear(&values);
  return status;
}

/* "U_x" for a vector variable U; a scalar's own name. */
static void name_component(char name[NAME_BYTES], const fg__vtk_vector *vector, int axis,
                           int component, const char *prime)
{
  if (vector->names > 1)
    snprintf(name, NAME_BYTES, "%.200s%s", vector->name[component], prime);
  else
    snprintf(name, NAME_BYTES, "%.200s_%c%s", vector->name[0], LETTERS[axis], prime);
}

/* What only files that name others leave to choose from. */
static fg_status check_choice(const fg__vtk *vtk, const fg_read_options *options)
{
  if (options->time != 0 && vtk->times == 0)
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: time %d is asked for, but the file holds one only, number 0",
                    vtk->path, options->time);
  if (options->block && !vtk->has_blocks)
    return fg__fail(vtk->context, FG_STATUS_ARGUMENT,
                    "%s: block \"%.100s\" is asked for, but the file has no blocks",
                    vtk->path, options->block);
  return FG_STATUS_OK;
}

static fg_status create_axes(double *out[3], const fg__vtk *vtk, const fg__vtk_grid *grid)
{
  for (int k = 0; k < grid->dimension; ++k) {
    int axis = grid->axis[k];
    size_t count = grid->points[k];
    out[k] = fg__allocate(count, sizeof(double));
    if (!out[k])
      return fg__fail_memory(vtk->context, "an axis", count * sizeof(double));
    for (size_t i = 0; i < count; ++i)
      out[k][i] = fg__vtk_grid_coordinate(grid, vtk, k, i);
    if (!vtk->uneven && (!(out[k][1] > out[k][0]) || !isfinite(out[k][count - 1])))
      return fg__fail(vtk->context, FG_STATUS_FILE_FORMAT,
                      "%s: points along %c from %g in steps of %g are no axis", vtk->path,
                      LETTERS[axis], out[k][0], vtk->spacing[axis]);
  }
  return FG_STATUS_OK;
}

/* What the file tells of its own axes, where the field has them. */
static void use_words(fg_field_arrays *arrays, const fg__vtk_words *words,
                      const fg__vtk_grid *grid)
{
  for (int k = 0; k < grid->dimension; ++k)
    if (grid->axis[k] != k)
      return;
  for (int k = 0; k < grid->dimension; ++k) {
    if (words->axis_name[k][0])
      arrays->axis_name[k] = words->axis_name[k];
    arrays->axis_units[k] = words->axis_units[k];
  }
  if (arrays->scale == FG_SCALE_AUTO)
    arrays->scale = words->scale;
  if (arrays->scale == FG_SCALE_GEO)
    arrays->period[0] = words->period;
  if (arrays->scale == FG_SCALE_MAP && words->projection[0])
    arrays->projection = words->projection;
}

static fg_status create_field(fg_field **out, const fg__vtk *vtk,
                              const fg__vtk_grid *grid, const fg__vtk_vector *vector,
                              const fg__vtk_words *words, fg_scale scale,
                              float *velocity[3], double *const axis[3],
                              const fg__slab_index *slab)
{
  char component[3][NAME_BYTES], axis_name[3][3] = {"", "", ""};
  const fg__cell_set *cells = &vtk->cells;
  fg_field_arrays arrays = {.dimension = grid->dimension,
                            .scale = scale,
                            .velocity_units = vector->units,
                            .title = vector->names == 1 ? vector->name[0] : NULL,
                            .time = words->time[0] ? words->time : NULL,
                            .level = words->level[0] ? words->level : NULL};
  for (int k = 0; k < grid->dimension; ++k) {
    const int along = cells->tilted && k < 2 ? cells->basis.axis[k] : grid->axis[k];
    const char *prime =
        cells->tilted && !fg__plane_is_axis(&cells->basis, k < 2 ? k : 0) ? "'" : "";
    name_component(component[k], vector, along, vector->components == 3 ? along : k,
                   prime);
    axis_name[k][0] = LETTERS[along];
    axis_name[k][1] = *prime;
    arrays.size[k] = (int)grid->points[k];
    arrays.axis[k] = axis[k];
    arrays.velocity[k] = velocity[k];
    arrays.velocity_name[k] = component[k];
    arrays.axis_name[k] = axis_name[k];
  }
  use_words(&arrays, words, grid);
  if (arrays.scale == FG_SCALE_AUTO)
    arrays.scale = FG_SCALE_PLAIN;
  return fg__field_of_rows(out, vtk->context, &arrays, velocity, slab);
}

/* Adds up squares: of the normal component, and of all. */
static void add_squares(double sum[2], float *const velocity[3], size_t i)
{
  double all = 0.0;
  for (int k = 0; k < 3; ++k)
    all += (double)velocity[k][i] * (double)velocity[k][i];
  sum[0] += isfinite(all) ? (double)velocity[2][i] * (double)velocity[2][i] : 0.0;
  sum[1] += isfinite(all) ? all : 0.0;
}

/* The share of the normal component where all samples are there. */
static double find_normal_share(float *const velocity[3], const fg__vtk_grid *grid)
{
  double sum[2] = {0.0, 0.0};
  for (size_t i = 0; velocity[2] && i < fg__vtk_grid_wanted(grid); ++i)
    add_squares(sum, velocity, i);
  return sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
}

static fg_status build(fg_field **out, const fg__vtk *vtk, fg__vtk_grid *grid,
                       const fg__vtk_vector *vector, const fg_read_options *options,
                       fg__slab_index slab)
{
  const fg__rows rows = fg__rows_of(&slab, (int)grid->points[grid->dimension - 1], false);
  fg_status status =
      fg__check_memory(vtk->context, vtk->path,
                       (double)fg__vtk_grid_points(grid) /
                           (double)grid->points[grid->dimension - 1] * rows.held,
                       grid->dimension * (double)sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  grid->first_row = (size_t)rows.first;
  grid->rows = (size_t)rows.held;
  float *velocity[3] = {NULL, NULL, NULL};
  double *axis[3] = {NULL, NULL, NULL};
  fg__vtk_words words;
  double normal_share = 0.0;
  const bool plane = grid->dimension == 2 && vector->components == 3 && slab.count == 1;
  status = create_axes(axis, vtk, grid);
  if (status == FG_STATUS_OK)
    status = fg__vtk_words_find(&words, vtk);
  if (status == FG_STATUS_OK && (vtk->time[0] || !words.time[0]))
    status = read_time(words.time, vtk);
  if (status == FG_STATUS_OK)
    status = fg__vtk_samples_read(velocity, vtk, grid, vector, options->mask, plane);
  if (status == FG_STATUS_OK && plane)
    normal_share = find_normal_share(velocity, grid);
  if (status == FG_STATUS_OK)
    status = create_field(out, vtk, grid, vector, &words, options->scale, velocity, axis,
                          &slab);
  if (status == FG_STATUS_OK)
    (*out)->normal_share = normal_share;
  for (int k = 0; k < 3; ++k) {
    free(velocity[k]);
    free(axis[k]);
  }
  return status;
}

fg_status fg__vtk_read(fg_field **out, fg_context *context, const fg__source *source,
                       const fg_read_options *options, fg__slab_index slab,
                       fg__vtk_opener *opener)
{
  *out = NULL;
  fg_status status = fg__check_one_file(context, source, options, "VTK files");
  if (status != FG_STATUS_OK)
    return status;
  fg__vtk vtk;
  fg__vtk_grid grid;
  fg__vtk_vector vector;
  char *names = NULL;
  status = opener(&vtk, context, source, options);
  if (status == FG_STATUS_OK)
    status = check_choice(&vtk, options);
  if (status == FG_STATUS_OK) /* first: the grid of cells is not known before */
    status = fg__vtk_read_coordinates(&vtk);
  if (status == FG_STATUS_OK)
    status = fg__vtk_choose(&vector, &names, &vtk, options->vars);
  if (status == FG_STATUS_OK)
    status = fg__vtk_grid_find(&grid, &vtk);
  if (status == FG_STATUS_OK)
    status = build(out, &vtk, &grid, &vector, options, slab);
  free(names);
  return fg__vtk_close(&vtk, status);
}

/* What can only be decoded together is so once, not again for each of its parts. */
static size_t counted_at_once(const fg__vtk *vtk, const fg__vtk_vector *vector)
{
  size_t most = COUNTED_AT_ONCE;
  for (size_t p = 0; p < vtk->piece_count; ++p)
    for (int k = 0; k < vector->names; ++k) {
      const fg__vtk_array *array = fg__vtk_find(vtk, p, vector->place, vector->name[k]);
      size_t tuples, together = 0;
      if (array && fg__vtk_tuples(&tuples, vtk, &vtk->pieces[p], vector->place))
        together = fg__vtk_values_together(fg__vtk_home(vtk, p), array, tuples);
      most = together > most ? together : most;
    }
  return most;
}

/* Counts missing samples, and in a plane what is normal to it. */
static fg_status count_samples(fg_inventory_vector *entry, const fg__vtk *vtk,
                               const fg__vtk_grid *grid, const fg__vtk_vector *vector)
{
  const bool normal = grid->dimension == 2 && vector->components == 3;
  double sum[2] = {0.0, 0.0};
  const size_t all = grid->points[grid->dimension - 1];
  const size_t row = fg__vtk_grid_points(grid) / all;
  const size_t at_once = counted_at_once(vtk, vector);
  const size_t most = row < at_once ? at_once / row : 1;
  size_t missing = 0;
  for (size_t first = 0; first < all; first += most) {
    float *velocity[3];
    fg__vtk_grid some = *grid;
    some.first_row = first;
    some.rows = all - first < most ? all - first : most;
    fg_status status = fg__vtk_samples_read(velocity, vtk, &some, vector, NULL, normal);
    if (status != FG_STATUS_OK)
      return status;
    for (size_t i = 0; i < fg__vtk_grid_wanted(&some); ++i) {
      bool here = true;
      for (int k = 0; k < grid->dimension; ++k)
        here = here && isfinite(velocity[k][i]);
      missing += !here;
      if (normal && velocity[2])
        add_squares(sum, velocity, i);
    }
    for (int k = 0; k < 3; ++k)
      free(velocity[k]);
  }
  entry->missing_share = (double)missing / (double)fg__vtk_grid_points(grid);
  entry->normal_share = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
  return FG_STATUS_OK;
}

/* Of a plane in space that is not that of x and y. */
static void name_axes(const char *out[3], const fg__vtk *vtk, const fg__vtk_grid *grid)
{
  static const char *const names[2][3] = {{"x", "y", "z"}, {"x'", "y'", "z'"}};
  const fg__cell_set *cells = &vtk->cells;
  for (int k = 0; k < 2 && grid->dimension == 2; ++k) {
    const int along = cells->tilted ? cells->basis.axis[k] : grid->axis[k];
    out[k] = names[cells->tilted && !fg__plane_is_axis(&cells->basis, k)][along];
  }
}

/* What is not supported is said of the vector, not held against the file. */
static fg_status describe(fg_inventory_vector *entry, const fg__vtk *vtk,
                          const fg__vtk_vector *vector, bool with_samples)
{
  fg__vtk_grid grid;
  fg__vtk_words words = {.scale = FG_SCALE_AUTO};
  fg_status status = fg__vtk_grid_find(&grid, vtk);
  entry->dimension = grid.dimension;
  name_axes(entry->axis_name, vtk, &grid);
  entry->cells = fg__cell_set_count(&vtk->cells);
  for (int k = 0; k < grid.dimension && status == FG_STATUS_OK; ++k) {
    entry->size[k] = (int)grid.points[k];
    entry->bounds[2 * k] = fg__vtk_grid_coordinate(&grid, vtk, k, 0);
    entry->bounds[2 * k + 1] = fg__vtk_grid_coordinate(&grid, vtk, k, grid.points[k] - 1);
  }
  if (status == FG_STATUS_OK)
    status = fg__vtk_words_find(&words, vtk);
  if (status == FG_STATUS_OK && words.scale != FG_SCALE_AUTO && grid.axis[1] == 1) {
    entry->scale = words.scale;
    entry->periodic[0] = words.period > 0.0;
  }
  if (with_samples && status == FG_STATUS_OK)
    status = count_samples(entry, vtk, &grid, vector);
  return status;
}

/* The times of a collection with their words, which take `words`. */
static fg_status list_times(fg_axis_value **out, char (**words)[FG__TIME_BYTES],
                            const fg__vtk *vtk)
{
  const size_t count = (size_t)(vtk->time_list ? vtk->times : 0);
  fg_status status = FG_STATUS_OK;
  *out = fg__allocate(count, sizeof **out);
  *words = fg__allocate(count, sizeof **words);
  if (!*out || !*words)
    return fg__fail_memory(vtk->context, "times", count * sizeof **out);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i) {
    status = fg__time_write((*words)[i], vtk->context, vtk->time_list[i]);
    (*out)[i] = (fg_axis_value){vtk->time_list[i], "", (*words)[i]};
  }
  return status;
}

fg_status fg__vtk_inventory(fg_inventory *inventory, fg_context *context,
                            const fg__source *source, fg__vtk_opener *opener)
{
  fg__vtk vtk;
  fg__vtk_vector *vectors = NULL;
  fg_axis_value *times = NULL;
  char(*words)[FG__TIME_BYTES] = NULL;
  size_t count = 0;
  fg_status status = opener(&vtk, context, source, NULL);
  if (status == FG_STATUS_OK)
    status = fg__vtk_read_coordinates(&vtk);
  if (status == FG_STATUS_OK)
    status = fg__vtk_vectors(&vectors, &count, &vtk);
  if (status == FG_STATUS_OK)
    status = list_times(&times, &words, &vtk);
  for (size_t i = 0; i < count && status == FG_STATUS_OK; ++i) {
    fg_inventory_vector entry = {.components = vectors[i].components,
                                 .units = vectors[i].units ? vectors[i].units : "",
                                 .found_by = vectors[i].found_by,
                                 .times = vtk.times > 0 ? vtk.times : 1,
                                 .time_value = vtk.time_list ? times : NULL,
                                 .levels = 1,
                                 .scale = FG_SCALE_PLAIN};
    for (int k = 0; k < vectors[i].names; ++k)
      entry.name[k] = vectors[i].name[k];
    char *unusable = NULL;
    status = describe(&entry, &vtk, &vectors[i], i < DESCRIBED_SAMPLES);
    if (status == FG_STATUS_UNSUPPORTED) {
      const char *message = fg_context_message(context);
      size_t prefix = strlen(source->path) + 2; /* "PATH: " is said elsewhere */
      unusable = fg__copy_text(strlen(message) > prefix ? message + prefix : message);
      entry.unusable = unusable;
      fg_context_clear(context);
      status = FG_STATUS_OK;
    }
    if (status == FG_STATUS_OK)
      status = fg__inventory_add(inventory, context, &entry);
    free(unusable);
  }
  free(times);
  free(words);
  free(vectors);
  return fg__vtk_close(&vtk, status);
}

FG__VTK_HOOKS(fg__vtk_open_any)

const fg__format fg__format_vti = {
    .name = "VTK XML",
    .files =
        "VTK XML images, rectilinear, curvilinear and unstructured grids and planes "
        "(.vti, .vtr, .vts, .vtu, .vtp), legacy files of them (.vtk), and files that "
        "name such in parallel, as blocks or over time (.pvti, ..., .vtm, .pvd)",
    .is_mine = fg__is_vtk_xml,
    .inventory = inventory_hook,
    .read = read_hook,
    .tensors = fg__tensors_of_vtk};
