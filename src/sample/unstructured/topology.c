/* Nodes and faces of a mesh: positions, and which nodes are the corners of each face. */
#include "base/memory.h"
#include "sample/unstructured/mesh.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers read at once. */
static const size_t BLOCK_VALUES = (size_t)1 << 20;

void fg__mesh_topology_clear(fg__mesh_topology *faces)
{
  for (int k = 0; k < 2; ++k) {
    free(faces->at[k]);
    free(faces->centre[k]);
  }
  free(faces->first);
  free(faces->node);
  *faces = (fg__mesh_topology){0};
}

static size_t length_of(const fg__dataset *data, const fg__variable *v, int k)
{
  return data->dimensions[v->dimension[k]].length;
}

/* A connectivity as it is stored: number [f * corners + c]; INT_MIN: a fill value. */
typedef struct number_list {
  int *number;
  size_t faces, corners;
  int start;
} number_list;

static int number_of(double stored, const double *fill)
{
  const bool whole = stored >= (double)(INT_MIN + 1) && stored <= (double)INT_MAX;
  return whole && !(stored >= *fill && stored <= *fill) ? (int)stored : INT_MIN;
}

static fg_status read_numbers(number_list *out, const fg__dataset *data,
                              const fg__unstructured *mesh)
{
  const fg__variable *v = mesh->connectivity;
  const int along = mesh->faces_along;
  const size_t rows = length_of(data, v, 0), row = length_of(data, v, 1);
  double fill = v->fill, start = 0.0;
  fg__attribute_numbers(v, "_FillValue", &fill, 1);
  out->start = fg__attribute_numbers(v, "start_index", &start, 1) == 1
                   ? (start >= 1.0) - (start < 0.0)
                   : INT_MIN;
  out->faces = length_of(data, v, along);
  out->corners = length_of(data, v, 1 - along);
  if (out->corners < 3 || row >= INT_MAX / 8 / rows)
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' has %zu corners of %zu faces", v->path, v->name,
                    out->corners, out->faces);
  size_t at_once = BLOCK_VALUES / row;
  at_once = at_once < 1 ? 1 : at_once > rows ? rows : at_once;
  double *block = fg__allocate(at_once * row, sizeof *block);
  out->number = fg__allocate(rows * row, sizeof *out->number);
  fg_status status = block && out->number
                         ? FG_STATUS_OK
                         : fg__fail_memory(data->context, "a mesh's faces",
                                           rows * row * sizeof *out->number);
  for (size_t first = 0; first < rows && status == FG_STATUS_OK; first += at_once) {
    const size_t from[2] = {first, 0};
    const size_t count[2] = {rows - first < at_once ? rows - first : at_once, row};
    status = fg__variable_fetch(v, from, count, block);
    for (size_t n = 0; n < count[0] * row && status == FG_STATUS_OK; ++n) {
      const size_t i = first + n / row, j = n % row;
      out->number[along == 0 ? i * out->corners + j : j * out->corners + i] =
          number_of(block[n], &fill);
    }
    if (status == FG_STATUS_OK)
      status = fg__check_stop(data->context);
  }
  free(block);
  return status;
}

/* Where nothing says what the first node's number is, the numbers may: one as large as
 * the count of nodes counts from 1, a zero among the first three corners from 0. */
static int start_of(const number_list *list, const fg__unstructured *mesh, size_t nodes)
{
  if (list->start != INT_MIN)
    return list->start;
  int least = INT_MAX, largest = INT_MIN;
  for (size_t n = 0; n < list->faces * list->corners; ++n) {
    const int number = list->number[n];
    if (number == INT_MIN)
      continue;
    largest = number > largest ? number : largest;
    if (n % list->corners < 3 && number < least)
      least = number;
  }
  if (largest == (int)nodes)
    return 1;
  return least == 0 ? 0 : mesh->start;
}

static fg_status fail_node(const fg__dataset *data, const fg__unstructured *mesh,
                           size_t face, int number, size_t nodes, int start)
{
  return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                  "%s: '%s' has node %d as a corner of face %zu, but the nodes are %d to "
                  "%zu",
                  mesh->connectivity->path, mesh->connectivity->name, number, face, start,
                  nodes - 1 + (size_t)start);
}

/* Corners that follow the third and are no nodes fill up the row. */
static bool ends_row(int number, int start, size_t corner)
{
  return number == INT_MIN || (corner >= 3 && number < start);
}

static bool is_new(const int *corner, int count, int node)
{
  for (int k = 0; k < count; ++k)
    if (corner[k] == node)
      return false;
  return true;
}

static fg_status keep_corners(fg__mesh_topology *out, const fg__dataset *data,
                              const fg__unstructured *mesh, number_list *list,
                              const double *counts)
{
  const int start = start_of(list, mesh, out->nodes);
  int kept = 0;
  for (size_t f = 0; f < list->faces; ++f) {
    const int begin = kept;
    const double most =
        counts ? fmin(counts[f], (double)list->corners) : (double)list->corners;
    out->first[f] = kept;
    for (size_t c = 0; (double)c < most; ++c) {
      const int number = list->number[f * list->corners + c];
      if (ends_row(number, start, c))
        continue;
      if (number < start || (size_t)(number - start) >= out->nodes)
        return fail_node(data, mesh, f, number, out->nodes, start);
      /* the list is read ahead of what is kept of it */
      if (is_new(list->number + begin, kept - begin, number - start))
        list->number[kept++] = number - start;
    }
  }
  out->first[list->faces] = kept;
  out->count = list->faces;
  out->node = list->number;
  list->number = NULL;
  return FG_STATUS_OK;
}

