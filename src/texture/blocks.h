/* The square blocks that a picture falls into, which threads paint in any order. */
#ifndef FG__BLOCKS_H
#define FG__BLOCKS_H

#include <stdatomic.h>

#include "texture/raster.h"

enum { FG__BLOCK = 128 }; /* pixels a side: a block fits into a second-level cache */

typedef struct fg__texture_blocks {
  int size[2];  /* of the picture */
  int along[2]; /* blocks along x and y */
  atomic_int next;
} fg__texture_blocks;

static inline void fg__blocks_begin(fg__texture_blocks *blocks, const fg__raster *raster)
{
  for (int k = 0; k < 2; ++k) {
    blocks->size[k] = raster->size[k];
    blocks->along[k] = (raster->size[k] + FG__BLOCK - 1) / FG__BLOCK;
  }
  atomic_init(&blocks->next, 0);
}

/* Takes the next block: its lowest pixel and size; false when all are taken. */
static inline bool fg__blocks_take(fg__texture_blocks *blocks, int first[2], int size[2])
{
  int number = atomic_fetch_add_explicit(&blocks->next, 1, memory_order_relaxed);
  if (number >= blocks->along[0] * blocks->along[1])
    return false;
  const int at[2] = {number % blocks->along[0], number / blocks->along[0]};
  for (int k = 0; k < 2; ++k) {
    first[k] = at[k] * FG__BLOCK;
    const int rest = blocks->size[k] - first[k];
    size[k] = rest < FG__BLOCK ? rest : FG__BLOCK;
  }
  return true;
}

#endif
