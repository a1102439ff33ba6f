#include "evolve/components.h"

#include <limits.h>
#include <stdlib.h>

#include "base/memory.h"

/* A run is a stretch of positive nodes in one row, each joined to the next. Union-find
 * works on runs, of which there are some ten times fewer than nodes. */
struct fg__run {
  int parent; /* the run itself at the root; never a later run */
  int label;
  double area;
};

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

bool fg__components_edge_active(const fg__component_grid *grid, int x, int y, int axis)
{
  if (!grid->active)
    return true;
  return fg__components_cell_active(grid, x, y) ||
         (axis == 0 ? fg__components_cell_active(grid, x, y - 1)
                    : fg__components_cell_active(grid, x - 1, y));
}

static bool node_active(const fg__component_grid *grid, int x, int y)
{
  return fg__components_cell_active(grid, x, y) ||
         fg__components_cell_active(grid, x - 1, y) ||
         fg__components_cell_active(grid, x, y - 1) ||
         fg__components_cell_active(grid, x - 1, y - 1);
}

bool fg__components_saddle_joins(float a, float b, float c, float d)
{
  /* the value at the saddle point is (ad - bc)/(a + d - b - c), its denominator positive
   */
  return (double)a * (double)d > (double)b * (double)c;
}

/* The root of a run's tree. */
static int find(struct fg__run *run, int index)
{
  while (run[index].parent != index) {
    run[index].parent = run[run[index].parent].parent;
    index = run[index].parent;
  }
  return index;
}

/* Joins two trees; the earlier root stays, so that a root is its component's first run.
 */
static void join(struct fg__run *run, int a, int b)
{
  a = find(run, a);
  b = find(run, b);
  if (a < b)
    run[b].parent = a;
  else
    run[a].parent = b;
}

/* Cuts row y into runs and writes each node's run, counted from 1, to label; 0 outside.
 * The run array holds a row more than it needs. */
static void cut_row(fg__components *components, const fg__component_grid *grid, int y)
{
  int width = grid->nodes[0];
  const float *u = grid->u + (size_t)y * (size_t)width;
  int *label = components->label + (size_t)y * (size_t)width;
  struct fg__run *run = components->run;
  int last = (int)components->run_count;
  bool inside = false;
  for (int x = 0; x < width; ++x) {
    if (!(u[x] > 0.0F) || (grid->active && !node_active(grid, x, y))) {
      inside = false;
      label[x] = 0;
      continue;
    }
    if (!inside || (grid->active && !fg__components_edge_active(grid, x - 1, y, 0))) {
      run[last] = (struct fg__run){.parent = last};
      ++last;
    }
    inside = true;
    label[x] = last;
  }
  components->run_count = (size_t)last;
}

/* Share of the edge from a corner p > 0 to a corner q <= 0 that is positive. A NaN in q
 * counts as the middle. */
static double edge_share(float p, float q)
{
  double share = (double)p / ((double)p - (double)q);
  return share <= 1.0 ? share : 0.5;
}

/* Area of the corner p > 0 whose two neighbours q and r are not positive. */
static double corner_area(float p, float q, float r)
{
  return 0.5 * edge_share(p, q) * edge_share(p, r);
}

/* Area of the corner p <= 0 cut off by its two neighbours q, r > 0. */
static double notch_area(float p, float q, float r)
{
  return 0.5 * (1.0 - edge_share(q, p)) * (1.0 - edge_share(r, p));
}

/* Joins the runs at the corners of an active cell and shares out its positive area.
 * Corners go round the cell: neighbours in the array are neighbours along an edge. */
static void add_mixed_cell(struct fg__run *run, const float value[4], const int corner[4])
{
  int positive = 0;
  int first = -1; /* a positive corner after one that is not */
  for (int k = 0; k < 4; ++k) {
    positive += corner[k] != 0;
    if (corner[k] != 0 && corner[(k + 3) & 3] == 0)
      first = k;
  }
  const float v[4] = {value[first], value[(first + 1) & 3], value[(first + 2) & 3],
                      value[(first + 3) & 3]};
  int run0 = corner[first] - 1;
  int run1 = corner[(first + 1) & 3] - 1;
  int run2 = corner[(first + 2) & 3] - 1;
  if (positive == 1) {
    run[run0].area += corner_area(v[0], v[1], v[3]);
  } else if (positive == 3) {
    join(run, run0, run1);
    join(run, run1, run2);
    run[run0].area += 1.0 - notch_area(v[3], v[0], v[2]);
  } else if (run1 >= 0) {
    join(run, run0, run1);
    run[run0].area += 0.5 * (edge_share(v[0], v[3]) + edge_share(v[1], v[2]));
  } else if (fg__components_saddle_joins(v[0], v[1], v[3], v[2])) {
    join(run, run0, run2);
    run[run0].area += 1.0 - notch_area(v[1], v[0], v[2]) - notch_area(v[3], v[2], v[0]);
  } else {
    run[run0].area += corner_area(v[0], v[1], v[3]);
    run[run2].area += corner_area(v[2], v[1], v[3]);
  }
}

