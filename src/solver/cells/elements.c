#include "solver/cells/elements.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "solver/cells/images.h"

/* The work of a cell is compiled for each number of dimensions. */
#define INLINE static inline __attribute__((always_inline))

static double integral(const int a[3], const int b[3], int dimension, int p, int q)
{
  double product = 1.0;
  for (int k = 0; k < 3 && k < dimension; ++k) {
    if (k == p && k == q)
      product *= a[k] * b[k];
    else if (k == p)
      product *= 0.5 * a[k];
    else if (k == q)
      product *= 0.5 * b[k];
    else
      product *= a[k] == b[k] ? 1.0 / 3.0 : 1.0 / 6.0;
  }
  return product;
}

/* With s the signs of a corner's place, 1D integrals over the unit interval give per
 * axis: both functions 1/3 (s alike) or 1/6, one derivative s/2, both s_a s_b. */
void fg__cell_coupling(int a, int b, int dimension, const double spacing[3],
                       double weight[FG__TENSOR_COMPONENTS])
{
  static const int axes[FG__TENSOR_COMPONENTS][2] = {{0, 0}, {0, 1}, {1, 1},
                                                     {2, 2}, {0, 2}, {1, 2}};
  int place[2][3];
  for (int k = 0; k < 3; ++k) {
    place[0][k] = a >> k & 1 ? 1 : -1;
    place[1][k] = b >> k & 1 ? 1 : -1;
  }
  for (int n = 0; n < FG__TENSOR_COMPONENTS; ++n) {
    int p = axes[n][0], q = axes[n][1];
    weight[n] = 0.0;
    if (p >= dimension || q >= dimension)
      continue;
    double both = integral(place[0], place[1], dimension, p, q);
    if (p != q)
      both += integral(place[0], place[1], dimension, q, p);
    weight[n] = both / (spacing[p] * spacing[q]);
  }
}

static fg_status allocate(fg__elements *out, fg_context *context, int dimension,
                          const int nodes[3])
{
  fg__cell_layout layout = fg__cell_layout_of(dimension, nodes);
  *out = (fg__elements){.dimension = dimension, .row = layout.row, .plane = layout.plane};
  memcpy(out->nodes, layout.nodes, sizeof out->nodes);
  size_t size = layout.size;
  int arrays = fg__element_values(dimension);
  float *memory = fg__allocate(size * (size_t)arrays, sizeof *memory);
  if (!memory)
    return fg__fail_memory(context, "a level's cells",
                           size * (size_t)arrays * sizeof *memory);
  out->memory = memory;
  for (int n = 0; n < arrays; ++n)
    out->value[n] = memory + (size_t)n * size + layout.origin;
  return FG_STATUS_OK;
}

/* Matrices of one cell: mass of the corners, couplings of the Laplacian and the energy,
 * whose rows sum to zero. */
typedef struct element {
  double mass[FG__MOST_CORNERS];
  double stiffness[2][FG__MOST_CORNERS][FG__MOST_CORNERS];
} element;

/* Couplings of a unit cell's corners, of which fine cells of the finest level are made.
 */
typedef struct unit {
  double weight[FG__MOST_CORNERS][FG__MOST_CORNERS][FG__TENSOR_COMPONENTS];
} unit;

INLINE void read_tensor(const fg__fine_cells *fine, const unit *u, int dimension,
                        ptrdiff_t at, element *out)
{
  const fg__cells_of_box *cells = fine->tensor;
  int corners = 1 << dimension, components = dimension == 3 ? 6 : 3;
  double active = (double)cells->weight[at];
  for (int a = 0; a < corners; ++a) {
    out->mass[a] = active / corners;
    for (int b = 0; b < corners; ++b) {
      const double *weight = u->weight[a][b];
      double energy = 0.0;
      for (int n = 0; n < components; ++n)
        energy += fine->gamma * (double)cells->component[n][at] * weight[n];
      out->stiffness[0][a][b] = active * (weight[0] + weight[2] + weight[3]);
      out->stiffness[1][a][b] = energy;
    }
  }
}

