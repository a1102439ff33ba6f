/* The nodes that close a level where it ends inside the domain. */
#ifndef FG__CLOSURE_H
#define FG__CLOSURE_H

#include "mesh/partition.h"

/* Given who owns the cells of a level (as the nodes at their lower corners; at the upper
 * ends of natural axes also the closing nodes), makes the partition of all nodes of these
 * cells: boxes grow by one node where nothing follows them, and where that leaves nodes
 * out, thin boxes are added. A node without a cell at its upper corner, and no other, may
 * be in several boxes: where a level has a re-entrant corner, boxes that begin at even
 * nodes cannot avoid it. Collective. MEMORY. */
fg_status fg__partition_close(fg__partition *out, fg_context *context,
                              const fg__partition *cells);

#endif