/* Joins runs across the cells between row y and the next one. */
static void join_rows(fg__components *components, const fg__component_grid *grid, int y)
{
  size_t width = (size_t)grid->nodes[0];
  size_t cells = (size_t)grid_cells(grid, 0);
  size_t above = y + 1 < grid->nodes[1] ? (size_t)y + 1 : 0;
  const float *u0 = grid->u + (size_t)y * width;
  const float *u1 = grid->u + above * width;
  const int *row0 = components->label + (size_t)y * width;
  const int *row1 = components->label + above * width;
  const unsigned char *active = grid->active ? grid->active + (size_t)y * cells : NULL;
  struct fg__run *run = components->run;
  int joined0 = 0; /* the pair of runs that the last full cell joined */
  int joined1 = 0;
  for (size_t x = 0; x < cells; ++x) {
    size_t next = x + 1 < width ? x + 1 : 0;
    int a = row0[x];
    int b = row0[next];
    int c = row1[x];
    int d = row1[next];
    if (!(a | b | c | d) || (active && !active[x]))
      continue;
    if (!a || !b || !c || !d) {
      add_mixed_cell(run, (const float[4]){u0[x], u0[next], u1[next], u1[x]},
                     (const int[4]){a, b, d, c});
      continue;
    }
    run[a - 1].area += 1.0;
    if (a == b && c == d && a == joined0 && c == joined1)
      continue;
    joined0 = a;
    joined1 = c;
    join(run, a - 1, b - 1);
    join(run, a - 1, c - 1);
    join(run, c - 1, d - 1);
  }
}

/* Gives every component its label and its area; a root comes before all its other runs.
 */
static fg_status number_components(fg__components *components, fg_context *context,
                                   double debris_area)
{
  struct fg__run *run = components->run;
  int runs = (int)components->run_count;
  for (int k = runs - 1; k >= 0; --k) {
    int root = find(run, k);
    if (root != k)
      run[root].area += run[k].area;
  }
  components->count = 0;
  components->debris = 0;
  for (int k = 0; k < runs; ++k) {
    if (run[k].parent != k) {
      run[k].label = run[find(run, k)].label;
      continue;
    }
    if (!(run[k].area >= debris_area)) {
      run[k].label = -1;
      ++components->debris;
      continue;
    }
    size_t needed = (size_t)components->count + 1;
    if (!fg__grow((void **)&components->area, &components->area_capacity, needed,
                  sizeof *components->area))
      return fg__fail_memory(context, "areas of clusters",
                             needed * sizeof *components->area);
    components->area[components->count] = run[k].area;
    run[k].label = ++components->count;
  }
  return FG_STATUS_OK;
}

fg_status fg__components_count(fg__components *components, fg_context *context,
                               const fg__component_grid *grid)
{
  size_t width = (size_t)grid->nodes[0];
  size_t height = (size_t)grid->nodes[1];
  if (width > INT_MAX / height)
    return fg__fail(context, FG_STATUS_ARGUMENT, "clusters: %zu x %zu nodes are too many",
                    width, height);
  size_t nodes = width * height;
  if (!fg__grow((void **)&components->label, &components->label_capacity, nodes,
                sizeof *components->label))
    return fg__fail_memory(context, "labels", nodes * sizeof *components->label);
  components->run_count = 0;
  for (int y = 0; y < grid->nodes[1]; ++y) {
    size_t needed = components->run_count + width;
    if (!fg__grow((void **)&components->run, &components->run_capacity, needed,
                  sizeof *components->run))
      return fg__fail_memory(context, "runs of nodes", needed * sizeof *components->run);
    cut_row(components, grid, y);
    if (y > 0)
      join_rows(components, grid, y - 1);
  }
  if (grid->periodic[1])
    join_rows(components, grid, grid->nodes[1] - 1);
  return number_components(components, context, grid->debris_area);
}

fg_status fg__components_find(fg__components *components, fg_context *context,
                              const fg__component_grid *grid)
{
  fg_status status = fg__components_count(components, context, grid);
  if (status)
    return status;
  size_t nodes = (size_t)grid->nodes[0] * (size_t)grid->nodes[1];
  for (size_t k = 0; k < nodes; ++k) {
    if (components->label[k])
      components->label[k] = components->run[components->label[k] - 1].label;
  }
  return FG_STATUS_OK;
}

void fg__components_clear(fg__components *components)
{
  free(components->label);
  free(components->area);
  free(components->run);
  *components = (fg__components){0};
}
