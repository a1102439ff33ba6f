/* The ghosts of plain arrays of a block: x fastest, a ghost row or plane on both sides of
 * each axis that is divided. Rows are never cut, so there are none along x. (exchange.h
 * fills those of the solver's arrays.) */
#ifndef FG__HALO_H
#define FG__HALO_H

#include "grid/exchange/slabs.h"

/* A plain array of 4 bytes a node. It has ghost slices along the outermost axis, and in
 * 3D ghost rows where y is divided. */
typedef struct fg__halo {
  const fg__partition *partition;
  int nodes[3];         /* of this rank's block */
  int ghost_rows;       /* 3D: 1 where y is divided, else 0 */
  ptrdiff_t row, slice; /* elements from a row, from a slice to the next */
  size_t size;          /* elements of the array, ghosts included */
  ptrdiff_t first;      /* from the array's start to node (0, 0, 0) */
  float *side[4];       /* faces along y on their way; NULL where y is not divided */
} fg__halo;

/* The shape of such arrays for this rank's block. MEMORY. */
fg_status fg__halo_create(fg__halo *out, fg_context *context,
                          const fg__partition *partition);
void fg__halo_clear(fg__halo *halo);

/* Fills the ghosts of an array from its start on, those at edges included; beyond a
 * natural boundary they stay as they are. Bytes are only copied. Collective. */
void fg__halo_fill(const fg__halo *halo, void *array);

#endif
