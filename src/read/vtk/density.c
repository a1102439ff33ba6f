#include "read/vtk/density.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "decode/vtk/vtk.h"

enum { HIDDEN_CELL = 32 }; /* vtkDataSetAttributes::HIDDENCELL */

/* The variable of that name at points or of cells; NULL: none of one component. */
static const fg__variable *find(const fg__dataset *data, fg__location location,
                                const char *name)
{
  const fg__variable *v = fg__dataset_find(data, name);
  return v && v->location == location && v->rank == 3 && !v->element ? v : NULL;
}

/* Reads all numbers of it. *out is for free(). */
static fg_status read_all(double **out, size_t *count, const fg__dataset *data,
                          fg__location location, const char *name)
{
  const size_t start[3] = {0, 0, 0};
  size_t size[3];
  double probe;
  const fg__variable *v = find(data, location, name);
  if (!v)
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                    "%s: is no density: it has no array \"%s\" of one component",
                    data->file[0].path, name);
  *count = 1;
  for (int k = 0; k < 3; ++k) {
    size[k] = data->dimensions[v->dimension[k]].length;
    *count *= size[k];
  }
  const fg_status status = fg__variable_fetch_one(v, start, &probe);
  if (status != FG_STATUS_OK)
    return status;
  *out = fg__allocate(*count, sizeof **out);
  return *out ? fg__variable_fetch(v, start, size, *out)
              : fg__fail_memory(data->context, "a density", *count * sizeof **out);
}

/* Nodes; along a periodic axis the file shows the first again behind the last. */
static fg_status describe(fg_density_arrays *a, const fg__dataset *data,
                          const fg_field_arrays *field)
{
  const char *path = data->file[0].path;
  a->dimension = field->dimension;
  if (!data->space.on_axes)
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                    "%s: is no density: its grid is uneven", path);
  for (int k = 0; k < 3; ++k) {
    const size_t points = data->space.points[k];
    const bool flat = k >= a->dimension;
    a->periodic[k] = !flat && field->period[k] > 0.0;
    a->nodes[k] = flat ? 1 : (int)points - (a->periodic[k] ? 1 : 0);
    if (flat ? points != 1 : a->nodes[k] < 2)
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: %zu points along axis %d; it is no density of this field",
                      path, points, k);
    const fg__variable *axis = &data->variables[data->space.axis[k]];
    if (!flat && (fg__attribute_numbers(axis, "origin", &a->origin[k], 1) == 0 ||
                  fg__attribute_numbers(axis, "spacing", &a->spacing[k], 1) == 0))
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: is no density: its grid is uneven", path);
  }
  return FG_STATUS_OK;
}

static fg_status take_nodes(fg__density_file *out, const fg__dataset *data,
                            const double *u, const double *cluster, size_t points)
{
  const fg_density_arrays *a = &out->arrays;
  const size_t *shown = data->space.points;
  size_t to = 0;
  double most = 0.0;
  out->u = fg__allocate(points, sizeof *out->u);
  if (!out->u)
    return fg__fail_memory(data->context, "a density", points * sizeof *out->u);
  for (int z = 0; z < a->nodes[2]; ++z)
    for (int y = 0; y < a->nodes[1]; ++y)
      for (int x = 0; x < a->nodes[0]; ++x, ++to) {
        const size_t from = ((size_t)z * shown[1] + (size_t)y) * shown[0] + (size_t)x;
        out->u[to] = (float)u[from];
        most = cluster[from] > most ? cluster[from] : most;
      }
  if (most > INT_MAX)
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT, "%s: has a cluster number %g",
                    data->file[0].path, most);
  out->arrays.clusters = (int)most;
  return FG_STATUS_OK;
}

/* A number of vtkGhostType is a byte of bits. */
static fg_status take_cells(fg__density_file *out, const fg__dataset *data,
                            const double *bits, size_t cells)
{
  out->active = fg__allocate(cells, 1);
  if (!out->active)
    return fg__fail_memory(data->context, "a density", cells);
  for (size_t n = 0; n < cells; ++n) {
    if (!(bits[n] >= 0.0 && bits[n] <= UCHAR_MAX))
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: vtkGhostType of cell %zu of %zu is %g", data->file[0].path, n,
                      cells, bits[n]);
    out->active[n] = ((unsigned)bits[n] & HIDDEN_CELL) == 0;
  }
  return FG_STATUS_OK;
}

static fg_status read_density(fg__density_file *out, const fg__dataset *data,
                              const fg_field_arrays *field)
{
  static const char ghosts[] = "vtkGhostType";
  double *u = NULL, *cluster = NULL, *bits = NULL;
  size_t points = 0, cells = 0;
  fg_density_arrays *a = &out->arrays;
  const fg__variable *file = &data->groups[0];
  fg_status status = describe(a, data, field);
  if (status == FG_STATUS_OK)
    status = read_all(&u, &points, data, FG__AT_POINTS, "u");
  if (status == FG_STATUS_OK)
    status = read_all(&cluster, &points, data, FG__AT_POINTS, "cluster");
  if (status == FG_STATUS_OK)
    status = take_nodes(out, data, u, cluster, points);
  if (status == FG_STATUS_OK && find(data, FG__OF_CELLS, ghosts))
    status = read_all(&bits, &cells, data, FG__OF_CELLS, ghosts);
  if (status == FG_STATUS_OK && bits)
    status = take_cells(out, data, bits, cells);
  fg__attribute_numbers(file, "TimeValue", &a->time, 1);
  fg__attribute_numbers(file, "LeastClusterArea", &a->debris_area, 1);
  if (status == FG_STATUS_OK && !(a->debris_area >= 0.0 && isfinite(a->debris_area)))
    status = fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: the least area of a cluster is %g", data->file[0].path,
                      a->debris_area);
  free(u);
  free(cluster);
  free(bits);
  a->u = out->u;
  a->active = out->active;
  return status;
}

fg_status fg__density_file_read(fg__density_file *out, fg_context *context,
                                const fg__source *source, const fg_field_arrays *field)
{
  fg__dataset data = {0};
  *out = (fg__density_file){0};
  fg_status status = fg__vtk_open(&data, context, source, NULL);
  if (status == FG_STATUS_OK)
    status = read_density(out, &data, field);
  fg__dataset_close(&data);
  return status;
}

void fg__density_file_clear(fg__density_file *file)
{
  free(file->u);
  free(file->active);
  *file = (fg__density_file){0};
}
