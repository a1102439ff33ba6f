/* From leaves to the levels of a mesh. */
#ifndef FG__MERGE_H
#define FG__MERGE_H

#include "mesh/mesh.h"

/* Fills leaves, levels and tiles of a mesh from its forest. Collective. On failure what
 * there is can be cleared. MEMORY. */
fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context);

#endif
