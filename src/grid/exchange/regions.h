/* Gathers regions of a grid from the blocks of all ranks on the ranks that need them:
 * the window round a cluster, the rows of a file.
 *
 * Every rank knows all blocks and all regions, so each finds by itself what to send to
 * whom. One exchange is enough. */
#ifndef FG__REGIONS_H
#define FG__REGIONS_H

#include <stdint.h>

#include "grid/partition.h"

typedef struct fg__region {
  fg__box nodes; /* along a periodic axis it may reach up to a period beyond either end */
  int rank;      /* who gets it */
} fg__region;

/* What this rank's block holds: an array of elements of `size` bytes, x fastest. Elements
 * are nodes, or cells, which belong to the block that owns their lowest corner. */
typedef struct fg__region_source {
  size_t size;
  const void *first;    /* node (0, 0, 0) */
  ptrdiff_t row, plane; /* elements from a row, a plane to the next */
} fg__region_source;

/* Fills out[n], x fastest, with region n where that is this rank's; other entries are not
 * read. The regions are the same on all ranks; their nodes must be owned. Collective.
 * MEMORY, UNSUPPORTED (more than 2^31 elements to or from a rank). */
fg_status fg__regions_fill(fg_context *context, const fg__partition *partition,
                           const fg__region *region, int count,
                           const fg__region_source *source, void *const out[]);

#endif
