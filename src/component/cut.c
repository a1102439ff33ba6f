#include "component/cutter.h"

#include <string.h>

#include "base/memory.h"

/* More than the shares of a whole cell's corners may lack for having been rounded. */
static const double rounding = 1e-4;

static fg_status cut_plane(fg__cutter *c, fg_context *context, int k, int64_t *covered)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  for (int j = 0; j < s->nodes[1]; ++j) {
    size_t needed = (size_t)c->run_count + (size_t)s->nodes[0];
    if (!fg__grow((void **)&components->run, &components->run_capacity, needed,
                  sizeof *components->run))
      return fg__fail_memory(context, "runs of nodes", needed * sizeof *components->run);
    int number = fg__row_number(s, j, k);
    components->run_of_row[number] = c->run_count;
    *covered += fg__cutter_cut_row(c, j, k);
    components->run_of_row[number + 1] = c->run_count;
    if (j > 0)
      fg__cutter_join_beside(c, j, j - 1, j - 1, k);
  }
  for (int j = 0; j < s->nodes[1] && k > 0; ++j)
    fg__cutter_join_below(c, j, k, k - 1);
  if (s->high[1] == FG__SIDE_WRAP)
    fg__cutter_join_beside(c, s->nodes[1] - 1, 0, s->nodes[1] - 1, k);
  return FG_STATUS_OK;
}

/* Gathers runs into pieces; a root comes before all its other runs. */
static fg_status gather_pieces(fg__cutter *c, fg_context *context)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  struct fg__component_run *run = components->run;
  int rows = s->nodes[1] * s->nodes[2];
  components->piece_count = 0;
  for (int row = 0; row < rows; ++row)
    for (int n = components->run_of_row[row]; n < components->run_of_row[row + 1]; ++n) {
      if (run[n].parent != n) {
        run[n].piece = run[fg__cutter_root(run, n)].piece;
        components->piece[run[n].piece].size += run[n].size;
        continue;
      }
      size_t needed = (size_t)components->piece_count + 1;
      if (!fg__grow((void **)&components->piece, &components->piece_capacity, needed,
                    sizeof *components->piece))
        return fg__fail_memory(context, "pieces of clusters",
                               needed * sizeof *components->piece);
      int64_t first = s->first + run[n].first + row % s->nodes[1] * s->step[1] +
                      row / s->nodes[1] * s->step[2];
      run[n].piece = components->piece_count++;
      components->piece[run[n].piece] = (fg__component_piece){first, run[n].size};
    }
  return FG_STATUS_OK;
}

/* Measures, in 2D, the pieces whose lower bound, the cells that are positive throughout,
 * is not above exact_below. Meanwhile -1 - size stands for the size of such a piece. */
static void measure_small_pieces(fg__cutter *c)
{
  fg__components *components = c->components;
  const fg__shape *s = &c->shape;
  fg__component_piece *piece = components->piece;
  for (int n = 0; n < components->piece_count; ++n)
    if (piece[n].size < c->exact_below)
      piece[n].size = -1;
  for (int k = 0; k < s->nodes[2]; ++k)
    for (int n = components->run_of_row[k]; n < components->run_of_row[k + 1]; ++n) {
      const struct fg__component_run *run = &components->run[n];
      if (piece[run->piece].size >= 0)
        continue;
      const fg__component_stretch nodes = {run->first, run->last};
      fg__share_plane(s, k - 1, nodes, c->space, c->plane[0]);
      fg__share_plane(s, k, nodes, c->space, c->plane[1]);
      fg__cutter_measure(c, 0, k, nodes);
      piece[run->piece].size -= fg__cutter_steps(c, run->first, run->last);
    }
  for (int n = 0; n < components->piece_count; ++n)
    if (piece[n].size < 0)
      piece[n].size = -1 - piece[n].size;
}

static fg_status check_size(fg_context *context, const fg__component_box *box)
{
  bool flat = box->grid_nodes[2] <= 1;
  int64_t planes = flat ? 1 : box->nodes[2];
  int64_t rows = (int64_t)box->nodes[1] * planes;
  if (rows <= INT_MAX && rows * box->nodes[0] <= INT_MAX)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "clusters: %d x %d x %d nodes are too many", box->nodes[0],
                  box->nodes[1], flat ? 1 : box->nodes[2]);
}

