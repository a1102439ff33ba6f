#include "evolve/spread_clusters.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Floats of a box with its ring. */
static size_t ring_size(const fg__level *box)
{
  const int *nodes = box->layout.nodes;
  size_t size = (size_t)(nodes[0] + 2) * (size_t)(nodes[1] + 2);
  return box->layout.dimension == 3 ? size * (size_t)(nodes[2] + 2) : size;
}

static void describe(fg__component_box *out, const fg__spread *spread, int b)
{
  const fg__box *place = &fg__own_boxes(&spread->partition, &(int){0})[b];
  const fg__cells_of_box *cells = &spread->box[b].tensor;
  *out = (fg__component_box){
      .row = place->nodes[0] + 2, .cell_row = cells->row, .cell_plane = cells->plane};
  out->plane = out->row * (place->nodes[1] + 2);
  for (int k = 0; k < 3; ++k) {
    out->grid_nodes[k] = spread->partition.nodes[k];
    out->periodic[k] = spread->partition.periodic[k];
    out->first[k] = place->first[k];
    out->nodes[k] = place->nodes[k];
  }
}

/* Where node (0, 0, 0) lies in a box with its ring. */
static ptrdiff_t origin_of(const fg__component_box *grid, int dimension)
{
  return 1 + grid->row + (dimension == 3 ? grid->plane : 0);
}

static bool copy_mask(fg__spread_clusters *c, const fg__spread *spread, int b)
{
  if (!spread->masked)
    return true;
  ptrdiff_t origin;
  c->active[b] = fg__cells_mask(&spread->box[b].tensor, &origin);
  if (c->active[b])
    c->grid[b].active = c->active[b] + origin;
  return c->active[b];
}

static fg_status prepare(fg__spread_clusters *c, fg_context *context,
                         const fg__spread *spread)
{
  size_t count = (size_t)spread->count, bytes = count * sizeof *c->box;
  c->count = spread->count;
  c->box = fg__allocate(count, sizeof *c->box);
  c->u = fg__allocate(count, sizeof *c->u);
  c->number = fg__allocate(count, sizeof *c->number);
  c->active = fg__allocate(count, sizeof *c->active);
  c->grid = fg__allocate(count, sizeof *c->grid);
  bool whole = c->box && c->u && c->number && c->active && c->grid;
  for (int b = 0; b < c->count && whole; ++b) {
    size_t size = ring_size(&spread->box[b]);
    bytes = size * (sizeof *c->u[b] + sizeof *c->number[b]);
    c->u[b] = fg__allocate(size, sizeof *c->u[b]);
    c->number[b] = fg__allocate(size, sizeof *c->number[b]);
    describe(&c->grid[b], spread, b);
    whole = c->u[b] && c->number[b] && copy_mask(c, spread, b);
  }
  if (whole)
    return FG_STATUS_OK;
  fg__spread_clusters_clear(c); /* or the next call would take it for prepared */
  return fg__fail_memory(context, "the clusters", bytes);
}

/* A box's density to an array with a ring. */
static void export_ring(const fg__level *box, const float *u, float *ring)
{
  const fg__layout *layout = &box->layout;
  const int *nodes = layout->nodes;
  int solid = layout->dimension == 3;
  for (int k = -solid; k < nodes[2] + solid; ++k)
    for (int j = -1; j <= nodes[1]; ++j, ring += nodes[0] + 2) {
      const float *row = u + fg__row_at(layout, j, k);
      ring[0] = row[fg__column(layout, -1)];
      fg__row_export(layout, u, j, k, ring + 1);
      ring[nodes[0] + 1] = row[fg__column(layout, nodes[0])];
    }
}

/* Numbers of pieces, which travel as floats do: a box's outermost nodes from an array
 * with a ring, or the ring to it. */
