/* From where arrows in 3D are seen best. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/memory.h"
#include "base/vector.h"
#include "picture/camera.h"

/* Views that are tried, degrees: every azimuth with every elevation. */
enum { AZIMUTHS = 36, ELEVATIONS = 11 };
static const double azimuth_step = 10.0, lowest = 10.0, elevation_step = 4.0;

/* The view that is taken when others are not better by more than `as_good`. */
static const double default_azimuth = 30.0, default_elevation = 22.0;
static const double as_good = 0.05;

/* A head is read for the direction, a body for the way: in lengths of the body. */
static const double head_counts = 3.0;

/* Pixels a side of the image of depths. */
enum { SIDE = 192 };

/* Points of an icon's line are at most so far apart, in longest sides of the box. */
static const double longest_step = 0.008;

/* A point of a line: a ball of the arrow. */
typedef struct ball {
  double place[3], radius; /* in the view box */
  double counts;           /* of the piece to the next one; 0: none */
} ball;

typedef struct crowd {
  ball *ball;
  size_t count, capacity;
} crowd;

/* What is known of a ball from one viewpoint. */
typedef struct shade {
  double pixel[2], depth, radius;
} shade;

static fg_status add_ball(crowd *out, fg_context *context, const ball *one)
{
  if (!fg__grow((void **)&out->ball, &out->capacity, out->count + 1, sizeof *out->ball))
    return fg__fail_memory(context, "a view", out->count * sizeof *out->ball);
  out->ball[out->count++] = *one;
  return FG_STATUS_OK;
}

/* Brings a point into the box, along the axes with a period. */
static void wrap(const fg__view_box *view_box, double place[3])
{
  for (int k = 0; k < 3; ++k)
    if (view_box->period[k] > 0.0)
      place[k] -= view_box->period[k] *
                  floor((place[k] + view_box->half[k]) / view_box->period[k]);
}

static double length_of(const fg_icon *icon)
{
  double length = 0.0;
  for (int n = 0; n + 1 < icon->point_count; ++n)
    length += fg__distance(icon->points[n], icon->points[n + 1]);
  return length;
}

static fg_status add_icon(crowd *out, fg_context *context, const fg__view_box *view_box,
                          const fg_icon *icon)
{
  double base = length_of(icon) - icon->head_length, passed = 0.0;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n + 1 < icon->point_count && !status; ++n) {
    const double *from = icon->points[n], *to = icon->points[n + 1];
    double piece = fg__distance(from, to);
    int parts = (int)fmin(fmax(ceil(piece * view_box->scale / longest_step), 1.0), 1e4);
    for (int m = 0; m < parts && !status; ++m) {
      double t = (double)m / parts, at = passed + t * piece;
      double width = at <= base
                         ? icon->width
                         : icon->head_width * (1.0 - (at - base) / icon->head_length);
      ball one = {.radius = view_box->scale * width / 2.0,
                  .counts = at > base ? head_counts : 1.0};
      for (int k = 0; k < 3; ++k)
        one.place[k] = fg__view_box_place(view_box, k, from[k] + t * (to[k] - from[k]));
      wrap(view_box, one.place);
      status = add_ball(out, context, &one);
    }
    passed += piece;
  }
  if (!status && out->count > 0)
    out->ball[out->count - 1].counts = 0.0; /* the next one is another arrow's */
  return status;
}

/* Writes a disc into the image of depths. */
static void splat(float depth[SIDE][SIDE], const shade *one)
{
  int x0 = (int)ceil(one->pixel[0] - one->radius - 0.5);
  int x1 = (int)floor(one->pixel[0] + one->radius + 0.5);
  int y0 = (int)ceil(one->pixel[1] - one->radius - 0.5);
  int y1 = (int)floor(one->pixel[1] + one->radius + 0.5);
  for (int y = y0 > 0 ? y0 : 0; y <= y1 && y < SIDE; ++y)
    for (int x = x0 > 0 ? x0 : 0; x <= x1 && x < SIDE; ++x)
      if ((double)depth[y][x] > one->depth)
        depth[y][x] = (float)one->depth;
}

static bool is_seen(float depth[SIDE][SIDE], const shade *one)
{
  int x = (int)lround(one->pixel[0]), y = (int)lround(one->pixel[1]);
  if (x < 0 || y < 0 || x >= SIDE || y >= SIDE)
    return true;
  /* its neighbours along the line are not before it, nor is what only touches it */
  double slack = 4.0 * longest_step;
  return one->depth < (double)depth[y][x] + slack;
}

