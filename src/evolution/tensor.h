/* The tensor over an evolution's mesh, as the field and the energy make it, and the
 * multigrid hierarchy over both. A process alone holds the tensor of all cells until
 * stencils are made; several ranks make it block by block, from the same recipe. */
#ifndef FG__EVOLUTION_TENSOR_H
#define FG__EVOLUTION_TENSOR_H

#include "evolution/evolution.h"

/* Fills the tensor unless the mesh is spread, and counts the active cells; the mesh and
 * the options are there. Collective. ARGUMENT (no active cell), MEMORY. */
fg_status fg__evolution_tensor_create(fg_evolution *evolution, const fg_field *field);

/* Builds the levels with gamma as the weight of gradients, and frees the tensor, which
 * they hold from then on. Collective. MEMORY. */
fg_status fg__evolution_multigrid_create(fg__multigrid *out, fg_evolution *evolution,
                                         const fg_field *field, double gamma);

/* Leaves the byte a cell that says which are active. */
void fg__evolution_tensor_free(fg_evolution *evolution);

#endif
