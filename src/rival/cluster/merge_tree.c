#include "rival/cluster/merge_tree.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Merges between two looks at the stop flag. */
enum { STOP_INTERVAL = 4096 };

/* Each pair of neighbours is looked after by the later made one. A cluster has one entry:
 * the most alike of the earlier made neighbours it had when the entry was made. These can
 * only become fewer, since merging makes later ones; so an entry whose neighbour is gone
 * is not too late, and is made anew. */
typedef struct heap_entry {
  double error;
  int size; /* of both together: of equal errors the smaller cluster is made first */
  int cluster, neighbour;
} heap_entry;

typedef struct merging {
  fg__merge_tree *tree;
  const fg__domain *domain;
  const fg__merge_weights *weights;
  int *up;           /* [nodes] towards the cluster that a node is in now */
  int *first, *last; /* [nodes] its list of neighbours, -1: empty */
  int *next, *leaf;  /* [4 cells] the lists: a cell of the neighbour */
  int *seen;         /* [nodes] the last look that met it */
  int looks;
  heap_entry *heap; /* [nodes] */
  int heap_count;
} merging;

double fg__merge_error(const fg__merge_node *a, const fg__merge_node *b,
                       const fg__domain *domain, const fg__merge_weights *weights)
{
  double position[2], vector[2], mean[2];
  for (int k = 0; k < 2; k++) {
    position[k] = b->position[k] - a->position[k];
    vector[k] = b->vector[k] - a->vector[k];
    mean[k] = a->size * a->vector[k] + b->size * b->vector[k];
  }
  fg__domain_shortest(domain, position);
  double flow = sqrt(mean[0] * mean[0] + mean[1] * mean[1]);
  double along[2] = {0, 0}, less = 1;
  if (flow > 0) {
    along[0] = mean[0] / flow;
    along[1] = mean[1] / flow;
    less = 1 - 1 / (weights->elongation * weights->elongation);
  }
  /* the square less what it loses along the flow */
  double p = position[0] * along[0] + position[1] * along[1];
  double v = vector[0] * along[0] + vector[1] * along[1];
  double apart = position[0] * position[0] + position[1] * position[1] - less * p * p;
  double turned = vector[0] * vector[0] + vector[1] * vector[1] - less * v * v;
  return weights->position * sqrt(fmax(apart, 0) / domain->area) +
         (1 - weights->position) * sqrt(fmax(turned, 0)) / 2;
}

static bool is_before(const heap_entry *a, const heap_entry *b)
{
  if (a->error != b->error)
    return a->error < b->error;
  if (a->size != b->size)
    return a->size < b->size;
  return a->cluster < b->cluster;
}

static void push(merging *work, heap_entry entry)
{
  int at = work->heap_count++;
  while (at > 0 && is_before(&entry, &work->heap[(at - 1) / 2])) {
    work->heap[at] = work->heap[(at - 1) / 2];
    at = (at - 1) / 2;
  }
  work->heap[at] = entry;
}

static heap_entry pop(merging *work)
{
  heap_entry top = work->heap[0], moved = work->heap[--work->heap_count];
  int at = 0;
  for (;;) {
    int child = 2 * at + 1;
    if (child >= work->heap_count)
      break;
    if (child + 1 < work->heap_count &&
        is_before(&work->heap[child + 1], &work->heap[child]))
      child++;
    if (!is_before(&work->heap[child], &moved))
      break;
    work->heap[at] = work->heap[child];
    at = child;
  }
  work->heap[at] = moved;
  return top;
}

/* The cluster that a cell is in now; halves the way for the next time. */
static int cluster_of(merging *work, int node)
{
  int *up = work->up;
  while (up[node] != node) {
    up[node] = up[up[node]];
    node = up[node];
  }
  return node;
}

/* Makes the entry of a cluster, and drops from its list what it holds twice and what is
 * the cluster itself. */
static void look_round(merging *work, int cluster)
{
  const fg__merge_node *node = work->tree->node;
  heap_entry best = {.error = HUGE_VAL, .cluster = cluster, .neighbour = -1};
  int before = -1, look = ++work->looks;
  for (int i = work->first[cluster]; i >= 0; i = work->next[i]) {
    int other = cluster_of(work, work->leaf[i]);
    if (other == cluster || work->seen[other] == look) {
      if (before >= 0)
        work->next[before] = work->next[i];
      else
        work->first[cluster] = work->next[i];
      if (work->last[cluster] == i)
        work->last[cluster] = before;
      continue;
    }
    work->seen[other] = look;
    before = i;
    if (other > cluster)
      continue;
    heap_entry entry = {.error = fg__merge_error(&node[cluster], &node[other],
                                                 work->domain, work->weights),
                        .size = node[cluster].size + node[other].size,
                        .cluster = cluster,
                        .neighbour = other};
    if (best.neighbour < 0 || entry.error < best.error ||
        (entry.error == best.error && entry.size < best.size))
      best = entry;
  }
  if (best.neighbour >= 0)
    push(work, best);
}

