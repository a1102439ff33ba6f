/* NetCDF: classic, 64-bit offset, CDF-5 and NetCDF-4, through NetCDF-C. */
#include "read/netcdf/netcdf.h"

#include "base/memory.h"
#include "field/slab.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_netcdf(const unsigned char *bytes, size_t size)
{
  return fg__nc_kind_of(bytes, size) != FG__NC_NONE;
}

static fg_status add_second_file(fg__nc_file *file, fg_context *context, const char *path)
{
  fg__source source;
  fg_status status = fg__source_open(&source, context, path);
  if (status == FG_STATUS_OK && !is_netcdf(source.bytes, source.size))
    status = fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "%s: is no NetCDF file like the first one", path);
  if (status == FG_STATUS_OK)
    status = fg__nc_file_open(file, context, &source);
  fg__source_close(&source);
  return status;
}

typedef struct candidates {
  fg__nc_pair *pair;
  size_t count;
} candidates;

/* Writes "u,v", or "u,v,w" of a volume. */
static int write_names(char *out, size_t size, const fg__nc_pair *pair, bool volume)
{
  return snprintf(out, size, "%s,%s%s%s", pair->component[0]->name,
                  pair->component[1]->name, volume ? "," : "",
                  volume ? pair->component[2]->name : "");
}

/* Lists pairs as "u,v; u10,v10", as many as fit: all, or those whose dimension is not 0.
 */
static void list_pairs(const candidates *all, const int *dimension, char *out,
                       size_t size)
{
  size_t n = 0;
  out[0] = '\0';
  for (size_t i = 0; i < all->count; ++i) {
    if (dimension && dimension[i] == 0)
      continue;
    const char *between = n > 0 ? "; " : "";
    if (n + strlen(between) >= size)
      return;
    strcpy(out + n, between);
    const size_t start = n + strlen(between);
    const int written = write_names(out + start, size - start, &all->pair[i],
                                    dimension && dimension[i] == 3);
    if (written < 0 || (size_t)written >= size - start) {
      out[n] = '\0';
      return;
    }
    n = start + (size_t)written;
  }
}

static const fg__nc_variable *find_named(const fg__nc_file *file, const char *name,
                                         int preferred)
{
  for (size_t i = 0; i < file->variable_count; ++i) {
    const fg__nc_variable *v = &file->variables[i];
    if (v->file == preferred &&
        (strcmp(v->name, name) == 0 || strcmp(v->plain_name, name) == 0))
      return v;
  }
  return fg__nc_find(file, name);
}

static fg_status fail_unknown_name(const fg__nc_file *file, const candidates *all,
                                   const char *name)
{
  char list[1024];
  fg_status status =
      fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: has no variable '%s'",
               file->paths[file->root_count - 1], name);
  list_pairs(all, NULL, list, sizeof list);
  if (list[0])
    fg__hint(file->context, "pairs in it: %s", list);
  return status;
}

static fg_status fail_names(const fg__nc_file *file, const char *vars)
{
  fg__fail(file->context, FG_STATUS_ARGUMENT,
           "%s: '%s' are not the names of two or three components", file->paths[0], vars);
  fg__hint(file->context, "name two variables: --vars U,V; or three: --vars U,V,W");
  return FG_STATUS_ARGUMENT;
}

/* Parts "u,v" or "u,v,w"; returns how many, 0 for anything else. */
static int split_names(char name[3][FG__NC_NAME], const char *vars)
{
  int count = 0;
  while (count < 3) {
    const size_t length = strcspn(vars, ",");
    if (length == 0 || length >= FG__NC_NAME)
      return 0;
    memcpy(name[count], vars, length);
    name[count++][length] = '\0';
    if (!vars[length])
      return count > 1 ? count : 0;
    vars += length + 1;
  }
  return 0;
}

