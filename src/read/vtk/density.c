#include "read/vtk/density.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "read/vtk/vtk.h"

enum { HIDDEN_CELL = 32 }; /* vtkDataSetAttributes::HIDDENCELL */

/* What is taken from a file. */
typedef struct reading {
  fg_context *context;
  fg__vtk vtk;
  fg__vtk_values u, cluster, ghost;
  bool masked;
  fg_density_arrays arrays;
} reading;

static fg_status read_array(fg__vtk_values *out, const reading *r, fg__vtk_place place,
                            const char *name)
{
  const fg__vtk_array *array =
      r->vtk.piece_count == 1 ? fg__vtk_find(&r->vtk, 0, place, name) : NULL;
  size_t count;
  if (!array || array->components != 1 || !fg__vtk_count(&count, r->vtk.extent, place))
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                    "%s: is no density: it has no array \"%s\" of one component",
                    r->vtk.path, name);
  return fg__vtk_values_create(out, &r->vtk, array, count);
}

/* Nodes; along a periodic axis the file shows the first again behind the last. */
static fg_status describe(reading *r, const fg_field_arrays *field)
{
  fg_density_arrays *a = &r->arrays;
  const int *extent = r->vtk.extent;
  a->dimension = field->dimension;
  a->nodes[2] = 1;
  for (int k = 0; k < 3; ++k) {
    int points = extent[2 * k + 1] - extent[2 * k] + 1;
    bool flat = k >= a->dimension;
    a->periodic[k] = !flat && field->period[k] > 0.0;
    a->nodes[k] = points - (a->periodic[k] ? 1 : 0);
    a->origin[k] = flat ? 0.0 : r->vtk.origin[k];
    a->spacing[k] = flat ? 0.0 : r->vtk.spacing[k];
    if (flat ? points != 1 : a->nodes[k] < 2)
      return fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                      "%s: %d points along axis %d; it is no density of this field",
                      r->vtk.path, points, k);
  }
  if (r->vtk.uneven || r->vtk.kind != FG__VTK_ALONG_AXES)
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                    "%s: is no density: its grid is uneven", r->vtk.path);
  return FG_STATUS_OK;
}

/* A number about the whole, which older files may lack. */
static fg_status read_number(double *out, const reading *r, const char *name)
{
  const fg__vtk_array *array = fg__vtk_find(&r->vtk, 0, FG__VTK_FIELD, name);
  fg__vtk_values values;
  if (!array)
    return FG_STATUS_OK;
  fg_status status = fg__vtk_values_create(&values, &r->vtk, array, 1);
  if (status)
    return status;
  *out = fg__vtk_value(&values, 0);
  fg__vtk_values_clear(&values);
  return FG_STATUS_OK;
}

static fg_status read_all(reading *r)
{
  fg_status status = read_array(&r->u, r, FG__VTK_POINTS, "u");
  if (!status)
    status = read_array(&r->cluster, r, FG__VTK_POINTS, "cluster");
  r->masked = fg__vtk_find(&r->vtk, 0, FG__VTK_CELLS, "vtkGhostType") != NULL;
  if (!status && r->masked)
    status = read_array(&r->ghost, r, FG__VTK_CELLS, "vtkGhostType");
  if (!status)
    status = read_number(&r->arrays.time, r, "TimeValue");
  if (!status)
    status = read_number(&r->arrays.debris_area, r, "LeastClusterArea");
  if (!status && !(r->arrays.debris_area >= 0.0 && isfinite(r->arrays.debris_area)))
    status = fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                      "%s: the least area of a cluster is %g", r->vtk.path,
                      r->arrays.debris_area);
  return status;
}

static fg_status take_nodes(reading *r, float *u)
{
  const fg_density_arrays *a = &r->arrays;
  size_t columns = (size_t)a->nodes[0] + a->periodic[0];
  size_t rows = (size_t)a->nodes[1] + a->periodic[1], to = 0;
  double most = 0.0;
  for (int z = 0; z < a->nodes[2]; ++z)
    for (int y = 0; y < a->nodes[1]; ++y)
      for (int x = 0; x < a->nodes[0]; ++x, ++to) {
        size_t from = ((size_t)z * rows + (size_t)y) * columns + (size_t)x;
        double cluster = fg__vtk_value(&r->cluster, from);
        u[to] = (float)fg__vtk_value(&r->u, from);
        most = cluster > most ? cluster : most;
      }
  if (most > INT_MAX)
    return fg__fail(r->context, FG_STATUS_FILE_FORMAT, "%s: has a cluster number %g",
                    r->vtk.path, most);
  r->arrays.clusters = (int)most;
  return FG_STATUS_OK;
}

/* A number of vtkGhostType is a byte of bits. */
static fg_status take_cells(reading *r, unsigned char *active, size_t cells)
{
  for (size_t n = 0; n < cells; ++n) {
    double bits = fg__vtk_value(&r->ghost, n);
    if (!(bits >= 0.0 && bits <= UCHAR_MAX))
      return fg__fail(r->context, FG_STATUS_FILE_FORMAT,
                      "%s: vtkGhostType of cell %zu of %zu is %g", r->vtk.path, n, cells,
                      bits);
    active[n] = ((unsigned)bits & HIDDEN_CELL) == 0;
  }
  return FG_STATUS_OK;
}

static fg_status take_all(fg__density_file *out, reading *r)
{
  const fg_density_arrays *a = &r->arrays;
  size_t nodes = 1, cells = 1;
  for (int k = 0; k < a->dimension; ++k) {
    nodes *= (size_t)a->nodes[k];
    cells *= (size_t)(a->nodes[k] - (a->periodic[k] ? 0 : 1));
  }
  out->u = fg__allocate(nodes, sizeof *out->u);
  out->active = r->masked ? fg__allocate(cells, 1) : NULL;
  if (!out->u || (r->masked && !out->active))
    return fg__fail_memory(r->context, "a density", nodes * sizeof *out->u + cells);
  fg_status status = take_nodes(r, out->u);
  if (!status && out->active)
    status = take_cells(r, out->active, cells);
  out->arrays = r->arrays;
  out->arrays.u = out->u;
  out->arrays.active = out->active;
  return status;
}

fg_status fg__density_file_read(fg__density_file *out, fg_context *context,
                                const fg__source *source, const fg_field_arrays *field)
{
  *out = (fg__density_file){0};
  reading r = {.context = context};
  fg_status status = fg__vtk_open_xml(&r.vtk, context, source, NULL);
  if (!status)
    status = describe(&r, field);
  if (!status)
    status = read_all(&r);
  if (!status)
    status = take_all(out, &r);
  fg__vtk_values_clear(&r.u);
  fg__vtk_values_clear(&r.cluster);
  fg__vtk_values_clear(&r.ghost);
  return fg__vtk_close(&r.vtk, status);
}

void fg__density_file_clear(fg__density_file *file)
{
  free(file->u);
  free(file->active);
  *file = (fg__density_file){0};
}