INLINE void read_element(const fg__elements *elements, int dimension, ptrdiff_t at,
                         element *out)
{
  int corners = 1 << dimension;
  for (int a = 0; a < corners; ++a) {
    out->mass[a] = (double)elements->value[fg__element_mass(dimension, a)][at];
    for (int m = 0; m < 2; ++m) {
      double sum = 0.0;
      for (int b = 0; b < corners; ++b) {
        if (b == a)
          continue;
        int n = fg__element_coupling(dimension, m == 0, a, b);
        out->stiffness[m][a][b] = (double)elements->value[n][at];
        sum += out->stiffness[m][a][b];
      }
      out->stiffness[m][a][a] = -sum;
    }
  }
}

/* How far the fine node at an offset of 0, 1 or 2 from a coarse cell's lowest corner
 * follows each corner: its share of what is beside it, all of what is its own place. */
INLINE void read_interpolation(const fg__fine_cells *fine, int dimension,
                               const int lowest[3], const int offset[3],
                               double share[FG__MOST_CORNERS])
{
  ptrdiff_t at = fg__node_at(fine->layout, lowest[0] + offset[0], lowest[1] + offset[1],
                             lowest[2] + offset[2]);
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    bool beside = true;
    int side = 0;
    for (int k = 0; k < 3 && k < dimension; ++k) {
      int high = corner >> k & 1;
      if (offset[k] == 1)
        side |= high << k;
      else
        beside = beside && 2 * high == offset[k];
    }
    share[corner] = beside ? (double)fine->interpolation[side][at] : 0.0;
  }
}

/* Adds P' A P of a fine cell, share: those of its corners. */
INLINE void add_element(const element *from, double share[][FG__MOST_CORNERS],
                        int corners, element *to)
{
  for (int a = 0; a < corners; ++a)
    for (int c = 0; c < corners; ++c)
      to->mass[c] += share[a][c] * from->mass[a];
  for (int m = 0; m < 2; ++m)
    for (int a = 0; a < corners; ++a) {
      double row[FG__MOST_CORNERS] = {0.0};
      for (int b = 0; b < corners; ++b)
        for (int c = 0; c < corners; ++c)
          row[c] += from->stiffness[m][a][b] * share[b][c];
      for (int c = 0; c < corners; ++c)
        for (int d = 0; d < corners; ++d)
          to->stiffness[m][c][d] += share[a][c] * row[d];
    }
}

INLINE void coarsen_cell(const fg__fine_cells *fine, const unit *u, int dimension,
                         const int lowest[3], element *out)
{
  int corners = 1 << dimension;
  for (int a = 0; a < corners; ++a) {
    out->mass[a] = 0.0;
    for (int b = 0; b < corners; ++b)
      out->stiffness[0][a][b] = out->stiffness[1][a][b] = 0.0;
  }
  for (int cell = 0; cell < corners; ++cell) {
    const int place[3] = {cell & 1, cell >> 1 & 1, cell >> 2};
    double share[FG__MOST_CORNERS][FG__MOST_CORNERS];
    element own;
    for (int a = 0; a < corners; ++a) {
      int offset[3] = {place[0] + (a & 1), place[1] + (a >> 1 & 1), place[2] + (a >> 2)};
      read_interpolation(fine, dimension, lowest, offset, share[a]);
    }
    int i = lowest[0] + place[0], j = lowest[1] + place[1], k = lowest[2] + place[2];
    if (fine->tensor)
      read_tensor(fine, u, dimension, fg__cell_at(fine->tensor, i, j, k), &own);
    else
      read_element(fine->elements, dimension, fg__element_at(fine->elements, i, j, k),
                   &own);
    add_element(&own, share, corners, out);
  }
}

typedef struct coarsening {
  const fg__elements *out;
  const fg__fine_cells *fine;
  const int *count;
  unit unit;
} coarsening;

