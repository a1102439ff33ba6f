#include "evolve/components.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

/* Marks the positive nodes of row y that belong to the domain. */
static void mark_row(fg__components *components, const fg__component_grid *grid, int y)
{
  int width = grid->nodes[0];
  const float *u = grid->u + (size_t)y * (size_t)width;
  unsigned char *positive = components->positive + (size_t)y * (size_t)width;
  for (int x = 0; x < width; ++x)
    positive[x] = u[x] > 0.0F;
  if (!grid->active)
    return;
  for (int x = 0; x < width; ++x) {
    if (positive[x] && !node_active(grid, x, y))
      positive[x] = 0;
  }
}

/* Eight marks at once: most stretches of a row lie wholly inside or outside. */
static uint64_t eight(const unsigned char *positive)
{
  uint64_t marks;
  memcpy(&marks, positive, sizeof marks);
  return marks;
}

static const uint64_t all_positive = 0x0101010101010101U;

/* Cuts row y into runs and writes each node's run, counted from 1, to label; 0 outside.
 * The run array has room for as many runs as the row has nodes. */
static void cut_row(fg__components *components, const fg__component_grid *grid, int y)
{
  int width = grid->nodes[0];
  const unsigned char *positive = components->positive + (size_t)y * (size_t)width;
  int *label = components->label + (size_t)y * (size_t)width;
  struct fg__run *run = components->run;
  int last = (int)components->run_count;
  bool inside = false;
  for (int x = 0; x < width;) {
    uint64_t marks = x + 8 <= width ? eight(positive + x) : 2;
    if (marks == 0 || (marks == all_positive && inside && !grid->active)) {
      inside = marks != 0;
      for (int k = 0; k < 8; ++k)
        label[x + k] = inside ? last : 0;
      x += 8;
      continue;
    }
    int end = x + 8 < width ? x + 8 : width;
    for (; x < end; ++x) {
      if (!positive[x]) {
        inside = false;
        label[x] = 0;
        continue;
      }
      if (!inside || !fg__components_edge_active(grid, x - 1, y, 0)) {
        run[last] = (struct fg__run){.parent = last};
        ++last;
      }
      inside = true;
      label[x] = last;
    }
  }
  components->run_count = (size_t)last;
}

/* Area of the corner p > 0 of a cell whose two neighbours q and r are not positive: half
 * the product of the positive shares of its edges. A NaN counts as half the edges. */
static double corner_area(double p, double q, double r)
{
  double area = 0.5 * p * p / ((p - q) * (p - r));
  return area <= 0.5 ? area : 0.125;
}

/* Area below the zero set when it leaves corners p, q > 0 on one side of a cell and r, s,
 * beside p and q, on the other: the mean of the positive shares of two edges. */
static double half_area(double p, double q, double r, double s)
{
  double p_edge = p - r;
  double q_edge = q - s;
  double area = 0.5 * (p * q_edge + q * p_edge) / (p_edge * q_edge);
  return area <= 1.0 ? area : 0.5;
}

/* Joins runs that meet in a cell; most have met before. */
static inline void meet(struct fg__run *run, int a, int b)
{
  if (run[a].parent != run[b].parent)
    join(run, a, b);
}

/* Joins the runs at the corners of an active cell and shares out its positive area.
 * Corners go round the cell: neighbours in the array are neighbours along an edge. */
static inline void add_mixed_cell(struct fg__run *run, const float value[4],
                                  const int corner[4])
{
  /* by the set of positive corners: a positive one after one that is not */
  static const unsigned char first_of[16] = {0, 0, 1, 0, 2, 0, 1, 0,
                                             3, 3, 1, 3, 2, 2, 1, 0};
  unsigned set = 0;
  for (unsigned k = 0; k < 4; ++k)
    set |= (corner[k] != 0 ? 1U : 0U) << k;
  unsigned first = first_of[set];
  const double v[4] = {(double)value[first], (double)value[(first + 1) & 3],
                       (double)value[(first + 2) & 3], (double)value[(first + 3) & 3]};
  int run0 = corner[first] - 1;
  int run1 = corner[(first + 1) & 3] - 1;
  int run2 = corner[(first + 2) & 3] - 1;
  if (run1 >= 0 && run2 >= 0) {
    meet(run, run0, run1);
    meet(run, run1, run2);
    run[run0].area += 1.0 - corner_area(-v[3], -v[0], -v[2]);
  } else if (run1 >= 0) {
    meet(run, run0, run1);
    run[run0].area += half_area(v[0], v[1], v[3], v[2]);
  } else if (run2 < 0) {
    run[run0].area += corner_area(v[0], v[1], v[3]);
  } else if (fg__components_saddle_joins(value[first], value[(first + 1) & 3],
                                         value[(first + 3) & 3],
                                         value[(first + 2) & 3])) {
    meet(run, run0, run2);
    run[run0].area +=
        1.0 - corner_area(-v[1], -v[0], -v[2]) - corner_area(-v[3], -v[2], -v[0]);
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
  const unsigned char *positive0 = components->positive + (size_t)y * width;
  const unsigned char *positive1 = components->positive + above * width;
  int joined0 = 0; /* the pair of runs that the last full cell joined */
  int joined1 = 0;
  for (size_t x = 0; x < cells; ++x) {
    if (x + 9 <= width) {
      uint64_t marks0 = eight(positive0 + x);
      uint64_t marks1 = eight(positive1 + x);
      bool outside = (marks0 | marks1) == 0;
      if (outside || (!active && (marks0 & marks1) == all_positive &&
                      row0[x] == joined0 && row1[x] == joined1)) {
        /* seven cells: the eighth has corners that were not looked at */
        run[joined0 ? joined0 - 1 : 0].area += outside ? 0.0 : 7.0;
        x += 6;
        continue;
      }
    }
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
  if (!fg__grow((void **)&components->positive, &components->positive_capacity, nodes, 1))
    return fg__fail_memory(context, "marks of nodes", nodes);
  components->run_count = 0;
  for (int y = 0; y < grid->nodes[1]; ++y) {
    size_t needed = components->run_count + width;
    if (!fg__grow((void **)&components->run, &components->run_capacity, needed,
                  sizeof *components->run))
      return fg__fail_memory(context, "runs of nodes", needed * sizeof *components->run);
    mark_row(components, grid, y);
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
  free(components->positive);
  free(components->label);
  free(components->area);
  free(components->run);
  *components = (fg__components){0};
}
