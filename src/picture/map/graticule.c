#include "picture/map/graticule.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "picture/map/stroke.h"
#include "sphere/sphere.h"

/* Lines that a frame shows of either kind, about. */
static const double lines_shown = 6.0;

/* On maps of the world. */
static const double world_parallels = 30.0, world_meridians = 60.0;

/* On discs, meridians also where else they meet. */
static const double disc_lines = 4.5, disc_meridians = 30.0;

/* Nearer to a pole meridians are too close to be told apart, degrees of latitude. */
static const double nearest_pole = 75.0;

/* Or than this share of the latitudes that a box shows. */
static const double pole_share = 0.03;

static const double longest_step = 1.0, steps_in_frame = 90.0;

/* Whole samples do not fill a map to the pole: what is so near to a side, as a share of
 * the frame, ends there. */
static const double side_slack = 0.01;

typedef enum side { SIDE_LEFT, SIDE_RIGHT, SIDE_BOTTOM, SIDE_TOP } side;

/* Lines of one kind: parallels (k = 1) or meridians (k = 0). */
typedef struct family {
  int k;
  fg__ticks ticks;
  double low, high; /* along the lines, degrees */
} family;

/* Of the steps that read easily the one that comes nearest. quarters: those of an hour,
 * too. */
static double nice_step(double wanted, bool quarters)
{
  static const double steps[] = {1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 90.0, 15.0};
  const size_t count = sizeof steps / sizeof *steps - (quarters ? 0 : 1);
  double unit = 1.0;
  while (wanted < 0.7 * unit && unit > 1e-6)
    unit /= 10.0;
  double best = unit;
  for (size_t k = 0; k < (unit < 1.0 ? 3 : count); ++k)
    if (fabs(log(unit * steps[k] / wanted)) < fabs(log(best / wanted)))
      best = unit * steps[k];
  return best;
}

/* Whether meridians meet in the frame, in a point. */
static bool holds_pole(const fg__plane *plane)
{
  return (plane->kind == FG__PLANE_AZIMUTHAL ||
          (plane->kind == FG__PLANE_CUT && !fg__map_is_world(plane->map))) &&
         fmax(plane->north, -plane->south) > 90.0 - 1e-6;
}

static double step_of(const fg__plane *plane, int k)
{
  if (plane->disc)
    return k == 0 ? disc_meridians : nice_step(plane->radius / disc_lines, true);
  if (plane->whole)
    return k == 0 ? world_meridians : world_parallels;
  const double wanted =
      (k == 0 ? plane->east - plane->west : plane->north - plane->south) / lines_shown;
  return nice_step(k == 0 && holds_pole(plane) ? fmin(wanted, disc_meridians) : wanted,
                   false);
}

static bool is_round(const fg__plane *plane)
{
  return plane->east - plane->west > 360.0 - 1e-6;
}

static void describe_family(family *out, const fg__plane *plane, int k)
{
  fg__tick_axis axis;
  const double longitudes[2] = {plane->west, plane->east};
  const double latitudes[2] = {plane->south, plane->north};
  const double *across = k == 0 ? longitudes : latitudes;
  const double *along = k == 0 ? latitudes : longitudes;
  fg__axis_of_degrees(&axis, across[0], across[1],
                      k == 0 ? FG__TICKS_LONGITUDE : FG__TICKS_LATITUDE);
  out->k = k;
  out->ticks.count = 0;
  for (double step = step_of(plane, k); out->ticks.count == 0 && step < 720.0;
       step *= 2.0) {
    fg__ticks_fill(&out->ticks, &axis, step);
    if ((across[1] - across[0]) / step < 1.0)
      break;
  }
  /* the meridian that is shown at both ends is one; on maps with a cut it is the rim */
  if (k == 0 && is_round(plane) && out->ticks.count &&
      out->ticks.position[out->ticks.count - 1] > plane->east - 1e-9 &&
      plane->kind != FG__PLANE_DEGREES)
    --out->ticks.count;
  /* lines on a grid of degrees end beyond the frame, so that they cross it */
  const double more =
      plane->kind == FG__PLANE_DEGREES ? 0.01 * (along[1] - along[0]) : 0.0;
  out->low = along[0] - more;
  out->high = along[1] + more;
}

static bool is_rim(const fg__plane *plane, const family *f, double position)
{
  return plane->whole && !plane->disc && f->k == 0 &&
         fabs(fabs(position - plane->center[0]) - 180.0) < 1e-6;
}