static fg_status choose_named(fg__nc_pair *out, const fg__nc_file *file,
                              const candidates *all, const char *vars)
{
  char name[3][FG__NC_NAME];
  const int count = split_names(name, vars);
  if (count == 0)
    return fail_names(file, vars);
  *out = (fg__nc_pair){.found_by = "request", .volume = count == 3};
  for (int k = 0; k < count; ++k) {
    out->component[k] = find_named(file, name[k], k > 0 ? file->root_count - 1 : 0);
    if (!out->component[k])
      return fail_unknown_name(file, all, name[k]);
  }
  for (int k = 0; k < count; ++k)
    if (out->component[k] == out->component[(k + 1) % count])
      return fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: %s components are '%s'",
                      file->paths[0], count == 2 ? "both" : "two", name[k]);
  return FG_STATUS_OK;
}

static fg_status fail_unusable(const fg__nc_file *file, const fg__nc_pair *pair,
                               const fg__nc_grid *grid)
{
  char names[3 * FG__NC_NAME];
  write_names(names, sizeof names, pair, pair->volume);
  fg_status status = fg__fail(file->context, FG_STATUS_UNSUPPORTED, "%s: %s: %s",
                              file->paths[0], names, grid->unusable);
  if (grid->hint[0])
    fg__hint(file->context, "%s", grid->hint);
  return status;
}

static fg_status fail_no_vectors(const fg__nc_file *file)
{
  fg_status status =
      fg__fail(file->context, FG_STATUS_UNSUPPORTED,
               "%s: no vectors found among its %zu variable%s", file->paths[0],
               file->variable_count, file->variable_count == 1 ? "" : "s");
  if (file->root_count == 1)
    fg__hint(file->context, "name the components with --vars U,V; when the other one is "
                            "in a second file, add --vars-from FILE");
  else
    fg__hint(file->context, "name the components with --vars U,V");
  return status;
}

static fg_status fail_ambiguous(const fg__nc_file *file, const candidates *all,
                                const int *usable, int count)
{
  char list[1024];
  list_pairs(all, usable, list, sizeof list);
  fg_status status =
      fg__fail(file->context, FG_STATUS_ARGUMENT,
               "%s: holds %d vectors, and it is not clear which is meant: %s",
               file->paths[0], count, list);
  fg__hint(file->context, "choose one with --vars U,V");
  return status;
}

/* The only usable pair of the best rank that has one; the grid found on the way is kept.
 */
static fg_status choose_best(fg__nc_pair *out, fg__nc_grid *grid, const fg__nc_file *file,
                             const candidates *all, fg_scale scale)
{
  if (all->count == 0)
    return fail_no_vectors(file);
  int *usable = fg__allocate(all->count, sizeof *usable);
  if (!usable)
    return fg__fail_memory(file->context, "a choice", all->count * sizeof *usable);
  fg_status status = FG_STATUS_OK;
  fg__nc_grid first_unusable = {0};
  int count = 0;
  for (size_t i = 0; i < all->count && status == FG_STATUS_OK; ++i) {
    /* an unusable velocity is said, not silently replaced by another kind of vector */
    if (all->pair[0].is_velocity && !all->pair[i].is_velocity)
      break;
    if (count > 0 && all->pair[i].rank > out->rank)
      break;
    fg__nc_grid found;
    status = fg__nc_grid_find(&found, file, &all->pair[i], scale);
    usable[i] = status == FG_STATUS_OK && !found.unusable[0] ? found.dimension : 0;
    if (i == 0)
      memcpy(&first_unusable, &found, sizeof found);
    if (usable[i] > 0 && count++ == 0) {
      *out = all->pair[i];
      *grid = found;
    } else {
      fg__nc_grid_clear(&found);
    }
  }
  if (status == FG_STATUS_OK && count == 0)
    status = fail_unusable(file, &all->pair[0], &first_unusable);
  else if (status == FG_STATUS_OK && count > 1)
    status = fail_ambiguous(file, all, usable, count);
  free(usable);
  return status;
}

