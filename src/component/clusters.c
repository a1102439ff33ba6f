#include "component/clusters.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Fewer slices are not worth a slab of their own. */
enum { LEAST_SLICES = 4 };

/* What the threads work on. */
typedef struct task {
  fg__clusters *clusters;
  const fg__cluster_grid *grid;
  const float *u; /* NULL: 1 everywhere */
  bool counting;
} task;

static int outer_axis(const fg__clusters *c)
{
  return c->halo.partition->dimension - 1;
}

static fg_status fail_memory(fg_context *context, const fg__clusters *c)
{
  return fg__fail_memory(context, "the clusters", 2 * c->halo.size * sizeof *c->u);
}

/* Slices [begin, end) of the block with their ghosts along y. */
static void export_slices(const task *t, int begin, int end)
{
  const fg__layout *layout = t->grid->layout;
  const fg__halo *halo = &t->clusters->halo;
  for (int n = begin; n < end; ++n) {
    float *to = t->clusters->u + halo->first + n * halo->slice;
    if (layout->dimension == 2)
      fg__row_export(layout, t->u, n, 0, to);
    int ghosts = halo->ghost_rows;
    for (int j = -ghosts; j < layout->nodes[1] + ghosts && layout->dimension == 3; ++j)
      fg__row_export(layout, t->u, j, n, to + j * halo->row);
  }
}

static fg__component_box box_of(const fg__clusters *c, int slab)
{
  fg__component_box out = c->block;
  int axis = outer_axis(c), first = c->first[slab];
  out.first[axis] += first;
  out.nodes[axis] = c->first[slab + 1] - first;
  if (out.u)
    out.u += first * c->halo.slice;
  if (out.active)
    out.active += first * (axis == 2 ? out.cell_plane : out.cell_row);
  return out;
}

/* Failures are looked into by the caller, who has a context. */
static void cut(void *argument, const fg__thread *thread)
{
  const task *t = argument;
  fg__clusters *c = t->clusters;
  int slab = thread->index, slices = c->first[c->slabs];
  if (slab < c->slabs && t->u)
    export_slices(t, slab == 0 ? -1 : c->first[slab],
                  slab == c->slabs - 1 ? slices + 1 : c->first[slab + 1]);
  fg__threads_barrier(thread);
  if (slab >= c->slabs)
    return;
  fg__component_box box = box_of(c, slab);
  c->status[slab] = t->counting ? fg__components_cut(&c->slab[slab], NULL, &box)
                                : fg__components_cover(&c->slab[slab], NULL, &box);
}

static int *numbers_of(const fg__clusters *c, int slab)
{
  return c->number + c->halo.first + c->first[slab] * c->halo.slice;
}

/* Numbers follow each other from slab to slab. */
static void number(void *argument, const fg__thread *thread)
{
  const task *t = argument;
  const fg__clusters *c = t->clusters;
  if (thread->index >= c->slabs)
    return;
  fg__component_box box = box_of(c, thread->index);
  int before = c->before;
  for (int n = 0; n < thread->index; ++n)
    before += c->slab[n].piece_count;
  fg__components_number(&c->slab[thread->index], &box, before, false,
                        numbers_of(c, thread->index));
}

static void pair(void *argument, const fg__thread *thread)
{
  const task *t = argument;
  const fg__clusters *c = t->clusters;
  int slab = thread->index;
  if (slab >= c->slabs)
    return;
  fg__component_box box = box_of(c, slab);
  c->status[slab] = fg__components_pairs(&c->slab[slab], NULL, &box, numbers_of(c, slab));
}

/* One failure of all slabs, of all ranks. Collective. */
static fg_status agree(const fg__clusters *c, fg_context *context)
{
  const int *nodes = c->block.nodes;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < c->slabs && !status; ++n)
    if (c->status[n] == FG_STATUS_MEMORY)
      status = fail_memory(context, c);
    else if (c->status[n])
      status =
          fg__fail(context, c->status[n], "clusters: %d x %d x %d nodes are too many",
                   nodes[0], nodes[1], nodes[2]);
  return fg__ranks_agree(c->halo.partition->ranks, context, status);
}