static fg_status trace(fg__graticule *out, fg_context *context, const family *f,
                       double position)
{
  const fg__plane *plane = out->plane;
  fg__stroke stroke = {.longitude = NULL};
  const double step = fmin(longest_step, (f->high - f->low) / steps_in_frame);
  const int pieces = (int)ceil((f->high - f->low) / step);
  for (int n = 0; n <= pieces; ++n) {
    const double at = f->low + (f->high - f->low) * n / pieces;
    const double place[2] = {f->k == 0 ? position : at, f->k == 0 ? at : position};
    if (plane->kind == FG__PLANE_AZIMUTHAL &&
        fg__sphere_distance(plane->center, place) > plane->reach)
      fg__stroke_end(&stroke, &out->line, plane, false);
    else
      fg__stroke_add(&stroke, place[0], place[1]);
  }
  fg__stroke_end(&stroke, &out->line, plane, false);
  const bool failed = stroke.failed;
  fg__stroke_clear(&stroke);
  return failed ? fg__fail_memory(context, "a graticule", sizeof stroke) : FG_STATUS_OK;
}

static void add_label(fg__map_label *list, int *count, const char *text, int line,
                      const double at[2], double x, double y)
{
  if (*count == FG__MAP_LABELS || !isfinite(at[0]) || !isfinite(at[1]))
    return;
  fg__map_label *label = &list[(*count)++];
  *label = (fg__map_label){.at = {at[0], at[1]}, .out = {x, y}, .line = line};
  memcpy(label->text, text, sizeof label->text);
}

static void project(const fg__plane *plane, double longitude, double latitude,
                    double at[2])
{
  fg__plane_forward(plane, 1, &longitude, &latitude, &at[0], &at[1]);
}

/* Parallels at the left rim; meridians outside the foot, a line or an arc, or where
 * that is a point beside the equator. */
static void label_world(fg__graticule *out, const family *f, int n, int line)
{
  const fg__plane *plane = out->plane;
  const char *text = f->ticks.text[n];
  const double position = f->ticks.position[n];
  double at[2], feet[2][2];
  if (f->k == 1) {
    project(plane, plane->west + 1e-9, position, at);
    if (fabs(position) < 90.0 - 1e-6)
      add_label(out->label, &out->labels, text, line, at, -1.0, 0.0);
    return;
  }
  project(plane, plane->west + 1.0, -90.0, feet[0]);
  project(plane, plane->east - 1.0, -90.0, feet[1]);
  if (fabs(feet[1][0] - feet[0][0]) > 0.2 * (plane->high[0] - plane->low[0])) {
    double beside[2];
    project(plane, position, -90.0, at);
    project(plane, position + 1.0, -90.0, beside);
    const double east[2] = {beside[0] - at[0], beside[1] - at[1]};
    const double length = hypot(east[0], east[1]);
    add_label(out->label, &out->labels, text, line, at, east[1] / length,
              -east[0] / length);
    return;
  }
  static const double latitudes[] = {0.0,  -15.0, 15.0,  -45.0, 45.0, -8.0, 8.0,
                                     23.0, -23.0, -38.0, 38.0,  52.0, -52.0};
  for (size_t k = 0; k < sizeof latitudes / sizeof *latitudes; ++k) {
    project(plane, position, latitudes[k], at);
    add_label(out->inside, &out->insides, text, line, at, 0.0, 0.0);
  }
}

static bool is_polar(const fg__plane *plane)
{
  return fabs(plane->center[1]) > 90.0 - 1e-6;
}

/* Meridians round the rim. */
static void label_spoke(fg__graticule *out, const family *f, int n, int line)
{
  const fg__plane *plane = out->plane;
  double middle[2], there[2], at[2], out_of[2];
  const double latitude = plane->center[1] > 0.0 ? 80.0 : -80.0;
  project(plane, plane->center[0], plane->center[1], middle);
  project(plane, f->ticks.position[n], latitude, there);
  const double length = hypot(there[0] - middle[0], there[1] - middle[1]);
  const double radius = 0.5 * (plane->high[0] - plane->low[0]);
  for (int k = 0; k < 2; ++k) {
    out_of[k] = (there[k] - middle[k]) / length;
    at[k] = middle[k] + radius * out_of[k];
  }
  add_label(out->label, &out->labels, f->ticks.text[n], line, at, out_of[0], out_of[1]);
}

