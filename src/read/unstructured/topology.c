/* Nodes and faces of a mesh: positions, and which nodes are the corners of each face. */
#include "base/memory.h"
#include "read/unstructured/unstructured.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES_PER_RADIAN = 57.29577951308232;

/* Numbers read at once. */
static const size_t BLOCK_VALUES = (size_t)1 << 20;

void fg__nc_topology_clear(fg__nc_topology *faces)
{
  for (int k = 0; k < 2; ++k) {
    free(faces->at[k]);
    free(faces->centre[k]);
  }
  free(faces->first);
  free(faces->node);
  *faces = (fg__nc_topology){0};
}

static size_t length_of(const fg__nc_file *file, const fg__nc_variable *v, int k)
{
  return file->dimensions[v->dimension[k]].length;
}

static double factor_of(const fg__nc_unstructured *mesh, const fg__nc_variable *v)
{
  char units[FG__NC_TEXT];
  if (!fg__nc_text(v, "units", units, sizeof units) || !units[0])
    return mesh->in_radians ? DEGREES_PER_RADIAN : 1.0;
  return strncmp(units, "rad", 3) == 0 ? DEGREES_PER_RADIAN : 1.0;
}

fg_status fg__nc_positions_of(double *out[2], const fg__nc_file *file,
                              const fg__nc_unstructured *mesh,
                              const fg__nc_variable *const at[2], size_t count)
{
  for (int k = 0; k < 2; ++k) {
    const size_t numbers =
        length_of(file, at[k], 0) * (at[k]->rank > 1 ? length_of(file, at[k], 1) : 1);
    if (numbers != count)
      return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                      "%s: '%s' has %zu numbers instead of %zu", at[k]->path, at[k]->name,
                      numbers, count);
    out[k] = fg__allocate(count, sizeof *out[k]);
    if (!out[k])
      return fg__fail_memory(file->context, "positions", count * sizeof *out[k]);
    const fg_status status = fg__nc_line(out[k], file, at[k]);
    if (status != FG_STATUS_OK)
      return status;
    const double factor = mesh->in_plane ? 1.0 : factor_of(mesh, at[k]);
    for (size_t n = 0; n < count && factor > 1.0; ++n)
      out[k][n] *= factor;
  }
  return FG_STATUS_OK;
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

static fg_status read_numbers(number_list *out, const fg__nc_file *file,
                              const fg__nc_unstructured *mesh)
{
  const fg__nc_variable *v = mesh->connectivity;
  const int along = mesh->faces_along;
  const size_t rows = length_of(file, v, 0), row = length_of(file, v, 1);
  double fill = (double)NC_FILL_INT, start = 0.0;
  nc_type type;
  fg__nc_numbers(v, "_FillValue", &fill, 1, &type);
  out->start = fg__nc_numbers(v, "start_index", &start, 1, &type) == 1
                   ? (start >= 1.0) - (start < 0.0)
                   : INT_MIN;
  out->faces = length_of(file, v, along);
  out->corners = length_of(file, v, 1 - along);
  if (out->corners < 3 || row >= INT_MAX / 8 / rows)
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' has %zu corners of %zu faces", v->path, v->name,
                    out->corners, out->faces);
  size_t at_once = BLOCK_VALUES / row;
  at_once = at_once < 1 ? 1 : at_once > rows ? rows : at_once;
  double *block = fg__allocate(at_once * row, sizeof *block);
  out->number = fg__allocate(rows * row, sizeof *out->number);
  fg_status status = block && out->number
                         ? FG_STATUS_OK
                         : fg__fail_memory(file->context, "a mesh's faces",
                                           rows * row * sizeof *out->number);
  for (size_t first = 0; first < rows && status == FG_STATUS_OK; first += at_once) {
    const size_t from[2] = {first, 0};
    const size_t count[2] = {rows - first < at_once ? rows - first : at_once, row};
    const int error = fg__nc_fetch(v, from, count, block);
    if (error)
      status = fg__nc_fail(file->context, v->path, v->name, error);
    for (size_t n = 0; n < count[0] * row && status == FG_STATUS_OK; ++n) {
      const size_t i = first + n / row, j = n % row;
      out->number[along == 0 ? i * out->corners + j : j * out->corners + i] =
          number_of(block[n], &fill);
    }
    if (status == FG_STATUS_OK)
      status = fg__check_stop(file->context);
  }
  free(block);
  return status;
}

/* Where nothing says what the first node's number is, the numbers may: one as large as
 * the count of nodes counts from 1, a zero among the first three corners from 0. */
static int start_of(const number_list *list, const fg__nc_unstructured *mesh,
                    size_t nodes)
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

