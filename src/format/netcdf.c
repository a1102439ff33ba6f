/* NetCDF: classic, 64-bit offset, CDF-5 and NetCDF-4, through NetCDF-C. */
#include "format/netcdf.h"

#include "base/memory.h"

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

/* Lists pairs as "u,v; u10,v10", as many as fit. */
static void list_pairs(const candidates *all, const bool *chosen, char *out, size_t size)
{
  size_t n = 0;
  out[0] = '\0';
  for (size_t i = 0; i < all->count; ++i) {
    if (chosen && !chosen[i])
      continue;
    const int written =
        snprintf(out + n, size - n, "%s%s,%s", n > 0 ? "; " : "",
                 all->pair[i].component[0]->name, all->pair[i].component[1]->name);
    if (written < 0 || (size_t)written >= size - n) {
      out[n] = '\0';
      return;
    }
    n += (size_t)written;
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

static fg_status choose_named(fg__nc_pair *out, const fg__nc_file *file,
                              const candidates *all, const char *vars)
{
  char name[2][FG__NC_NAME] = {"", ""};
  const char *comma = strchr(vars, ',');
  if (!comma || strchr(comma + 1, ',') || comma == vars || !comma[1]) {
    fg_status status =
        fg__fail(file->context, FG_STATUS_ARGUMENT,
                 "%s: '%s' are not the names of two components", file->paths[0], vars);
    fg__hint(file->context, "name two variables: --vars U,V");
    return status;
  }
  snprintf(name[0], sizeof name[0], "%.*s",
           (int)(comma - vars < FG__NC_NAME ? comma - vars : FG__NC_NAME - 1), vars);
  snprintf(name[1], sizeof name[1], "%s", comma + 1);
  *out = (fg__nc_pair){.found_by = "request"};
  for (int k = 0; k < 2; ++k) {
    out->component[k] = find_named(file, name[k], k == 1 ? file->root_count - 1 : 0);
    if (!out->component[k])
      return fail_unknown_name(file, all, name[k]);
  }
  if (out->component[0] == out->component[1])
    return fg__fail(file->context, FG_STATUS_ARGUMENT, "%s: both components are '%s'",
                    file->paths[0], name[0]);
  return FG_STATUS_OK;
}

static fg_status fail_unusable(const fg__nc_file *file, const fg__nc_pair *pair,
                               const fg__nc_grid *grid)
{
  fg_status status =
      fg__fail(file->context, FG_STATUS_UNSUPPORTED, "%s: %s,%s: %s", file->paths[0],
               pair->component[0]->name, pair->component[1]->name, grid->unusable);
  if (grid->hint[0])
    fg__hint(file->context, "%s", grid->hint);
  return status;
}

static fg_status fail_no_vectors(const fg__nc_file *file)
{
  fg_status status = fg__fail(file->context, FG_STATUS_UNSUPPORTED,
                              "%s: no vectors found among its %zu variables",
                              file->paths[0], file->variable_count);
  if (file->root_count == 1)
    fg__hint(file->context, "name the components with --vars U,V; when the other one is "
                            "in a second file, add --vars-from FILE");
  else
    fg__hint(file->context, "name the components with --vars U,V");
  return status;
}

static fg_status fail_ambiguous(const fg__nc_file *file, const candidates *all,
                                const bool *usable, int count)
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
  bool *usable = fg__allocate(all->count, sizeof *usable);
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
    usable[i] = status == FG_STATUS_OK && !found.unusable[0];
    if (i == 0)
      memcpy(&first_unusable, &found, sizeof found);
    if (usable[i] && count++ == 0) {
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

typedef struct samples {
  float *velocity[2];
  unsigned char *valid;
} samples;

static void free_samples(samples *s)
{
  free(s->velocity[0]);
  free(s->velocity[1]);
  free(s->valid);
}

static fg_status read_samples(samples *out, const fg__nc_file *file,
                              const fg__nc_pair *pair, const fg__nc_grid *grid,
                              const fg_read_options *options)
{
  fg_status status = FG_STATUS_OK;
  const size_t time = (size_t)options->time;
  const size_t level = (size_t)options->level;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    fg__nc_missing missing;
    out->velocity[k] = fg__allocate(grid->samples, sizeof *out->velocity[k]);
    if (!out->velocity[k])
      return fg__fail_memory(file->context, "the velocity",
                             grid->samples * sizeof *out->velocity[k]);
    status = fg__nc_values(out->velocity[k], &missing, file, pair->component[k], grid,
                           time, level);
    if (status == FG_STATUS_OK)
      status = check_missing(file, pair->component[k], &missing, grid->samples);
  }
  if (status != FG_STATUS_OK || !options->mask)
    return status;
  const fg__nc_variable *mask = fg__nc_find(file, options->mask);
  if (!mask)
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: has no variable '%s' for the mask", file->paths[0],
                    options->mask);
  out->valid = fg__allocate(grid->samples, 1);
  if (!out->valid)
    return fg__fail_memory(file->context, "the mask", grid->samples);
  return fg__nc_mask(out->valid, file, mask, grid, pair->component[0], time, level);
}

static fg_status make_field(fg_field **out, const fg__nc_file *file,
                            const fg__nc_pair *pair, const fg__nc_grid *grid,
                            const fg_read_options *options)
{
  char title[FG__NC_TEXT];
  char units[FG__NC_TEXT];
  char text[FG__NC_TEXT];
  char time[FG__NC_TEXT] = "";
  char level[FG__NC_TEXT] = "";
  fg_status status = FG_STATUS_OK;
  samples read = {0};
  if (grid->time >= 0)
    status = fg__nc_index_words(file, grid->time_variable, grid->time_name,
                                (size_t)options->time, time, sizeof time);
  if (grid->level >= 0 && status == FG_STATUS_OK)
    status = fg__nc_index_words(file, grid->level_variable, grid->level_name,
                                (size_t)options->level, level, sizeof level);
  if (status == FG_STATUS_OK)
    status = read_samples(&read, file, pair, grid, options);
  if (status == FG_STATUS_OK) {
    fg__nc_title(pair, title, sizeof title);
    if (!fg__nc_text(pair->component[0], "units", text, sizeof text))
      fg__nc_text(pair->component[1], "units", text, sizeof text);
    fg__nc_units(text, units, sizeof units);
    fg_field_arrays arrays = {
        .dimension = 2,
        .size = {(int)grid->axis[0].size, (int)grid->axis[1].size, 1},
        .valid = read.valid,
        .scale = grid->scale,
        .velocity_units = units,
        .title = title,
        .time = time[0] ? time : NULL,
        .level = level[0] ? level : NULL};
    for (int k = 0; k < 2; ++k) {
      arrays.axis[k] = grid->axis[k].coordinate;
      arrays.period[k] = grid->axis[k].period;
      arrays.velocity[k] = read.velocity[k];
      arrays.velocity_name[k] = pair->component[k]->name;
      arrays.axis_name[k] = grid->axis[k].name;
      arrays.axis_units[k] = grid->axis[k].units;
    }
    status = fg_field_create(out, file->context, &arrays);
  }
  free_samples(&read);
  return status;
}

static fg_status read_field(fg_field **out, fg_context *context, const fg__source *source,
                            const fg_read_options *options)
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
    status =
        check_index(&file, "time", options->time, grid.time, grid.times, grid.time_name);
  if (status == FG_STATUS_OK)
    status = check_index(&file, "level", options->level, grid.level, grid.levels,
                         grid.level_name);
  if (status == FG_STATUS_OK)
    status = make_field(out, &file, &pair, &grid, options);
  fg__nc_grid_clear(&grid);
  fg__nc_file_close(&file);
  return status;
}

