#include "solver/stencil.h"

#include <string.h>

/* What the cells round an edge give its two nodes (cells/elements.h). */
typedef struct coupling {
  int cell[3];   /* of the node with the lesser index */
  int corner[2]; /* which the two nodes are of the cell */
  double weight[FG__TENSOR_COMPONENTS];
} coupling;

enum { MOST_CELLS = 4 }; /* that share an edge */

/* The cells that hold both a node and its neighbour at `offset`, and what each gives. */
static int couplings_to(const int offset[3], int dimension, const double spacing[3],
                        coupling out[MOST_CELLS])
{
  int count = 0;
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    coupling c = {.cell = {0, 0, 0}, .corner = {corner, corner}};
    bool holds = true;
    for (int k = 0; k < 3 && k < dimension; ++k) {
      int place = corner >> k & 1, other = place + offset[k];
      holds = holds && (other == 0 || other == 1);
      c.cell[k] = -place;
      c.corner[1] ^= offset[k] != 0 ? 1 << k : 0;
    }
    if (!holds)
      continue;
    fg__cell_coupling(corner, c.corner[1], dimension, spacing, c.weight);
    out[count++] = c;
  }
  return count;
}

/* Offset of the neighbour that entry n of a stencil couples to. */
static void offset_of(int n, int offset[3])
{
  offset[0] = n == 0 ? 1 : (n - 1) % 3 - 1;
  offset[1] = offset[2] = 0;
  if (n > 0)
    fg__upper_row((n - 1) / 3, &offset[1], &offset[2]);
}

/* Stencils to be computed, slice by slice. */
typedef struct assembly {
  const fg__level *level;
  const fg__stencil *out;
  double gamma;
  bool laplacian;
} assembly;

/* Couplings of nodes low ... high of a row from the cells round them, which their cells
 * each add in order. */
static void couple_row(const assembly *a, const coupling *c, int cells, int low, int high,
                       int j, int k, double *out)
{
  const fg__cells_of_box *tensor = &a->level->tensor;
  const fg__elements *elements = &a->level->elements;
  int dimension = a->level->layout.dimension;
  int count = high - low + 1, components = dimension == 3 ? 6 : 3;
  for (int i = 0; i < count; ++i)
    out[i] = 0.0;
  for (int n = 0; n < cells; ++n) {
    const double *weight = c[n].weight;
    int x = low + c[n].cell[0], y = j + c[n].cell[1], z = k + c[n].cell[2];
    if (elements->memory) {
      int entry =
          fg__element_coupling(dimension, a->laplacian, c[n].corner[0], c[n].corner[1]);
      const float *of = elements->value[entry] + fg__element_at(elements, x, y, z);
      for (int i = 0; i < count; ++i)
        out[i] += (double)of[i];
      continue;
    }
    ptrdiff_t at = fg__cell_at(tensor, x, y, z);
    if (a->laplacian) {
      double diagonal = weight[0] + weight[2] + weight[3];
      for (int i = 0; i < count; ++i)
        out[i] += (double)tensor->weight[at + i] * diagonal;
      continue;
    }
    const float *of[FG__TENSOR_COMPONENTS] = {NULL};
    for (int m = 0; m < components; ++m)
      of[m] = tensor->component[m] + at;
    for (int i = 0; i < count; ++i) {
      double entry = a->gamma * (double)of[0][i] * weight[0];
      for (int m = 1; m < components; ++m)
        entry += a->gamma * (double)of[m][i] * weight[m];
      out[i] += entry;
    }
  }
}

/* A thread's slices of those from low to high along the outermost axis. */
static void part_of(const fg__thread *thread, int axis, int low[3], int high[3])
{
  int begin, end;
  fg__threads_range(thread, high[axis] - low[axis] + 1, 1, &begin, &end);
  high[axis] = low[axis] + end - 1;
  low[axis] += begin;
}

/* Couplings from the cells, also of the ghosts before and after the box along axes where
 * a true node reads them. */
static void assemble_coupling(const assembly *a, int n, const fg__thread *thread)
{
  const fg__level *level = a->level;
  const fg__layout *at = &level->layout;
  int offset[3];
  offset_of(n, offset);
  coupling c[MOST_CELLS];
  int cells = couplings_to(offset, at->dimension, level->spacing, c);
  /* nodes whose neighbour at `offset` or who themselves are true */
  int low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = offset[k] > 0 ? -1 : 0;
    high[k] = at->nodes[k] - 1 + (offset[k] < 0);
  }
  part_of(thread, at->dimension - 1, low, high);
  void *scratch = level->scratch + (size_t)thread->index * level->scratch_size;
  double *row = scratch;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      couple_row(a, c, cells, low[0], high[0], j, k, row);
      float *to = a->out->to[n] + fg__row_at(at, j, k);
      for (int i = low[0]; i <= high[0]; ++i)
        to[fg__column(at, i)] = (float)row[i - low[0]];
    }
  memset(row, 0, (size_t)(high[0] - low[0] + 1) * sizeof *row);
}

/* Rows sum to zero. */
static void assemble_diagonals(const assembly *a, const fg__thread *thread)
{
  const fg__layout *at = &a->level->layout;
  int low[3] = {0, 0, 0};
  int high[3] = {at->nodes[0] - 1, at->nodes[1] - 1, at->nodes[2] - 1};
  part_of(thread, at->dimension - 1, low, high);
  int couplings = fg__coupling_count(a->level->layout.dimension);
  ptrdiff_t back[FG__MOST_COUPLINGS]
                [2]; /* to the other node, from even and odd columns */
  for (int n = 0; n < couplings; ++n)
    for (int odd = 0; odd < 2; ++odd) {
      int d[3];
      offset_of(n, d);
      back[n][odd] =
          fg__node_at(at, odd - d[0], -d[1], -d[2]) - fg__node_at(at, odd, 0, 0);
    }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = 0; i <= high[0]; ++i) {
        float sum = 0.0F;
        ptrdiff_t here = fg__node_at(at, i, j, k);
        for (int n = 0; n < couplings; ++n)
          sum += a->out->to[n][here] + a->out->to[n][here + back[n][i & 1]];
        a->out->center[here] = -sum;
      }
}

static void assemble_part(void *argument, const fg__thread *thread)
{
  const assembly *a = argument;
  for (int n = 0; n < fg__coupling_count(a->level->layout.dimension); ++n)
    assemble_coupling(a, n, thread);
  fg__threads_barrier(thread); /* diagonals read couplings of the slices before */
  assemble_diagonals(a, thread);
}

void fg__stencil_assemble(const fg__level *level, const fg__stencil *out, double gamma,
                          bool laplacian, fg__threads *threads)
{
  assembly a = {level, out, gamma, laplacian};
  fg__threads_run(threads, assemble_part, &a);
}

void fg__stencil_set_constants(fg__level *level)
{
  int dimension = level->layout.dimension;
  float sum = 0.0F;
  for (int n = 0; n < fg__coupling_count(level->layout.dimension); ++n) {
    int offset[3];
    offset_of(n, offset);
    coupling c[MOST_CELLS];
    double entry = 0.0;
    int cells = couplings_to(offset, dimension, level->spacing, c);
    for (int m = 0; m < cells; ++m)
      entry += c[m].weight[0] + c[m].weight[2] + c[m].weight[3];
    float value = (float)entry;
    sum += 2.0F * value;
    if (n == 0)
      level->laplacian_east = value;
    else if ((n - 1) % 3 == 1)
      level->laplacian_middle[(n - 1) / 3] = value;
    else
      level->laplacian_side[(n - 1) / 3] = value;
  }
  level->laplacian_center = -sum;
}