/* Places on the line from the middle on, halfway between lines of the other kind.
 * Parallels round a pole, which are labelled nowhere else, have more, a third of that
 * aside. The equator has none: 0° is what a meridian has, too. */
static void label_within(fg__graticule *out, const family *f, int n, int line)
{
  const fg__plane *plane = out->plane;
  const double position = f->ticks.position[n];
  const double step = f->k == 0 ? step_of(plane, 1) : step_of(plane, 0);
  if (f->k == 1 && (fabs(position) > 90.0 - 1e-6 || fabs(position) < 1e-6))
    return;
  const int first = out->insides;
  const bool needed = f->k == 1 && is_polar(plane);
  for (int k = 0; k < (needed ? 36 : 12); ++k) {
    static const double aside[] = {0.0, 1.0 / 3.0, -1.0 / 3.0};
    const double offset =
        (k % 2 ? -1.0 : 1.0) * (k % 12 / 2 + 0.5 + aside[k / 12]) * step;
    double at[2];
    if (f->k == 0 && fabs(plane->center[1] + offset) > nearest_pole)
      continue;
    if (f->k == 0)
      project(plane, position, plane->center[1] + offset, at);
    else
      project(plane, plane->center[0] + offset, position, at);
    add_label(out->inside, &out->insides, f->ticks.text[n], line, at, 0.0, 0.0);
  }
  for (int k = first; k < out->insides; ++k)
    out->inside[k].needed = needed;
}

static bool in_box(const fg__plane *plane, const double at[2])
{
  double slack = 1e-9 * (plane->high[0] - plane->low[0]);
  return at[0] >= plane->low[0] - slack && at[0] <= plane->high[0] + slack &&
         at[1] >= plane->low[1] - slack && at[1] <= plane->high[1] + slack;
}

/* Where the way from a place in the box to one outside leaves it. */
static side leave_box(const fg__plane *plane, const double in[2], const double out[2],
                      double at[2])
{
  side which = SIDE_LEFT;
  double least = HUGE_VAL;
  for (int k = 0; k < 2; ++k)
    for (int high = 0; high < 2; ++high) {
      const double limit = high ? plane->high[k] : plane->low[k];
      const double d = out[k] - in[k];
      const bool beyond = high ? out[k] > limit : out[k] < limit;
      const double share = beyond ? fmax((limit - in[k]) / d, 0.0) : HUGE_VAL;
      if (share < least) {
        least = share;
        which = (side)(2 * k + high);
      }
    }
  for (int k = 0; k < 2; ++k)
    at[k] = in[k] + fmin(least, 1.0) * (out[k] - in[k]);
  return which;
}

/* Whether meridians meet so near to a place that it is the middle one's alone. */
static bool is_others(const fg__plane *plane, const family *f, int n, const double at[2])
{
  double longitude, latitude;
  if (f->k == 1 || fabs(f->ticks.position[n] - plane->center[0]) < 1e-6)
    return false;
  fg__plane_inverse(plane, 1, &at[0], &at[1], &longitude, &latitude);
  const double off = 90.0 - fabs(latitude); /* NaN: at the pole */
  return holds_pole(plane) && !(off >= pole_share * (plane->north - plane->south));
}

/* Where the line traced last, the family's n-th, from `first` on, crosses a side of the
 * box. */
static void label_crossings(fg__graticule *out, size_t first, side wanted,
                            const family *f, int n)
{
  static const double ways[][2] = {{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}};
  const fg__plane *plane = out->plane;
  for (size_t k = first; k < out->line.count; ++k)
    for (size_t i = out->line.start[k]; i + 1 < out->line.start[k + 1]; ++i) {
      const double *a = out->line.point[i], *b = out->line.point[i + 1];
      const bool a_in = in_box(plane, a), b_in = in_box(plane, b);
      double at[2];
      if (a_in == b_in)
        continue;
      const side which = leave_box(plane, a_in ? a : b, a_in ? b : a, at);
      if (which == wanted && !is_others(plane, f, n, at))
        add_label(out->label, &out->labels, f->ticks.text[n], FG__TICK_LIMIT * f->k + n,
                  at, ways[which][0], ways[which][1]);
    }
}

/* Whether the lines traced last, from `first` on, are one line that closes: a parallel
 * round a pole that lies in the box. */
