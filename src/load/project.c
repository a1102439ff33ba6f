/* Icons of one plane on another. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "flowgrain/map.h"
#include "icon/icons.h"
#include "map/map.h"

typedef struct planes {
  fg__map *from, *to;
} planes;

/* Degrees of a point of the old plane, and the same on the new; NaN where it has no
 * image. `turn`: the longitude to be next to, so that a line is not torn. */
static void move_point(double out[3], double *longitude, const planes *between,
                       const double point[3], const double *turn)
{
  double degrees[2];
  fg__map_inverse(between->from, 1, &point[0], &point[1], &degrees[0], &degrees[1]);
  const double beside = turn ? *turn : fg__map_center(between->to);
  degrees[0] -= 360.0 * nearbyint((degrees[0] - beside) / 360.0);
  fg__map_forward(between->to, 1, &degrees[0], &degrees[1], &out[0], &out[1]);
  out[2] = 0.0;
  *longitude = degrees[0];
}

/* The root of the ratio of areas on the new plane to areas on the old one at a point. */
static double length_factor(const planes *between, const double point[3])
{
  double degrees[2];
  fg__map_inverse(between->from, 1, &point[0], &point[1], &degrees[0], &degrees[1]);
  const double old_scale = fg__map_area_scale(between->from, degrees[0], degrees[1]);
  const double new_scale = fg__map_area_scale(between->to, degrees[0], degrees[1]);
  return sqrt(new_scale / old_scale) * fg__map_unit(between->from) /
         fg__map_unit(between->to);
}

/* The longest run of points within half a turn of the new centre and with an image. */
static int find_run(int *first, const planes *between, double (*point)[3],
                    const double *longitude, int count)
{
  const double center = fg__map_center(between->to);
  int best = 0, run = 0;
  for (int i = 0; i < count; ++i) {
    const bool seen = isfinite(point[i][0]) && isfinite(point[i][1]) &&
                      fabs(longitude[i] - center) <= 180.0 + 1e-9;
    run = seen ? run + 1 : 0;
    if (run > best) {
      best = run;
      *first = i + 1 - run;
    }
  }
  return best;
}

static fg_status add_moved(fg_icons *out, fg_context *context, const planes *between,
                           const fg_icon *icon, double (*point)[3], double *longitude)
{
  const double factor = length_factor(between, icon->center);
  double ignored, start;
  int first = 0;
  fg_icon moved = *icon;
  move_point(moved.center, &start, between, icon->center, NULL);
  for (int i = 0; i < icon->point_count; ++i)
    move_point(point[i], &longitude[i], between, icon->points[i],
               i > 0 ? &longitude[i - 1] : &start);
  const int count = find_run(&first, between, point, longitude, icon->point_count);
  if (count < 2 || !isfinite(factor) || !isfinite(moved.center[0]))
    return FG_STATUS_OK;
  moved.points = (const double(*)[3])(point + first);
  moved.point_count = count;
  moved.width *= factor;
  moved.tail_width *= factor;
  moved.head_length *= factor;
  moved.head_width *= factor;
  moved.area *= factor * factor;
  moved.way[0] *= factor;
  moved.way[1] *= factor;
  if (icon->id > 0)
    move_point(moved.seed, &ignored, between, icon->seed, &start);
  moved.spine = moved.streamline = NULL;
  moved.spine_count = moved.streamline_count = 0;
  return fg__icons_add(out, context, &moved);
}

static fg_status fill(fg_icons *out, fg_context *context, const planes *between,
                      const fg_icons *icons)
{
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg_icons_count(icons) && status == FG_STATUS_OK; ++n) {
    const fg_icon *icon = fg_icons_at(icons, n);
    double(*point)[3] = fg__allocate((size_t)icon->point_count, sizeof *point);
    double *longitude = fg__allocate((size_t)icon->point_count, sizeof *longitude);
    status = point && longitude
                 ? add_moved(out, context, between, icon, point, longitude)
                 : fg__fail_memory(context, "an icon",
                                   (size_t)icon->point_count * sizeof *point);
    free(point);
    free(longitude);
  }
  fg__icons_set_clusters(out, fg_icons_clusters(icons), fg_icons_dropped(icons));
  fg__icons_set_next_id(out, fg__icons_next_id(icons));
  return status;
}

/* Whether icons are to be moved, and from which plane. */
static const char *old_plane(const fg_icons *icons, const fg_field *field)
{
  const char *there = fg__icons_plane_of(field), *here = fg_icons_projection(icons);
  if (!there || (here && strcmp(here, there) == 0))
    return NULL;
  return here ? here : strcmp(there, FG__DEGREES) == 0 ? NULL : FG__DEGREES;
}

fg_status fg_icons_project(fg_icons **icons, fg_context *context, const fg_field *field)
{
  if (!icons || !*icons || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "icons: a NULL argument");
  const char *from = old_plane(*icons, field);
  if (!from)
    return FG_STATUS_OK;
  planes between = {NULL, NULL};
  fg_icons *moved = NULL;
  fg_status status = fg__map_create(&between.from, context, from);
  if (status == FG_STATUS_OK)
    status = fg__map_create(&between.to, context, fg__icons_plane_of(field));
  if (status == FG_STATUS_OK)
    status = fg__icons_create_empty(&moved, context);
  if (status == FG_STATUS_OK)
    status = fg__icons_set_projection(moved, context, fg__icons_plane_of(field));
  if (status == FG_STATUS_OK)
    status = fill(moved, context, &between, *icons);
  if (status == FG_STATUS_OK) {
    fg_icons_destroy(*icons);
    *icons = moved;
  } else {
    fg_icons_destroy(moved);
  }
  fg__map_destroy(between.from);
  fg__map_destroy(between.to);
  return status;
}
