#include <stdlib.h>

#include "base/memory.h"
#include "mesh/brick.h"
#include "mesh/refinement.h"

struct fg__border {
  int most_arrays;
  fg__brick *brick; /* of border nodes */
  size_t count, capacity;
  fg__layout *layout, *half; /* of own boxes */
  long nodes;
  long first[9]; /* where a colour's values begin among an array's */
  float *value;  /* [most_arrays][nodes]: colour by colour, brick by brick */
};

static bool add_bricks(fg__border *b, int box, const fg__box_list *list)
{
  if (!list->box)
    return true; /* not one */
  void *memory = b->brick;
  bool grown = fg__grow(&memory, &b->capacity, b->count + list->count, sizeof *b->brick);
  b->brick = memory;
  for (size_t n = 0; grown && n < list->count; ++n) {
    fg__brick *added = &b->brick[b->count++];
    *added = (fg__brick){.box = box, .nodes = list->box[n]};
    for (int k = 0; k < 3; ++k) /* boxes begin at even indices */
      added->odd[k] = added->nodes.first[k] & 1;
  }
  return grown;
}

/* True when one of the cells round node (i, j, k) is outside; kind has nodes + 1 cells
 * along each axis of the dimension, from cell -1. */
static bool is_border(const unsigned char *kind, const fg__box *box, int dimension, int i,
                      int j, int k)
{
  size_t width = (size_t)box->nodes[0] + 1, height = (size_t)box->nodes[1] + 1;
  int depth = dimension == 3;
  for (int z = 0; z <= depth; ++z)
    for (int y = 0; y <= 1; ++y) {
      const unsigned char *row =
          kind + ((size_t)(k + z) * height + (size_t)(j + y)) * width + i;
      if (row[0] == FG__CELL_OUTSIDE || row[1] == FG__CELL_OUTSIDE)
        return true;
    }
  return false;
}

static bool find_runs(fg__box_list *out, const unsigned char *kind, const fg__box *box,
                      int dimension)
{
  for (int k = 0; k < box->nodes[2]; ++k)
    for (int j = 0; j < box->nodes[1]; ++j) {
      int start = 0;
      for (int i = 0; i <= box->nodes[0]; ++i) {
        if (i < box->nodes[0] && is_border(kind, box, dimension, i, j, k))
          continue;
        fg__box run = {{start, j, k}, {i - start, 1, 1}};
        if (i > start && !fg__box_list_add(out, &run))
          return false;
        start = i + 1;
      }
    }
  out->count = (size_t)fg__boxes_merge(out->box, (int)out->count);
  return true;
}

static bool add_box(fg__border *b, const fg__mesh *mesh, int level, int own,
                    const fg__box *box)
{
  size_t count = 1;
  for (int k = 0; k < mesh->dimension; ++k)
    count *= (size_t)box->nodes[k] + 1;
  unsigned char *kind = fg__allocate(count, 1);
  fg__box_list runs = {0};
  bool done = kind != NULL;
  if (done)
    fg__cell_kinds(kind, mesh, level, box);
  done =
      done && find_runs(&runs, kind, box, mesh->dimension) && add_bricks(b, own, &runs);
  free(runs.box);
  free(kind);
  return done;
}

static bool find_nodes(fg__border *b, const fg__mesh *mesh, int level)
{
  int count;
  const fg__box *own = fg__own_boxes(&mesh->level[level], &count);
  b->layout = fg__allocate((size_t)count, sizeof *b->layout);
  b->half = fg__allocate((size_t)count, sizeof *b->half);
  if (!b->layout || !b->half)
    return false;
  for (int n = 0; n < count; ++n) {
    int half[3];
    for (int k = 0; k < 3; ++k)
      half[k] = (own[n].nodes[k] + 1) / 2;
    b->layout[n] = fg__layout_of(mesh->dimension, own[n].nodes);
    b->half[n] = fg__layout_of(mesh->dimension, half);
    /* the coarsest level covers the domain */
    if (level + 1 < mesh->level_count && !add_box(b, mesh, level, n, &own[n]))
      return false;
  }
  for (int colour = 0; colour < 8; ++colour) {
    b->first[colour] = b->nodes;
    for (size_t n = 0; n < b->count; ++n)
      b->nodes += fg__brick_count(&b->brick[n], 1U << colour);
  }
  b->first[8] = b->nodes;
  b->value = fg__allocate((size_t)b->nodes * (size_t)b->most_arrays, sizeof *b->value);
  return b->value != NULL;
}