/* The offset of this rank's `own` entries in a list of all ranks', which has `total`.
 * Collective. */
static void find_offset(const fg__clusters *c, size_t own, size_t *before, size_t *total)
{
  const fg__ranks *ranks = c->halo.partition->ranks;
  memset(c->table, 0, (size_t)ranks->count * sizeof *c->table);
  c->table[ranks->rank] = own;
  fg__ranks_add(ranks, c->table, ranks->count);
  *before = *total = 0;
  for (int r = 0; r < ranks->count; ++r) {
    *before += r < ranks->rank ? c->table[r] : 0;
    *total += c->table[r];
  }
}

/* All ranks' pieces and pairs on every rank: each fills in its own, which the others have
 * as zeros. Collective. */
static fg_status merge(fg__clusters *c, fg_context *context, size_t before, size_t pieces,
                       double debris_area)
{
  const fg__ranks *ranks = c->halo.partition->ranks;
  fg__components *all = &c->found;
  size_t own = 0, pairs, first_pair;
  for (int n = 0; n < c->slabs; ++n)
    own += c->slab[n].pair_count;
  find_offset(c, own, &first_pair, &pairs);
  fg_status status = FG_STATUS_OK;
  if (!fg__grow((void **)&all->piece, &all->piece_capacity, pieces, sizeof *all->piece) ||
      !fg__grow((void **)&all->pair, &all->pair_capacity, pairs, sizeof *all->pair))
    status = fail_memory(context, c);
  status = fg__ranks_agree(ranks, context, status);
  if (status)
    return status;
  if (pieces > 0)
    memset(all->piece, 0, pieces * sizeof *all->piece);
  if (pairs > 0)
    memset(all->pair, 0, pairs * sizeof *all->pair);
  for (int n = 0; n < c->slabs; ++n) {
    const fg__components *slab = &c->slab[n];
    if (slab->piece_count > 0)
      memcpy(all->piece + before, slab->piece,
             (size_t)slab->piece_count * sizeof *slab->piece);
    if (slab->pair_count > 0)
      memcpy(all->pair + first_pair, slab->pair, slab->pair_count * sizeof *slab->pair);
    before += (size_t)slab->piece_count;
    first_pair += slab->pair_count;
  }
  fg__ranks_combine(ranks, (uint32_t *)all->pair, (int)(2 * pairs));
  fg__ranks_add(ranks, (uint64_t *)all->piece, (int)(2 * pieces));
  all->piece_count = (int)pieces;
  all->pair_count = pairs;
  status = fg__components_merge(all, context, all->piece, all->piece_count, all->pair,
                                pairs, debris_area);
  return fg__ranks_agree(ranks, context, status);
}

/* Steps 2 to 5 of components.h. */
static fg_status join(task *t, fg_context *context, double debris_area)
{
  fg__clusters *c = t->clusters;
  size_t own = 0, before, total;
  for (int n = 0; n < c->slabs; ++n) {
    own += (size_t)c->slab[n].piece_count;
    c->slab[n].pair_count = 0;
  }
  find_offset(c, own, &before, &total);
  c->before = (int)before;
  if (c->number) {
    fg__threads_run(t->grid->threads, number, t);
    fg__halo_fill(&c->halo, c->number);
    fg__threads_run(t->grid->threads, pair, t);
    fg_status status = agree(c, context);
    if (status)
      return status;
  }
  return merge(c, context, before, total, debris_area);
}

static void describe(fg__component_box *block, const fg__cluster_grid *grid,
                     const fg__halo *halo)
{
  const fg__partition *partition = grid->partition;
  const fg__box *own = fg__own_block(partition);
  *block = (fg__component_box){.row = halo->row,
                               .plane = halo->slice,
                               .active = grid->active,
                               .cell_row = grid->cell_row,
                               .cell_plane = grid->cell_plane};
  for (int k = 0; k < 3; ++k) {
    block->grid_nodes[k] = partition->nodes[k];
    block->periodic[k] = partition->periodic[k];
    block->first[k] = own->first[k];
    block->nodes[k] = own->nodes[k];
  }
}

