/* The couplings of a level's nodes, from its cells. */
#ifndef FG__STENCIL_H
#define FG__STENCIL_H

#include "solver/level.h"

/* Computes the stencil of the energy (gamma: what the cells' tensor is multiplied by) or
 * of the Laplacian at all nodes of a level, whose cells and scratch space are there. Any
 * number of threads (NULL: one thread) gives the same. */
void fg__stencil_assemble(const fg__level *level, const fg__stencil *out, double gamma,
                          bool laplacian, fg__threads *threads);

/* The Laplacian's constants, which hold where there is no mask. */
void fg__stencil_set_constants(fg__level *level);

#endif
