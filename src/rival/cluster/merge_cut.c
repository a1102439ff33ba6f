/* Some number of clusters out of the hierarchy. */
#include "rival/cluster/merge_tree.h"

#include "base/memory.h"

#include <stdlib.h>

/* A part of the domain below this share of |domain| / count is no cluster of the wanted
 * ones: an inlet of one cell would take the place of an ocean's cluster. */
static const double LEAST_SHARE = 0.05;

/* Who is counted: `whole` is the part of the domain that a node lies in, its root. */
typedef struct counting {
  const fg__merge_tree *tree;
  int *whole;             /* [nodes] */
  unsigned char *counted; /* [nodes] of roots */
} counting;

static int compare_sizes(const void *a, const void *b)
{
  const int *one = a, *other = b; /* size, root */
  if (one[0] != other[0])
    return one[0] > other[0] ? -1 : 1;
  return one[1] - other[1];
}

/* Marks the roots that are counted, at most `count`, the largest; returns how many. */
static fg_status choose_parts(counting *work, fg_context *context, int count, int *chosen)
{
  const fg__merge_tree *tree = work->tree;
  int roots = 0;
  for (int n = tree->nodes - 1; n >= 0; n--) {
    int parent = tree->node[n].parent;
    work->whole[n] = parent < 0 ? n : work->whole[parent];
    roots += parent < 0;
  }
  int(*ranked)[2] = fg__allocate((size_t)roots, sizeof *ranked);
  if (!ranked)
    return fg__fail_memory(context, "parts of the domain",
                           (size_t)roots * sizeof *ranked);
  int found = 0;
  for (int n = 0; n < tree->nodes; n++)
    if (tree->node[n].parent < 0) {
      ranked[found][0] = tree->node[n].size;
      ranked[found++][1] = n;
    }
  qsort(ranked, (size_t)roots, sizeof *ranked, compare_sizes);
  *chosen = 0;
  for (int i = 0; i < roots && *chosen < count; i++)
    if (ranked[i][0] >= LEAST_SHARE * tree->cells / count) {
      work->counted[ranked[i][1]] = 1;
      ++*chosen;
    }
  free(ranked);
  return FG_STATUS_OK;
}

/* Numbers what is not undone; `first` is the first node that is. */
static int number_cells(const counting *work, int first, int *label, int *number)
{
  const fg__merge_tree *tree = work->tree;
  int given = 0;
  /* a node's cluster is the topmost node above it that is not undone */
  for (int n = first - 1; n >= 0; n--) {
    int parent = tree->node[n].parent;
    number[n] = parent >= 0 && parent < first ? number[parent] : n;
  }
  for (int cell = 0; cell < tree->cells; cell++) {
    int top = number[cell];
    if (!work->counted[work->whole[cell]])
      continue;
    int *mark = &number[tree->nodes + top];
    if (!*mark)
      *mark = ++given;
    label[tree->raster[cell]] = *mark;
  }
  return given;
}

fg_status fg__merge_tree_cut(const fg__merge_tree *tree, fg_context *context, int count,
                             int *label, int *found, int *left_out)
{
  size_t nodes = (size_t)tree->nodes;
  counting work = {.tree = tree};
  work.whole = fg__allocate(nodes, sizeof *work.whole);
  work.counted = fg__allocate(nodes, 1);
  int *number = fg__allocate(2 * nodes, sizeof *number);
  fg_status status = FG_STATUS_OK;
  if (!work.whole || !work.counted || !number) {
    status = fg__fail_memory(context, "a cut through the hierarchy",
                             nodes * 3 * sizeof *number);
    goto cleanup;
  }
  int there = 0;
  status = choose_parts(&work, context, count, &there);
  if (status != FG_STATUS_OK)
    goto cleanup;
  int first = tree->nodes, all = 0;
  for (int n = 0; n < tree->nodes; n++)
    all += tree->node[n].parent < 0;
  for (; first > tree->cells && there < count; first--, all++)
    there += work.counted[work.whole[first - 1]];
  *found = number_cells(&work, first, label, number);
  *left_out = all - *found;
cleanup:
  free(work.whole);
  free(work.counted);
  free(number);
  return status;
}
