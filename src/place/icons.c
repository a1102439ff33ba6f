/* From placed lines to arrows, and from icons to the seeds of lines. */
#include "place/placement.h"

#include "base/memory.h"
#include "base/vector.h"
#include "icon/icons.h"
#include "icon/measure.h"
#include "icon/slender.h"
#include "place/regions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Body widths in lambda: of an arrow in still and in fast flow (that of the domain's
 * upper twentieth). A reader takes broad arrows for strong flow, so that width says the
 * same as colour. */
static const double SLOW_WIDTH = 0.028;
static const double FAST_WIDTH = 0.066;

/* In lengths of its line, at most: short arrows are slim, and their heads stay heads. */
static const double WIDEST = 0.085;

/* A head turns by this at most, and so does the body behind it over a quarter of its
 * length. */
static const double HEAD_TURN_COSINE = 0.5; /* 60 degrees */
static const double BEHIND_HEAD = 0.25;

/* A line that turns by more than this goes round something: a ring when the streamline
 * comes back to its tail within this share of its diameter, else a spiral. */
static const double ROUND_TURNING = 4.4;
static const double CLOSED = 0.12;

static double width_of(const fg__place_search *search, double speed, double length)
{
  const fg__place_domain *domain = search->domain;
  double share = domain->fast > 0.0 ? fmin(1.0, speed / domain->fast) : 1.0;
  double width = search->scale.lambda * (SLOW_WIDTH + share * (FAST_WIDTH - SLOW_WIDTH));
  return fmin(width, WIDEST * length);
}

/* An arrow, a ring or a spiral. */
static fg_icon_kind kind_of(const fg__place_search *search, const fg_icon *icon)
{
  double gap, diameter;
  double turning = fg__place_turning(icon->points, icon->point_count);
  if (turning < ROUND_TURNING ||
      !fg__place_close(&gap, &diameter, search->domain, &search->scale, icon->points[0],
                       fg__icon_length(icon) / turning))
    return FG_ICON_ARROW;
  return gap < CLOSED * diameter ? FG_ICON_RING : FG_ICON_SPIRAL;
}

/* The point halfway along the centreline. */
static void set_center(fg_icon *icon)
{
  double left = 0.5 * fg__icon_length(icon);
  for (int n = 1; n < icon->point_count; ++n) {
    const double *from = icon->points[n - 1];
    double along[3];
    for (int k = 0; k < 3; ++k)
      along[k] = icon->points[n][k] - from[k];
    double length = fg__length(along), share = length > left ? left / length : 1.0;
    for (int k = 0; k < 3; ++k)
      icon->center[k] = from[k] + share * along[k];
    left -= length;
    if (!(left > 0.0))
      return;
  }
}

/* The unit direction of the piece before point n, and its length. */
static double direction_of(double out[3], const double (*points)[3], int n)
{
  for (int k = 0; k < 3; ++k)
    out[k] = points[n][k] - points[n - 1][k];
  const double length = fg__length(out);
  for (int k = 0; k < 3; ++k)
    out[k] *= length > 0.0 ? 1.0 / length : 0.0;
  return length;
}

/* Whether no two pieces of a line that ends at point `last` lie apart by more than a head
 * may turn, over that length before its end. */
static bool is_calm(const double (*points)[3], int last, double length)
{
  double piece[3], other[3], left = length;
  for (int n = last; n > 0 && left > 0.0; --n) {
    left -= direction_of(piece, points, n);
    for (int m = last; m > n; --m) {
      direction_of(other, points, m);
      if (fg__dot(piece, other) < HEAD_TURN_COSINE)
        return false;
    }
  }
  return true;
}

/* The points of a line up to a place where its head is on a calm piece: the last one of
 * those as near to its end as the piece is long. An even tight arc has none, and keeps
 * its end. */
static int count_to_calm(const fg_icon *icon)
{
  const double reach = (1.0 + BEHIND_HEAD) * icon->head_length;
  double ignored[3], left = reach;
  for (int last = icon->point_count - 1; last > 0 && left >= 0.0; --last) {
    if (is_calm(icon->points, last, reach))
      return last + 1;
    left -= direction_of(ignored, icon->points, last);
  }
  return icon->point_count;
}