fg_status fg__border_create(fg__border **out, fg_context *context, const fg__mesh *mesh,
                            int level, int most_arrays)
{
  fg__border *b = *out = fg__allocate(1, sizeof *b);
  if (b)
    b->most_arrays = most_arrays;
  if (b && find_nodes(b, mesh, level))
    return FG_STATUS_OK;
  fg__border_destroy(b);
  *out = NULL;
  return fg__fail_memory(context, "a level's border", sizeof *b);
}

void fg__border_destroy(fg__border *border)
{
  if (!border)
    return;
  free(border->brick);
  free(border->layout);
  free(border->half);
  free(border->value);
  free(border);
}

long fg__border_count(const fg__border *border)
{
  return border->nodes;
}

float fg__interpolated(const fg__layout *half_layout, const float *half,
                       const int node[3])
{
  int low[3], odd[3];
  for (int k = 0; k < 3; ++k) {
    odd[k] = node[k] & 1;
    low[k] = node[k] / 2;
  }
  float sum = 0.0F;
  for (int z = 0; z <= odd[2]; ++z)
    for (int y = 0; y <= odd[1]; ++y)
      for (int x = 0; x <= odd[0]; ++x)
        sum += half[fg__node_at(half_layout, low[0] + x, low[1] + y, low[2] + z)];
  return sum / (float)(1 << (odd[0] + odd[1] + odd[2]));
}

static void interpolate(const fg__brick *brick, const fg__layout *half_layout,
                        const float *half, const fg__layout *layout, float *array)
{
  const int *first = brick->nodes.first, *nodes = brick->nodes.nodes;
  for (int k = first[2]; k < first[2] + nodes[2]; ++k)
    for (int j = first[1]; j < first[1] + nodes[1]; ++j)
      for (int i = first[0]; i < first[0] + nodes[0]; ++i)
        array[fg__node_at(layout, i, j, k)] =
            fg__interpolated(half_layout, half, (int[3]){i, j, k});
}

void fg__border_interpolate(fg__border *border, int count, float *const *const half[],
                            float *const *const array[])
{
  fg__border *b = border;
  float *value = b->value;
  for (int a = 0; a < count; ++a) {
    for (size_t n = 0; n < b->count; ++n) {
      int box = b->brick[n].box;
      interpolate(&b->brick[n], &b->half[box], half[a][box], &b->layout[box],
                  array[a][box]);
    }
    for (int colour = 0; colour < 8; ++colour)
      for (size_t n = 0; n < b->count; ++n) {
        int box = b->brick[n].box;
        value = fg__brick_pack(&b->brick[n], &b->layout[box], array[a][box], 1U << colour,
                               value);
      }
  }
}

void fg__border_restore(const fg__border *border, int count, float *const *const array[],
                        unsigned colours)
{
  const fg__border *b = border;
  for (int a = 0; a < count; ++a)
    for (int colour = 0; colour < 8; ++colour) {
      if (!(colours >> colour & 1U))
        continue;
      const float *value = b->value + a * b->nodes + b->first[colour];
      for (size_t n = 0; n < b->count; ++n) {
        int box = b->brick[n].box;
        value = fg__brick_unpack(&b->brick[n], &b->layout[box], array[a][box],
                                 1U << colour, value);
      }
    }
}