static void merge(merging *work, const heap_entry *entry)
{
  fg__merge_tree *tree = work->tree;
  int made = tree->nodes++, child[2] = {entry->neighbour, entry->cluster};
  fg__merge_node *a = &tree->node[child[0]], *b = &tree->node[child[1]];
  fg__merge_node *sum = &tree->node[made];
  *sum = (fg__merge_node){.parent = -1,
                          .child = {child[0], child[1]},
                          .size = a->size + b->size,
                          .error = entry->error};
  double share = (double)b->size / sum->size, way[2];
  for (int k = 0; k < 2; k++) {
    way[k] = b->position[k] - a->position[k];
    sum->vector[k] = a->vector[k] + share * (b->vector[k] - a->vector[k]);
  }
  fg__domain_shortest(work->domain, way);
  for (int k = 0; k < 2; k++)
    sum->position[k] = a->position[k] + share * way[k];
  a->parent = b->parent = made;
  work->up[child[0]] = work->up[child[1]] = work->up[made] = made;
  /* one list after the other; neither is empty, since each holds the other */
  work->first[made] = work->first[child[0]];
  work->next[work->last[child[0]]] = work->first[child[1]];
  work->last[made] = work->last[child[1]];
  look_round(work, made);
}

static void add_neighbour(merging *work, int cell, int other, int *used)
{
  int i = (*used)++;
  work->leaf[i] = other;
  work->next[i] = -1;
  if (work->first[cell] < 0)
    work->first[cell] = i;
  else
    work->next[work->last[cell]] = i;
  work->last[cell] = i;
}

/* Cells that share a side. */
static void find_neighbours(merging *work, const int *leaf_at)
{
  const fg__domain *domain = work->domain;
  const int step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  int used = 0;
  for (int cell = 0; cell < work->tree->cells; cell++) {
    int raster = work->tree->raster[cell];
    for (int d = 0; d < 4; d++) {
      int at[2] = {raster % domain->cells[0] + step[d][0],
                   raster / domain->cells[0] + step[d][1]};
      bool inside = true;
      for (int k = 0; k < 2; k++) {
        int n = domain->cells[k];
        if (domain->period[k] > 0)
          at[k] = (at[k] + n) % n;
        inside = inside && at[k] >= 0 && at[k] < n;
      }
      int other = inside ? leaf_at[at[1] * domain->cells[0] + at[0]] : -1;
      if (other >= 0 && other != cell)
        add_neighbour(work, cell, other, &used);
    }
  }
}

/* Cells become the first nodes, each in a list of its own. */
static void place_cells(merging *work, int *leaf_at)
{
  const fg__domain *domain = work->domain;
  fg__merge_tree *tree = work->tree;
  int count = domain->cells[0] * domain->cells[1];
  for (int raster = 0; raster < count; raster++) {
    leaf_at[raster] = -1;
    if (!domain->valid[raster])
      continue;
    int cell = leaf_at[raster] = tree->nodes++;
    tree->raster[cell] = raster;
    fg__merge_node *node = &tree->node[cell];
    *node = (fg__merge_node){.parent = -1, .child = {-1, -1}, .size = 1};
    fg__domain_center(domain, raster, node->position);
    for (int k = 0; k < 2; k++)
      node->vector[k] = fg__domain_direction(domain, raster)[k];
    work->up[cell] = cell;
    work->first[cell] = work->last[cell] = -1;
  }
}

static fg_status merge_all(merging *work, fg_context *context)
{
  fg__merge_tree *tree = work->tree;
  for (int cell = 0; cell < tree->cells; cell++)
    look_round(work, cell);
  while (work->heap_count > 0) {
    heap_entry entry = pop(work);
    if (tree->node[entry.cluster].parent >= 0)
      continue;
    if (tree->node[entry.neighbour].parent >= 0) {
      look_round(work, entry.cluster);
      continue;
    }
    merge(work, &entry);
    fg_status status =
        tree->nodes % STOP_INTERVAL == 0 ? fg__check_stop(context) : FG_STATUS_OK;
    if (status != FG_STATUS_OK)
      return status;
  }
  return FG_STATUS_OK;
}

fg_status fg__merge_tree_create(fg__merge_tree *out, fg_context *context,
                                const fg__domain *domain,
                                const fg__merge_weights *weights)
{
  size_t cells = (size_t)domain->valid_count, nodes = 2 * cells;
  size_t raster = (size_t)domain->cells[0] * (size_t)domain->cells[1];
  *out = (fg__merge_tree){.cells = (int)cells};
  merging work = {.tree = out, .domain = domain, .weights = weights};
  int *leaf_at = fg__allocate(raster, sizeof *leaf_at);
  int *numbers = fg__allocate(4 * nodes + 8 * cells, sizeof *numbers);
  out->raster = fg__allocate(cells, sizeof *out->raster);
  out->node = fg__allocate(nodes, sizeof *out->node);
  work.heap = fg__allocate(nodes, sizeof *work.heap);
  fg_status status = FG_STATUS_OK;
  if (!leaf_at || !numbers || !out->raster || !out->node || !work.heap) {
    status = fg__fail_memory(context, "the hierarchy of clusters",
                             nodes * (sizeof *out->node + sizeof *work.heap));
    goto cleanup;
  }
  work.up = numbers;
  work.first = numbers + nodes;
  work.last = numbers + 2 * nodes;
  work.seen = numbers + 3 * nodes;
  work.next = numbers + 4 * nodes;
  work.leaf = numbers + 4 * nodes + 4 * cells;
  place_cells(&work, leaf_at);
  find_neighbours(&work, leaf_at);
  status = merge_all(&work, context);
cleanup:
  free(leaf_at);
  free(numbers);
  free(work.heap);
  if (status != FG_STATUS_OK)
    fg__merge_tree_clear(out);
  return status;
}

void fg__merge_tree_clear(fg__merge_tree *tree)
{
  free(tree->raster);
  free(tree->node);
  *tree = (fg__merge_tree){0};
}
