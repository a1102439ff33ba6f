#include "cluster/stretch.h"

#include <stdlib.h>
#include <string.h>

#include "base/context.h"
#include "base/memory.h"

static bool find_stretch(fg__stretch *out, const fg_density_arrays *density,
                         const fg__window *window, int k, int n)
{
  return fg__stretch_find(out, density, k, window->origin[k], window->nodes[k], n);
}

static int count_nodes(const fg__window *window, const fg__stretch *x,
                       const fg__stretch *y)
{
  int count = 0;
  for (int j = y->first; j <= y->last; ++j)
    for (int i = x->first; i <= x->last; ++i)
      count += window->level[j * window->nodes[0] + i] > 0.0F;
  return count;
}

/* Copies a rectangle of the window. */
static fg_status take(fg__window *out, fg_context *context,
                      const fg_density_arrays *density, const fg__window *whole,
                      const fg__stretch range[2])
{
  *out = (fg__window){.cluster = whole->cluster};
  for (int k = 0; k < 2; ++k) {
    const fg__stretch *r = &range[k];
    bool from_start = r->first == 0, to_end = r->last == whole->nodes[k] - 1;
    out->nodes[k] = r->last - r->first + 1;
    out->spacing[k] = whole->spacing[k];
    out->origin[k] = density->origin[k] + r->start * density->spacing[k];
    out->at_border[2 * k] = from_start ? whole->at_border[2 * k] : true;
    out->at_border[2 * k + 1] = to_end ? whole->at_border[2 * k + 1] : true;
  }
  size_t wide = (size_t)out->nodes[0], high = (size_t)out->nodes[1];
  size_t row = (size_t)whole->nodes[0];
  out->level = fg__allocate(wide * high, sizeof *out->level);
  out->active = fg__allocate((wide - 1) * (high - 1), 1);
  if (!out->level || !out->active)
    return fg__fail_memory(context, "a cluster's window", wide * high * sizeof(float));
  for (size_t y = 0; y < high; ++y) {
    size_t from = (size_t)range[1].first + y, x = (size_t)range[0].first;
    memcpy(out->level + y * wide, whole->level + from * row + x,
           wide * sizeof *out->level);
    if (y + 1 < high)
      memcpy(out->active + y * (wide - 1), whole->active + from * (row - 1) + x,
             wide - 1);
  }
  return fg__window_keep_largest(out, context);
}

/* Goes through the parts: finds how many nodes all have and the largest has, or, when
 * these are known, takes those that get an icon. */
typedef struct division {
  const fg_density_arrays *density;
  const fg__window *whole;
  int all, largest;
  double least; /* nodes that a part needs, but for the largest */
} division;

static void count_parts(division *d)
{
  fg__stretch range[2];
  for (int n = 0; find_stretch(&range[1], d->density, d->whole, 1, n); ++n)
    for (int m = 0; find_stretch(&range[0], d->density, d->whole, 0, m); ++m) {
      int nodes = count_nodes(d->whole, &range[0], &range[1]);
      d->all += nodes;
      d->largest = nodes > d->largest ? nodes : d->largest;
    }
}

static fg_status take_parts(fg__window_part *part, int *count, fg_context *context,
                            const division *d)
{
  fg__stretch range[2];
  bool has_largest = false;
  *count = 0;
  for (int n = 0; find_stretch(&range[1], d->density, d->whole, 1, n); ++n)
    for (int m = 0; find_stretch(&range[0], d->density, d->whole, 0, m); ++m) {
      int nodes = count_nodes(d->whole, &range[0], &range[1]);
      bool largest = nodes == d->largest && !has_largest;
      has_largest = has_largest || largest;
      if ((!largest && nodes < d->least) || *count == FG__WINDOW_PARTS)
        continue;
      fg__window_part *next = &part[(*count)++];
      next->share = (double)nodes / d->all;
      fg_status status = take(&next->window, context, d->density, d->whole, range);
      if (status)
        return status;
    }
  return FG_STATUS_OK;
}

fg_status fg__window_divide(fg__window_part part[FG__WINDOW_PARTS], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__window *whole)
{
  fg__stretch second;
  *count = 0;
  if (!find_stretch(&second, density, whole, 0, 1) &&
      !find_stretch(&second, density, whole, 1, 1)) {
    part[0] = (fg__window_part){*whole, 1.0};
    *count = 1;
    *whole = (fg__window){0};
    return FG_STATUS_OK;
  }
  division d = {.density = density, .whole = whole};
  count_parts(&d);
  d.least = d.all * fg__stretch_least(labels, whole->cluster);
  fg_status status = take_parts(part, count, context, &d);
  fg__window_clear(whole);
  return status;
}