static void copy_sides(const fg__level *box, void *in_layout, void *in_ring, bool to_ring)
{
  const int *nodes = box->layout.nodes;
  int solid = box->layout.dimension == 3, low = to_ring ? -1 : 0;
  int last[3];
  for (int axis = 0; axis < 3; ++axis)
    last[axis] = nodes[axis] - 1 - low;
  int first_plane = solid ? low : 0, last_plane = solid ? last[2] : 0;
  ptrdiff_t row = nodes[0] + 2, plane = row * (nodes[1] + 2);
  for (int k = first_plane; k <= last_plane; ++k)
    for (int j = low; j <= last[1]; ++j) {
      bool all = j == low || j == last[1] || (solid && (k == low || k == last[2]));
      float *ring = (float *)in_ring + (k + solid) * plane + (j + 1) * row + 1;
      for (int i = low; i <= last[0]; i += all || i == last[0] ? 1 : last[0] - low) {
        float *a = (float *)in_layout + fg__node_at(&box->layout, i, j, k);
        if (to_ring)
          memcpy(ring + i, a, sizeof *a);
        else
          memcpy(a, ring + i, sizeof *a);
      }
    }
}

/* This rank's places in a table of all ranks', `own` of `total`: it fills those, and the
 * others, which add nothing to them, do likewise. Collective. */
static fg_status find_places(fg_context *context, const fg__ranks *ranks, uint64_t own,
                             uint64_t *before, uint64_t *total)
{
  uint64_t *counts = fg__allocate((size_t)ranks->count, sizeof *counts);
  fg_status status = FG_STATUS_OK;
  if (!counts)
    status =
        fg__fail_memory(context, "the clusters", (size_t)ranks->count * sizeof *counts);
  status = fg__ranks_agree(ranks, context, status);
  *before = *total = 0;
  if (!status) {
    counts[ranks->rank] = own;
    fg__ranks_add(ranks, counts, ranks->count);
    for (int r = 0; r < ranks->count; ++r) {
      *before += r < ranks->rank ? counts[r] : 0;
      *total += counts[r];
    }
  }
  free(counts);
  return status;
}

static fg_status join(fg__spread_clusters *c, fg_context *context,
                      const fg__spread *spread, const uint64_t *pieces,
                      uint64_t piece_count, uint64_t before_pairs, uint64_t pair_count,
                      double debris_area)
{
  const fg__ranks *ranks = spread->partition.ranks;
  uint64_t *words = fg__allocate(pair_count, sizeof *words);
  fg__component_piece *piece = fg__allocate(piece_count, sizeof *piece);
  fg__component_pair *pair = fg__allocate(pair_count, sizeof *pair);
  fg_status status = FG_STATUS_OK;
  if (!words || !piece || !pair)
    status = fg__fail_memory(context, "the clusters",
                             pair_count * (sizeof *words + sizeof *pair) +
                                 piece_count * sizeof *piece);
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    uint64_t at = before_pairs;
    for (int b = 0; b < c->count; ++b)
      for (size_t n = 0; n < c->box[b].pair_count; ++n)
        words[at++] = (uint64_t)c->box[b].pair[n].low << 32 |
                      (uint64_t)(uint32_t)c->box[b].pair[n].high;
    fg__ranks_add(ranks, words, (int)pair_count);
    for (uint64_t n = 0; n < pair_count; ++n)
      pair[n] = (fg__component_pair){(int)(words[n] >> 32), (int)(uint32_t)words[n]};
    for (uint64_t n = 0; n < piece_count; ++n)
      piece[n] =
          (fg__component_piece){(int64_t)pieces[2 * n], (int64_t)pieces[2 * n + 1]};
    status = fg__components_merge(&c->whole, context, piece, (int)piece_count, pair,
                                  pair_count, debris_area);
    status = fg__ranks_agree(ranks, context, status);
  }
  free(words);
  free(piece);
  free(pair);
  return status;
}