static fg_status read_counts(double **out, const fg__dataset *data,
                             const fg__unstructured *mesh, size_t faces)
{
  const fg__variable *v = mesh->corner_count;
  if (!v)
    return FG_STATUS_OK;
  if (length_of(data, v, 0) != faces)
    return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' has %zu numbers for %zu faces", v->path, v->name,
                    length_of(data, v, 0), faces);
  *out = fg__allocate(faces, sizeof **out);
  return *out ? fg__read_all(*out, data, v)
              : fg__fail_memory(data->context, "counts of corners", faces * sizeof **out);
}

static fg_status read_connectivity(fg__mesh_topology *out, const fg__dataset *data,
                                   const fg__unstructured *mesh)
{
  number_list list = {0};
  double *counts = NULL;
  out->nodes = length_of(data, mesh->node[0], 0);
  fg_status status = fg__positions_of(out->at, data, mesh, mesh->node, out->nodes, 2);
  if (status == FG_STATUS_OK)
    status = read_numbers(&list, data, mesh);
  if (status == FG_STATUS_OK)
    status = read_counts(&counts, data, mesh, list.faces);
  if (status == FG_STATUS_OK) {
    out->first = fg__allocate(list.faces + 1, sizeof *out->first);
    status = out->first ? keep_corners(out, data, mesh, &list, counts)
                        : fg__fail_memory(data->context, "a mesh's faces",
                                          list.faces * sizeof *out->first);
  }
  free(list.number);
  free(counts);
  return status;
}

/* Adds the corners of some cells, whose longitudes and latitudes lie in two blocks. */
static bool add_corners(fg__mesh_topology *out, fg__node_table *table,
                        double *const block[2], size_t first, size_t count,
                        size_t corners)
{
  for (size_t f = first; f < first + count; ++f) {
    const int begin = f > 0 ? out->first[f] : 0;
    int kept = begin;
    for (size_t c = 0; c < corners; ++c) {
      const size_t n = (f - first) * corners + c;
      if (!isfinite(block[0][n]) || !(fabs(block[1][n]) <= 90.0 + 1e-6))
        continue;
      const int node = fg__node_table_at(table, block[0][n], block[1][n]);
      if (node < 0)
        return false;
      if (is_new(out->node + begin, kept - begin, node))
        out->node[kept++] = node;
    }
    out->first[f + 1] = kept;
  }
  return true;
}

static fg_status read_bounds(fg__mesh_topology *out, const fg__dataset *data,
                             const fg__unstructured *mesh)
{
  const size_t faces = length_of(data, mesh->bounds[0], 0);
  const size_t corners = length_of(data, mesh->bounds[0], 1);
  if (corners >= INT_MAX / 8 / faces)
    return fg__fail(data->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%s' has %zu corners of %zu cells, more than are handled",
                    mesh->bounds[0]->path, mesh->bounds[0]->name, corners, faces);
  size_t at_once = BLOCK_VALUES / corners;
  at_once = at_once < 1 ? 1 : at_once > faces ? faces : at_once;
  fg__node_table table = {0};
  double *block[2] = {fg__allocate(at_once * corners, sizeof **block),
                      fg__allocate(at_once * corners, sizeof **block)};
  out->first = fg__allocate(faces + 1, sizeof *out->first);
  out->node = fg__allocate(faces * corners, sizeof *out->node);
  bool memory = block[0] && block[1] && out->first && out->node;
  fg_status status = FG_STATUS_OK;
  for (size_t f = 0; f < faces && memory && status == FG_STATUS_OK; f += at_once) {
    const size_t from[2] = {f, 0};
    const size_t count[2] = {faces - f < at_once ? faces - f : at_once, corners};
    for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
      const fg__variable *v = mesh->bounds[k];
      status = fg__variable_fetch(v, from, count, block[k]);
      const double factor = fg__degrees_in(mesh, mesh->centre[k]);
      for (size_t n = 0; n < count[0] * corners && factor != 1.0; ++n)
        block[k][n] *= factor;
    }
    memory =
        status != FG_STATUS_OK || add_corners(out, &table, block, f, count[0], corners);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(data->context);
  }
  out->count = faces;
  out->nodes = table.nodes;
  for (int k = 0; k < 2; ++k) {
    out->at[k] = table.at[k];
    table.at[k] = NULL;
    free(block[k]);
  }
  fg__node_table_clear(&table);
  return memory ? status : fg__fail_memory(data->context, "corners of cells", 0);
}

fg_status fg__mesh_topology_read(fg__mesh_topology *out, const fg__dataset *data,
                                 const fg__unstructured *mesh)
{
  *out = (fg__mesh_topology){0};
  fg_status status = mesh->sides > 0      ? fg__healpix_faces(out, data, mesh)
                     : mesh->connectivity ? read_connectivity(out, data, mesh)
                                          : read_bounds(out, data, mesh);
  if (status == FG_STATUS_OK && mesh->centre[0] && mesh->centre[1])
    status = fg__positions_of(out->centre, data, mesh, mesh->centre, out->count, 2);
  return status;
}
