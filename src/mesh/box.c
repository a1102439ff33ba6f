#include "mesh/box.h"

#include <stdlib.h>

#include "base/memory.h"

fg__box fg__box_intersection(const fg__box *a, const fg__box *b)
{
  fg__box out;
  for (int k = 0; k < 3; ++k) {
    int a_end = a->first[k] + a->nodes[k], b_end = b->first[k] + b->nodes[k];
    out.first[k] = a->first[k] > b->first[k] ? a->first[k] : b->first[k];
    out.nodes[k] = (a_end < b_end ? a_end : b_end) - out.first[k];
  }
  return out;
}

int fg__box_without(fg__box out[6], const fg__box *box, const fg__box *hole)
{
  fg__box rest = *box;
  int count = 0;
  for (int k = 2; k >= 0; --k) {
    int below = hole->first[k] - rest.first[k];
    int above = rest.nodes[k] - below - hole->nodes[k];
    if (below > 0) {
      out[count] = rest;
      out[count++].nodes[k] = below;
    }
    if (above > 0) {
      out[count] = rest;
      out[count].first[k] = hole->first[k] + hole->nodes[k];
      out[count++].nodes[k] = above;
    }
    rest.first[k] = hole->first[k];
    rest.nodes[k] = hole->nodes[k];
  }
  return count;
}

/* Orders boxes so that those which could be merged along `axis` follow each other. */
static int compare_along(const fg__box *a, const fg__box *b, int axis)
{
  for (int k = 2; k >= 0; --k) {
    if (k == axis)
      continue;
    if (a->first[k] != b->first[k])
      return a->first[k] < b->first[k] ? -1 : 1;
    if (a->nodes[k] != b->nodes[k])
      return a->nodes[k] < b->nodes[k] ? -1 : 1;
  }
  return (a->first[axis] > b->first[axis]) - (a->first[axis] < b->first[axis]);
}

static int compare_along_x(const void *a, const void *b)
{
  return compare_along(a, b, 0);
}

static int compare_along_y(const void *a, const void *b)
{
  return compare_along(a, b, 1);
}

static int compare_along_z(const void *a, const void *b)
{
  return compare_along(a, b, 2);
}

static int compare_places(const void *a, const void *b)
{
  const fg__box *x = a, *y = b;
  for (int k = 2; k >= 0; --k)
    if (x->first[k] != y->first[k])
      return x->first[k] < y->first[k] ? -1 : 1;
  return 0;
}

static bool continues(const fg__box *a, const fg__box *b, int axis)
{
  for (int k = 0; k < 3; ++k)
    if (k != axis && (a->first[k] != b->first[k] || a->nodes[k] != b->nodes[k]))
      return false;
  return a->first[axis] + a->nodes[axis] == b->first[axis];
}

int fg__boxes_merge(fg__box *box, int count)
{
  int (*const compare[])(const void *, const void *) = {compare_along_x, compare_along_y,
                                                        compare_along_z};
  if (count == 0)
    return 0;
  for (int axis = 0; axis < 3; ++axis) {
    qsort(box, (size_t)count, sizeof *box, compare[axis]);
    int last = 0;
    for (int n = 1; n < count; ++n)
      if (continues(&box[last], &box[n], axis))
        box[last].nodes[axis] += box[n].nodes[axis];
      else
        box[++last] = box[n];
    count = last + 1;
  }
  qsort(box, (size_t)count, sizeof *box, compare_places);
  return count;
}

bool fg__box_list_add(fg__box_list *list, const fg__box *box)
{
  void *memory = list->box;
  bool grown = fg__grow(&memory, &list->capacity, list->count + 1, sizeof *list->box);
  list->box = memory;
  if (grown)
    list->box[list->count++] = *box;
  return grown;
}

bool fg__box_list_take_out(fg__box_list *list, const fg__box *hole)
{
  size_t before = list->count, kept = 0;
  for (size_t n = 0; n < before; ++n) {
    fg__box common = fg__box_intersection(&list->box[n], hole), rest[6];
    if (fg__box_is_empty(&common))
      continue;
    int parts = fg__box_without(rest, &list->box[n], &common);
    list->box[n].nodes[0] = 0; /* empty: dropped below */
    for (int p = 0; p < parts; ++p)
      if (!fg__box_list_add(list, &rest[p]))
        return false;
  }
  for (size_t n = 0; n < list->count; ++n)
    if (!fg__box_is_empty(&list->box[n]))
      list->box[kept++] = list->box[n];
  list->count = kept;
  return true;
}