/* Steps 2 to 5 of components.h. */
static fg_status number_and_join(fg__spread_clusters *c, fg_context *context,
                                 const fg__spread *spread, float *scratch,
                                 double debris_area)
{
  const fg__ranks *ranks = spread->partition.ranks;
  uint64_t own = 0, before, total, before_pairs, pair_count;
  for (int b = 0; b < c->count; ++b)
    own += (uint64_t)c->box[b].piece_count;
  fg_status status = find_places(context, ranks, own, &before, &total);
  if (status)
    return status;
  c->before = (int)before;
  uint64_t at = before;
  for (int b = 0; b < c->count; ++b) {
    ptrdiff_t origin = origin_of(&c->grid[b], spread->box[b].layout.dimension);
    fg__components_number(&c->box[b], &c->grid[b], (int)at, false, c->number[b] + origin);
    copy_sides(&spread->box[b], scratch + spread->offset[b], c->number[b], false);
    at += (uint64_t)c->box[b].piece_count;
  }
  /* no image of a border is asked for */
  fg__spread_exchange_ends(spread, 1, &scratch);
  uint64_t pairs = 0;
  for (int b = 0; b < c->count && !status; ++b) {
    ptrdiff_t origin = origin_of(&c->grid[b], spread->box[b].layout.dimension);
    copy_sides(&spread->box[b], scratch + spread->offset[b], c->number[b], true);
    status =
        fg__components_pairs(&c->box[b], context, &c->grid[b], c->number[b] + origin);
    pairs += c->box[b].pair_count;
  }
  uint64_t *pieces = fg__allocate(2 * total, sizeof *pieces);
  if (!status && !pieces)
    status = fg__fail_memory(context, "the clusters", 2 * total * sizeof *pieces);
  status = fg__ranks_agree(ranks, context, status);
  if (!status)
    status = find_places(context, ranks, pairs, &before_pairs, &pair_count);
  if (!status) {
    at = 2 * before;
    for (int b = 0; b < c->count; ++b)
      for (int n = 0; n < c->box[b].piece_count; ++n) {
        pieces[at++] = (uint64_t)c->box[b].piece[n].first;
        pieces[at++] = (uint64_t)c->box[b].piece[n].size;
      }
    fg__ranks_add(ranks, pieces, (int)(2 * total));
    status =
        join(c, context, spread, pieces, total, before_pairs, pair_count, debris_area);
  }
  free(pieces);
  return status;
}

fg_status fg__spread_clusters_find(fg__spread_clusters *clusters, fg_context *context,
                                   const fg__spread *spread, const float *u,
                                   float *scratch, double debris_area, bool counting)
{
  fg__spread_clusters *c = clusters;
  const fg__ranks *ranks = spread->partition.ranks;
  fg_status status = c->grid ? FG_STATUS_OK : prepare(c, context, spread);
  double covered = 0.0;
  for (int b = 0; b < c->count && !status; ++b) {
    c->grid[b].u = NULL;
    if (u) {
      export_ring(&spread->box[b], u + spread->offset[b], c->u[b]);
      c->grid[b].u = c->u[b] + origin_of(&c->grid[b], spread->box[b].layout.dimension);
    }
    status = counting ? fg__components_cut(&c->box[b], context, &c->grid[b])
                      : fg__components_cover(&c->box[b], context, &c->grid[b]);
    covered += c->box[b].covered;
  }
  status = fg__ranks_agree(ranks, context, status);
  if (status)
    return status;
  /* multiples of 1/8 */
  uint64_t eighths = (uint64_t)(8.0 * covered);
  fg__ranks_add(ranks, &eighths, 1);
  c->covered = (double)eighths / 8.0;
  return counting ? number_and_join(c, context, spread, scratch, debris_area)
                  : FG_STATUS_OK;
}

void fg__spread_clusters_label(const fg__spread_clusters *clusters, int b, int *label)
{
  const fg__spread_clusters *c = clusters;
  fg__component_box plain = c->grid[b];
  plain.row = plain.nodes[0];
  plain.plane = plain.row * plain.nodes[1];
  int before = c->before;
  for (int n = 0; n < b; ++n)
    before += c->box[n].piece_count;
  fg__components_label(&c->box[b], &plain, c->whole.piece_label, before, label);
}

void fg__spread_clusters_clear(fg__spread_clusters *clusters)
{
  fg__spread_clusters *c = clusters;
  for (int b = 0; b < c->count; ++b) {
    if (c->box)
      fg__components_clear(&c->box[b]);
    if (c->u)
      free(c->u[b]);
    if (c->number)
      free(c->number[b]);
    if (c->active)
      free(c->active[b]);
  }
  fg__components_clear(&c->whole);
  free(c->box);
  free(c->u);
  free(c->number);
  free(c->active);
  free(c->grid);
  *c = (fg__spread_clusters){0};
}
