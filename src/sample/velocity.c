/* Samples of a field or of some of its rows: components, level by level in 3D, and
 * mask. */
#include "sample/velocity.h"
#include "base/memory.h"
#include "sample/missing.h"

#include <math.h>
#include <stdlib.h>

/* Number of samples on one level. */
static size_t plane_size(const fg__grid *grid)
{
  return grid->axis[0].size * grid->axis[1].size;
}

static size_t level_of(const fg__grid *grid, size_t k)
{
  const fg__grid_axis *z = &grid->axis[2];
  return z->first + (z->reversed ? z->size - 1 - k : k);
}

static size_t level_count(const fg__grid *grid)
{
  return grid->dimension == 3 ? grid->axis[2].size : 1;
}

/* Number of samples in one row along the last axis. */
static size_t row_size(const fg__grid *grid)
{
  return grid->dimension == 3 ? plane_size(grid) : grid->axis[0].size;
}

/* The grid restricted to rows [first, first + count). */
static fg__grid rows_of_grid(const fg__grid *grid, int first, int count)
{
  fg__grid out = *grid;
  fg__grid_axis *axis = &out.axis[out.dimension - 1];
  axis->first +=
      axis->reversed ? axis->size - (size_t)first - (size_t)count : (size_t)first;
  axis->size = (size_t)count;
  return out;
}

/* The source of samples. */
typedef struct source {
  const fg__dataset *data;
  const fg__pair *pair;
  const fg__grid *grid;
  const fg__rows *rows;
  size_t time, level;
  const char *mask;       /* NULL: none is named */
  fg__extremes *extremes; /* of parts, to decide by once all are read; NULL: none */
} source;

/* The means of both faces; a missing face beside a present one is a wall (0). Returns the
 * number of centres with neither. */
static size_t average_faces(float *out, const float *face, const fg__grid *grid, int k)
{
  const size_t columns = grid->axis[0].size, row = columns + (k == 0 ? 1 : 0);
  size_t missing = 0;
  for (size_t n = 0; n < plane_size(grid); ++n) {
    const float *a = face + n / columns * row + n % columns;
    const float *b = a + (k == 0 ? 1 : row);
    const double sum = (isnan(*a) ? 0.0 : (double)*a) + (isnan(*b) ? 0.0 : (double)*b);
    const bool none = isnan(*a) && isnan(*b);
    out[n] = none ? NAN : (float)(0.5 * sum);
    missing += none;
  }
  return missing;
}

/* Counts missing centres by the most frequent reason of missing faces. */
static void count_centres(fg__missing_counts *missing, const fg__missing_counts *of_faces,
                          size_t count)
{
  if (of_faces->fill >= of_faces->range && of_faces->fill >= of_faces->not_a_number)
    missing->fill += count;
  else if (of_faces->range >= of_faces->not_a_number)
    missing->range += count;
  else
    missing->not_a_number += count;
}

/* Component k at the centres, in some rows of the grid. */
static fg_status read_faces(float *out, fg__missing_counts *missing, const source *from,
                            int k, const fg__grid *grid)
{
  const fg__staggered *faces = &grid->faces;
  const int *position = faces->position[k];
  fg__grid own = *grid;
  for (int c = 0; c < 2; ++c)
    own.axis[c].position = position[c];
  own.time = position[FG__ROLE_TIME];
  own.level = position[FG__ROLE_LEVEL];
  own.axis[k].first -= faces->before[k];
  ++own.axis[k].size;
  const size_t samples = plane_size(&own);
  float *face = fg__allocate(samples, sizeof *face);
  if (!face)
    return fg__fail_memory(from->data->context, "the velocity", samples * sizeof *face);
  fg__missing_counts of_faces = {0};
  const fg_status status =
      fg__read_values(face, &of_faces, from->data, from->pair->component[k], &own,
                      from->time, from->level);
  if (status == FG_STATUS_OK)
    count_centres(missing, &of_faces, average_faces(out, face, grid, k));
  free(face);
  return status;
}

static fg_status read_values(float *out, fg__missing_counts *missing, const source *from,
                             int k, const fg__grid *grid)
{
  if (grid->faces.used)
    return read_faces(out, missing, from, k, grid);
  fg_status status = FG_STATUS_OK;
  for (size_t z = 0; z < level_count(grid) && status == FG_STATUS_OK; ++z)
    status = fg__read_values(out + z * plane_size(grid), missing, from->data,
                             from->pair->component[k], grid, from->time,
                             grid->dimension == 3 ? level_of(grid, z) : from->level);
  return status;
}

