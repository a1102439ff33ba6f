/* Grids cut into boxes at random places, and what their nodes hold, for tests of whatever
 * works on boxes. The same on every rank. */
#ifndef FG__SHARES_TEST_H
#define FG__SHARES_TEST_H

#include "mesh/layout.h"
#include "mesh/partition.h"
#include "mesh/together_test.h"

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
enum { GRID_COUNT = sizeof GRIDS / sizeof *GRIDS, MOST_SHARES = 64 };

static inline int nodes_along(const grid *g, int k)
{
  return k >= g->dimension ? 1 : g->cells[k] + !g->periodic[k];
}

static inline unsigned random_below(uint64_t *seed, unsigned end)
{
  *seed = *seed * 6364136223846793005U + 1442695040888963407U;
  return (unsigned)(*seed >> 33) % end;
}

typedef struct shares {
  fg__box box[MOST_SHARES];
  int owner[MOST_SHARES];
  int count;
} shares;

/* Cuts the grid again and again where a multiple of `alignment` nodes lies below. Owners
 * are dealt at random. */
static inline shares cut_at_random(const grid *g, uint64_t seed, int alignment)
{
  shares out = {.count = 1};
  for (int k = 0; k < 3; ++k)
    out.box[0].nodes[k] = nodes_along(g, k);
  unsigned wanted = 1 + random_below(&seed, 24);
  for (int trial = 0; trial < 200 && out.count < (int)wanted; ++trial) {
    fg__box *cut = &out.box[random_below(&seed, (unsigned)out.count)];
    unsigned k = random_below(&seed, (unsigned)g->dimension);
    int parts = cut->nodes[k] / alignment;
    if (parts < 2)
      continue;
    int below = alignment * (int)(1 + random_below(&seed, (unsigned)parts - 1));
    fg__box *above = &out.box[out.count++];
    *above = *cut;
    above->first[k] += below;
    above->nodes[k] -= below;
    cut->nodes[k] = below;
  }
  for (int n = 0; n < out.count; ++n)
    out.owner[n] = (int)random_below(&seed, (unsigned)us.ranks->count);
  return out;
}

static inline int own_shares(const shares *s, fg__box own[MOST_SHARES])
{
  int count = 0;
  for (int n = 0; n < s->count; ++n)
    if (s->owner[n] == us.ranks->rank)
      own[count++] = s->box[n];
  return count;
}

static inline bool has_node(const fg__box *box, const int node[3])
{
  for (int k = 0; k < 3; ++k)
    if (node[k] < box->first[k] || node[k] >= box->first[k] + box->nodes[k])
      return false;
  return true;
}

static inline int owner_of(const shares *s, const int node[3])
{
  for (int n = 0; n < s->count; ++n)
    if (has_node(&s->box[n], node))
      return s->owner[n];
  return -1;
}

static inline fg__partition partition_of(const grid *g, const shares *s)
{
  fg__box own[MOST_SHARES];
  int count = own_shares(s, own);
  fg__partition out;
  if (fg__partition_create(&out, us.context, us.ranks, g->dimension, g->cells,
                           g->periodic, own, count) != FG_STATUS_OK)
    abort();
  return out;
}

/* Different at each node of the grids above and in each array; exact in float. */
static inline float value_at(int array, const int node[3])
{
  return (float)(node[0] + 50 * (node[1] + 50 * node[2])) + 0.25F * (float)array;
}

/* Arrays of each own box: pointers to node (0, 0, 0). */
typedef struct fields {
  int count, boxes;
  fg__layout layout[MOST_SHARES];
  float *node[4][MOST_SHARES];
  float *const *array[4];
} fields;

static const float UNTOUCHED = -7.5F;

static inline fields fields_of(const fg__partition *partition, int count)
{
  fields out = {.count = count};
  const fg__box *own = fg__own_boxes(partition, &out.boxes);
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < out.boxes; ++b) {
      fg__layout l = out.layout[b] = fg__layout_of(partition->dimension, own[b].nodes);
      float *memory = allocate_or_end(l.array_size, sizeof *memory);
      for (size_t n = 0; n < l.array_size; ++n)
        memory[n] = UNTOUCHED;
      out.node[a][b] = memory + l.first;
      for (int k = 0; k < own[b].nodes[2]; ++k)
        for (int j = 0; j < own[b].nodes[1]; ++j)
          for (int i = 0; i < own[b].nodes[0]; ++i)
            out.node[a][b][fg__node_at(&l, i, j, k)] =
                value_at(a, (int[3]){own[b].first[0] + i, own[b].first[1] + j,
                                     own[b].first[2] + k});
    }
  return out;
}

/* fields are returned by value: their own addresses are only settled afterwards. */
static inline float *const *const *arrays_of(fields *f)
{
  for (int a = 0; a < f->count; ++a)
    f->array[a] = f->node[a];
  return f->array;
}

static inline void fields_clear(fields *f)
{
  for (int a = 0; a < f->count; ++a)
    for (int b = 0; b < f->boxes; ++b)
      free(f->node[a][b] - f->layout[b].first);
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