INLINE void coarsen_part(const coarsening *c, int dimension, const fg__thread *thread)
{
  int corners = 1 << dimension, begin[3] = {0, 0, 0};
  int end[3] = {c->count[0], c->count[1], c->count[2]};
  fg__threads_range(thread, end[dimension - 1], 1, &begin[dimension - 1],
                    &end[dimension - 1]);
  for (int k = begin[2]; k < end[2]; ++k)
    for (int j = begin[1]; j < end[1]; ++j)
      for (int i = 0; i < end[0]; ++i) {
        element e;
        coarsen_cell(c->fine, &c->unit, dimension, (int[]){2 * i, 2 * j, 2 * k}, &e);
        ptrdiff_t at = fg__element_at(c->out, i, j, k);
        float *const *value = c->out->value;
        for (int a = 0; a < corners; ++a) {
          value[fg__element_mass(dimension, a)][at] = (float)(e.mass[a] / corners);
          for (int b = 0; b < a; ++b)
            for (int m = 0; m < 2; ++m)
              value[fg__element_coupling(dimension, m == 0, a, b)][at] =
                  (float)(e.stiffness[m][a][b] / corners);
        }
      }
}

static void coarsen_in_2d(void *argument, const fg__thread *thread)
{
  coarsen_part(argument, 2, thread);
}

static void coarsen_in_3d(void *argument, const fg__thread *thread)
{
  coarsen_part(argument, 3, thread);
}

fg_status fg__elements_coarsen(fg__elements *out, fg_context *context,
                               const fg__fine_cells *fine, const int nodes[3],
                               const int count[3], fg__threads *threads)
{
  int dimension = fine->layout->dimension, corners = 1 << dimension;
  fg_status status = allocate(out, context, dimension, nodes);
  if (status)
    return status;
  coarsening c = {.out = out, .fine = fine, .count = count};
  for (int a = 0; a < corners; ++a)
    for (int b = 0; b < corners; ++b)
      fg__cell_coupling(a, b, dimension, fine->spacing, c.unit.weight[a][b]);
  fg__threads_run(threads, dimension == 3 ? coarsen_in_3d : coarsen_in_2d, &c);
  return FG_STATUS_OK;
}

/* Mirrored, corners change places. */
static void copy_image(const void *argument, ptrdiff_t to, ptrdiff_t from, int axis,
                       bool mirrored)
{
  const fg__elements *e = argument;
  int dimension = e->dimension, corners = 1 << dimension;
  int turn = mirrored ? 1 << axis : 0;
  for (int a = 0; a < corners; ++a) {
    e->value[fg__element_mass(dimension, a)][to] =
        e->value[fg__element_mass(dimension, a ^ turn)][from];
    for (int b = 0; b < a; ++b)
      for (int m = 0; m < 2; ++m)
        e->value[fg__element_coupling(dimension, m == 0, a, b)][to] =
            e->value[fg__element_coupling(dimension, m == 0, a ^ turn, b ^ turn)][from];
  }
}

void fg__elements_fill_images(const fg__elements *elements, const fg__box *box,
                              const int level_cells[3], const bool periodic[3])
{
  fg__cell_layout layout = fg__cell_layout_of(elements->dimension, elements->nodes);
  fg__cell_images_fill(&layout, box, level_cells, periodic, copy_image, elements);
}

fg_status fg__elements_from_arrays(fg__elements *out, fg_context *context,
                                   const float *const values[], int dimension,
                                   const int cells[3], const bool periodic[3])
{
  int count[3] = {1, 1, 1}, nodes[3] = {1, 1, 1};
  for (int k = 0; k < 3 && k < dimension; ++k) {
    count[k] = cells[k];
    nodes[k] = cells[k] + !periodic[k];
  }
  fg_status status = allocate(out, context, dimension, nodes);
  if (status)
    return status;
  size_t n = 0;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i, ++n)
        for (int v = 0; v < fg__element_values(dimension); ++v)
          out->value[v][fg__element_at(out, i, j, k)] = values[v][n];
  const fg__box whole = {{0, 0, 0}, {nodes[0], nodes[1], nodes[2]}};
  fg__elements_fill_images(out, &whole, count, periodic);
  return FG_STATUS_OK;
}

void fg__elements_clear(fg__elements *elements)
{
  free(elements->memory);
  *elements = (fg__elements){0};
}