static fg_status fail_node(const fg__nc_file *file, const fg__nc_unstructured *mesh,
                           size_t face, int number, size_t nodes, int start)
{
  return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
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

static fg_status keep_corners(fg__nc_topology *out, const fg__nc_file *file,
                              const fg__nc_unstructured *mesh, number_list *list,
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
        return fail_node(file, mesh, f, number, out->nodes, start);
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

static fg_status read_counts(double **out, const fg__nc_file *file,
                             const fg__nc_unstructured *mesh, size_t faces)
{
  const fg__nc_variable *v = mesh->corner_count;
  if (!v)
    return FG_STATUS_OK;
  if (length_of(file, v, 0) != faces)
    return fg__fail(file->context, FG_STATUS_FILE_FORMAT,
                    "%s: '%s' has %zu numbers for %zu faces", v->path, v->name,
                    length_of(file, v, 0), faces);
  *out = fg__allocate(faces, sizeof **out);
  return *out ? fg__nc_line(*out, file, v)
              : fg__fail_memory(file->context, "counts of corners", faces * sizeof **out);
}

static fg_status read_connectivity(fg__nc_topology *out, const fg__nc_file *file,
                                   const fg__nc_unstructured *mesh)
{
  number_list list = {0};
  double *counts = NULL;
  out->nodes = length_of(file, mesh->node[0], 0);
  fg_status status = fg__nc_positions_of(out->at, file, mesh, mesh->node, out->nodes);
  if (status == FG_STATUS_OK)
    status = read_numbers(&list, file, mesh);
  if (status == FG_STATUS_OK)
    status = read_counts(&counts, file, mesh, list.faces);
  if (status == FG_STATUS_OK) {
    out->first = fg__allocate(list.faces + 1, sizeof *out->first);
    status = out->first ? keep_corners(out, file, mesh, &list, counts)
                        : fg__fail_memory(file->context, "a mesh's faces",
                                          list.faces * sizeof *out->first);
  }
  free(list.number);
  free(counts);
  return status;
}

/* Adds the corners of some cells, whose longitudes and latitudes lie in two blocks. */
static bool add_corners(fg__nc_topology *out, fg__nc_node_table *table,
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
      const int node = fg__nc_node_at(table, block[0][n], block[1][n]);
      if (node < 0)
        return false;
      if (is_new(out->node + begin, kept - begin, node))
        out->node[kept++] = node;
    }
    out->first[f + 1] = kept;
  }
  return true;
}

static fg_status read_bounds(fg__nc_topology *out, const fg__nc_file *file,
                             const fg__nc_unstructured *mesh)
{
  const size_t faces = length_of(file, mesh->bounds[0], 0);
  const size_t corners = length_of(file, mesh->bounds[0], 1);
  if (corners >= INT_MAX / 8 / faces)
    return fg__fail(file->context, FG_STATUS_UNSUPPORTED,
                    "%s: '%s' has %zu corners of %zu cells, more than are handled",
                    mesh->bounds[0]->path, mesh->bounds[0]->name, corners, faces);
  size_t at_once = BLOCK_VALUES / corners;
  at_once = at_once < 1 ? 1 : at_once > faces ? faces : at_once;
  fg__nc_node_table table = {0};
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
      const fg__nc_variable *v = mesh->bounds[k];
      const int error = fg__nc_fetch(v, from, count, block[k]);
      if (error)
        status = fg__nc_fail(file->context, v->path, v->name, error);
      const double factor = factor_of(mesh, mesh->centre[k]);
      for (size_t n = 0; n < count[0] * corners && factor > 1.0; ++n)
        block[k][n] *= factor;
    }
    memory =
        status != FG_STATUS_OK || add_corners(out, &table, block, f, count[0], corners);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(file->context);
  }
  out->count = faces;
  out->nodes = table.nodes;
  for (int k = 0; k < 2; ++k) {
    out->at[k] = table.at[k];
    table.at[k] = NULL;
    free(block[k]);
  }
  fg__nc_node_table_clear(&table);
  return memory ? status : fg__fail_memory(file->context, "corners of cells", 0);
}

fg_status fg__nc_topology_read(fg__nc_topology *out, const fg__nc_file *file,
                               const fg__nc_unstructured *mesh)
{
  *out = (fg__nc_topology){0};
  fg_status status = mesh->sides > 0      ? fg__nc_healpix_faces(out, file, mesh)
                     : mesh->connectivity ? read_connectivity(out, file, mesh)
                                          : read_bounds(out, file, mesh);
  if (status == FG_STATUS_OK && mesh->centre[0] && mesh->centre[1])
    status = fg__nc_positions_of(out->centre, file, mesh, mesh->centre, out->count);
  return status;
}
