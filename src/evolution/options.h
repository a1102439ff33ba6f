/* An evolution's options: defaults, limits, and that they are the same on every rank. */
#ifndef FG__EVOLUTION_OPTIONS_H
#define FG__EVOLUTION_OPTIONS_H

#include "evolution/evolution.h"

/* Default number of nodes along the longest side of a mesh. */
int fg__default_nodes(int dimension);

/* Fills in the defaults of a mesh in `dimension` dimensions, then checks every option.
 * ARGUMENT. */
fg_status fg__evolution_options_settle(fg_evolution_options *options, fg_context *context,
                                       int dimension);

/* Whether all ranks have the same field and settled options: with different meshes they
 * would wait for messages that never come. Collective. ARGUMENT. */
fg_status fg__evolution_check_alike(const fg_evolution *evolution);

#endif
