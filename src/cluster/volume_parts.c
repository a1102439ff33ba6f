#include "cluster/volume.h"

#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"
#include "cluster/stretch.h"

/* A box of the window's nodes between neighbouring borders of the domain. */
typedef struct piece {
  fg__stretch range[3];
  int order;     /* x fastest */
  size_t inside; /* nodes of the cluster */
} piece;

static int count_stretches(const fg_density_arrays *density, const fg__volume *volume,
                           int k)
{
  fg__stretch range;
  int count = 0;
  while (fg__stretch_find(&range, density, k, volume->origin[k], volume->nodes[k], count))
    ++count;
  return count;
}

static size_t count_nodes(const fg__volume *volume, const fg__stretch range[3])
{
  size_t count = 0;
  for (int z = range[2].first; z <= range[2].last; ++z)
    for (int y = range[1].first; y <= range[1].last; ++y)
      for (int x = range[0].first; x <= range[0].last; ++x)
        count += volume->level[fg__volume_node(volume, x, y, z)] > 0.0F;
  return count;
}

/* All pieces, x fastest; *piece is allocated. */
static fg_status find_pieces(piece **out, int *count, fg_context *context,
                             const fg_density_arrays *density, const fg__volume *whole)
{
  int along[3];
  for (int k = 0; k < 3; ++k)
    along[k] = count_stretches(density, whole, k);
  *count = along[0] * along[1] * along[2];
  *out = fg__allocate((size_t)*count, sizeof **out);
  if (!*out)
    return fg__fail_memory(context, "parts of a cluster", (size_t)*count * sizeof **out);
  for (int n = 0; n < *count; ++n) {
    piece *p = &(*out)[n];
    const int at[3] = {n % along[0], n / along[0] % along[1], n / along[0] / along[1]};
    p->order = n;
    for (int k = 0; k < 3; ++k)
      fg__stretch_find(&p->range[k], density, k, whole->origin[k], whole->nodes[k],
                       at[k]);
    p->inside = count_nodes(whole, p->range);
  }
  return FG_STATUS_OK;
}

static int by_size(const void *a, const void *b)
{
  const piece *p = a, *q = b;
  if (p->inside != q->inside)
    return p->inside < q->inside ? 1 : -1;
  return p->order - q->order;
}

static int by_place(const void *a, const void *b)
{
  const piece *p = a, *q = b;
  return p->order - q->order;
}

static fg_status take(fg__volume *out, fg_context *context,
                      const fg_density_arrays *density, const fg__volume *whole,
                      const fg__stretch range[3])
{
  *out = (fg__volume){.cluster = whole->cluster};
  size_t cells = 1;
  for (int k = 0; k < 3; ++k) {
    const fg__stretch *r = &range[k];
    bool from_start = r->first == 0, to_end = r->last == whole->nodes[k] - 1;
    out->nodes[k] = r->last - r->first + 1;
    out->spacing[k] = whole->spacing[k];
    out->origin[k] = density->origin[k] + r->start * density->spacing[k];
    out->at_border[2 * k] = from_start ? whole->at_border[2 * k] : true;
    out->at_border[2 * k + 1] = to_end ? whole->at_border[2 * k + 1] : true;
    cells *= (size_t)out->nodes[k] - 1;
  }
  size_t nodes = fg__volume_count(out), wide = (size_t)out->nodes[0];
  out->level = fg__allocate(nodes, sizeof *out->level);
  out->active = fg__allocate(cells, 1);
  if (!out->level || !out->active)
    return fg__fail_memory(context, "a cluster's window", nodes * sizeof *out->level);
  int first = range[0].first;
  for (int z = 0; z < out->nodes[2]; ++z)
    for (int y = 0; y < out->nodes[1]; ++y) {
      int from_y = range[1].first + y, from_z = range[2].first + z;
      memcpy(out->level + fg__volume_node(out, 0, y, z),
             whole->level + fg__volume_node(whole, first, from_y, from_z),
             wide * sizeof *out->level);
      if (y + 1 < out->nodes[1] && z + 1 < out->nodes[2])
        memcpy(out->active + fg__volume_cell(out, 0, y, z),
               whole->active + fg__volume_cell(whole, first, from_y, from_z), wide - 1);
    }
  return fg__volume_keep_largest(out, context);
}

fg_status fg__volume_divide(fg__volume_part part[FG__VOLUME_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__volume *whole)
{
  piece *pieces = NULL;
  int found, wanted = 0;
  *count = 0;
  fg_status status = find_pieces(&pieces, &found, context, density, whole);
  if (!status && found == 1) {
    part[(*count)++] = (fg__volume_part){*whole, 1.0};
    *whole = (fg__volume){0};
  } else if (!status) {
    double all = 0.0;
    for (int n = 0; n < found; ++n)
      all += (double)pieces[n].inside;
    double least = all * fg__stretch_least(labels, whole->cluster);
    qsort(pieces, (size_t)found, sizeof *pieces, by_size);
    while (wanted < found && wanted < FG__VOLUME_PARTS &&
           (wanted == 0 || (double)pieces[wanted].inside >= least))
      ++wanted;
    qsort(pieces, (size_t)wanted, sizeof *pieces, by_place);
    for (int n = 0; n < wanted && !status; ++n) {
      fg__volume_part *next = &part[(*count)++];
      next->share = (double)pieces[n].inside / all;
      status = take(&next->volume, context, density, whole, pieces[n].range);
    }
  }
  free(pieces);
  fg__volume_clear(whole);
  return status;
}