/* Working memory for a box; its parts follow each other in a few arrays. */
static fg_status take_memory(fg__cutter *c, fg_context *context,
                             const fg__component_box *box)
{
  fg__components *components = c->components;
  fg_status status = check_size(context, box);
  if (status)
    return status;
  c->shape = fg__shape_of(box);
  size_t width = (size_t)c->shape.nodes[0];
  size_t rows = (size_t)c->shape.nodes[1] * (size_t)c->shape.nodes[2];
  size_t plane = width * (size_t)c->shape.nodes[1];
  if (!fg__grow((void **)&components->run_of_row, &components->run_of_row_capacity,
                rows + 1, sizeof(int)) ||
      !fg__grow((void **)&components->ends, &components->ends_capacity, 3 * width + 2,
                sizeof(int)) ||
      !fg__grow((void **)&components->marks, &components->marks_capacity, width + 24,
                1) ||
      !fg__grow((void **)&components->cells, &components->cells_capacity, width + 2, 1) ||
      !fg__grow((void **)&components->shares, &components->shares_capacity,
                2 * plane + 4 * (width + 2), sizeof(float)))
    return fg__fail_memory(context, "working memory of clusters",
                           (rows + 3 * width + 2 * plane) * sizeof(float));
  memset(components->marks, 0, width + 24);
  c->marks = components->marks + 8;
  c->cells = components->cells + 1;
  c->ends = components->ends;
  c->plane[0] = components->shares;
  c->plane[1] = components->shares + plane;
  c->space = components->shares + 2 * plane;
  if (!box->u) {
    float *ones = c->space + 3 * (width + 2);
    for (size_t n = 0; n < width + 2; ++n)
      ones[n] = 1.0F;
    c->shape.ones = ones + 1;
  }
  if (box->exact_below > 0.0 && box->u && !box->active &&
      c->shape.high[1] == FG__SIDE_FLAT)
    c->exact_below = 1 + (int64_t)(box->exact_below * (1.0 + rounding) * FG__WHOLE_CELL);
  components->run_of_row[0] = 0;
  return FG_STATUS_OK;
}

/* In cells, of a number of 2^-d cells: exact. */
static double cells_of(const fg__shape *s, int64_t parts)
{
  return (double)parts * (s->high[1] == FG__SIDE_FLAT ? 0.25 : 0.125);
}

fg_status fg__components_cut(fg__components *components, fg_context *context,
                             const fg__component_box *box)
{
  fg__cutter c = {.components = components};
  fg_status status = take_memory(&c, context, box);
  int64_t covered = 0;
  const fg__component_stretch all = {0, c.shape.nodes[0] - 1};
  if (!status && !c.exact_below)
    fg__share_plane(&c.shape, -1, all, c.space, c.plane[0]);
  for (int k = 0; !status && k < c.shape.nodes[2]; ++k) {
    if (!c.exact_below)
      fg__share_plane(&c.shape, k, all, c.space, c.plane[1]);
    status = cut_plane(&c, context, k, &covered);
    float *swap = c.plane[0];
    c.plane[0] = c.plane[1];
    c.plane[1] = swap;
  }
  if (status)
    return status;
  if (c.shape.high[2] == FG__SIDE_WRAP)
    for (int j = 0; j < c.shape.nodes[1]; ++j)
      fg__cutter_join_below(&c, j, 0, c.shape.nodes[2] - 1);
  components->covered = cells_of(&c.shape, covered);
  status = gather_pieces(&c, context);
  if (!status && c.exact_below)
    measure_small_pieces(&c);
  return status;
}

fg_status fg__components_cover(fg__components *components, fg_context *context,
                               const fg__component_box *box)
{
  fg__cutter c = {.components = components};
  fg_status status = take_memory(&c, context, box);
  if (status)
    return status;
  const fg__shape *s = &c.shape;
  int64_t covered = 0;
  for (int k = 0; k < s->nodes[2]; ++k)
    for (int j = 0; j < s->nodes[1]; ++j) {
      fg__cutter_mark(&c, j, k);
      int64_t sum = 0;
      if (s->active) {
        for (int x = 0; x < s->nodes[0]; ++x)
          sum += c.marks[x] ? c.cells[x - 1] + c.cells[x] : 0;
        covered += sum;
        continue;
      }
      for (int x = 0; x < s->nodes[0]; ++x)
        sum += c.marks[x];
      sum *= 2;
      sum -= s->low[0] == FG__SIDE_BOUNDARY && c.marks[0];
      sum -= s->high[0] == FG__SIDE_BOUNDARY && c.marks[s->nodes[0] - 1];
      covered += sum * fg__cutter_row_weight(s, j, k);
    }
  components->covered = cells_of(s, covered);
  return FG_STATUS_OK;
}
