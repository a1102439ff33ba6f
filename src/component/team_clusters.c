#include "component/team_clusters.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Fewer slices are not worth a slab of their own. */
enum { LEAST_SLICES = 4 };

/* What the team works on. */
typedef struct task {
  fg__team_clusters *clusters;
  const fg__layout *layout;
  const float *u;
  fg__component_box grid; /* the whole */
  int slices, axis;       /* along the outermost axis */
  size_t slice;           /* nodes of one */
  bool counting;
} task;

static float *plain_slice(const task *t, int slice)
{
  return t->clusters->u + (size_t)(slice + 1) * t->slice;
}

static int *number_slice(const task *t, int slice)
{
  return t->clusters->number + (size_t)(slice + 1) * t->slice;
}

/* Copies what lies beyond the ends of a periodic axis to the slices kept for it: of u or
 * of the numbers, both 4 bytes a node. */
static void wrap(const task *t, void *array, int slice)
{
  unsigned char *at = array;
  size_t bytes = t->slice * sizeof(float);
  if (t->grid.periodic[t->axis] && slice == 0)
    memcpy(at + (size_t)(t->slices + 1) * bytes, at + bytes, bytes);
  if (t->grid.periodic[t->axis] && slice == t->slices - 1)
    memcpy(at, at + (size_t)t->slices * bytes, bytes);
}

static void export_slab(const task *t, int begin, int end)
{
  for (int n = begin; n < end; ++n) {
    float *to = plain_slice(t, n);
    if (t->layout->dimension == 2)
      fg__row_export(t->layout, t->u, n, 0, to);
    for (int j = 0; j < t->layout->nodes[1] && t->layout->dimension == 3; ++j)
      fg__row_export(t->layout, t->u, j, n, to + (size_t)j * (size_t)t->grid.row);
    wrap(t, t->clusters->u, n);
  }
}

static fg__component_box box_of(const task *t, int slab)
{
  const int *first = t->clusters->first;
  fg__component_box out = t->grid;
  out.first[t->axis] = first[slab];
  out.nodes[t->axis] = first[slab + 1] - first[slab];
  out.u = plain_slice(t, first[slab]);
  if (out.active)
    out.active += first[slab] * (t->axis == 2 ? out.cell_plane : out.cell_row);
  return out;
}

static bool has_failed(const fg__team_clusters *c)
{
  for (int n = 0; n < c->slabs; ++n)
    if (c->status[n])
      return true;
  return false;
}

/* Numbers follow each other from slab to slab. */
static void number_slab(const task *t, int slab, const fg__component_box *box)
{
  fg__team_clusters *c = t->clusters;
  int before = 0, begin = c->first[slab], end = c->first[slab + 1];
  for (int n = 0; n < slab; ++n)
    before += c->slab[n].piece_count;
  fg__components_number(&c->slab[slab], box, before, false, number_slice(t, begin));
  wrap(t, c->number, begin);
  wrap(t, c->number, end - 1);
}

/* Failures are looked into by the caller, who has a context. */
static void work(void *argument, const fg__share *share)
{
  const task *t = argument;
  fg__team_clusters *c = t->clusters;
  int slab = share->member;
  bool mine = slab < c->slabs;
  fg__component_box box = {.row = 0};
  if (mine) {
    export_slab(t, c->first[slab], c->first[slab + 1]);
    box = box_of(t, slab);
  }
  fg__team_barrier(share);
  if (mine)
    c->status[slab] = t->counting ? fg__components_cut(&c->slab[slab], NULL, &box)
                                  : fg__components_cover(&c->slab[slab], NULL, &box);
  fg__team_barrier(share);
  if (!t->counting || c->slabs == 1 || has_failed(c))
    return;
  if (mine)
    number_slab(t, slab, &box);
  fg__team_barrier(share);
  if (mine)
    c->status[slab] =
        fg__components_pairs(&c->slab[slab], NULL, &box, number_slice(t, c->first[slab]));
}

