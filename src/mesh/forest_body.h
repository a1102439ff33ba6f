/* Included by forest_2d.c and, with p4est's names turned into p8est's, by forest_3d.c. */
#ifndef FG__FOREST_BODY_H
#define FG__FOREST_BODY_H

#include "mesh/forest.h"

#include <math.h>
#include <stdlib.h>
#ifndef P4_TO_P8
#include <p4est_bits.h>
#include <p4est_extended.h>
#else
#include <p8est_bits.h>
#include <p8est_extended.h>
#endif

#include "base/memory.h"
#include "mesh/communicator.h"

struct fg__forest {
  p4est_connectivity_t *connectivity;
  p4est_t *p4est;
  int depth;
};

static void destroy(fg__forest *forest)
{
  if (!forest)
    return;
  if (forest->p4est)
    p4est_destroy(forest->p4est);
  if (forest->connectivity)
    p4est_connectivity_destroy(forest->connectivity);
  free(forest);
}

static fg_status create(fg__forest **out, fg_context *context, const fg__ranks *ranks,
                        const int trees[3], const bool periodic[3], int refinements,
                        int depth)
{
  fg__forest *forest = *out = fg__allocate(1, sizeof *forest);
  if (!forest)
    return fg__fail_memory(context, "the forest", sizeof *forest);
  forest->depth = depth;
#ifndef P4_TO_P8
  forest->connectivity =
      p4est_connectivity_new_brick(trees[0], trees[1], periodic[0], periodic[1]);
#else
  forest->connectivity = p8est_connectivity_new_brick(
      trees[0], trees[1], trees[2], periodic[0], periodic[1], periodic[2]);
#endif
  forest->p4est = p4est_new_ext(fg__communicator(ranks), forest->connectivity, 0,
                                refinements, 1, 0, NULL, NULL);
  return FG_STATUS_OK;
}

static int leaf_count(const fg__forest *forest)
{
  return forest->p4est->local_num_quadrants;
}

static fg__leaf leaf_of(const fg__forest *forest, p4est_topidx_t tree,
                        const p4est_quadrant_t *quadrant)
{
  double corner[3] = {0.0};
  p4est_qcoord_to_vertex(forest->connectivity, tree, quadrant->x, quadrant->y,
#ifdef P4_TO_P8
                         quadrant->z,
#endif
                         corner);
  fg__leaf leaf = {.side = 1 << (forest->depth - quadrant->level)};
  for (int k = 0; k < P4EST_DIM; ++k)
    leaf.first[k] = (int)lround(ldexp(corner[k], forest->depth));
  return leaf;
}

static void leaves(const fg__forest *forest, fg__leaf *out)
{
  p4est_t *p4est = forest->p4est;
  for (p4est_topidx_t t = p4est->first_local_tree; t <= p4est->last_local_tree; ++t) {
    p4est_tree_t *tree = p4est_tree_array_index(p4est->trees, t);
    for (size_t q = 0; q < tree->quadrants.elem_count; ++q)
      *out++ = leaf_of(forest, t, p4est_quadrant_array_index(&tree->quadrants, q));
  }
}

#ifndef P4_TO_P8
const fg__forest_kind fg__forest_2d
#else
const fg__forest_kind fg__forest_3d
#endif
    = {create, destroy, leaf_count, leaves};

#endif