static fg_status read_component(fg__velocity_samples *out, const source *from, int k)
{
  const fg__rows *rows = from->rows;
  const size_t row = row_size(from->grid), samples = row * (size_t)rows->held;
  fg_status status =
      fg__check_memory(from->data->context, from->data->file[0].path, (double)samples,
                       from->grid->dimension * (double)sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  out->velocity[k] = fg__allocate(samples, sizeof *out->velocity[k]);
  if (!out->velocity[k])
    return fg__fail_memory(from->data->context, "the velocity",
                           samples * sizeof *out->velocity[k]);
  const fg__grid own = rows_of_grid(from->grid, rows->first, rows->own);
  status = read_values(out->velocity[k], &out->missing[k], from, k, &own);
  if (status != FG_STATUS_OK || rows->held == rows->own)
    return status;
  fg__missing_counts others = {0}; /* counted with another slab */
  const fg__grid rest =
      rows_of_grid(from->grid, rows->first + rows->own, rows->held - rows->own);
  return read_values(out->velocity[k] + row * (size_t)rows->own, &others, from, k, &rest);
}

/* A centre with one component gets 0 for the other, which has walls on both sides. */
static void close_walls(float *const velocity[2], size_t samples)
{
  for (size_t n = 0; n < samples; ++n)
    for (int k = 0; k < 2; ++k)
      if (isnan(velocity[k][n]) && !isnan(velocity[1 - k][n]))
        velocity[k][n] = 0.0F;
}

/* Of the grid's own mask, which is true where a sample is not to be used, without a
 * name. */
static fg_status read_mask(fg__velocity_samples *out, const source *from,
                           const char *name)
{
  const fg__variable *mask =
      name ? fg__dataset_find(from->data, name) : from->grid->hidden;
  if (!mask)
    return fg__fail(from->data->context, FG_STATUS_ARGUMENT,
                    "%s: has no variable '%s' for the mask", from->data->file[0].path,
                    name);
  const size_t samples = row_size(from->grid) * (size_t)from->rows->held;
  out->valid = fg__allocate(samples, 1);
  if (!out->valid)
    return fg__fail_memory(from->data->context, "the mask", samples);
  const fg__grid grid = rows_of_grid(from->grid, from->rows->first, from->rows->held);
  fg_status status = FG_STATUS_OK;
  for (size_t z = 0; z < level_count(&grid) && status == FG_STATUS_OK; ++z)
    status = fg__read_mask(out->valid + z * plane_size(&grid), from->data, mask, &grid,
                           from->pair->component[0], from->time,
                           grid.dimension == 3 ? level_of(&grid, z) : from->level);
  for (size_t n = 0; n < samples && status == FG_STATUS_OK && !name; ++n)
    out->valid[n] = !out->valid[n];
  return status;
}

enum { AT_ONCE = 1 << 22 }; /* samples in memory while all rows are looked at */

static int rows_at_once(const fg__grid *grid)
{
  const size_t row = row_size(grid);
  return row < AT_ONCE ? (int)(AT_ONCE / row) : 1;
}

/* Components and mask as the file has them. */
static fg_status read_raw(fg__velocity_samples *out, const source *from)
{
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < from->grid->dimension && status == FG_STATUS_OK; ++k)
    status = read_component(out, from, k);
  return status == FG_STATUS_OK && (from->mask || from->grid->hidden)
             ? read_mask(out, from, from->mask)
             : status;
}

static fg__raw_samples raw_of(const fg__velocity_samples *samples, const source *from)
{
  fg__raw_samples raw =
      fg__raw_samples_of(from->data, from->pair, from->grid->dimension, samples->velocity,
                         row_size(from->grid) * (size_t)from->rows->held);
  raw.valid = samples->valid;
  return raw;
}

/* All rows, some at a time. */
static fg_status look_at_all(fg__extremes *out, const source *from)
{
  const fg__grid *grid = from->grid->whole ? from->grid->whole : from->grid;
  const int all = (int)grid->axis[grid->dimension - 1].size;
  const int once = rows_at_once(grid);
  fg_status status = FG_STATUS_OK;
  *out = (fg__extremes){.count = 0};
  for (int first = 0; first < all && status == FG_STATUS_OK; first += once) {
    const int own = all - first < once ? all - first : once;
    const fg__rows rows = {first, own, own};
    source part = *from;
    fg__velocity_samples samples = {0};
    part.grid = grid;
    part.rows = &rows;
    status = read_raw(&samples, &part);
    if (status == FG_STATUS_OK) {
      const fg__raw_samples raw = raw_of(&samples, &part);
      fg__missing_mask(&raw, &from->data->missing);
      fg__extremes_add(out, &raw);
    }
    fg__velocity_samples_clear(&samples);
  }
  return status;
}

