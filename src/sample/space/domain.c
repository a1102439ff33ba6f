/* The plane or volume that points in space fill. */
#include <stdlib.h>

#include "base/memory.h"
#include "sample/space/space.h"

/* The axis that points are flat along: one point thick, else two; -1 for a volume, or -2
 * for a line. */
static int flat_axis(const size_t points[3])
{
  int single = 0, flat = -1, thin = -1;
  for (int k = 0; k < 3; ++k)
    if (points[k] == 1) {
      ++single;
      flat = k;
    } else if (points[k] == 2) {
      thin = k;
    }
  if (single > 1)
    return -2;
  return flat < 0 ? thin : flat;
}

/* Takes the dataset's cells in linear parts, and finds their raster. */
static fg_status locate(fg__cell_set *set, fg__dataset *data)
{
  fg__topology *from = &data->space.cells;
  fg_status status = FG_STATUS_OK;
  *set = (fg__cell_set){.context = data->context,
                        .path = data->file[0].path,
                        .points = from->points,
                        .position = from->position,
                        .numbers = from->cells,
                        .region = data->region};
  from->position = NULL;
  const size_t cells = from->corners > 0 ? from->cells : 0;
  for (size_t c = 0; c < cells && status == FG_STATUS_OK; ++c) {
    const size_t end = c + 1 < from->cells ? from->first[c + 1] : from->corners;
    status = fg__cell_set_add_as(set, from->type[c], from->corner + from->first[c],
                                 end - from->first[c], (int)c);
  }
  return status == FG_STATUS_OK ? fg__cell_set_locate(set) : status;
}

static fg_status find_descending(fg__space_domain *domain, const fg__dataset *data)
{
  for (int k = 0; k < domain->dimension; ++k) {
    const fg__variable *v = &data->variables[data->space.axis[domain->axis[k]]];
    const size_t begin = 0, end = domain->size[k] - 1;
    double first, last;
    fg_status status = fg__variable_fetch_one(v, &begin, &first);
    if (status == FG_STATUS_OK)
      status = fg__variable_fetch_one(v, &end, &last);
    if (status != FG_STATUS_OK)
      return status;
    domain->descends[k] = last < first;
  }
  return FG_STATUS_OK;
}

fg_status fg__space_domain_open(fg__dataset *data)
{
  fg__space_domain *domain = fg__allocate(1, sizeof *domain);
  size_t points[3];
  if (!domain)
    return fg__fail_memory(data->context, "a domain", sizeof *domain);
  *domain = (fg__space_domain){.dimension = 0};
  data->space.domain = domain;
  if (!data->space.on_axes) {
    domain->cells = fg__allocate(1, sizeof *domain->cells);
    if (!domain->cells)
      return fg__fail_memory(data->context, "cells", sizeof *domain->cells);
    const fg_status status = locate(domain->cells, data);
    if (status != FG_STATUS_OK)
      return status;
    domain->is_tilted = domain->cells->tilted;
    domain->basis = domain->cells->basis;
  }
  for (int k = 0; k < 3; ++k)
    points[k] = domain->cells ? (size_t)domain->cells->size[k] : data->space.points[k];
  domain->flat = flat_axis(points);
  for (int k = 0; k < 3 && domain->flat > -2; ++k)
    if (k != domain->flat) {
      domain->axis[domain->dimension] = k;
      domain->size[domain->dimension++] = points[k];
    }
  return domain->cells ? FG_STATUS_OK : find_descending(domain, data);
}

void fg__space_domain_close(fg__dataset *data)
{
  fg__space_domain *domain = data->space.domain;
  if (!domain)
    return;
  if (domain->cells)
    fg__cell_set_clear(domain->cells);
  free(domain->cells);
  free(domain);
  data->space.domain = NULL;
}

fg_status fg__space_domain_coordinates(double *out, const fg__dataset *data, int k,
                                       size_t first, size_t count)
{
  const fg__space_domain *domain = data->space.domain;
  const int axis = domain->axis[k];
  if (domain->cells) {
    for (size_t i = 0; i < count; ++i)
      out[i] = domain->cells->origin[axis] +
               domain->cells->spacing[axis] * (double)(first + i);
    return FG_STATUS_OK;
  }
  const size_t stored = domain->descends[k] ? domain->size[k] - first - count : first;
  const fg_status status =
      fg__variable_fetch(&data->variables[data->space.axis[axis]], &stored, &count, out);
  for (size_t i = 0; i < count / 2 && domain->descends[k] && status == FG_STATUS_OK;
       ++i) {
    const double kept = out[i];
    out[i] = out[count - 1 - i];
    out[count - 1 - i] = kept;
  }
  return status;
}

size_t fg__space_domain_row(const fg__space_domain *domain)
{
  return domain->size[0] * (domain->dimension == 3 ? domain->size[1] : 1);
}
