#include "icon/rest.h"

#include "icon/icons_make.h"
#include "icon/measure.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Flow that crosses a long cluster, or turns in a wide one, leaves parts of it without an
 * arrow. In roots of the mean cluster's area (0.55 of a fair share where clusters cover
 * 0.3): points this far from all arrows are left, and an arrow for them is at least so
 * long. They must have this share of the mean area. docs/method/icons.md has what these
 * add. */
static const double FAR = 0.5;
static const double SHORTEST = 0.65;
static const double LEAST = 0.35;

/* Straight pieces at most that stand for a centreline: of a ring each turns by 5 degrees,
 * and its middle is a thousandth of the radius off. */
enum { PIECES = 60 };

static double mean_area(const fg__labels *labels)
{
  double sum = 0;
  for (int n = 0; n < labels->count; n++)
    sum += labels->area[n];
  return sum / labels->count;
}

static double count_nodes(const fg__window *window)
{
  int nodes = window->nodes[0] * window->nodes[1], inside = 0;
  for (int i = 0; i < nodes; i++)
    inside += window->level[i] > 0.0F;
  return inside;
}

static double square_to_piece(const double a[3], const double b[3], const double p[2])
{
  double dx = b[0] - a[0], dy = b[1] - a[1], x = p[0] - a[0], y = p[1] - a[1];
  double length = dx * dx + dy * dy;
  double t = length > 0 ? fmin(fmax((x * dx + y * dy) / length, 0), 1) : 0;
  return (x - t * dx) * (x - t * dx) + (y - t * dy) * (y - t * dy);
}

static double square_to_icon(const fg_icon *icon, const double point[2])
{
  int last = icon->point_count - 1, stride = last / PIECES + 1;
  double nearest = HUGE_VAL;
  for (int k = 0; k < last; k += stride) {
    int next = k + stride < last ? k + stride : last;
    nearest = fmin(nearest, square_to_piece(icon->points[k], icon->points[next], point));
  }
  return nearest;
}

static int nearest_icon(double *square, const fg_icon *icon, int count,
                        const fg__window *window, int node)
{
  const double point[2] = {
      window->origin[0] + node % window->nodes[0] * window->spacing[0],
      window->origin[1] + node / window->nodes[0] * window->spacing[1]};
  int nearest = 0;
  *square = HUGE_VAL;
  for (int n = 0; n < count; n++) {
    double next = square_to_icon(&icon[n], point);
    if (next < *square) {
      *square = next;
      nearest = n;
    }
  }
  return nearest;
}

static fg_status copy(fg__window *out, fg_context *context, const fg__window *window)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  size_t cells = (size_t)(window->nodes[0] - 1) * (size_t)(window->nodes[1] - 1);
  *out = *window;
  fg_status status = fg__window_allocate(out, context);
  if (status != FG_STATUS_OK)
    return status;
  memcpy(out->level, window->level, nodes * sizeof *out->level);
  memcpy(out->active, window->active, cells);
  return FG_STATUS_OK;
}

fg_status fg__rest_find(fg__window *rest, bool *found, fg_context *context,
                        const fg__window *window, const fg_icon *icon, int count,
                        const fg__labels *labels)
{
  double mean = mean_area(labels), far = FAR * sqrt(mean);
  double least = LEAST * mean / (window->spacing[0] * window->spacing[1]);
  *found = false;
  if (count_nodes(window) < least)
    return FG_STATUS_OK;
  fg_status status = copy(rest, context, window);
  if (status != FG_STATUS_OK)
    return status;
  double spacing = fmin(window->spacing[0], window->spacing[1]), square;
  for (int n = 0; n < window->nodes[0] * window->nodes[1]; n++)
    if (rest->level[n] > 0.0F) {
      nearest_icon(&square, icon, count, window, n);
      rest->level[n] = fminf(rest->level[n], (float)((sqrt(square) - far) / spacing));
    }
  status = fg__window_keep_largest(rest, context);
  *found = status == FG_STATUS_OK && count_nodes(rest) >= least;
  if (!*found)
    fg__window_clear(rest);
  return status;
}

bool fg__rest_deserves(const fg_icon *icon, const fg__labels *labels)
{
  return fg__icon_length(icon) >= SHORTEST * sqrt(mean_area(labels));
}

void fg__rest_give_up(fg__window *window, const fg__window *rest)
{
  for (int n = 0; n < window->nodes[0] * window->nodes[1]; n++)
    if (rest->level[n] > 0.0F)
      window->level[n] = -window->level[n];
}

void fg__rest_share_out(fg_icon *icon, int count, const fg__window *window)
{
  int own[FG__ICON_PARTS] = {0}, all = 0;
  double square;
  for (int n = 0; n < window->nodes[0] * window->nodes[1]; n++)
    if (window->level[n] > 0.0F) {
      ++own[nearest_icon(&square, icon, count, window, n)];
      ++all;
    }
  for (int n = 0; n < count; n++)
    icon[n].area *= (double)own[n] / all;
}
