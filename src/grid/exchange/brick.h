/* Bricks of nodes that are copied from array to array or through a message. */
#ifndef FG__BRICK_H
#define FG__BRICK_H

#include <stdint.h>

#include "grid/box.h"
#include "grid/layout.h"

/* Nodes of the arrays of one block, ghosts perhaps, in local indices. */
typedef struct fg__brick {
  fg__box nodes;
  int odd[3]; /* 1 where the source of the first node has an odd global index */
} fg__brick;

/* How many of a brick's nodes have a colour of the set (layout.h). */
int64_t fg__brick_count(const fg__brick *brick, unsigned colours);

/* Writes those nodes one after the other; returns the end of what was written. */
float *fg__brick_pack(const fg__brick *brick, const fg__layout *layout,
                      const float *array, unsigned colours, float *out);

/* Reads them back, in the same order; returns the end of what was read. */
const float *fg__brick_unpack(const fg__brick *brick, const fg__layout *layout,
                              float *array, unsigned colours, const float *in);

/* Copies to a brick from one of the same size and the same sources. */
void fg__brick_copy(const fg__brick *to, const fg__layout *to_layout, float *to_array,
                    const fg__brick *from, const fg__layout *from_layout,
                    const float *from_array, unsigned colours);

#endif