static bool is_closed(const fg__graticule *out, size_t first)
{
  const fg__polygons *lines = &out->line;
  if (lines->count != first + 1)
    return false;
  const double *a = lines->point[lines->start[first]];
  const double *b = lines->point[lines->start[first + 1] - 1];
  const double width = out->plane->high[0] - out->plane->low[0];
  return hypot(b[0] - a[0], b[1] - a[1]) < 1e-6 * width;
}

static bool has_label(const fg__graticule *out, int line)
{
  for (int n = 0; n < out->labels; ++n)
    if (out->label[n].line == line)
      return true;
  return false;
}

/* Lines that end in the box are labelled, too: a parallel at the left side, for it ends
 * at the meridian where the map is cut; a meridian that ends at the lower side, at a pole
 * that is a line, there. */
static void label_end(fg__graticule *out, size_t first, const family *f, int n)
{
  const fg__plane *plane = out->plane;
  const int across = 1 - f->k;
  double at[2] = {HUGE_VAL, HUGE_VAL};
  for (size_t part = first; part < out->line.count; ++part) {
    const size_t ends[2] = {out->line.start[part], out->line.start[part + 1] - 1};
    for (int i = 0; i < 2; ++i) {
      const double *end = out->line.point[ends[i]];
      if (in_box(plane, end) && end[across] < at[across])
        memcpy(at, end, sizeof at);
    }
  }
  const double above = at[across] - plane->low[across];
  if (f->k == 0 && (above > side_slack * (plane->high[1] - plane->low[1]) ||
                    is_others(plane, f, n, at)))
    return;
  at[across] = isfinite(above) ? plane->low[across] : above;
  add_label(out->label, &out->labels, f->ticks.text[n], FG__TICK_LIMIT * f->k + n, at,
            f->k == 0 ? 0.0 : -1.0, f->k == 0 ? -1.0 : 0.0);
}

/* The first line of the polygons that belongs to each line of the two families. */
typedef struct places {
  size_t first[2][FG__TICK_LIMIT + 1];
} places;

/* Parallels at the left side and meridians at the lower one; what does not get there, at
 * the opposite sides: degrees of both kinds in one row are hard to read. Parallels that
 * close round a pole have them inside. */
static void label_box(fg__graticule *out, const family *f, const places *where)
{
  static const side order[2][2] = {{SIDE_BOTTOM, SIDE_TOP}, {SIDE_LEFT, SIDE_RIGHT}};
  fg__polygons *lines = &out->line;
  const size_t all = lines->count;
  for (int k = 0; k < 2; ++k)
    for (int which = 1; which >= 0; --which)
      for (int n = 0; n < f[which].ticks.count; ++n) {
        lines->count = where->first[which][n + 1];
        label_crossings(out, where->first[which][n], order[which][k], &f[which], n);
      }
  for (int k = 1; k >= 0; --k)
    for (int n = 0; n < f[k].ticks.count; ++n) {
      const int line = FG__TICK_LIMIT * k + n;
      lines->count = where->first[k][n + 1];
      if (has_label(out, line))
        continue;
      if (k == 1 && is_closed(out, where->first[k][n]))
        label_within(out, &f[k], n, line);
      else
        label_end(out, where->first[k][n], &f[k], n);
    }
  lines->count = all;
}

fg_status fg__graticule_create(fg__graticule *out, fg_context *context,
                               const fg__plane *plane)
{
  family f[2];
  places where = {{{0}}};
  memset(out, 0, sizeof *out);
  out->plane = plane;
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2; ++k) {
    describe_family(&f[k], plane, k);
    for (int n = 0; n < f[k].ticks.count && !status; ++n) {
      where.first[k][n] = out->line.count;
      if (!is_rim(plane, &f[k], f[k].ticks.position[n]))
        status = trace(out, context, &f[k], f[k].ticks.position[n]);
      where.first[k][n + 1] = out->line.count;
    }
  }
  for (int k = 1; k >= 0 && plane->whole; --k)
    for (int n = 0; n < f[k].ticks.count; ++n) {
      const int line = FG__TICK_LIMIT * k + n;
      if (is_rim(plane, &f[k], f[k].ticks.position[n]))
        continue;
      if (!plane->disc)
        label_world(out, &f[k], n, line);
      else if (k == 0 && is_polar(plane))
        label_spoke(out, &f[k], n, line);
      else
        label_within(out, &f[k], n, line);
    }
  if (!plane->whole)
    label_box(out, f, &where);
  if (status)
    fg__graticule_clear(out);
  return status;
}

void fg__graticule_clear(fg__graticule *graticule)
{
  fg__polygons_clear(&graticule->line);
}
