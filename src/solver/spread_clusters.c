#include "solver/spread_clusters.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Floats of a block with its ring. */
static size_t ring_size(const fg__level *block)
{
  const int *nodes = block->layout.nodes;
  size_t size = (size_t)(nodes[0] + 2) * (size_t)(nodes[1] + 2);
  return block->layout.dimension == 3 ? size * (size_t)(nodes[2] + 2) : size;
}

static fg__component_box describe(const fg__spread *spread)
{
  const fg__box *place = fg__own_block(&spread->partition);
  const fg__cells_of_box *cells = &spread->block.tensor;
  fg__component_box out = {
      .row = place->nodes[0] + 2, .cell_row = cells->row, .cell_plane = cells->plane};
  out.plane = out.row * (place->nodes[1] + 2);
  for (int k = 0; k < 3; ++k) {
    out.grid_nodes[k] = spread->partition.nodes[k];
    out.periodic[k] = spread->partition.periodic[k];
    out.first[k] = place->first[k];
    out.nodes[k] = place->nodes[k];
  }
  return out;
}

/* Where node (0, 0, 0) lies in a block with its ring. */
static ptrdiff_t origin_of(const fg__component_box *grid, int dimension)
{
  return 1 + grid->row + (dimension == 3 ? grid->plane : 0);
}

static bool copy_mask(fg__spread_clusters *c, const fg__spread *spread)
{
  if (!spread->masked)
    return true;
  ptrdiff_t origin;
  c->active = fg__cells_mask(&spread->block.tensor, &origin);
  if (c->active)
    c->grid.active = c->active + origin;
  return c->active;
}

static fg_status prepare(fg__spread_clusters *c, fg_context *context,
                         const fg__spread *spread)
{
  size_t size = ring_size(&spread->block);
  c->u = fg__allocate(size, sizeof *c->u);
  c->number = fg__allocate(size, sizeof *c->number);
  c->grid = describe(spread);
  if (c->u && c->number && copy_mask(c, spread))
    return FG_STATUS_OK;
  fg__spread_clusters_clear(c); /* or the next call would take it for prepared */
  return fg__fail_memory(context, "the clusters",
                         size * (sizeof *c->u + sizeof *c->number));
}

/* A block's density to an array with a ring. */
static void export_ring(const fg__level *block, const float *u, float *ring)
{
  const fg__layout *layout = &block->layout;
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

/* Numbers of pieces, which travel as floats do: a block's outermost nodes from an array
 * with a ring, or the ring to it. */
static void copy_sides(const fg__level *block, void *in_layout, void *in_ring,
                       bool to_ring)
{
  const int *nodes = block->layout.nodes;
  int solid = block->layout.dimension == 3, low = to_ring ? -1 : 0;
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
        float *a = (float *)in_layout + fg__node_at(&block->layout, i, j, k);
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
  uint64_t *words = fg__allocate((size_t)pair_count, sizeof *words);
  fg__component_piece *piece = fg__allocate((size_t)piece_count, sizeof *piece);
  fg__component_pair *pair = fg__allocate((size_t)pair_count, sizeof *pair);
  fg_status status = FG_STATUS_OK;
  if (!words || !piece || !pair)
    status = fg__fail_memory(context, "the clusters",
                             (size_t)pair_count * (sizeof *words + sizeof *pair) +
                                 (size_t)piece_count * sizeof *piece);
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    const fg__components *own = &c->pieces;
    for (size_t n = 0; n < own->pair_count; ++n)
      words[before_pairs + n] =
          (uint64_t)own->pair[n].low << 32 | (uint64_t)(uint32_t)own->pair[n].high;
    fg__ranks_add(ranks, words, (int)pair_count);
    for (uint64_t n = 0; n < pair_count; ++n)
      pair[n] = (fg__component_pair){(int)(words[n] >> 32), (int)(uint32_t)words[n]};
    for (uint64_t n = 0; n < piece_count; ++n)
      piece[n] =
          (fg__component_piece){(int64_t)pieces[2 * n], (int64_t)pieces[2 * n + 1]};
    status = fg__components_merge(&c->whole, context, piece, (int)piece_count, pair,
                                  (size_t)pair_count, debris_area);
    status = fg__ranks_agree(ranks, context, status);
  }
  free(words);
  free(piece);
  free(pair);
  return status;
}

/* Steps 2 to 5 of component/components.h. */
static fg_status number_and_join(fg__spread_clusters *c, fg_context *context,
                                 const fg__spread *spread, float *scratch,
                                 double debris_area)
{
  const fg__ranks *ranks = spread->partition.ranks;
  const fg__level *block = &spread->block;
  const fg__components *own = &c->pieces;
  uint64_t before, total, before_pairs, pair_count;
  fg_status status =
      find_places(context, ranks, (uint64_t)own->piece_count, &before, &total);
  if (status)
    return status;
  c->before = (int)before;
  int *number = c->number + origin_of(&c->grid, block->layout.dimension);
  fg__components_number(own, &c->grid, c->before, false, number);
  copy_sides(block, scratch, c->number, false);
  /* no mirror image is asked for */
  fg__spread_exchange_ends(spread, 1, &scratch);
  copy_sides(block, scratch, c->number, true);
  status = fg__components_pairs(&c->pieces, context, &c->grid, number);
  uint64_t *pieces = fg__allocate(2 * (size_t)total, sizeof *pieces);
  if (!status && !pieces)
    status = fg__fail_memory(context, "the clusters", 2 * (size_t)total * sizeof *pieces);
  status = fg__ranks_agree(ranks, context, status);
  if (!status)
    status = find_places(context, ranks, (uint64_t)own->pair_count, &before_pairs,
                         &pair_count);
  if (!status) {
    uint64_t *to = pieces + 2 * before;
    for (int n = 0; n < own->piece_count; ++n) {
      *to++ = (uint64_t)own->piece[n].first;
      *to++ = (uint64_t)own->piece[n].size;
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
  fg_status status = c->u ? FG_STATUS_OK : prepare(c, context, spread);
  if (!status) {
    c->grid.u = NULL;
    if (u) {
      export_ring(&spread->block, u, c->u);
      c->grid.u = c->u + origin_of(&c->grid, spread->block.layout.dimension);
    }
    status = counting ? fg__components_cut(&c->pieces, context, &c->grid)
                      : fg__components_cover(&c->pieces, context, &c->grid);
  }
  status = fg__ranks_agree(ranks, context, status);
  if (status)
    return status;
  /* multiples of 1/8 */
  uint64_t eighths = (uint64_t)(8.0 * c->pieces.covered);
  fg__ranks_add(ranks, &eighths, 1);
  c->covered = (double)eighths / 8.0;
  return counting ? number_and_join(c, context, spread, scratch, debris_area)
                  : FG_STATUS_OK;
}

void fg__spread_clusters_label(const fg__spread_clusters *clusters, int *label)
{
  const fg__spread_clusters *c = clusters;
  fg__component_box plain = c->grid;
  plain.row = plain.nodes[0];
  plain.plane = plain.row * plain.nodes[1];
  fg__components_label(&c->pieces, &plain, c->whole.piece_label, c->before, label);
}

void fg__spread_clusters_clear(fg__spread_clusters *clusters)
{
  fg__components_clear(&clusters->pieces);
  fg__components_clear(&clusters->whole);
  free(clusters->u);
  free(clusters->number);
  free(clusters->active);
  *clusters = (fg__spread_clusters){0};
}
