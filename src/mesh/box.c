#include "mesh/box.h"

#include <stdlib.h>

fg__box fg__box_halved(const fg__box *fine)
{
  fg__box even;
  for (int k = 0; k < 3; ++k) {
    int end = fine->first[k] + fine->nodes[k];
    even.first[k] = (fine->first[k] + 1) / 2;
    even.nodes[k] = (end + 1) / 2 - even.first[k];
  }
  return even;
}

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
