/* Included by forest_2d.c and, with p4est's names turned into p8est's, by forest_3d.c. */
#ifndef FG__FOREST_BODY_H
#define FG__FOREST_BODY_H

#include "mesh/forest.h"

#include <math.h>
#include <stdlib.h>
#ifndef P4_TO_P8
#include <p4est_extended.h>
#else
#include <p8est_extended.h>
#endif

#include "base/memory.h"
#include "mesh/communicator.h"

static p4est_connectivity_t *lay_brick(const int trees[3], const bool periodic[3])
{
#ifndef P4_TO_P8
  return p4est_connectivity_new_brick(trees[0], trees[1], periodic[0], periodic[1]);
#else
  return p4est_connectivity_new_brick(trees[0], trees[1], trees[2], periodic[0],
                                      periodic[1], periodic[2]);
#endif
}

static fg__leaf leaf_of(p4est_connectivity_t *brick, p4est_topidx_t tree,
                        const p4est_quadrant_t *quadrant, int depth)
{
  double corner[3] = {0.0};
  p4est_qcoord_to_vertex(brick, tree, quadrant->x, quadrant->y,
#ifdef P4_TO_P8
                         quadrant->z,
#endif
                         corner);
  fg__leaf leaf = {{0, 0, 0}};
  for (int k = 0; k < P4EST_DIM; ++k)
    leaf.first[k] = (int)lround(ldexp(corner[k], depth));
  return leaf;
}

static void list_leaves(p4est_t *p4est, int depth, fg__leaf *out)
{
  for (p4est_topidx_t t = p4est->first_local_tree; t <= p4est->last_local_tree; ++t) {
    p4est_tree_t *tree = p4est_tree_array_index(p4est->trees, t);
    for (size_t q = 0; q < tree->quadrants.elem_count; ++q)
      *out++ = leaf_of(p4est->connectivity, t,
                       p4est_quadrant_array_index(&tree->quadrants, q), depth);
  }
}

/* p4est itself ends the program when it has no memory. */
#ifndef P4_TO_P8
fg_status fg__forest_leaves_2d
#else
fg_status fg__forest_leaves_3d
#endif
    (fg__leaf **out, int *count, fg_context *context, const fg__ranks *ranks,
     const int trees[3], const bool periodic[3], int depth)
{
  p4est_connectivity_t *brick = lay_brick(trees, periodic);
  p4est_t *p4est =
      p4est_new_ext(fg__communicator(ranks), brick, 0, depth, 1, 0, NULL, NULL);
  size_t leaves = (size_t)p4est->local_num_quadrants;
  *count = 0;
  *out = fg__allocate(leaves, sizeof **out);
  fg_status status = FG_STATUS_OK;
  if (*out) {
    list_leaves(p4est, depth, *out);
    *count = (int)leaves;
  } else {
    status = fg__fail_memory(context, "the leaves", leaves * sizeof **out);
  }
  p4est_destroy(p4est);
  p4est_connectivity_destroy(brick);
  status = fg__ranks_agree(ranks, context, status);
  if (status) {
    free(*out);
    *out = NULL;
    *count = 0;
  }
  return status;
}

#endif
