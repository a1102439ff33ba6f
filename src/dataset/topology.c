/* Cells between points, as files list them. */
#include <limits.h>
#include <string.h>

#include "base/memory.h"
#include "dataset/dataset.h"

static bool grow(fg__topology *t, size_t corners)
{
  size_t capacity = t->cell_capacity;
  void *type = t->type, *first = t->first, *corner = t->corner;
  bool grown = fg__grow(&type, &capacity, t->cells + 1, sizeof *t->type);
  t->type = type;
  capacity = t->cell_capacity;
  grown = grown && fg__grow(&first, &capacity, t->cells + 1, sizeof *t->first);
  t->first = first;
  if (grown)
    t->cell_capacity = capacity;
  grown = grown &&
          fg__grow(&corner, &t->corner_capacity, t->corners + corners, sizeof *t->corner);
  t->corner = corner;
  return grown;
}

/* Appends points of the cell that is added. */
static fg_status resolve(fg__dataset *data, const double *node, size_t nodes,
                         const fg__piece_points *points)
{
  fg__topology *t = &data->space.cells;
  for (size_t i = 0; i < nodes; ++i) {
    if (!(node[i] >= 0.0 && node[i] < (double)points->count))
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: corner %zu of cell %zu is point %g of %zu", data->file[0].path,
                      i, t->cells, node[i], points->count);
    t->corner[t->corners++] = (int)(points->first + (size_t)node[i]);
  }
  return FG_STATUS_OK;
}

static fg_status resolve_faces(fg__dataset *data, const double *face, size_t numbers,
                               const fg__piece_points *points)
{
  fg__topology *t = &data->space.cells;
  const size_t counted = t->corners++;
  size_t at = 1;
  int faces = 0;
  for (; (double)faces < face[0]; ++faces) {
    const double corners = at < numbers ? face[at++] : -1.0;
    if (!(corners >= 0.0 && corners <= (double)(numbers - at)))
      return fg__fail(data->context, FG_STATUS_FILE_FORMAT,
                      "%s: the faces of cell %zu, a polyhedron, are not within their %zu "
                      "numbers",
                      data->file[0].path, t->cells, numbers);
    t->corner[t->corners++] = (int)corners;
    const fg_status status = resolve(data, face + at, (size_t)corners, points);
    if (status != FG_STATUS_OK)
      return status;
    at += (size_t)corners;
  }
  t->corner[counted] = faces;
  return FG_STATUS_OK;
}

fg_status fg__topology_add(fg__dataset *dataset, int type, const double *node,
                           size_t nodes, const double *face, size_t numbers,
                           const fg__piece_points *points)
{
  fg__topology *t = &dataset->space.cells;
  const bool solid = type == FG__POLYHEDRON;
  const size_t room = nodes + numbers + solid;
  if (room > INT_MAX || t->corners > INT_MAX - room || t->cells == INT_MAX)
    return fg__fail(dataset->context, FG_STATUS_UNSUPPORTED, "%s: more than %d corners",
                    dataset->file[0].path, INT_MAX);
  if (!grow(t, room))
    return fg__fail_memory(dataset->context, "cells", t->corners * sizeof *t->corner);
  t->type[t->cells] = (unsigned char)type;
  t->first[t->cells] = t->corners;
  if (solid)
    t->corner[t->corners++] = (int)nodes;
  fg_status status = resolve(dataset, node, nodes, points);
  if (status == FG_STATUS_OK && solid && numbers > 0)
    status = resolve_faces(dataset, face, numbers, points);
  ++t->cells;
  return status;
}
