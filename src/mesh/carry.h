/* Bringing values from a mesh to the one adapted from it. */
#ifndef FG__CARRY_H
#define FG__CARRY_H

#include "mesh/mesh.h"

/* Fills `count` arrays on all levels of a mesh: source[n][a][b] points to node (0, 0, 0)
 * of array a in own box b of level n of the mesh `from`, target likewise. Where a level
 * of `from` has a node, also below finer leaves, its value is taken; elsewhere the value
 * is interpolated from the next coarser level of `to`. So a refined area keeps the
 * function that it had; and what coarsened leaves shall have, the coarse levels of `from`
 * must hold below the fine ones. Ghosts are not filled. Both meshes are of one domain and
 * as many levels. Collective. MEMORY. */
fg_status fg__mesh_carry(fg_context *context, const fg__mesh *from, const fg__mesh *to,
                         int count, float *const *const *const source[],
                         float *const *const *const target[]);

#endif
