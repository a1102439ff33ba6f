/* All samples of a field: its components, level by level in 3D, and its mask. */
#include "base/memory.h"
#include "format/netcdf.h"

#include <stdlib.h>

/* Samples of one level, and the level of the file that is the grid's k-th. */
static size_t plane_size(const fg__nc_grid *grid)
{
  return grid->axis[0].size * grid->axis[1].size;
}

static size_t level_of(const fg__nc_grid *grid, size_t k)
{
  const fg__nc_axis *z = &grid->axis[2];
  return z->first + (z->reversed ? z->size - 1 - k : k);
}

static size_t level_count(const fg__nc_grid *grid)
{
  return grid->dimension == 3 ? grid->axis[2].size : 1;
}

static fg_status read_component(fg__nc_samples *out, const fg__nc_file *file,
                                const fg__nc_variable *variable, int k,
                                const fg__nc_grid *grid, size_t time, size_t level)
{
  out->velocity[k] = fg__allocate(grid->samples, sizeof *out->velocity[k]);
  if (!out->velocity[k])
    return fg__fail_memory(file->context, "the velocity",
                           grid->samples * sizeof *out->velocity[k]);
  fg_status status = FG_STATUS_OK;
  for (size_t z = 0; z < level_count(grid) && status == FG_STATUS_OK; ++z)
    status = fg__nc_values(out->velocity[k] + z * plane_size(grid), &out->missing[k],
                           file, variable, grid, time,
                           grid->dimension == 3 ? level_of(grid, z) : level);
  return status;
}

static fg_status read_mask(fg__nc_samples *out, const fg__nc_file *file,
                           const fg__nc_pair *pair, const fg__nc_grid *grid, size_t time,
                           size_t level, const char *name)
{
  const fg__nc_variable *mask = fg__nc_find(file, name);
  if (!mask)
    return fg__fail(file->context, FG_STATUS_ARGUMENT,
                    "%s: has no variable '%s' for the mask", file->paths[0], name);
  out->valid = fg__allocate(grid->samples, 1);
  if (!out->valid)
    return fg__fail_memory(file->context, "the mask", grid->samples);
  fg_status status = FG_STATUS_OK;
  for (size_t z = 0; z < level_count(grid) && status == FG_STATUS_OK; ++z)
    status = fg__nc_mask(out->valid + z * plane_size(grid), file, mask, grid,
                         pair->component[0], time,
                         grid->dimension == 3 ? level_of(grid, z) : level);
  return status;
}

fg_status fg__nc_samples_read(fg__nc_samples *out, const fg__nc_file *file,
                              const fg__nc_pair *pair, const fg__nc_grid *grid,
                              size_t time, size_t level, const char *mask)
{
  *out = (fg__nc_samples){0};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < grid->dimension && status == FG_STATUS_OK; ++k)
    status = read_component(out, file, pair->component[k], k, grid, time, level);
  if (status == FG_STATUS_OK && mask)
    status = read_mask(out, file, pair, grid, time, level, mask);
  return status;
}

void fg__nc_samples_clear(fg__nc_samples *samples)
{
  for (int k = 0; k < 3; ++k)
    free(samples->velocity[k]);
  free(samples->valid);
  *samples = (fg__nc_samples){0};
}
