#include "cluster/pieces.h"

#include <math.h>
#include <string.h>

/* A part with less than this share both of the cluster and of the mean cluster gets no
 * icon: it would be a small arrow beside large ones. */
static const double LEAST_SHARE = 0.25;

double fg__piece_least(double cluster, double mean)
{
  return LEAST_SHARE * fmin(cluster, mean);
}

/* The stretch number n, from 0 on; false when there are fewer. */
static bool find_stretch(fg__stretch *out, const fg_density_arrays *density,
                         const fg__window *window, int axis, int n)
{
  int last = window->nodes[axis] - 1;
  *out = (fg__stretch){0, last, 0};
  if (axis >= density->dimension)
    return n == 0;
  out->start = (int)lround((window->origin[axis] - density->origin[axis]) /
                           density->spacing[axis]);
  if (!density->periodic[axis])
    return n == 0;
  int period = density->nodes[axis];
  int turn = (int)floor((double)out->start / period) + n;
  int first = turn * period - out->start, next = first + period;
  out->first = first > 0 ? first : 0;
  out->last = next < last ? next : last;
  out->start += out->first - turn * period;
  return out->first < last;
}

static int count_stretches(const fg_density_arrays *density, const fg__window *window,
                           int axis)
{
  fg__stretch range;
  int count = 0;
  while (find_stretch(&range, density, window, axis, count))
    ++count;
  return count;
}

static double count_nodes(const fg__window *window, const fg__stretch range[3])
{
  size_t wide = (size_t)window->nodes[0], high = (size_t)window->nodes[1], count = 0;
  for (int z = range[2].first; z <= range[2].last; ++z)
    for (int y = range[1].first; y <= range[1].last; ++y) {
      const float *row = window->level + ((size_t)z * high + (size_t)y) * wide;
      for (int x = range[0].first; x <= range[0].last; ++x)
        count += row[x] > 0.0F;
    }
  return (double)count;
}

/* All pieces of a window, x fastest. */
typedef struct pieces {
  const fg_density_arrays *density;
  const fg__window *window;
  int along[3], count;
} pieces;

/* A piece; `share` counts nodes. */
static fg__piece piece_at(const pieces *all, int n)
{
  fg__piece out;
  int at[3] = {n % all->along[0], n / all->along[0] % all->along[1],
               n / all->along[0] / all->along[1]};
  for (int k = 0; k < 3; ++k)
    find_stretch(&out.range[k], all->density, all->window, k, at[k]);
  out.share = count_nodes(all->window, out.range);
  return out;
}

/* Adds a piece behind the others; of too many the smallest goes. */
static void keep(fg__piece list[FG__WINDOW_PIECES], int *count, const fg__piece *piece)
{
  int smallest = 0;
  if (*count == FG__WINDOW_PIECES) {
    for (int n = 1; n < *count; ++n)
      if (list[n].share <= list[smallest].share)
        smallest = n;
    if (piece->share <= list[smallest].share)
      return;
    --*count;
    memmove(&list[smallest], &list[smallest + 1],
            (size_t)(*count - smallest) * sizeof *list);
  }
  list[(*count)++] = *piece;
}

static double mean_area(const fg__labels *labels)
{
  double mean = 0.0;
  for (int n = 0; n < labels->count; ++n)
    mean += labels->area[n] / labels->count;
  return mean;
}

int fg__pieces_find(fg__piece out[FG__WINDOW_PIECES], const fg_density_arrays *density,
                    const fg__labels *labels, const fg__window *window)
{
  pieces all = {.density = density, .window = window, .count = 1};
  int count = 0, largest = 0;
  double most = 0.0, nodes = 0.0, kept = 0.0;
  for (int k = 0; k < 3; ++k)
    all.count *= all.along[k] = count_stretches(density, window, k);
  if (all.count == 1)
    return 0;
  for (int n = 0; n < all.count; ++n) {
    double share = piece_at(&all, n).share;
    largest = share > most ? n : largest;
    most = fmax(most, share);
    nodes += share;
  }
  double area = labels->area[window->cluster - 1];
  double least = nodes * fg__piece_least(area, mean_area(labels)) / area;
  for (int n = 0; n < all.count; ++n) {
    fg__piece piece = piece_at(&all, n);
    if (n == largest || piece.share >= least)
      keep(out, &count, &piece);
  }
  for (int n = 0; n < count; ++n)
    kept += out[n].share;
  for (int n = 0; n < count; ++n)
    out[n].share /= kept;
  return count;
}

/* Takes over what is known of a window along one axis for a piece of it. */
static void cut_along(fg__window *out, const fg__stretch *range,
                      const fg_density_arrays *density, int axis)
{
  bool *at_boundary = &out->at_boundary[2 * axis];
  at_boundary[0] = at_boundary[0] || range->first > 0;
  at_boundary[1] = at_boundary[1] || range->last < out->nodes[axis] - 1;
  out->nodes[axis] = range->last - range->first + 1;
  out->origin[axis] = density->origin[axis] + range->start * density->spacing[axis];
}

/* Copies a box of the window. */
static fg_status take(fg__window *out, fg_context *context,
                      const fg_density_arrays *density, const fg__window *whole,
                      const fg__stretch range[3])
{
  *out = *whole;
  for (int k = 0; k < whole->dimension; ++k)
    cut_along(out, &range[k], density, k);
  fg_status status = fg__window_allocate(out, context);
  if (status)
    return status;
  size_t wide = (size_t)out->nodes[0];
  int first = range[0].first, layers = out->dimension == 3 ? out->nodes[2] - 1 : 1;
  for (int z = 0; z < out->nodes[2]; ++z)
    for (int y = 0; y < out->nodes[1]; ++y) {
      int from_y = range[1].first + y, from_z = range[2].first + z;
      memcpy(out->level + fg__window_node(out, 0, y, z),
             whole->level + fg__window_node(whole, first, from_y, from_z),
             wide * sizeof *out->level);
      if (y + 1 < out->nodes[1] && z < layers)
        memcpy(out->active + fg__window_cell(out, 0, y, z),
               whole->active + fg__window_cell(whole, first, from_y, from_z), wide - 1);
    }
  return fg__window_keep_largest(out, context);
}

fg_status fg__window_divide(fg__window_piece part[FG__WINDOW_PIECES], int *count,
                            fg_context *context, const fg_density_arrays *density,
                            const fg__labels *labels, fg__window *whole)
{
  fg__piece piece[FG__WINDOW_PIECES];
  int found = fg__pieces_find(piece, density, labels, whole);
  fg_status status = FG_STATUS_OK;
  *count = 0;
  if (found == 0) {
    part[(*count)++] = (fg__window_piece){*whole, 1.0};
    *whole = (fg__window){0};
  }
  for (; *count < found && !status; ++*count) {
    fg__window_piece *next = &part[*count];
    next->share = piece[*count].share;
    status = take(&next->window, context, density, whole, piece[*count].range);
  }
  fg__window_clear(whole);
  return status;
}
