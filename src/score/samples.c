#include "score/samples.h"

#include "base/memory.h"
#include "base/weighted.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lines of thirty thousand times the domain's side. */
enum { MOST_SAMPLES = 1 << 24 };

/* A walk along a line. */
typedef struct walk {
  const double (*point)[3];
  int points, dimension;
  int segment;
  double before; /* arc length at the segment's begin */
} walk;

static double distance(const double a[3], const double b[3], int dimension)
{
  const double along = hypot(b[0] - a[0], b[1] - a[1]);
  return dimension == 3 ? hypot(along, b[2] - a[2]) : along;
}

static double length_of(const fg_icon *icon, int dimension)
{
  double sum = 0.0;
  for (int i = 1; i < icon->point_count; ++i)
    sum += distance(icon->points[i - 1], icon->points[i], dimension);
  return sum;
}

/* The point at arc length s, not before the last one asked for. */
static void walk_to(walk *w, double s, double out[3])
{
  double length = distance(w->point[w->segment], w->point[w->segment + 1], w->dimension);
  while (w->segment + 2 < w->points && w->before + length < s) {
    w->before += length;
    ++w->segment;
    length = distance(w->point[w->segment], w->point[w->segment + 1], w->dimension);
  }
  const double *from = w->point[w->segment], *to = w->point[w->segment + 1];
  double share = length > 0.0 ? (s - w->before) / length : 0.0;
  share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
  for (int k = 0; k < 3; ++k)
    out[k] = k < w->dimension ? from[k] + share * (to[k] - from[k]) : 0.0;
}

/* The direction from a to b; false when they are one point. */
static bool set_chord(double out[3], const double a[3], const double b[3], int dimension)
{
  const double length = distance(a, b, dimension);
  for (int k = 0; k < 3; ++k)
    out[k] = k < dimension && length > 0.0 ? (b[k] - a[k]) / length : 0.0;
  return length > 0.0;
}

static void wrap(const fg_field *field, double position[3])
{
  for (int k = 0; k < field->contents.dimension; ++k) {
    const double period = field->contents.period[k], first = field->contents.axis[k][0];
    if (period > 0.0 && !(position[k] >= first && position[k] < first + period)) {
      position[k] -= period * floor((position[k] - first) / period);
      if (!(position[k] < first + period))
        position[k] = first;
    }
  }
}

static void add_sample(fg__samples *samples, const fg__domain_raster *raster,
                       const double position[3], const double tangent[3])
{
  double ignored[3];
  double *at = samples->position[samples->count];
  memcpy(at, position, 3 * sizeof *at);
  wrap(raster->field, at);
  if (!fg_field_velocity(raster->field, at, ignored)) {
    ++samples->outside;
    return;
  }
  memcpy(samples->tangent[samples->count++], tangent, 3 * sizeof *tangent);
}

static size_t pieces_of(double length, const fg__domain_raster *raster)
{
  return (size_t)ceil(length / (0.5 * raster->spacing));
}

/* The middle `kept` of an icon's `length`. */
static void add_icon(fg__samples *samples, const fg__domain_raster *raster,
                     const fg_icon *icon, double length, double kept)
{
  walk ends = {
      .point = icon->points, .points = icon->point_count, .dimension = raster->dimension};
  walk middles = ends;
  const size_t pieces = pieces_of(kept, raster);
  const double from = 0.5 * (length - kept);
  double begin[3], end[3], middle[3], tangent[3];
  walk_to(&ends, from, begin);
  for (size_t n = 0; n < pieces; ++n) {
    walk_to(&ends, from + kept * (double)(n + 1) / (double)pieces, end);
    walk_to(&middles, from + kept * ((double)n + 0.5) / (double)pieces, middle);
    /* a line that turns round within a piece goes as the segment in its middle */
    if (set_chord(tangent, begin, end, raster->dimension) ||
        set_chord(tangent, icon->points[middles.segment],
                  icon->points[middles.segment + 1], raster->dimension))
      add_sample(samples, raster, middle, tangent);
    memcpy(begin, end, sizeof begin);
  }
}

