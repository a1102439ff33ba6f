/* Between the blocks of a distributed level and the same level whole on every rank: the
 * way into the replicated part of a multigrid and back.
 *
 * All ranks receive all nodes: n floats a level and array, at once. That bounds how fine
 * a replicated level may be: (1/16)^3 of 1025^3 nodes are 1 MB an array. */
#ifndef FG__GATHER_H
#define FG__GATHER_H

#include "grid/layout.h"
#include "grid/partition.h"

typedef struct fg__gather fg__gather;

/* Makes the plan for a partition, for up to `most_arrays` arrays at a time. Collective.
 * MEMORY. */
fg_status fg__gather_create(fg__gather **out, fg_context *context,
                            const fg__partition *partition, int most_arrays);
void fg__gather_destroy(fg__gather *gather); /* NULL-safe */

/* Collects `count` arrays: array[a] points to node (0, 0, 0) of array a in the own block,
 * whole[a] to that of the whole grid's array, in the layout of partition->nodes. The
 * ghosts of whole[a] are left alone. Collective. */
void fg__gather_fill(fg__gather *gather, int count, float *const array[],
                     float *const whole[]);

/* The way back: copies this rank's block out of whole arrays, ghosts included, for which
 * the ghosts of the whole arrays must have been filled. Not collective. */
void fg__gather_return(const fg__gather *gather, int count, float *const whole[],
                       float *const array[]);

#endif
