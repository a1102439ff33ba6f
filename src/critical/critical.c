#include "flowgrain/critical.h"

#include "base/memory.h"
#include "critical/directions.h"

#include <stdlib.h>

struct fg_critical_points {
  fg_critical_point *point;
  int count;
  double length; /* lambda */
};

enum { DEFAULT_COUNT = 40, MOST_COUNT = 1000000 };

/* The share of a Gaussian that a straight boundary leaves at one standard deviation. */
static const double LEAST_SHARE = 0.8413;

/* |div| / |curl| up to which a streamline counts as closed: at this ratio its radius
 * changes by 1.87 in a turn. |curl| / |div| up to which it counts as straight: then it
 * turns by less than 30 degrees on the way from lambda / 16 to lambda / 2. */
static const double CLOSED = 0.1, STRAIGHT = 0.25;

static void set_unit(double out[2], double x, double y)
{
  const double length = hypot(x, y);
  out[0] = length > 0.0 ? x / length : 1.0;
  out[1] = length > 0.0 ? y / length : 0.0;
}

/* Eigenvectors: what the gradient less one eigenvalue leaves is along the other's. */
static void set_axes(fg_critical_point *out, const double g[2][2], double root)
{
  const double middle = 0.5 * (g[0][0] + g[1][1]);
  for (int k = 0; k < 2; ++k) {
    const double other = middle + (k ? 0.5 : -0.5) * root;
    const double a[2] = {g[0][0] - other, g[1][0]}, b[2] = {g[0][1], g[1][1] - other};
    const bool first = hypot(a[0], a[1]) >= hypot(b[0], b[1]);
    set_unit(out->axis[k], first ? a[0] : b[0], first ? a[1] : b[1]);
  }
}

static int sign_of(double x)
{
  return (x > 0.0) - (x < 0.0);
}

/* A vortex beside one that turns the other way, as one point, has none. */
static bool has_kind(const fg__point *point)
{
  const double(*g)[2] = point->gradient;
  return point->index < 0 || fabs(g[0][0] + g[1][1]) + fabs(g[1][0] - g[0][1]) > 0.0;
}

static fg_critical_point classify(const fg__point *point)
{
  const double(*g)[2] = point->gradient;
  const double divergence = g[0][0] + g[1][1], curl = g[1][0] - g[0][1];
  const double determinant = g[0][0] * g[1][1] - g[0][1] * g[1][0];
  const double discriminant = divergence * divergence - 4.0 * determinant;
  fg_critical_point out = {.at = {point->at[0], point->at[1]}, .index = point->index};
  if (point->index < 0) {
    set_axes(&out, g, sqrt(fmax(discriminant, 0.0)));
    return out;
  }
  const bool closed = fabs(divergence) <= CLOSED * fabs(curl);
  const bool straight =
      !closed && (discriminant >= 0.0 || fabs(curl) <= STRAIGHT * fabs(divergence));
  out.sense = straight ? 0 : sign_of(curl);
  out.outward = closed ? 0 : sign_of(divergence);
  out.kind = closed            ? FG_CRITICAL_CENTRE
             : !straight       ? FG_CRITICAL_SPIRAL
             : out.outward > 0 ? FG_CRITICAL_SOURCE
                               : FG_CRITICAL_SINK;
  return out;
}

static fg_status create(fg_critical_points **out, fg_context *context, size_t count,
                        double length)
{
  *out = fg__allocate(1, sizeof **out);
  if (*out)
    (*out)->point = fg__allocate(count, sizeof *(*out)->point);
  if (!*out || !(*out)->point) {
    fg_critical_points_destroy(*out);
    *out = NULL;
    return fg__fail_memory(context, "critical points", count * sizeof *(*out)->point);
  }
  (*out)->length = length;
  return FG_STATUS_OK;
}

static fg_status find(fg_critical_points **out, fg_context *context,
                      const fg__domain_raster *raster, double length,
                      fg__threads *threads)
{
  fg__directions directions;
  fg__points found = {0};
  fg_status status = fg__directions_create(&directions, context, raster, length);
  for (size_t n = 0; n < raster->cells && status == FG_STATUS_OK; ++n)
    fg__directions_set(&directions, n, raster->inside[n], (double)raster->direction[0][n],
                       (double)raster->direction[1][n]);
  if (status == FG_STATUS_OK)
    status = fg__directions_find(&found, &directions, context, threads);
  if (status == FG_STATUS_OK)
    status = create(out, context, fg__points_left(&found), length);
  for (size_t n = 0; n < found.count && status == FG_STATUS_OK; ++n)
    if (!found.point[n].gone && has_kind(&found.point[n]) &&
        fg__directions_share(&directions, found.point[n].at) >= LEAST_SHARE)
      (*out)->point[(*out)->count++] = classify(&found.point[n]);
  fg__points_clear(&found);
  fg__directions_clear(&directions);
  return status;
}

/* The length of the options; 0: one out of range. */
static double length_of(const fg_critical_options *options, double side)
{
  const double most = 1e3 * side, least = side / sqrt(MOST_COUNT);
  const int count = options->count ? options->count : DEFAULT_COUNT;
  const bool given = !(options->length >= 0.0 && options->length <= 0.0);
  const double length = given ? options->length : side / sqrt(count);
  return count > 0 && length >= least && length <= most ? length : 0.0;
}

static fg_status search(fg_critical_points **out, fg_context *context,
                        const fg_field *field, const fg_critical_options *options,
                        fg__threads *threads)
{
  fg__domain_raster raster;
  fg_status status = fg__domain_raster_create(&raster, context, field, threads);
  const double length = length_of(options, raster.side);
  if (status == FG_STATUS_OK && !(length > 0.0))
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "critical points: at the scale of %d arrows or a length of %g, in "
                      "a domain of the side %g",
                      options->count, options->length, raster.side);
  if (status == FG_STATUS_OK)
    status = find(out, context, &raster, length, threads);
  fg__domain_raster_clear(&raster);
  return status;
}

fg_status fg_critical_points_find(fg_critical_points **out, fg_context *context,
                                  const fg_field *field,
                                  const fg_critical_options *options)
{
  static const fg_critical_options usual = {0};
  fg__threads *threads = NULL;
  options = options ? options : &usual;
  if (!out || !field || options->threads < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "critical points: a NULL argument, or %d threads", options->threads);
  *out = NULL;
  if (fg_field_contents(field)->dimension != 2)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "critical points: the field is in 3D, and they are found in 2D");
  fg_status status =
      fg__threads_create(&threads, context, options->threads ? options->threads : 1);
  if (status == FG_STATUS_OK)
    status = search(out, context, field, options, threads);
  fg__threads_destroy(threads);
  return status;
}

void fg_critical_points_destroy(fg_critical_points *points)
{
  if (points)
    free(points->point);
  free(points);
}

int fg_critical_points_count(const fg_critical_points *points)
{
  return points ? points->count : 0;
}

const fg_critical_point *fg_critical_points_at(const fg_critical_points *points,
                                               int index)
{
  return index >= 0 && index < fg_critical_points_count(points) ? &points->point[index]
                                                                : NULL;
}

const char *fg_critical_kind_word(fg_critical_kind kind)
{
  static const char *const words[FG_CRITICAL_KINDS] = {"saddle", "centre", "spiral",
                                                       "source", "sink"};
  return (unsigned)kind < FG_CRITICAL_KINDS ? words[kind] : NULL;
}

double fg_critical_points_length(const fg_critical_points *points)
{
  return points->length;
}