/* What some rows may hold all rows decide, so that every part of a field is refused where
 * the whole is. Where a caller looks at all parts it decides. */
static fg_status settle_missing(const fg__velocity_samples *out, const source *from)
{
  const fg__dataset *data = from->data;
  const fg__raw_samples raw = raw_of(out, from);
  fg__extremes own = {.count = 0}, *extremes = from->extremes ? from->extremes : &own;
  fg_status status = FG_STATUS_OK;
  fg__missing_mask(&raw, &data->missing);
  fg__extremes_add(extremes, &raw);
  if (from->extremes || data->missing.none)
    return FG_STATUS_OK;
  if ((from->grid->whole ||
       (size_t)from->rows->own < from->grid->axis[from->grid->dimension - 1].size) &&
      fg__extremes_are_suspect(extremes, raw.components))
    status = look_at_all(extremes, from);
  return status == FG_STATUS_OK
             ? fg__missing_decide(data->context, extremes, &raw, &data->missing)
             : status;
}

/* The vertical component of a section, in the ratio of its axes. */
static void scale_vertical(float *w, const source *from)
{
  const size_t row = row_size(from->grid);
  const double *rate = from->grid->rate + from->rows->first;
  for (size_t n = 0; n < row * (size_t)from->rows->held; ++n)
    w[n] = fg__as_velocity(rate[n / row] * (double)w[n]);
}

static fg_status read_samples(fg__velocity_samples *out, const source *from)
{
  const size_t count = row_size(from->grid) * (size_t)from->rows->held;
  *out = (fg__velocity_samples){0};
  fg_status status = read_raw(out, from);
  if (status == FG_STATUS_OK)
    status = settle_missing(out, from);
  if (status == FG_STATUS_OK)
    status = fg__polar_turn_all(from->data->context, out->velocity, count,
                                &from->pair->polar, from->data->file[0].path,
                                from->pair->component[1]->plain_name);
  if (status == FG_STATUS_OK && from->grid->faces.used)
    close_walls(out->velocity, count);
  if (status == FG_STATUS_OK && from->grid->rate)
    scale_vertical(out->velocity[1], from);
  return status;
}

fg_status fg__velocity_samples_read(fg__velocity_samples *out, const fg__dataset *data,
                                    const fg__pair *pair, const fg__grid *grid,
                                    const fg__rows *rows, size_t time, size_t level,
                                    const char *mask)
{
  const source from = {data, pair, grid, rows, time, level, mask, NULL};
  return read_samples(out, &from);
}

void fg__velocity_samples_clear(fg__velocity_samples *samples)
{
  for (int k = 0; k < 3; ++k)
    free(samples->velocity[k]);
  free(samples->valid);
  *samples = (fg__velocity_samples){0};
}

fg_status fg__velocity_missing(double *share, const fg__dataset *data,
                               const fg__pair *pair, const fg__grid *grid)
{
  const size_t all = grid->axis[grid->dimension - 1].size, row = grid->samples / all;
  const size_t most = (size_t)rows_at_once(grid);
  fg__extremes extremes = {.count = 0};
  const fg_read_options at = fg__first_samples(pair, grid);
  size_t count = 0;
  fg_status status = FG_STATUS_OK;
  for (size_t first = 0; first < all && status == FG_STATUS_OK; first += most) {
    const int own = (int)(all - first < most ? all - first : most);
    const fg__rows rows = {(int)first, own, own};
    fg__velocity_samples read = {0};
    const source from = {data, pair,     grid, &rows, (size_t)at.time, (size_t)at.level,
                         NULL, &extremes};
    status = read_samples(&read, &from);
    const fg__raw_samples raw = raw_of(&read, &from);
    if (status == FG_STATUS_OK && first + most >= all)
      status = fg__missing_decide(data->context, &extremes, &raw, &data->missing);
    for (size_t i = 0; i < row * (size_t)own && status == FG_STATUS_OK; ++i) {
      bool missing = read.valid && !read.valid[i];
      for (int k = 0; k < grid->dimension; ++k)
        missing = missing || !isfinite(read.velocity[k][i]);
      count += missing;
    }
    fg__velocity_samples_clear(&read);
  }
  if (status == FG_STATUS_OK)
    *share = (double)count / (double)grid->samples;
  return status;
}