static fg_status count_missing(fg_inventory_vector *vector, const fg__nc_file *file,
                               const fg__nc_pair *pair, const fg__nc_grid *grid)
{
  samples read = {0};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    fg__nc_missing missing;
    read.velocity[k] = fg__allocate(grid->samples, sizeof *read.velocity[k]);
    if (read.velocity[k])
      status =
          fg__nc_values(read.velocity[k], &missing, file, pair->component[k], grid, 0, 0);
    else
      status = fg__fail_memory(file->context, "the velocity",
                               grid->samples * sizeof *read.velocity[k]);
  }
  size_t count = 0;
  for (size_t i = 0; i < grid->samples && status == FG_STATUS_OK; ++i)
    count += isnan(read.velocity[0][i]) || isnan(read.velocity[1][i]);
  if (status == FG_STATUS_OK)
    vector->missing_share = (double)count / (double)grid->samples;
  free_samples(&read);
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
      .components = 2,
      .name = {pair->component[0]->name, pair->component[1]->name, NULL},
      .units = units,
      .found_by = pair->found_by,
      .dimension = 2,
      .size = {0, 0, 1},
      .times = (int)grid.times,
      .levels = (int)grid.levels,
      .scale = grid.scale,
      .periodic = {grid.axis[0].period > 0.0}};
  for (int k = 0; k < 2; ++k) {
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
  free(all.pair);
  fg__nc_file_close(&file);
  return status;
}

const fg__format fg__format_netcdf = {"NetCDF", is_netcdf, describe, read_field};