/* The greatest length to which lines must be cut so that all together have at most `all`:
 * the shortest keep theirs, the others share the rest alike. */
static double common_length(double *sorted, int count, double all)
{
  qsort(sorted, (size_t)count, sizeof *sorted, fg__by_size);
  double used = 0.0;
  for (int n = 0; n < count; ++n) {
    const double share = (all - used) / (count - n);
    if (sorted[n] > share)
      return fmax(share, 0.0);
    used += sorted[n];
  }
  return HUGE_VAL;
}

/* Lengths of the lines, and what is kept of each. */
typedef struct lengths {
  double *whole, *kept;
} lengths;

static fg_status cut_lines(lengths *out, fg_context *context, const fg_icons *icons,
                           const fg__domain_raster *raster, double longest, double all)
{
  const int count = fg_icons_count(icons);
  const size_t bytes = (size_t)count * sizeof(double);
  double *sorted = fg__allocate((size_t)count, sizeof *sorted);
  out->whole = fg__allocate((size_t)count, sizeof *out->whole);
  out->kept = fg__allocate((size_t)count, sizeof *out->kept);
  fg_status status = FG_STATUS_OK;
  if (!sorted || !out->whole || !out->kept)
    status = fg__fail_memory(context, "the lengths of icons", 3 * bytes);
  for (int n = 0; n < count && status == FG_STATUS_OK; ++n) {
    out->whole[n] = length_of(fg_icons_at(icons, n), raster->dimension);
    if (!isfinite(out->whole[n]))
      status = fg__fail(context, FG_STATUS_ARGUMENT, "score: icon %d of %d is %g long", n,
                        count, out->whole[n]);
    sorted[n] = out->kept[n] = fmin(out->whole[n], longest);
  }
  if (status == FG_STATUS_OK) {
    const double most = common_length(sorted, count, all);
    for (int n = 0; n < count; ++n)
      out->kept[n] = fmin(out->kept[n], most);
  }
  free(sorted);
  return status;
}

static fg_status allocate(fg__samples *samples, fg_context *context,
                          const fg__domain_raster *raster, const double *kept)
{
  double pieces = 0.0;
  samples->shortest = samples->icons ? HUGE_VAL : 0.0;
  for (int n = 0; n < samples->icons; ++n) {
    pieces += ceil(kept[n] / (0.5 * raster->spacing));
    samples->length += kept[n];
    samples->shortest = fmin(samples->shortest, kept[n]);
    samples->longest = fmax(samples->longest, kept[n]);
  }
  if (pieces > MOST_SAMPLES)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "score: lines of %g in all, %g times the domain's side, are too long",
                    samples->length, samples->length / raster->side);
  const size_t count = (size_t)pieces + 1;
  samples->first = fg__allocate((size_t)samples->icons + 1, sizeof *samples->first);
  samples->position = fg__allocate(count, sizeof *samples->position);
  samples->tangent = fg__allocate(count, sizeof *samples->tangent);
  if (samples->first && samples->position && samples->tangent)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "samples of icons",
                         count * 2 * sizeof *samples->position);
}

fg_status fg__samples_create(fg__samples *out, fg_context *context,
                             const fg__domain_raster *raster, const fg_icons *icons,
                             double longest, double all)
{
  *out = (fg__samples){.icons = fg_icons_count(icons)};
  lengths lines = {0};
  fg_status status = cut_lines(&lines, context, icons, raster, longest, all);
  if (status == FG_STATUS_OK)
    status = allocate(out, context, raster, lines.kept);
  for (int n = 0; n < out->icons && status == FG_STATUS_OK; ++n) {
    out->first[n] = out->count;
    add_icon(out, raster, fg_icons_at(icons, n), lines.whole[n], lines.kept[n]);
    out->first[n + 1] = out->count;
  }
  free(lines.whole);
  free(lines.kept);
  return status;
}

void fg__samples_clear(fg__samples *samples)
{
  free(samples->first);
  free(samples->position);
  free(samples->tangent);
  *samples = (fg__samples){0};
}