static fg_status choose(fg__nc_pair *pair, fg__nc_grid *grid, const fg__nc_file *file,
                        const fg_read_options *options)
{
  candidates all = {0};
  fg_status status = fg__nc_pairs(&all.pair, &all.count, file);
  if (status == FG_STATUS_OK && options->vars) {
    status = choose_named(pair, file, &all, options->vars);
    if (status == FG_STATUS_OK)
      status = fg__nc_grid_find(grid, file, pair, options->scale);
    if (status == FG_STATUS_OK && grid->unusable[0])
      status = fail_unusable(file, pair, grid);
  } else if (status == FG_STATUS_OK) {
    status = choose_best(pair, grid, file, &all, options->scale);
  }
  free(all.pair);
  return status;
}

/* Components that are named are looked for in both files: where neither they nor the mask
 * are of the second, it is not the file that was meant. */
static fg_status check_second(const fg__nc_file *file, const fg__nc_pair *pair,
                              const char *mask)
{
  const fg__nc_variable *masked = mask ? fg__nc_find(file, mask) : NULL;
  bool used = file->root_count < 2 || (masked && masked->file == 1);
  for (int k = 0; k < 3; ++k)
    used = used || (pair->component[k] && pair->component[k]->file == 1);
  if (used)
    return FG_STATUS_OK;
  fg__fail(file->context, FG_STATUS_ARGUMENT,
           "%s: gives no component: '%.200s' and '%.200s' are both of %s", file->paths[1],
           pair->component[0]->name, pair->component[1]->name, file->paths[0]);
  fg__hint(file->context,
           "name one of its variables with --vars, or leave out --vars-from");
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
  return fg__fail(file->context, FG_STATUS_ARGUMENT,
                  "%s: %s %d asked for, but '%s' has %zu: 0 to %zu", file->paths[0], what,
                  index, name, count, count - 1);
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

/* What is missing of a part is judged with all others. */
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

static fg_status make_field(fg_field **out, const fg__nc_file *file,
                            const fg__nc_pair *pair, const fg__nc_grid *grid,
                            const fg_read_options *options, fg__slab_index slab)
{
  char title[FG__NC_TEXT];
  char units[FG__NC_TEXT];
  char text[FG__NC_TEXT];
  char time[FG__NC_TEXT] = "";
  char level[FG__NC_TEXT] = "";
  fg_status status = FG_STATUS_OK;
  fg__nc_samples read = {0};
  const fg__nc_axis *last = &grid->axis[grid->dimension - 1];
  if (last->period > 0.0)
    slab = (fg__slab_index){0, 1};
  const fg__rows rows = fg__rows_of(&slab, (int)last->size, false);
  if (grid->time >= 0)
    status = fg__nc_index_words(file, grid->time_variable, grid->time_name,
                                (size_t)options->time, time, sizeof time);
  if (grid->level >= 0 && grid->dimension == 2 && status == FG_STATUS_OK)
    status = fg__nc_index_words(file, grid->level_variable, grid->level_name,
                                (size_t)options->level, level, sizeof level);
  if (status == FG_STATUS_OK)
    status = fg__nc_samples_read(&read, file, pair, grid, &rows, (size_t)options->time,
                                 (size_t)options->level, options->mask);
  for (int k = 0; k < grid->dimension && status == FG_STATUS_OK && slab.count == 1; ++k)
    status = check_missing(file, pair->component[k], &read.missing[k], grid->samples);
  if (status == FG_STATUS_OK) {
    fg__nc_title(pair, grid->dimension, title, sizeof title);
    if (!fg__nc_text(pair->component[0], "units", text, sizeof text))
      fg__nc_text(pair->component[1], "units", text, sizeof text);
    fg__nc_units(text, units, sizeof units);
    status = fg__nc_status(file, status);
  }
  if (status == FG_STATUS_OK) {
    fg_field_arrays arrays = {.dimension = grid->dimension,
                              .valid = read.valid,
                              .scale = grid->scale,
                              .velocity_units = units,
                              .title = title,
                              .time = time[0] ? time : NULL,
                              .level = level[0] ? level : NULL};
    for (int k = 0; k < grid->dimension; ++k) {
      arrays.size[k] = (int)grid->axis[k].size;
      arrays.axis[k] = grid->axis[k].coordinate;
      arrays.period[k] = grid->axis[k].period;
      arrays.velocity[k] = read.velocity[k];
      arrays.velocity_name[k] = pair->component[k]->name;
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

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options, fg__slab_index slab)
{
  fg__nc_file file = {0};
  fg__nc_pair pair = {0};
  fg__nc_grid grid = {0};
  fg_status status = fg__nc_file_open(&file, context, source);
  if (status == FG_STATUS_OK && options->vars_from)
    status = add_second_file(&file, context, options->vars_from);
  if (status == FG_STATUS_OK)
    status = choose(&pair, &grid, &file, options);
  if (status == FG_STATUS_OK)
    status = check_second(&file, &pair, options->mask);
  if (status == FG_STATUS_OK)
    status =
        check_index(&file, "time", options->time, grid.time, grid.times, grid.time_name);
  if (status == FG_STATUS_OK)
    status = check_level(&file, &grid, options->level);
  if (status == FG_STATUS_OK)
    status = make_field(out, &file, &pair, &grid, options, slab);
  status = fg__nc_status(&file, status);
  fg__nc_grid_clear(&grid);
  fg__nc_file_close(&file);
  return status;
}

/* Samples that an inventory has in memory at a time. */
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

static fg_status describe_pair(fg_inventory *inventory, const fg__nc_file *file,
                               const fg__nc_pair *pair)
{
  char text[FG__NC_TEXT];
  char units[FG__NC_TEXT];
  fg__nc_grid grid;
  fg_status status = fg__nc_grid_find(&grid, file, pair, FG_SCALE_AUTO);
  if (!fg__nc_text(pair->component[0], "units", text, sizeof text))
    fg__nc_text(pair->component[1], "units", text, sizeof text);
  fg__nc_units(text, units, sizeof units);
  fg_inventory_vector vector = {
      .components = grid.dimension,
      .name = {pair->component[0]->name, pair->component[1]->name,
               grid.dimension == 3 ? pair->component[2]->name : NULL},
      .units = units,
      .found_by = pair->found_by,
      .dimension = grid.dimension,
      .size = {0, 0, 1},
      .times = (int)grid.times,
      .levels = grid.dimension == 3 ? 1 : (int)grid.levels,
      .scale = grid.scale,
      .periodic = {grid.axis[0].period > 0.0}};
  for (int k = 0; k < grid.dimension; ++k) {
    vector.size[k] = (int)grid.axis[k].size;
    if (grid.axis[k].coordinate) {
      vector.bounds[2 * k] = grid.axis[k].coordinate[0];
      vector.bounds[2 * k + 1] = grid.axis[k].coordinate[grid.axis[k].size - 1];
    }
  }
  char reason[sizeof grid.unusable + sizeof grid.hint + 2];
  snprintf(reason, sizeof reason, "%s%s%s", grid.unusable, grid.hint[0] ? "; " : "",
           grid.hint);
  if (grid.unusable[0])
    vector.unusable = reason;
  else if (status == FG_STATUS_OK)
    status = count_missing(&vector, file, pair, &grid);
  if (status == FG_STATUS_OK)
    status = fg__inventory_add(inventory, file->context, &vector);
  fg__nc_grid_clear(&grid);
  return status;
}

static fg_status describe(fg_inventory *inventory, fg_context *context,
                          const fg__source *source)
{
  fg__nc_file file = {0};
  candidates all = {0};
  fg_status status = fg__nc_file_open(&file, context, source);
  if (status == FG_STATUS_OK)
    status = fg__nc_pairs(&all.pair, &all.count, &file);
  for (size_t i = 0; i < all.count && status == FG_STATUS_OK; ++i)
    status = describe_pair(inventory, &file, &all.pair[i]);
  status = fg__nc_status(&file, status);
  free(all.pair);
  fg__nc_file_close(&file);
  return status;
}

const fg__format fg__format_netcdf = {
    .name = "NetCDF",
    .files = "NetCDF (classic, 64-bit offset, CDF-5, NetCDF-4)",
    .is_mine = is_netcdf,
    .inventory = describe,
    .read = read_field};
