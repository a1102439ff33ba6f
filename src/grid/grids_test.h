/* Grids divided into blocks at random places, and what their nodes hold, for tests of
 * whatever works on blocks. The same on every rank. */
#ifndef FG__GRIDS_TEST_H
#define FG__GRIDS_TEST_H

#include "grid/layout.h"
#include "grid/partition.h"
#include "grid/together_test.h"

typedef struct grid {
  int dimension;
  int cells[3];
  bool periodic[3];
} grid;

static const grid GRIDS[] = {
    {2, {16, 8, 1}, {false, false, false}},  {2, {40, 24, 1}, {true, false, false}},
    {2, {8, 48, 1}, {false, true, false}},   {2, {32, 32, 1}, {true, true, false}},
    {3, {16, 8, 24}, {false, false, false}}, {3, {8, 16, 8}, {true, false, true}},
    {3, {24, 8, 16}, {false, true, false}},  {3, {16, 16, 16}, {true, true, true}},
};
enum { GRID_COUNT = sizeof GRIDS / sizeof *GRIDS };

static inline int nodes_along(const grid *g, int k)
{
  return k >= g->dimension ? 1 : g->cells[k] + !g->periodic[k];
}

static inline unsigned random_below(uint64_t *seed, unsigned end)
{
  *seed = *seed * 6364136223846793005U + 1442695040888963407U;
  return (unsigned)(*seed >> 33) % end;
}

/* Moves the cuts between `count` blocks along an axis to random multiples of `alignment`
 * that leave two nodes at least: `first` has count + 1 places. */
static inline void cut_at_random(int *first, int count, int nodes, int alignment,
                                 uint64_t *seed)
{
  int least = alignment > 2 ? alignment : 2;
  int units = (nodes - least * count) / alignment;
  for (int n = 0, moved = 0; n < count; ++n) {
    first[n] = n * least + moved * alignment;
    moved += (int)random_below(seed, (unsigned)(units - moved + 1));
  }
  first[count] = nodes;
}

/* Slabs in 2D, slabs or pencils in 3D; in any arrangement. */
static inline fg__partition divide_at_random(const grid *g, uint64_t seed, int alignment)
{
  enum { MOST = 64 };
  int ranks = us.ranks->count, blocks[3] = {1, ranks, 1}, first[3][MOST + 1] = {{0}};
  if (g->dimension == 3) {
    do
      blocks[1] = 1 + (int)random_below(&seed, (unsigned)ranks);
    while (ranks % blocks[1] != 0);
    blocks[2] = ranks / blocks[1];
  }
  fg__partition out;
  if (ranks > MOST ||
      fg__partition_create(&out, us.context, us.ranks, g->dimension, g->cells,
                           g->periodic, blocks, 1) != FG_STATUS_OK)
    abort();
  first[2][1] = 1; /* in 2D */
  for (int k = 1; k < 3 && k < g->dimension; ++k)
    cut_at_random(first[k], blocks[k], nodes_along(g, k), alignment, &seed);
  fg__box *block = out.block;
  for (int z = 0; z < blocks[2]; ++z)
    for (int y = 0; y < blocks[1]; ++y, ++block) {
      block->first[1] = first[1][y];
      block->nodes[1] = first[1][y + 1] - first[1][y];
      block->first[2] = first[2][z];
      block->nodes[2] = first[2][z + 1] - first[2][z];
    }
  return out;
}

static inline bool has_node(const fg__box *box, const int node[3])
{
  for (int k = 0; k < 3; ++k)
    if (node[k] < box->first[k] || node[k] >= box->first[k] + box->nodes[k])
      return false;
  return true;
}

/* FG__NOBODY also for a node in several blocks. */
static inline int owner_of(const fg__partition *partition, const int node[3])
{
  int owner = FG__NOBODY, owners = 0;
  for (int rank = 0; rank < partition->ranks->count; ++rank)
    if (has_node(&partition->block[rank], node)) {
      owner = rank;
      ++owners;
    }
  return owners == 1 ? owner : FG__NOBODY;
}

/* Different at each node of the grids above and in each array; exact in float. */
static inline float value_at(int array, const int node[3])
{
  return (float)(node[0] + 50 * (node[1] + 50 * node[2])) + 0.25F * (float)array;
}

/* Arrays of the own block: pointers to node (0, 0, 0). */
typedef struct fields {
  int count;
  fg__layout layout;
  float *array[4];
} fields;

static const float UNTOUCHED = -7.5F;

static inline void fields_forget(fields *f)
{
  for (int a = 0; a < f->count; ++a)
    for (size_t n = 0; n < f->layout.array_size; ++n)
      (f->array[a] - f->layout.first)[n] = UNTOUCHED;
}

static inline fields fields_of(const fg__partition *partition, int count)
{
  const fg__box *own = fg__own_block(partition);
  fields out = {.count = count,
                .layout = fg__layout_of(partition->dimension, own->nodes)};
  const fg__layout *l = &out.layout;
  for (int a = 0; a < count; ++a)
    out.array[a] = (float *)allocate_or_end(l->array_size, sizeof(float)) + l->first;
  fields_forget(&out);
  for (int a = 0; a < count; ++a)
    for (int k = 0; k < own->nodes[2]; ++k)
      for (int j = 0; j < own->nodes[1]; ++j)
        for (int i = 0; i < own->nodes[0]; ++i)
          out.array[a][fg__node_at(l, i, j, k)] = value_at(
              a, (int[3]){own->first[0] + i, own->first[1] + j, own->first[2] + k});
  return out;
}

static inline void fields_clear(fields *f)
{
  for (int a = 0; a < f->count; ++a)
    free(f->array[a] - f->layout.first);
}

/* The node of the grid that a node of index -1 ... nodes stands for. */
static inline int image_along(const grid *g, int k, int index)
{
  int nodes = nodes_along(g, k);
  if (g->periodic[k])
    return (index + nodes) % nodes;
  return index < 0 ? -index : index >= nodes ? 2 * (nodes - 1) - index : index;
}

#endif
