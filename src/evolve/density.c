#include "base/context.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

struct fg_density {
  fg_density_arrays arrays;
  float *u;
  unsigned char *active;
};

static size_t cell_count(const fg_density_arrays *arrays)
{
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    count *= (size_t)(arrays->periodic[k] ? arrays->nodes[k] : arrays->nodes[k] - 1);
  return count;
}

static size_t node_count(const fg_density_arrays *arrays)
{
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    count *= (size_t)arrays->nodes[k];
  return count;
}

static fg_status check(fg_context *context, const fg_density_arrays *arrays)
{
  if (arrays->dimension != 2 && arrays->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: dimension %d, not 2 or 3",
                    arrays->dimension);
  if (!arrays->u)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: no values");
  size_t count = 1;
  for (int k = 0; k < arrays->dimension; ++k) {
    if (arrays->nodes[k] < 2)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "density: %d nodes along axis %d, at least 2 are needed",
                      arrays->nodes[k], k);
    if (!(arrays->spacing[k] > 0.0) || !isfinite(arrays->spacing[k]) ||
        !isfinite(arrays->origin[k]))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "density: spacing %g and origin %g along axis %d",
                      arrays->spacing[k], arrays->origin[k], k);
    if ((size_t)arrays->nodes[k] > SIZE_MAX / 16 / count)
      return fg__fail(context, FG_STATUS_ARGUMENT, "density: the grid is too large");
    count *= (size_t)arrays->nodes[k];
  }
  return FG_STATUS_OK;
}

fg_status fg_density_create_from_arrays(fg_density **out, fg_context *context,
                                        const fg_density_arrays *arrays)
{
  if (!out || !arrays)
    return fg__fail(context, FG_STATUS_ARGUMENT, "density: a NULL argument");
  *out = NULL;
  fg_status status = check(context, arrays);
  if (status)
    return status;
  size_t nodes = node_count(arrays);
  size_t cells = cell_count(arrays);
  fg_density *density = fg__allocate(1, sizeof *density);
  if (!density)
    return fg__fail_memory(context, "a density", sizeof *density);
  density->arrays = *arrays;
  for (int k = arrays->dimension; k < 3; ++k) {
    density->arrays.nodes[k] = 1;
    density->arrays.origin[k] = density->arrays.spacing[k] = 0.0;
    density->arrays.periodic[k] = false;
  }
  density->u = fg__allocate(nodes, sizeof *density->u);
  density->active = arrays->active ? fg__allocate(cells, 1) : NULL;
  if (!density->u || (arrays->active && !density->active)) {
    fg_density_destroy(density);
    return fg__fail_memory(context, "a density", nodes * sizeof(float) + cells);
  }
  memcpy(density->u, arrays->u, nodes * sizeof *density->u);
  if (arrays->active)
    memcpy(density->active, arrays->active, cells);
  density->arrays.u = density->u;
  density->arrays.active = density->active;
  *out = density;
  return FG_STATUS_OK;
}

void fg_density_destroy(fg_density *density)
{
  if (!density)
    return;
  free(density->u);
  free(density->active);
  free(density);
}

const fg_density_arrays *fg_density_contents(const fg_density *density)
{
  return &density->arrays;
}
