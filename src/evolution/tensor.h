/* The tensor over an evolution's mesh, as the field and the energy make it, and the
 * multigrid hierarchy over both. Each rank holds the cells round its block until stencils
 * are made of them. */
#ifndef FG__EVOLUTION_TENSOR_H
#define FG__EVOLUTION_TENSOR_H

#include "evolution/evolution.h"

/* Finds the cells round this rank's block and counts the active ones of all; the mesh
 * and the options are there. Collective. ARGUMENT (no active cell), MEMORY. */
fg_status fg__evolution_cells_create(fg_evolution *evolution, const fg_field *field);

/* Builds the levels with gamma as the weight of gradients; they take over the cells.
 * Collective. MEMORY. */
fg_status fg__evolution_multigrid_create(fg__multigrid *out, fg_evolution *evolution,
                                         double gamma);

#endif