static bool take_memory(fg__clusters *c, const fg__ranks *ranks, int slabs)
{
  size_t count = (size_t)slabs;
  bool divided = slabs > 1 || ranks->count > 1;
  c->slab = fg__allocate(count, sizeof *c->slab);
  c->first = fg__allocate(count + 1, sizeof *c->first);
  c->status = fg__allocate(count, sizeof *c->status);
  c->table = fg__allocate((size_t)ranks->count, sizeof *c->table);
  c->u = fg__allocate(c->halo.size, sizeof *c->u);
  c->number = divided ? fg__allocate(c->halo.size, sizeof *c->number) : NULL;
  return c->slab && c->first && c->status && c->table && c->u && (c->number || !divided);
}

static fg_status prepare(fg__clusters *c, fg_context *context,
                         const fg__cluster_grid *grid)
{
  int slices = grid->layout->nodes[grid->partition->dimension - 1];
  int most = slices / LEAST_SLICES, slabs = fg__threads_count(grid->threads);
  slabs = slabs < most ? slabs : most;
  slabs = slabs < 1 ? 1 : slabs;
  if (c->slabs == slabs)
    return FG_STATUS_OK;
  fg__clusters_clear(c);
  fg_status status = fg__halo_create(&c->halo, context, grid->partition);
  if (!status && !take_memory(c, grid->partition->ranks, slabs))
    status = fail_memory(context, c);
  if (status) { /* or the next call would take it for prepared */
    fg__clusters_clear(c);
    return status;
  }
  c->slabs = slabs;
  for (int n = 0; n <= slabs; ++n)
    c->first[n] = (int)((int64_t)slices * n / slabs);
  return FG_STATUS_OK;
}

fg_status fg__clusters_find(fg__clusters *clusters, fg_context *context,
                            const fg__cluster_grid *grid, const float *u,
                            const fg__cluster_request *request)
{
  fg__clusters *c = clusters;
  const fg__ranks *ranks = grid->partition->ranks;
  task t = {.clusters = c, .grid = grid, .u = u, .counting = request->counting};
  fg_status status = prepare(c, context, grid);
  status = fg__ranks_agree(ranks, context, status);
  if (status)
    return status;
  describe(&c->block, grid, &c->halo);
  c->block.u = u ? c->u + c->halo.first : NULL;
  c->block.exact_below = request->exact_below;
  fg__threads_run(grid->threads, cut, &t);
  status = agree(c, context);
  if (status)
    return status;
  double covered = 0.0;
  for (int n = 0; n < c->slabs; ++n)
    covered += c->slab[n].covered;
  uint64_t eighths = (uint64_t)(8.0 * covered); /* covered is a multiple of 1/8 */
  fg__ranks_add(ranks, &eighths, 1);
  c->covered = (double)eighths / 8.0;
  return request->counting ? join(&t, context, request->debris_area) : FG_STATUS_OK;
}

void fg__clusters_label(const fg__clusters *clusters, int *label)
{
  const fg__clusters *c = clusters;
  int before = c->before;
  for (int n = 0; n < c->slabs; ++n) {
    fg__component_box box = box_of(c, n);
    box.row = box.nodes[0];
    box.plane = box.row * box.nodes[1];
    fg__components_label(&c->slab[n], &box, c->found.piece_label, before, label);
    label += box.plane * box.nodes[2];
    before += c->slab[n].piece_count;
  }
}

void fg__clusters_clear(fg__clusters *clusters)
{
  fg__clusters *c = clusters;
  for (int n = 0; n < c->slabs; ++n)
    fg__components_clear(&c->slab[n]);
  fg__components_clear(&c->found);
  fg__halo_clear(&c->halo);
  free(c->slab);
  free(c->first);
  free(c->status);
  free(c->table);
  free(c->u);
  free(c->number);
  *c = (fg__clusters){0};
}