/* What is read of a piece seen under an angle to the line of sight, by its sine: three
 * quarters of one that is foreshortened by half, little of one that points at the viewer.
 * As the length is seen, a few arrows end-on would weigh less than many that are a little
 * longer. */
static double read_of(double sine)
{
  const double s = fmin(sine, 1.0);
  return s * (2.0 - s);
}

/* Length of what is seen, by what is read of it, in the view box. */
static double merit_of(const crowd *all, const fg__camera *camera, shade *seen,
                       float depth[SIDE][SIDE])
{
  double sum = 0.0;
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x)
      depth[y][x] = INFINITY;
  for (size_t n = 0; n < all->count; ++n) {
    double to[3];
    fg__subtract(all->ball[n].place, camera->eye, to);
    fg__camera_project(camera, all->ball[n].place, seen[n].pixel);
    seen[n].depth = fg__dot(to, camera->forward);
    seen[n].radius = all->ball[n].radius * camera->factor / seen[n].depth;
    splat(depth, &seen[n]);
  }
  for (size_t n = 0; n + 1 < all->count; ++n) {
    double projected = hypot(seen[n + 1].pixel[0] - seen[n].pixel[0],
                             seen[n + 1].pixel[1] - seen[n].pixel[1]) *
                       seen[n].depth / camera->factor;
    double piece = fg__distance(all->ball[n].place, all->ball[n + 1].place);
    if (all->ball[n].counts > 0.0 && piece > 0.0 && piece < 2.0 * longest_step &&
        is_seen(depth, &seen[n]))
      sum += all->ball[n].counts * piece * read_of(projected / piece);
  }
  return sum;
}

/* The cosine of the angle to the default view. */
static double nearness(double azimuth, double elevation)
{
  double a = (azimuth - default_azimuth) * FG__RADIANS;
  double e = elevation * FG__RADIANS, u = default_elevation * FG__RADIANS;
  return cos(e) * cos(u) * cos(a) + sin(e) * sin(u);
}

static void choose(double *azimuth, double *elevation,
                   const double merit[AZIMUTHS * ELEVATIONS])
{
  double best = 0.0, nearest = -HUGE_VAL;
  for (int n = 0; n < AZIMUTHS * ELEVATIONS; ++n)
    best = fmax(best, merit[n]);
  for (int n = 0; n < AZIMUTHS * ELEVATIONS; ++n) {
    double a = azimuth_step * (n % AZIMUTHS);
    double e = lowest + elevation_step * (n / AZIMUTHS), near = nearness(a, e);
    if (merit[n] >= (1.0 - as_good) * best && near > nearest + 1e-9) {
      nearest = near;
      *azimuth = a;
      *elevation = e;
    }
  }
}

fg_status fg_solid_best_view(double *azimuth, double *elevation, fg_context *context,
                             const fg_field *field, const fg_icons *icons)
{
  if (!azimuth || !elevation || !field || !icons ||
      fg_field_contents(field)->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "a view: a field in 3 dimensions, icons and places for the angles "
                    "are needed");
  const fg__pane pane = {0.0, 0.0, SIDE, SIDE};
  fg__view_box view_box;
  fg__view_box_of(&view_box, fg_field_contents(field));
  crowd all = {.ball = NULL};
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < fg_icons_count(icons) && !status; ++n)
    status = add_icon(&all, context, &view_box, fg_icons_at(icons, n));
  float(*depth)[SIDE] = fg__allocate(SIDE, sizeof *depth);
  shade *seen = fg__allocate(all.count, sizeof *seen);
  if (!status && (!depth || !seen))
    status = fg__fail_memory(context, "a view", all.count * sizeof *seen);
  double merit[AZIMUTHS * ELEVATIONS];
  for (int n = 0; n < AZIMUTHS * ELEVATIONS && !status; ++n) {
    fg__camera camera;
    fg__camera_look(&camera, &view_box, azimuth_step * (n % AZIMUTHS),
                    lowest + elevation_step * (n / AZIMUTHS), &pane);
    merit[n] = merit_of(&all, &camera, seen, depth);
    status = fg__check_stop(context);
  }
  if (!status)
    choose(azimuth, elevation, merit);
  free(seen);
  free(depth);
  free(all.ball);
  return status;
}