static void set_width(fg_icon *icon, const fg__place_search *search)
{
  if (search->scale.dimension == 3)
    fg__solid_set_slender(icon, search->scale.lambda);
  else
    fg__icon_set_width(icon, 2, width_of(search, icon->speed, fg__icon_length(icon)));
}

static fg_status add_icon(fg_icons *icons, fg_context *context,
                          const fg__place_search *search, int index,
                          const fg__place_region *read)
{
  const fg__place_icon *placed = search->icon[index];
  double(*points)[3] = NULL;
  fg_icon icon = {.cluster = placed->identity + 1,
                  .id = placed->identity + 1,
                  .area = read->measure,
                  .speed = read->speed};
  fg_status status = fg__place_trace_fine(&points, &icon.point_count, context,
                                          search->domain, &search->scale, &placed->line);
  if (status != FG_STATUS_OK)
    return status;
  if (icon.point_count < 2) {
    free(points);
    return fg__fail(context, FG_STATUS_NO_CONVERGENCE,
                    "the line of arrow %d ends where it begins", index);
  }
  icon.points = (const double(*)[3])points;
  if (!(read->moving > 0.0))
    icon.speed = fg__place_speed(search->domain, placed->seed.position);
  icon.kind = kind_of(search, &icon);
  set_width(&icon, search);
  icon.point_count = count_to_calm(&icon);
  set_width(&icon, search);
  set_center(&icon);
  for (int k = 0; k < 3; ++k)
    icon.seed[k] = placed->seed.position[k];
  for (int k = 0; k < 2; ++k)
    icon.way[k] = placed->seed.way[k];
  status = fg__icons_add(icons, context, &icon);
  free(points);
  return status;
}

fg_status fg_placement_icons(fg_icons **out, const fg_placement *placement)
{
  const fg__place_search *search = fg__placement_search(placement);
  fg_context *context = search->context;
  fg_icons *icons = NULL;
  fg__place_region *read = fg__allocate((size_t)search->count, sizeof *read);
  *out = NULL;
  if (!read)
    return fg__fail_memory(context, "the icons", (size_t)search->count * sizeof *read);
  fg_status status = fg__place_measure_regions(read, context, search);
  if (status == FG_STATUS_OK)
    status = fg__icons_create_empty(&icons, context);
  if (status == FG_STATUS_OK)
    status = fg__icons_set_projection(icons, context,
                                      fg__icons_plane_of(fg__placement_field(placement)));
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n)
    status = add_icon(icons, context, search, n, &read[n]);
  free(read);
  if (status != FG_STATUS_OK) {
    fg_icons_destroy(icons);
    return status;
  }
  fg__icons_set_clusters(icons, search->count, 0);
  fg__icons_set_next_id(icons, search->next_identity + 1);
  *out = icons;
  return FG_STATUS_OK;
}

bool fg__place_is_placed(const fg_icon *icon)
{
  return icon->way[0] + icon->way[1] > 0.0;
}

fg__place_seed fg__place_seed_of(const fg_icon *icon, const fg__place_scale *scale)
{
  fg__place_seed seed = {{0}, {0}};
  if (fg__place_is_placed(icon)) {
    memcpy(seed.position, icon->seed, sizeof seed.position);
    memcpy(seed.way, icon->way, sizeof seed.way);
    return seed;
  }
  double length = fg__icon_length(icon), half = length / 2.0, done = 0.0;
  memcpy(seed.position, icon->points[0], sizeof seed.position);
  for (int n = 1; n < icon->point_count && done < half; ++n) {
    const double *a = icon->points[n - 1], *b = icon->points[n];
    double piece = fg__distance(a, b);
    double t = piece > 0.0 ? fmin(1.0, (half - done) / piece) : 0.0;
    fg__lerp(a, t, b, seed.position);
    done += piece;
  }
  double way = scale->free ? fmin(fmax(half, 0.3 * scale->lambda), scale->lambda)
                           : 0.5 * scale->lambda;
  seed.way[0] = seed.way[1] = way;
  return seed;
}
