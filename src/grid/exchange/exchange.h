/* Halo exchange: fills the ghosts of a level's blocks from the owners of their sources.
 *
 * A ghost at index -1 or n of an axis stands for the next node of the whole grid; beyond
 * a natural boundary for its mirror image (-1 for 1, n for n - 2 of the grid), beyond a
 * periodic one for the node at the other end. A ghost at an edge or corner of a block is
 * found axis by axis. Every ghost is copied straight from its owner: within the rank by
 * memory, between ranks in one message per neighbouring rank and exchange, whatever the
 * number of arrays. A ghost's column, row and plane are even or odd as its source's are,
 * so an exchange can be confined to a set of colours: after a Gauss-Seidel sweep has
 * changed one colour, that is all there is to send.
 *
 *     float *const arrays[] = {u, w};  // node (0, 0, 0) of the own block, layout.h
 *     fg__exchange_fill(exchange, 2, arrays, FG__ALL_COLOURS);
 *
 * All ranks exchange in the same order. Between begin and finish the plan may not be used
 * again, nodes of the colours sent must keep their values and ghosts of these colours are
 * undefined; others may be read and written. Not thread-safe: one thread exchanges. */
#ifndef FG__EXCHANGE_H
#define FG__EXCHANGE_H

#include "grid/layout.h"
#include "grid/partition.h"

typedef struct fg__exchange fg__exchange;

/* Makes the plan for a level whose blocks have two nodes a side at least, for up to
 * `most_arrays` arrays at a time; the partition may go afterwards. Collective. MEMORY. */
fg_status fg__exchange_create(fg__exchange **out, fg_context *context,
                              const fg__partition *partition, int most_arrays);
void fg__exchange_destroy(fg__exchange *exchange); /* NULL-safe */

/* Begins to fill the ghosts of the given colours in `count` arrays; array[a] points to
 * node (0, 0, 0) of array a in the own block, and stays valid until finish. Copies within
 * the rank are made here. */
void fg__exchange_begin(fg__exchange *exchange, int count, float *const array[],
                        unsigned colours);

/* Waits for the others' values and puts them into the ghosts. */
void fg__exchange_finish(fg__exchange *exchange);

static inline void fg__exchange_fill(fg__exchange *exchange, int count,
                                     float *const array[], unsigned colours)
{
  fg__exchange_begin(exchange, count, array, colours);
  fg__exchange_finish(exchange);
}

#endif
