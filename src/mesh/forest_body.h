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

/* Shared by a forest and those adapted from it. */
typedef struct brick {
  p4est_connectivity_t *connectivity;
  int users;
} brick;

struct fg__forest {
  const fg__ranks *ranks;
  brick *brick;
  p4est_t *p4est;
  int depth;
};

static void destroy(fg__forest *forest)
{
  if (!forest)
    return;
  if (forest->p4est)
    p4est_destroy(forest->p4est);
  if (forest->brick && --forest->brick->users == 0) {
    p4est_connectivity_destroy(forest->brick->connectivity);
    free(forest->brick);
  }
  free(forest);
}

static brick *lay_brick(const int trees[3], const bool periodic[3])
{
  brick *out = fg__allocate(1, sizeof *out);
  if (!out)
    return NULL;
  out->users = 1;
#ifndef P4_TO_P8
  out->connectivity =
      p4est_connectivity_new_brick(trees[0], trees[1], periodic[0], periodic[1]);
#else
  out->connectivity = p8est_connectivity_new_brick(trees[0], trees[1], trees[2],
                                                   periodic[0], periodic[1], periodic[2]);
#endif
  return out;
}

/* p4est itself ends the program when it has no memory. */
static fg_status create(fg__forest **out, fg_context *context, const fg__ranks *ranks,
                        const int trees[3], const bool periodic[3], int depth,
                        bool adaptive)
{
  fg__forest *forest = *out = fg__allocate(1, sizeof *forest);
  fg_status status = FG_STATUS_OK;
  if (forest)
    forest->brick = lay_brick(trees, periodic);
  if (!forest || !forest->brick)
    status = fg__fail_memory(context, "the forest", sizeof *forest);
  status = fg__ranks_agree(ranks, context, status);
  if (status) {
    destroy(forest);
    *out = NULL;
    return status;
  }
  forest->ranks = ranks;
  forest->depth = depth;
  forest->p4est = p4est_new_ext(fg__communicator(ranks), forest->brick->connectivity, 0,
                                depth, 1, 0, NULL, NULL);
  if (adaptive)
    p4est_partition(forest->p4est, 1, NULL);
  return FG_STATUS_OK;
}

/* A quadrant's user_int is the refinement wanted for it. */
static int is_too_coarse(p4est_t *p4est, p4est_topidx_t tree, p4est_quadrant_t *quadrant)
{
  (void)p4est;
  (void)tree;
  return quadrant->level < quadrant->p.user_int;
}

static int are_too_fine(p4est_t *p4est, p4est_topidx_t tree, p4est_quadrant_t *sister[])
{
  (void)p4est;
  (void)tree;
  for (int n = 0; n < P4EST_CHILDREN; ++n)
    if (sister[n]->p.user_int >= sister[n]->level)
      return 0;
  return 1;
}

static void inherit(p4est_t *p4est, p4est_topidx_t tree, int out_count,
                    p4est_quadrant_t *out[], int in_count, p4est_quadrant_t *in[])
{
  (void)p4est;
  (void)tree;
  (void)out_count;
  for (int n = 0; n < in_count; ++n)
    in[n]->p.user_int = out[0]->p.user_int;
}

static fg_status adapt(fg__forest **out, fg_context *context, const fg__forest *forest,
                       const signed char *wanted)
{
  fg__forest *adapted = *out = fg__allocate(1, sizeof *adapted);
  fg_status status = FG_STATUS_OK;
  if (!adapted)
    status = fg__fail_memory(context, "the forest", sizeof *adapted);
  status = fg__ranks_agree(forest->ranks, context, status);
  if (status) {
    destroy(adapted);
    *out = NULL;
    return status;
  }
  *adapted = *forest;
  ++adapted->brick->users;
  p4est_t *p4est = adapted->p4est = p4est_copy(forest->p4est, 0);
  for (p4est_topidx_t t = p4est->first_local_tree; t <= p4est->last_local_tree; ++t) {
    p4est_tree_t *tree = p4est_tree_array_index(p4est->trees, t);
    for (size_t q = 0; q < tree->quadrants.elem_count; ++q)
      p4est_quadrant_array_index(&tree->quadrants, q)->p.user_int =
          forest->depth - *wanted++;
  }
  /* sisters are all here (adaptive), so nobody else's wishes matter to coarsening */
  p4est_coarsen_ext(p4est, 0, 0, are_too_fine, NULL, inherit);
  p4est_refine_ext(p4est, 1, forest->depth, is_too_coarse, NULL, inherit);
  p4est_balance(p4est, P4EST_CONNECT_FULL, NULL);
  p4est_partition(p4est, 1, NULL);
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
  p4est_qcoord_to_vertex(forest->brick->connectivity, tree, quadrant->x, quadrant->y,
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
    = {create, adapt, destroy, leaf_count, leaves};

#endif
