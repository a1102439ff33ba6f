#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "component/shape.h"

static const double cells_in_a_step = 0x1p-24;

/* A node beside the box: where it lies in memory; false when there is none. */
static bool place(const fg__shape *s, const int node[3], ptrdiff_t *offset)
{
  *offset = 0;
  for (int axis = 0; axis < 3; ++axis) {
    int index = fg__shape_node(s, axis, node[axis]);
    if (index == FG__NOWHERE)
      return false;
    *offset += index * s->stride[axis];
  }
  return true;
}

/* Whether a node and the one a step away are joined directly: the step leads along one
 * axis, or across a face. Both are positive. */
static bool joined(const fg__shape *s, const int node[3], const int step[3])
{
  int low[3], high[3];    /* cells round the edge or face */
  int beside[2][3];       /* the face's other corners */
  int axes = 0, other[3]; /* of the step */
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = node[axis] - (step[axis] <= 0);
    high[axis] = node[axis] - (step[axis] < 0);
    beside[0][axis] = beside[1][axis] = node[axis];
    other[axis] = node[axis] + step[axis];
    if (step[axis] != 0 && axes < 2)
      beside[axes++][axis] += step[axis];
  }
  fg__gate gate = fg__gate_of(s, low[1], high[1], low[2], high[2]);
  if (!fg__gate_open(&gate, s, low[0], high[0]))
    return false;
  ptrdiff_t a, b, c, d;
  if (axes == 1 || !s->u)
    return axes == 1; /* where all are positive, edges join the corners of a face */
  return place(s, node, &a) && place(s, beside[0], &b) && place(s, beside[1], &c) &&
         place(s, other, &d) &&
         fg__components_saddle_joins(s->u[a], s->u[b], s->u[c], s->u[d]);
}

static fg_status add_pair(fg__components *c, fg_context *context, int low, int high)
{
  if (c->pair_count > 0 && c->pair[c->pair_count - 1].low == low &&
      c->pair[c->pair_count - 1].high == high)
    return FG_STATUS_OK;
  size_t needed = c->pair_count + 1;
  if (!fg__grow((void **)&c->pair, &c->pair_capacity, needed, sizeof *c->pair))
    return fg__fail_memory(context, "pieces of clusters that meet",
                           needed * sizeof *c->pair);
  c->pair[c->pair_count++] = (fg__component_pair){low, high};
  return FG_STATUS_OK;
}

/* Pairs of a node on the box's side and its neighbours beyond that side. */
static fg_status pair_node(fg__components *c, fg_context *context, const fg__shape *s,
                           const int *number, const int node[3], int axis, int out)
{
  ptrdiff_t here = 0, there;
  (void)place(s, node, &here);
  if (number[here] <= 0)
    return FG_STATUS_OK;
  for (int n = 0; n < 5; ++n) { /* straight on, or aside along another axis */
    int aside = n < 3 ? (axis + 1) % 3 : (axis + 2) % 3;
    int step[3] = {0, 0, 0};
    step[axis] = out;
    if (n > 0)
      step[aside] = n % 2 == 1 ? 1 : -1;
    const int other[3] = {node[0] + step[0], node[1] + step[1], node[2] + step[2]};
    if (!place(s, other, &there) || number[there] <= 0 || number[there] >= number[here])
      continue;
    if (!joined(s, node, step))
      continue;
    fg_status status = add_pair(c, context, number[there], number[here]);
    if (status)
      return status;
  }
  return FG_STATUS_OK;
}

static int compare_pairs(const void *a, const void *b)
{
  const fg__component_pair *p = a, *q = b;
  if (p->high != q->high)
    return p->high < q->high ? -1 : 1;
  return (p->low > q->low) - (p->low < q->low);
}

static void drop_repeated_pairs(fg__components *c)
{
  if (c->pair_count == 0)
    return;
  qsort(c->pair, c->pair_count, sizeof *c->pair, compare_pairs);
  size_t kept = 1;
  for (size_t n = 1; n < c->pair_count; ++n)
    if (compare_pairs(&c->pair[n], &c->pair[kept - 1]) != 0)
      c->pair[kept++] = c->pair[n];
  c->pair_count = kept;
}

