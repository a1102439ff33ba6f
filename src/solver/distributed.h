/* A level that several ranks divide: this rank's block, and the exchange of its ghosts.
 * Arrays are handled by the place of the block's node (0, 0, 0). */
#ifndef FG__DISTRIBUTED_H
#define FG__DISTRIBUTED_H

#include "grid/exchange/exchange.h"
#include "grid/exchange/slabs.h"
#include "grid/mesh.h"
#include "solver/kernel/kernel.h"

enum { FG__MOST_EXCHANGED = FG__RESTRICTED };

typedef struct fg__distributed {
  fg__partition partition;
  fg__exchange *exchange;
  bool masked;   /* somewhere, if not here */
  bool in_slabs; /* the last axis alone is divided: */
  fg__slabs slabs;
  float *sent, *received; /* as in level.h, for all ranks */
  fg__level block;
  float *residual[FG__RESTRICTED]; /* in slabs the first only: room for one array */
  void *memory;
} fg__distributed;

typedef struct fg__distributed_description {
  int halvings; /* from the mesh's cells to this level's */
  double gamma;
  bool masked;                  /* somewhere on the mesh, if not here */
  const fg__distributed *finer; /* the next finer level; NULL: this one is the finest */
} fg__distributed_description;

/* Makes a level of the mesh's grid, takes ownership of its partition, and computes
 * stencils: of the finest level from the block's cells, which it takes over, of a coarser
 * one from the means of the finer level's. Collective. MEMORY. */
fg_status fg__distributed_create(fg__distributed *out, fg_context *context,
                                 const fg__mesh *mesh, fg__cells_of_box *finest,
                                 fg__partition *partition,
                                 const fg__distributed_description *description);
void fg__distributed_clear(fg__distributed *level);

/* Fills the ghosts of the given colours of up to FG__MOST_EXCHANGED arrays. */
void fg__distributed_exchange(const fg__distributed *level, int count,
                              float *const array[], unsigned colours);

/* Fills the ghosts of whole arrays, where kernels have filled those of slabs that are
 * images. */
void fg__distributed_exchange_ends(const fg__distributed *level, int count,
                                   float *const array[]);

/* In slabs: what kernels that sweep over slices are given, so that they exchange halos
 * where threads would wait for each other. */
fg__thread fg__distributed_share(const fg__distributed *level);

/* Of pencils, which exchange all ghosts between sweeps: restriction to a coarse level,
 * whose u and w become 0, after a sweep of a linear level; and the coarse level's
 * correction, then a sweep. */
void fg__distributed_descend(const fg__distributed *fine, const fg__distributed *coarse,
                             const fg__kernel *kernel, float tau, bool linear);
void fg__distributed_ascend(const fg__distributed *coarse, const fg__distributed *fine,
                            const fg__kernel *kernel, float tau, bool linear);

#endif
