#include "evolve/parts.h"

#include <stdlib.h>

#include "base/memory.h"

static size_t index_of(const fg__level *level, int i, int j)
{
  return (size_t)j * (size_t)level->columns + (size_t)i;
}

static double mass_at(const fg__level *level, int i, int j)
{
  double weight = (double)level->column_mass[fg__column(level, i)];
  if (!level->periodic[1] && (j == 0 || j == level->rows - 1))
    weight *= 0.5;
  return weight * (double)*fg__node(level, level->mass, i, j);
}

/* Flood fill from a node, over the corners of active cells; `stack` has room for all. */
static void fill(const fg__level *level, int *of_node, int part, int i, int j, int *stack)
{
  size_t top = 0;
  of_node[index_of(level, i, j)] = part;
  stack[top++] = (int)index_of(level, i, j);
  while (top > 0) {
    int node = stack[--top];
    int x = node % level->columns, y = node / level->columns;
    for (int corner = 0; corner < 4; ++corner) {
      int cx = x - corner % 2, cy = y - corner / 2; /* a cell that has the node */
      for (int k = 0; k < 2; ++k) {
        int *c = k == 0 ? &cx : &cy;
        if (level->periodic[k])
          *c = (*c + level->cells[k]) % level->cells[k];
      }
      if (cx < 0 || cy < 0 || cx >= level->cells[0] || cy >= level->cells[1] ||
          !(level->cell_weight[(size_t)cy * (size_t)level->cells[0] + (size_t)cx] > 0.0F))
        continue;
      for (int other = 0; other < 4; ++other) {
        int ox = (cx + other % 2) % level->columns, oy = (cy + other / 2) % level->rows;
        size_t n = index_of(level, ox, oy);
        if (of_node[n] >= 0)
          continue;
        of_node[n] = part;
        stack[top++] = (int)n;
      }
    }
  }
}

static fg_status label(fg__parts *out, fg_context *context, const fg__level *level)
{
  size_t nodes = (size_t)level->columns * (size_t)level->rows;
  int *stack = fg__allocate(nodes, sizeof *stack);
  out->of_node = fg__allocate(nodes, sizeof *out->of_node);
  if (!stack || !out->of_node) {
    free(stack);
    return fg__fail_memory(context, "the parts of the domain", 2 * nodes * sizeof *stack);
  }
  for (size_t n = 0; n < nodes; ++n)
    out->of_node[n] = -1;
  out->count = 0;
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i)
      if (out->of_node[index_of(level, i, j)] < 0 && mass_at(level, i, j) > 0.0)
        fill(level, out->of_node, out->count++, i, j, stack);
  free(stack);
  return FG_STATUS_OK;
}

static void sum_parts(const fg__parts *parts, const fg__level *level, const float *u)
{
  for (int n = 0; n < parts->count; ++n)
    parts->sum[n] = 0.0;
  for (int j = 0; j < level->rows; ++j) {
    const float *row = u + (ptrdiff_t)j * level->stride;
    for (int i = 0; i < level->columns; ++i) {
      int part = parts->of_node[index_of(level, i, j)];
      if (part >= 0)
        parts->sum[part] += mass_at(level, i, j) * (double)row[fg__column(level, i)];
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
  for (int j = 0; j < level->rows; ++j)
    for (int i = 0; i < level->columns; ++i) {
      int part = out->of_node[index_of(level, i, j)];
      if (part >= 0)
        out->mass[part] += mass_at(level, i, j);
    }
  sum_parts(out, level, u);
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
  sum_parts(parts, level, u);
  for (int n = 0; n < parts->count; ++n)
    parts->sum[n] = parts->mean[n] - parts->sum[n] / parts->mass[n];
  for (int j = 0; j < level->rows; ++j) {
    float *row = fg__row(level, u, j);
    for (int i = 0; i < level->columns; ++i) {
      int part = parts->of_node[index_of(level, i, j)];
      if (part >= 0)
        row[fg__column(level, i)] += (float)parts->sum[part];
    }
  }
  fg__fill_ghosts(level, u);
}
