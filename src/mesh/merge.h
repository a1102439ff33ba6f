/* From leaves to the boxes of a mesh. */
#ifndef FG__MERGE_H
#define FG__MERGE_H

#include "mesh/forest.h"
#include "mesh/mesh.h"

/* Fills partition and tiles of a mesh from this rank's leaves. Collective. On failure
 * what there is can be cleared. MEMORY. */
fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context,
                                const fg__leaf leaf[], int count);

#endif
