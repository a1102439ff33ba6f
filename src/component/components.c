#include "component/components.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "component/shape.h"

static int grid_cells(const fg__component_grid *grid, int axis)
{
  return grid->periodic[axis] ? grid->nodes[axis] : grid->nodes[axis] - 1;
}

bool fg__components_cell_active(const fg__component_grid *grid, int x, int y)
{
  int cells_x = grid_cells(grid, 0);
  int cells_y = grid_cells(grid, 1);
  if (x < 0 || x >= cells_x) {
    if (!grid->periodic[0])
      return false;
    x = x < 0 ? cells_x - 1 : 0;
  }
  if (y < 0 || y >= cells_y) {
    if (!grid->periodic[1])
      return false;
    y = y < 0 ? cells_y - 1 : 0;
  }
  return !grid->active || grid->active[(size_t)y * (size_t)cells_x + (size_t)x];
}

/* Writes the value of each run's piece to its nodes, 0 to all others. */
static void write_row(const fg__components *components, int row, int width,
                      const int *piece_value, int before, int *out)
{
  const struct fg__component_run *run = components->run;
  memset(out, 0, (size_t)width * sizeof *out);
  for (int n = components->run_of_row[row]; n < components->run_of_row[row + 1]; ++n) {
    int value =
        piece_value ? piece_value[before + run[n].piece] : before + run[n].piece + 1;
    for (int x = run[n].first; x <= run[n].last; ++x)
      out[x] = value;
  }
}

void fg__components_number(const fg__components *components, const fg__component_box *box,
                           int before, bool all, int *number)
{
  fg__shape s = fg__shape_of(box);
  bool flat = s.high[1] == FG__SIDE_FLAT;
  int end = s.nodes[0] - 1;
  for (int k = 0; k < s.nodes[2]; ++k)
    for (int j = 0; j < s.nodes[1]; ++j) {
      int row = fg__row_number(&s, j, k);
      int *out = number + j * s.stride[1] + k * s.stride[2];
      bool outermost =
          k == 0 || k == s.nodes[2] - 1 || (!flat && (j == 0 || j == s.nodes[1] - 1));
      if (all || outermost) {
        write_row(components, row, s.nodes[0], NULL, before, out);
        continue;
      }
      int first = components->run_of_row[row], last = components->run_of_row[row + 1] - 1;
      const struct fg__component_run *run = components->run;
      out[0] = out[end] = 0;
      if (first <= last && run[first].first == 0)
        out[0] = before + run[first].piece + 1;
      if (first <= last && run[last].last == end)
        out[end] = before + run[last].piece + 1;
    }
}

void fg__components_label(const fg__components *components, const fg__component_box *box,
                          const int *piece_label, int before, int *label)
{
  fg__shape s = fg__shape_of(box);
  for (int k = 0; k < s.nodes[2]; ++k)
    for (int j = 0; j < s.nodes[1]; ++j)
      write_row(components, fg__row_number(&s, j, k), s.nodes[0], piece_label, before,
                label + j * s.stride[1] + k * s.stride[2]);
}

fg__component_box fg__component_box_of(const fg__component_grid *grid)
{
  ptrdiff_t width = grid->nodes[0], height = grid->nodes[1];
  fg__component_box out = {.u = grid->u,
                           .row = width,
                           .plane = width * height,
                           .active = grid->active,
                           .cell_row = grid->periodic[0] ? width : width - 1};
  out.cell_plane = out.cell_row * (grid->periodic[1] ? height : height - 1);
  for (int k = 0; k < 3; ++k) {
    out.grid_nodes[k] = out.nodes[k] = grid->nodes[k];
    out.periodic[k] = grid->periodic[k];
  }
  return out;
}

fg_status fg__components_count(fg__components *components, fg_context *context,
                               const fg__component_grid *grid)
{
  fg__component_box box = fg__component_box_of(grid);
  fg_status status = fg__components_cut(components, context, &box);
  if (status)
    return status;
  return fg__components_merge(components, context, components->piece,
                              components->piece_count, NULL, 0, grid->debris_area);
}

fg_status fg__components_find(fg__components *components, fg_context *context,
                              const fg__component_grid *grid)
{
  fg_status status = fg__components_count(components, context, grid);
  if (status)
    return status;
  fg__component_box box = fg__component_box_of(grid);
  size_t nodes = (size_t)grid->nodes[0] * (size_t)grid->nodes[1];
  if (grid->nodes[2] > 1)
    nodes *= (size_t)grid->nodes[2];
  if (!fg__grow((void **)&components->label, &components->label_capacity, nodes,
                sizeof *components->label))
    return fg__fail_memory(context, "labels", nodes * sizeof *components->label);
  fg__components_label(components, &box, components->piece_label, 0, components->label);
  return FG_STATUS_OK;
}

void fg__components_clear(fg__components *components)
{
  void *const memory[] = {
      components->label,      components->area,        components->piece,
      components->pair,       components->piece_label, components->run,
      components->run_of_row, components->ends,        components->root,
      components->group,      components->marks,       components->cells,
      components->shares};
  for (size_t n = 0; n < sizeof memory / sizeof *memory; ++n)
    free(memory[n]);
  *components = (fg__components){0};
}
