/* From what a rank is dealt to the boxes of a mesh: leaves of the forest, merged, or a
 * slab of whole slices (rows in 2D, planes in 3D) along the last axis. */
#ifndef FG__MERGE_H
#define FG__MERGE_H

#include "mesh/forest.h"
#include "mesh/mesh.h"

/* Fills partition and tiles of a mesh from this rank's leaves. Collective. On failure
 * what there is can be cleared. MEMORY. */
fg_status fg__mesh_merge_leaves(fg__mesh *mesh, fg_context *context,
                                const fg__leaf leaf[], int count);

/* Of how many cells' thickness slabs should be multiples, a power of two from 8 up, so
 * that a rank has least to do: the thinner, the more evenly they are dealt, and the finer
 * the level that every rank has whole. 0: other boxes are better, or there is one rank.
 */
int fg__mesh_slab_unit(const fg__mesh *mesh);

/* As fg__mesh_merge_leaves does, one slab a rank, from below. */
fg_status fg__mesh_cut_slabs(fg__mesh *mesh, fg_context *context, int unit);

#endif