fg_status fg__components_pairs(fg__components *components, fg_context *context,
                               const fg__component_box *box, const int *number)
{
  fg__shape s = fg__shape_of(box);
  components->pair_count = 0;
  for (int side = 0; side < 6; ++side) {
    int axis = side / 2, out = side % 2 ? 1 : -1;
    if ((out < 0 ? s.low[axis] : s.high[axis]) != FG__SIDE_RING)
      continue;
    int first[3] = {0, 0, 0};
    int last[3] = {s.nodes[0] - 1, s.nodes[1] - 1, s.nodes[2] - 1};
    first[axis] = last[axis] = out < 0 ? 0 : last[axis];
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const int node[3] = {i, j, k};
          fg_status status = pair_node(components, context, &s, number, node, axis, out);
          if (status)
            return status;
        }
  }
  drop_repeated_pairs(components);
  return FG_STATUS_OK;
}

static int find(int *root, int index)
{
  while (root[index] != index) {
    root[index] = root[root[index]];
    index = root[index];
  }
  return index;
}

/* A component while pieces are merged. */
typedef struct fg__component_group {
  fg__component_piece piece; /* first: the first of all its pieces */
  int root;
} group;

static int compare_groups(const void *a, const void *b)
{
  const group *p = a, *q = b;
  return (p->piece.first > q->piece.first) - (p->piece.first < q->piece.first);
}

/* Adds up pieces at the roots, and lists those in the order of their first nodes. */
static int group_pieces(fg__components *c, const fg__component_piece *piece, int count)
{
  group *list = c->group;
  int groups = 0;
  for (int n = 0; n < count; ++n) /* a root comes before the others */
    if (c->root[n] == n) {
      c->piece_label[n] = groups;
      list[groups++] = (group){piece[n], n};
    }
  bool ordered = true;
  for (int n = 0; n < count; ++n) {
    int root = find(c->root, n);
    if (root == n)
      continue;
    fg__component_piece *sum = &list[c->piece_label[root]].piece;
    sum->size += piece[n].size;
    sum->first = piece[n].first < sum->first ? piece[n].first : sum->first;
  }
  for (int n = 1; n < groups && ordered; ++n)
    ordered = list[n - 1].piece.first < list[n].piece.first;
  if (!ordered)
    qsort(list, (size_t)groups, sizeof *list, compare_groups);
  return groups;
}

fg_status fg__components_merge(fg__components *components, fg_context *context,
                               const fg__component_piece *piece, int piece_count,
                               const fg__component_pair *pair, size_t pair_count,
                               double debris_area)
{
  fg__components *c = components;
  size_t count = (size_t)piece_count;
  c->count = c->debris = 0;
  if (!fg__grow((void **)&c->root, &c->root_capacity, count, sizeof *c->root) ||
      !fg__grow((void **)&c->group, &c->group_capacity, count, sizeof *c->group) ||
      !fg__grow((void **)&c->area, &c->area_capacity, count, sizeof *c->area) ||
      !fg__grow((void **)&c->piece_label, &c->piece_label_capacity, count,
                sizeof *c->piece_label))
    return fg__fail_memory(context, "clusters", count * sizeof *c->group);
  for (int n = 0; n < piece_count; ++n)
    c->root[n] = n;
  for (size_t n = 0; n < pair_count; ++n) {
    int low = find(c->root, pair[n].low - 1), high = find(c->root, pair[n].high - 1);
    c->root[low < high ? high : low] = low < high ? low : high;
  }
  int groups = group_pieces(c, piece, piece_count);
  for (int n = 0; n < groups; ++n) {
    double cells = (double)c->group[n].piece.size * cells_in_a_step;
    bool whole = cells >= debris_area;
    if (whole)
      c->area[c->count] = cells;
    c->piece_label[c->group[n].root] = whole ? ++c->count : -1;
    c->debris += !whole;
  }
  for (int n = 0; n < piece_count; ++n)
    if (c->root[n] != n)
      c->piece_label[n] = c->piece_label[find(c->root, n)];
  return FG_STATUS_OK;
}
