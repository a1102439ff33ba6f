#include "mesh/closure.h"

#include <stdlib.h>

#include "mesh/exchange.h"

/* Beyond the end are mirror images, or in 2D nothing. */
static bool ends_there(const fg__partition *level, const fg__box *box, int axis)
{
  return !level->periodic[axis] &&
         box->first[axis] + box->nodes[axis] == level->nodes[axis];
}

/* What is left of `box` when those of the list are taken out. */
static bool subtract(fg__box_list *left, const fg__box *box, const fg__box_list *taken)
{
  left->count = 0;
  bool done = fg__box_list_add(left, box);
  for (size_t n = 0; done && left->count > 0 && n < taken->count; ++n)
    done = fg__box_list_take_out(left, &taken->box[n]);
  return done;
}

/* Lets an own box grow by one node along each axis on whose upper side nothing follows;
 * `uncovered` are its ghosts without an owner. */
static bool grow(fg__box *box, const fg__partition *level, const fg__box_list *uncovered,
                 fg__box_list *left)
{
  fg__box grown = {{0, 0, 0}, {box->nodes[0], box->nodes[1], box->nodes[2]}};
  for (int k = 0; k < 3; ++k) {
    fg__box face = grown;
    face.first[k] = box->nodes[k];
    face.nodes[k] = 1;
    if (ends_there(level, box, k))
      continue;
    if (!subtract(left, &face, uncovered))
      return false;
    /* around a periodic axis the face lies at the other end, in no box of its own */
    bool round = box->first[k] + box->nodes[k] == level->nodes[k];
    if (left->count == 0 && !round)
      ++grown.nodes[k];
  }
  for (int k = 0; k < 3; ++k)
    box->nodes[k] = grown.nodes[k];
  return true;
}

/* Adds the part of a box's ghosts on its upper sides that no own box has yet. */
static bool add_strip(fg__box_list *own, const fg__partition *level, const fg__box *box,
                      const fg__box *ghosts, fg__box_list *left)
{
  fg__box upper = {{0, 0, 0}, {box->nodes[0], box->nodes[1], box->nodes[2]}};
  for (int k = 0; k < 3; ++k)
    upper.nodes[k] += !ends_there(level, box, k);
  fg__box strip = fg__box_intersection(ghosts, &upper);
  if (fg__box_is_empty(&strip))
    return true;
  for (int k = 0; k < 3; ++k) {
    strip.first[k] += box->first[k];
    if (strip.first[k] == level->nodes[k]) /* periodic */
      strip.first[k] = 0;
  }
  if (!subtract(left, &strip, own))
    return false;
  /* the whole strip, so that it begins at even nodes */
  return left->count == 0 || fg__box_list_add(own, &strip);
}

static bool close_boxes(fg__box_list *out, const fg__partition *level,
                        const fg__uncovered *uncovered, int count)
{
  int own_count;
  const fg__box *own = fg__own_boxes(level, &own_count);
  fg__box_list left = {0}, ghosts = {0};
  bool done = true;
  for (int b = 0; done && b < own_count; ++b) {
    fg__box box = own[b];
    ghosts.count = 0;
    for (int n = 0; done && n < count; ++n)
      if (uncovered[n].box == b)
        done = fg__box_list_add(&ghosts, &uncovered[n].nodes);
    done = done && grow(&box, level, &ghosts, &left) && fg__box_list_add(out, &box);
  }
  for (int n = 0; done && n < count; ++n)
    done = add_strip(out, level, &own[uncovered[n].box], &uncovered[n].nodes, &left);
  free(left.box);
  free(ghosts.box);
  return done;
}

fg_status fg__partition_close(fg__partition *out, fg_context *context,
                              const fg__partition *cells)
{
  *out = (fg__partition){0};
  fg__exchange *ghosts;
  fg__box_list closed = {0};
  int count;
  fg_status status = fg__exchange_create(&ghosts, context, cells, 0);
  if (status)
    return status;
  const fg__uncovered *uncovered = fg__exchange_uncovered(ghosts, &count);
  if (!close_boxes(&closed, cells, uncovered, count))
    status = fg__fail_memory(context, "a level's border", closed.count * sizeof(fg__box));
  status = fg__ranks_agree(cells->ranks, context, status);
  if (!status)
    status =
        fg__partition_create(out, context, cells->ranks, cells->dimension, cells->cells,
                             cells->periodic, closed.box, (int)closed.count);
  free(closed.box);
  fg__exchange_destroy(ghosts);
  return status;
}
