#include "evolve/parts.h"

#include <stdlib.h>

#include "base/memory.h"

static size_t node_count(const fg__level *level)
{
  const int *nodes = level->layout.nodes;
  return (size_t)nodes[0] * (size_t)nodes[1] * (size_t)nodes[2];
}

static double axis_mass(const fg__level *level, int axis, int at)
{
  bool border = axis < level->layout.dimension && !level->periodic[axis] &&
                (at == 0 || at == level->layout.nodes[axis] - 1);
  return border ? 0.5 : 1.0;
}

/* Weight in sums of the nodes of a row but for that of their columns. */
static double row_mass(const fg__level *level, int j, int k)
{
  return axis_mass(level, 1, j) * axis_mass(level, 2, k);
}

/* Flood fill from a node, over the corners of active cells; `stack` has room for all. */
static void fill(const fg__level *level, int *of_node, int part, int start, int *stack)
{
  const int *nodes = level->layout.nodes;
  int corners = 1 << level->layout.dimension;
  size_t top = 0;
  of_node[start] = part;
  stack[top++] = start;
  while (top > 0) {
    int node = stack[--top];
    int at[3] = {node % nodes[0], node / nodes[0] % nodes[1], node / nodes[0] / nodes[1]};
    for (int corner = 0; corner < corners; ++corner) {
      int cell[3]; /* one that has the node */
      for (int k = 0; k < 3; ++k)
        cell[k] = at[k] - (corner >> k & 1);
      /* images beyond the borders hold the same nodes as their true cells */
      if (!(level->tensor.weight[fg__cell_at(&level->tensor, cell[0], cell[1], cell[2])] >
            0.0F))
        continue;
      for (int other = 0; other < corners; ++other) {
        int n = 0;
        for (int k = 2; k >= 0; --k) {
          int place = cell[k] + (other >> k & 1);
          if (level->periodic[k])
            place = (place + nodes[k]) % nodes[k];
          else if (place < 0 || place >= nodes[k])
            place = at[k];
          n = n * nodes[k] + place;
        }
        if (of_node[n] >= 0)
          continue;
        of_node[n] = part;
        stack[top++] = n;
      }
    }
  }
}

static fg_status label(fg__parts *out, fg_context *context, const fg__level *level)
{
  size_t nodes = node_count(level);
  int *stack = fg__allocate(nodes, sizeof *stack);
  out->of_node = fg__allocate(nodes, sizeof *out->of_node);
  if (!stack || !out->of_node) {
    free(stack);
    return fg__fail_memory(context, "the parts of the domain", 2 * nodes * sizeof *stack);
  }
  for (size_t n = 0; n < nodes; ++n)
    out->of_node[n] = -1;
  out->count = 0;
  int n = 0;
  for (int k = 0; k < level->layout.nodes[2]; ++k)
    for (int j = 0; j < level->layout.nodes[1]; ++j)
      for (int i = 0; i < level->layout.nodes[0]; ++i, ++n)
        if (out->of_node[n] < 0 && *fg__node(level, level->mass, i, j, k) > 0.0F)
          fill(level, out->of_node, out->count++, n, stack);
  free(stack);
  return FG_STATUS_OK;
}

/* Adds mass times u (times 1 when u is NULL) of each part to sum. */
static void sum_parts(const fg__parts *parts, const fg__level *level, const float *u,
                      double *sum)
{
  const fg__layout *at = &level->layout;
  for (int n = 0; n < parts->count; ++n)
    sum[n] = 0.0;
  const int *part = parts->of_node;
  for (int k = 0; k < at->nodes[2]; ++k)
    for (int j = 0; j < at->nodes[1]; ++j) {
      double whole = row_mass(level, j, k);
      ptrdiff_t row = fg__row_at(at, j, k);
      for (int i = 0; i < at->nodes[0]; ++i, ++part) {
        ptrdiff_t column = fg__column(at, i);
        double mass = whole * (double)level->column_mass[column] *
                      (double)level->mass[row + column];
        if (*part >= 0)
          sum[*part] += mass * (u ? (double)u[row + column] : 1.0);
      }
    }
}

static fg_status measure(fg__parts *out, fg_context *context, const fg__level *level,
                         const float *u)
{
  size_t count = (size_t)out->count;
  out->mass = fg__allocate(count, sizeof *out->mass);
  out->mean = fg__allocate(count, sizeof *out->mean);
  out->sum = fg__allocate(count, sizeof *out->sum);
  if (!out->mass || !out->mean || !out->sum)
    return fg__fail_memory(context, "the parts of the domain",
                           3 * count * sizeof(double));
  sum_parts(out, level, NULL, out->mass);
  sum_parts(out, level, u, out->sum);
  for (size_t n = 0; n < count; ++n)
    out->mean[n] = out->sum[n] / out->mass[n];
  return FG_STATUS_OK;
}

fg_status fg__parts_create(fg__parts *out, fg_context *context, const fg__level *level,
                           const float *u)
{
  *out = (fg__parts){.count = 1};
  if (!level->mass)
    return FG_STATUS_OK;
  fg_status status = label(out, context, level);
  if (!status && out->count > 1)
    status = measure(out, context, level, u);
  if (status || out->count <= 1) {
    fg__parts_clear(out);
    out->count = 1;
  }
  return status;
}

void fg__parts_clear(fg__parts *parts)
{
  free(parts->of_node);
  free(parts->mass);
  free(parts->mean);
  free(parts->sum);
  *parts = (fg__parts){0};
}

void fg__parts_restore_means(const fg__parts *parts, const fg__level *level, float *u)
{
  if (parts->count <= 1)
    return;
  const fg__layout *at = &level->layout;
  sum_parts(parts, level, u, parts->sum);
  for (int n = 0; n < parts->count; ++n)
    parts->sum[n] = parts->mean[n] - parts->sum[n] / parts->mass[n];
  const int *part = parts->of_node;
  for (int k = 0; k < at->nodes[2]; ++k)
    for (int j = 0; j < at->nodes[1]; ++j) {
      float *row = fg__row(level, u, j, k);
      for (int i = 0; i < at->nodes[0]; ++i, ++part)
        if (*part >= 0)
          row[fg__column(at, i)] += (float)parts->sum[*part];
    }
  fg__fill_ghosts(level, u);
}