/* All pieces and pairs, one slab behind the other. */
static fg_status merge(fg__team_clusters *c, fg_context *context, double debris_area)
{
  fg__components *all = &c->whole;
  size_t pieces = 0, pairs = 0;
  for (int n = 0; n < c->slabs; ++n) {
    pieces += (size_t)c->slab[n].piece_count;
    pairs += c->slabs > 1 ? c->slab[n].pair_count : 0;
  }
  void *piece = all->piece, *pair = all->pair;
  bool grown = fg__grow(&piece, &all->piece_capacity, pieces, sizeof *all->piece) &&
               fg__grow(&pair, &all->pair_capacity, pairs, sizeof *all->pair);
  all->piece = piece;
  all->pair = pair;
  if (!grown)
    return fg__fail_memory(context, "clusters",
                           pieces * sizeof *all->piece + pairs * sizeof *all->pair);
  pieces = pairs = 0;
  for (int n = 0; n < c->slabs; ++n) {
    const fg__components *slab = &c->slab[n];
    size_t met = c->slabs > 1 ? slab->pair_count : 0;
    if (slab->piece_count > 0)
      memcpy(all->piece + pieces, slab->piece,
             (size_t)slab->piece_count * sizeof *slab->piece);
    if (met > 0)
      memcpy(all->pair + pairs, slab->pair, met * sizeof *slab->pair);
    pieces += (size_t)slab->piece_count;
    pairs += met;
  }
  all->piece_count = (int)pieces;
  all->pair_count = pairs;
  return fg__components_merge(all, context, all->piece, all->piece_count, all->pair,
                              pairs, debris_area);
}

static int slab_count(const task *t, fg__team *team)
{
  /* a slab's ring of the mask is not in memory beyond a periodic end */
  if (t->grid.active && t->grid.periodic[t->axis])
    return 1;
  int members = fg__team_members(team), most = t->slices / LEAST_SLICES;
  int slabs = members < most ? members : most;
  return slabs < 1 ? 1 : slabs;
}

static fg_status prepare(const task *t, fg_context *context, int slabs)
{
  fg__team_clusters *c = t->clusters;
  if (c->slabs != slabs) {
    fg__team_clusters_clear(c);
    size_t count = (size_t)slabs, nodes = (size_t)(t->slices + 2) * t->slice;
    c->slab = fg__allocate(count, sizeof *c->slab);
    c->first = fg__allocate(count + 1, sizeof *c->first);
    c->status = fg__allocate(count, sizeof *c->status);
    c->u = fg__allocate(nodes, sizeof *c->u);
    c->number = slabs > 1 ? fg__allocate(nodes, sizeof *c->number) : NULL;
    if (!c->slab || !c->first || !c->status || !c->u || (slabs > 1 && !c->number)) {
      fg__team_clusters_clear(c);
      return fg__fail_memory(context, "the clusters", 2 * nodes * sizeof *c->u);
    }
    c->slabs = slabs;
  }
  for (int n = 0; n <= slabs; ++n)
    c->first[n] = (int)((int64_t)t->slices * n / slabs);
  return FG_STATUS_OK;
}

fg_status fg__team_clusters_find(fg__team_clusters *clusters, fg_context *context,
                                 fg__team *team, const fg__layout *layout,
                                 const bool periodic[3], const float *u,
                                 const unsigned char *active, double debris_area,
                                 bool counting)
{
  fg__team_clusters *c = clusters;
  task t = {.clusters = c, .layout = layout, .u = u, .counting = counting};
  fg__component_grid grid = {.active = active};
  for (int k = 0; k < 3; ++k) {
    grid.nodes[k] = layout->nodes[k];
    grid.periodic[k] = periodic[k];
  }
  t.grid = fg__component_box_of(&grid);
  t.grid.enough = debris_area;
  t.axis = layout->dimension - 1;
  t.slices = layout->nodes[t.axis];
  t.slice = (size_t)(t.axis == 2 ? t.grid.plane : t.grid.row);
  fg_status status = prepare(&t, context, slab_count(&t, team));
  if (status)
    return status;
  fg__team_run(team, work, &t);
  c->covered = 0.0; /* eighths: their sum is exact */
  for (int n = 0; n < c->slabs; ++n) {
    c->covered += c->slab[n].covered;
    if (c->status[n] == FG_STATUS_MEMORY)
      return fg__fail_memory(context, "the clusters", t.slice * sizeof(float));
    if (c->status[n])
      return fg__fail(context, c->status[n], "clusters: %d x %d x %d nodes are too many",
                      grid.nodes[0], grid.nodes[1], grid.nodes[2]);
  }
  return counting ? merge(c, context, debris_area) : FG_STATUS_OK;
}

void fg__team_clusters_clear(fg__team_clusters *clusters)
{
  fg__team_clusters *c = clusters;
  for (int n = 0; n < c->slabs; ++n)
    fg__components_clear(&c->slab[n]);
  fg__components_clear(&c->whole);
  free(c->slab);
  free(c->first);
  free(c->status);
  free(c->u);
  free(c->number);
  *c = (fg__team_clusters){0};
}
