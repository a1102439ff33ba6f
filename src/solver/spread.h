/* A level that several ranks share: the arrays of this rank's block, and the exchange of
 * its ghosts. Arrays are handled by the place of the block's node (0, 0, 0). */
#ifndef FG__SPREAD_H
#define FG__SPREAD_H

#include "grid/exchange/exchange.h"
#include "grid/exchange/slabs.h"
#include "grid/mesh.h"
#include "solver/kernel/kernel.h"

enum { FG__MOST_EXCHANGED = FG__RESTRICTED };

typedef struct fg__spread {
  fg__partition partition;
  fg__exchange *exchange;
  bool masked;   /* somewhere, if not here */
  bool in_slabs; /* the last axis alone is divided: */
  fg__slabs slabs;
  float *handed, *taken; /* as in level.h, for all ranks */
  fg__level block;
  float *residual[FG__RESTRICTED]; /* in slabs the first only: room for one array */
  void *memory;
} fg__spread;

typedef struct fg__spread_description {
  int halvings; /* from the mesh's cells to this level's */
  double gamma;
  const fg__spread *finer; /* the next finer level; NULL: this one is the finest */
} fg__spread_description;

/* Makes a level of the mesh's grid, takes over its partition, and computes stencils from
 * the tensor: the finest that `recipe` gives for each block, a coarser one from the means
 * of the finer level's. Collective. MEMORY, and what the recipe meets. */
fg_status fg__spread_create(fg__spread *out, fg_context *context, const fg__mesh *mesh,
                            const fg__tensor_recipe *recipe, fg__partition *partition,
                            const fg__spread_description *description);
void fg__spread_clear(fg__spread *spread);

/* Fills the ghosts of the given colours of up to FG__MOST_EXCHANGED arrays. */
void fg__spread_exchange(const fg__spread *spread, int count, float *const array[],
                         unsigned colours);

/* Fills the ghosts of whole arrays, where kernels have filled those of slabs that are
 * images. */
void fg__spread_exchange_ends(const fg__spread *spread, int count, float *const array[]);

/* Restricts to a coarse level; its u and w become 0. A linear level is swept first. */
void fg__spread_descend(const fg__spread *fine, const fg__spread *coarse,
                        const fg__kernel *kernel, float tau, bool linear);

/* Makes a coarse level's system of what was restricted. */
void fg__spread_find_space(const fg__spread *coarse, const fg__kernel *kernel, float tau);

/* From scale * v to v: a coarse level's u, before it corrects. */
void fg__spread_unscale(const fg__spread *coarse, const fg__kernel *kernel);

/* The coarse level's correction; then a sweep. True when the next cycle's restriction is
 * done as well, for which there must be `more` cycles. */
bool fg__spread_ascend(const fg__spread *coarse, const fg__spread *fine,
                       const fg__kernel *kernel, float tau, bool linear, bool more);

#endif
