#include "map/project.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/threads.h"
#include "base/vector.h"
#include "field/slab.h"
#include "map/plane.h"
#include "map/values.h"

/* Samples along the longer side: two a node of the mesh for 200 arrows on the globe. */
enum { SAMPLES = 768, FEWEST_SAMPLES = 16, MOST_SAMPLES = 16384 };

/* Where the data are finer than the plane's samples, so many places in each, a side, are
 * averaged at most; they lie 1.5 steps of the data apart, and each is the mean of the
 * four data round it. */
enum { MOST_PARTS = 16 };
static const double PART_STEPS = 1.5;

/* Between a sample's corners its parts are placed linearly, where its middle is theirs to
 * so much of its diagonal. */
static const double STRAIGHT = 0.02;

/* Places of points that are looked at for the rectangle in which they lie. */
enum { MOST_PLACES = 200000 };

/* Places that are worth a thread. */
static const double THREAD_PLACES = 1e6;

bool fg__map_is_asked(const fg_map_options *options)
{
  return options && !(options->projection && strcmp(options->projection, "none") == 0);
}

bool fg__map_is_named(const fg_map_options *options)
{
  return fg__map_is_asked(options) &&
         (options->has_center || options->has_region ||
          (options->projection && strcmp(options->projection, "auto") != 0));
}

typedef struct sampling {
  const fg__sphere *sphere;
  const fg__map_plane *plane;
  const char *projection;
  int first, rows;    /* along y */
  int parts;          /* of a sample's side that are averaged */
  float *velocity[3]; /* the third NULL */
  fg_status failed[FG__MOST_THREADS];
} sampling;

/* A row of positions, and what is found there. */
typedef struct line {
  double *x, *y, *longitude, *latitude;
  float *east, *north;
  double (*corner[2])[3]; /* of the samples, below and above: unit vectors; NaN: none */
  int hint;
} line;

static bool create_row(line *out, int samples)
{
  const size_t n = (size_t)samples + 1;
  *out = (line){.hint = -1};
  out->x = fg__allocate(n, sizeof(double));
  out->y = fg__allocate(n, sizeof(double));
  out->longitude = fg__allocate(n, sizeof(double));
  out->latitude = fg__allocate(n, sizeof(double));
  out->east = fg__allocate(n, sizeof(float));
  out->north = fg__allocate(n, sizeof(float));
  for (int k = 0; k < 2; ++k)
    out->corner[k] = fg__allocate(n, sizeof *out->corner[k]);
  return out->x && out->y && out->longitude && out->latitude && out->east && out->north &&
         out->corner[0] && out->corner[1];
}

static void destroy_row(line *row)
{
  free(row->x);
  free(row->y);
  free(row->longitude);
  free(row->latitude);
  free(row->east);
  free(row->north);
  free(row->corner[0]);
  free(row->corner[1]);
}

/* n positions from (x, y) on, in samples. */
static void locate(line *out, const sampling *work, const fg__map *map, int n, double x,
                   double y)
{
  const fg__map_plane *plane = work->plane;
  for (int i = 0; i < n; ++i) {
    out->x[i] = plane->first[0] + (i + x) * plane->spacing;
    out->y[i] = plane->first[1] + y * plane->spacing;
  }
  fg__map_inverse(map, (size_t)n, out->x, out->y, out->longitude, out->latitude);
  for (int i = 0; i < n; ++i)
    if (isfinite(out->longitude[i]) &&
        !fg__map_plane_shows(plane, map, out->longitude[i], out->latitude[i]))
      out->longitude[i] = (double)NAN;
}

static void find_corners(line *at, const sampling *work, const fg__map *map, int j)
{
  const int n = work->plane->size[0] + 1;
  for (int side = 0; side < 2; ++side) {
    locate(at, work, map, n, -0.5, j + side - 0.5);
    for (int i = 0; i < n; ++i) {
      const fg__sphere_frame to = fg__sphere_frame_at(at->longitude[i], at->latitude[i]);
      memcpy(at->corner[side][i], to.up, sizeof to.up);
    }
  }
}

/* Parts of sample i between its corners; false where these do not lie round its middle,
 * as at the outline and at cuts. */
static bool place_parts(double (*up)[3], const line *at, int i, int parts,
                        const double middle[3])
{
  const double *a = at->corner[0][i], *b = at->corner[0][i + 1];
  const double *c = at->corner[1][i], *d = at->corner[1][i + 1];
  double mean[3];
  for (int k = 0; k < 3; ++k)
    mean[k] = 0.25 * (a[k] + b[k] + c[k] + d[k]);
  if (!(fg__distance(mean, middle) < STRAIGHT * fg__distance(a, d)))
    return false;
  for (int part = 0; part < parts * parts; ++part) {
    const double s = (part % parts + 0.5) / parts, t = (part / parts + 0.5) / parts;
    for (int k = 0; k < 3; ++k)
      up[part][k] =
          (1.0 - t) * ((1.0 - s) * a[k] + s * b[k]) + t * ((1.0 - s) * c[k] + s * d[k]);
    const double length = fg__length(up[part]);
    for (int k = 0; k < 3; ++k)
      up[part][k] /= length;
  }
  return true;
}

/* The same by the projection; those without an image are left out. Returns how many. */
static size_t locate_parts(double (*up)[3], const sampling *work, const fg__map *map,
                           int i, int j)
{
  const int parts = work->parts;
  size_t count = 0;
  for (int part = 0; part < parts * parts; ++part) {
    const fg__map_plane *plane = work->plane;
    const double x =
        plane->first[0] + (i + (part % parts + 0.5) / parts - 0.5) * plane->spacing;
    const double y =
        plane->first[1] + (j + (part / parts + 0.5) / parts - 0.5) * plane->spacing;
    double longitude, latitude;
    fg__map_inverse(map, 1, &x, &y, &longitude, &latitude);
    if (!isfinite(longitude) || !fg__map_plane_shows(plane, map, longitude, latitude))
      continue;
    const fg__sphere_frame to = fg__sphere_frame_at(longitude, latitude);
    memcpy(up[count++], to.up, sizeof to.up);
  }
  return count;
}

/* The mean of a sample's parts, components at its middle. Missing where the middle is. */
static void average(line *at, const sampling *work, const fg__map *map, int j)
{
  const int n = work->plane->size[0];
  find_corners(at, work, map, j);
  locate(at, work, map, n, 0.0, j);
  fg__sphere_sample(at->east, at->north, work->sphere, (size_t)n, at->longitude,
                    at->latitude);
  for (int i = 0; i < n; ++i) {
    double up[MOST_PARTS * MOST_PARTS][3], sum[3] = {0.0, 0.0, 0.0};
    if (!isfinite(at->east[i]) || !isfinite(at->north[i]))
      continue;
    const fg__sphere_frame to = fg__sphere_frame_at(at->longitude[i], at->latitude[i]);
    const size_t count = place_parts(up, at, i, work->parts, to.up)
                             ? (size_t)(work->parts * work->parts)
                             : locate_parts(up, work, map, i, j);
    const size_t found =
        fg__sphere_add(sum, work->sphere, count, (const double(*)[3])up, &at->hint);
    if (found == 0)
      continue;
    at->east[i] = (float)(fg__dot(sum, to.east) / (double)found);
    at->north[i] = (float)(fg__dot(sum, to.north) / (double)found);
  }
}

static void sample_row(line *at, const sampling *work, const fg__map *map, int j)
{
  const size_t n = (size_t)work->plane->size[0];
  if (work->parts > 1) {
    average(at, work, map, j);
  } else {
    locate(at, work, map, (int)n, 0.0, j);
    fg__sphere_sample(at->east, at->north, work->sphere, n, at->longitude, at->latitude);
  }
  fg__map_turn_row(map, n, at->longitude, at->latitude, at->east, at->north);
  for (size_t i = 0; i < n; ++i)
    if (isnan(at->longitude[i]) || isnan(at->east[i]) || isnan(at->north[i]))
      at->east[i] = at->north[i] = NAN;
  const size_t place = (size_t)(j - work->first) * n;
  memcpy(work->velocity[0] + place, at->east, n * sizeof(float));
  memcpy(work->velocity[1] + place, at->north, n * sizeof(float));
}

/* Threads take rows in turn, so that the poles' and the equator's are shared alike; each
 * has a map of its own. */
static void sample_rows(void *argument, const fg__thread *thread)
{
  sampling *work = argument;
  fg__map *map = NULL;
  line at;
  fg_status status =
      create_row(&at, work->plane->size[0]) ? FG_STATUS_OK : FG_STATUS_MEMORY;
  if (status == FG_STATUS_OK)
    status = fg__map_create(&map, NULL, work->projection);
  const int height = work->plane->size[1];
  for (int k = thread->index; k < work->rows && status == FG_STATUS_OK;
       k += thread->count)
    sample_row(&at, work, map, (work->first + k) % height);
  work->failed[thread->index] = status;
  fg__map_destroy(map);
  destroy_row(&at);
}

static fg_status sample(sampling *work, fg_context *context, int thread_count)
{
  fg__threads *threads = NULL;
  fg_status status = fg__threads_create(&threads, context, thread_count);
  if (status != FG_STATUS_OK)
    return status;
  fg__threads_run(threads, sample_rows, work);
  for (int k = 0; k < fg__threads_count(threads) && status == FG_STATUS_OK; ++k)
    if (work->failed[k] != FG_STATUS_OK)
      status = fg__fail_memory(context, "a row of a map",
                               (size_t)work->plane->size[0] * 8 * sizeof(double));
  fg__threads_destroy(threads);
  return status;
}

static fg_status fill_axes(fg_field_arrays *arrays, fg_context *context,
                           const fg__map_plane *plane)
{
  for (int k = 0; k < 2; ++k) {
    double *axis = fg__allocate((size_t)plane->size[k], sizeof *axis);
    if (!axis)
      return fg__fail_memory(context, "an axis", (size_t)plane->size[k] * sizeof *axis);
    for (int i = 0; i < plane->size[k]; ++i)
      axis[i] = plane->first[k] + i * plane->spacing;
    arrays->axis[k] = axis;
    arrays->size[k] = plane->size[k];
  }
  return FG_STATUS_OK;
}

static fg_status make(fg_field **out, fg_context *context, const fg__sphere *sphere,
                      const fg__map_plane *plane, const char *projection, int parts,
                      int threads, int number, int count)
{
  sampling work = {
      .sphere = sphere, .plane = plane, .projection = projection, .parts = parts};
  fg_field_arrays arrays = *fg__sphere_words(sphere);
  int own = 0;
  if (count > plane->size[1])
    count = 1;
  fg__slab_rows(&work.first, &own, plane->size[1], count > 1 ? number : 0, count);
  work.rows = fg__slab_rows_held(plane->size[1], work.first, own, false);
  const size_t samples = (size_t)plane->size[0] * (size_t)work.rows;
  fg_status status =
      fg__check_memory(context, "field", (double)samples, 2.0 * sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  arrays.dimension = 2;
  arrays.scale = FG_SCALE_MAP;
  arrays.projection = projection;
  arrays.axis[0] = arrays.axis[1] = arrays.axis[2] = NULL;
  arrays.period[0] = arrays.period[1] = 0.0;
  arrays.valid = NULL;
  arrays.velocity[2] = NULL;
  for (int k = 0; k < 2; ++k) {
    arrays.velocity[k] = work.velocity[k] = fg__allocate(samples, sizeof(float));
    arrays.axis_name[k] = k ? "y" : "x";
    arrays.axis_units[k] = "km";
  }
  if (!work.velocity[0] || !work.velocity[1])
    status = fg__fail_memory(context, "a map", 2 * samples * sizeof(float));
  if (status == FG_STATUS_OK)
    status = fill_axes(&arrays, context, plane);
  if (status == FG_STATUS_OK)
    status = sample(&work, context, threads > 0 ? threads : 1);
  if (status == FG_STATUS_OK)
    status = fg__map_check_values(context, &plane->area, sphere, work.velocity, samples,
                                  count == 1);
  if (status == FG_STATUS_OK)
    status = count == 1 ? fg__field_take(out, context, &arrays, work.velocity)
                        : fg__field_create_slab(out, context, &arrays, work.velocity,
                                                number, count);
  for (int k = 0; k < 2; ++k) {
    free((void *)(uintptr_t)arrays.axis[k]);
    free(work.velocity[k]);
  }
  return status;
}

static int threads_for(const fg_map_options *options, const fg__map_plane *plane,
                       int parts)
{
  const double places = (double)plane->size[0] * plane->size[1] * parts * parts;
  if (options->threads > 0)
    return options->threads;
  return (int)fmax(1.0, fmin(fg__threads_available(), places / THREAD_PLACES));
}

static fg_status check_options(fg_context *context, const fg_map_options *options)
{
  const double *region = options->region, *center = options->center;
  if (options->has_region &&
      !(fabs(region[0]) <= 720.0 && fabs(region[1]) <= 720.0 &&
        fabs(region[1] - region[0]) > 0.0 && region[1] - region[0] <= 360.0 &&
        fabs(region[2]) <= 90.0 && fabs(region[3]) <= 90.0 && region[2] < region[3]))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "region %g,%g,%g,%g: west, east, south, north in degrees are needed, "
                    "west apart from east, south below north, of 360 degrees at most",
                    region[0], region[1], region[2], region[3]);
  if ((options->has_center && !(fabs(center[0]) <= 360.0)) ||
      (options->has_center_latitude && !(fabs(center[1]) <= 90.0)))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "centre %g,%g: a longitude and a latitude are needed", center[0],
                    center[1]);
  if (options->samples &&
      (options->samples < FEWEST_SAMPLES || options->samples > MOST_SAMPLES))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "map: %d samples along the longer side; %d to %d are possible",
                    options->samples, FEWEST_SAMPLES, MOST_SAMPLES);
  return FG_STATUS_OK;
}

/* Whether there are values at sea alone: none at all but one of these places inland. */
static bool is_of_the_sea(const fg__sphere *sphere)
{
  static const double longitude[] = {20, 100, -105, -58, 25, 133, 45, 80};
  static const double latitude[] = {15, 50, 45, -12, -22, -24, 24, 60};
  enum { PLACES = 8 };
  float east[PLACES], north[PLACES];
  int present = 0;
  fg__sphere_sample(east, north, sphere, PLACES, longitude, latitude);
  for (int k = 0; k < PLACES; ++k)
    present += isfinite(east[k]) && isfinite(north[k]);
  return present <= 1;
}

static void find_area(fg__map_area *out, const fg__sphere *sphere,
                      const fg_map_options *options)
{
  fg__sphere_extent extent;
  fg__sphere_extent_of(&extent, sphere);
  *out = (fg__map_area){extent.west, extent.east, extent.south, extent.north, false};
  if (options->has_region) {
    const double west = options->region[0];
    double east = options->region[1];
    while (east <= west)
      east += 360.0;
    *out = (fg__map_area){west, east, options->region[2], options->region[3], false};
  }
  out->sea = out->east - out->west >= FG__MAP_ALL_ROUND && is_of_the_sea(sphere);
}

/* "auto" is the plane of the sphere's own points, if they have one that can be drawn. */
static const char *find_own_plane(const fg__sphere *sphere, const fg_map_options *options)
{
  const char *own = fg__sphere_words(sphere)->projection;
  fg__map_words words;
  const bool is_auto = !options->projection || strcmp(options->projection, "auto") == 0;
  return own && is_auto && !options->has_center &&
                 fg__map_words_read(&words, NULL, own) == FG_STATUS_OK &&
                 !fg__map_words_are_degrees(&words)
             ? own
             : NULL;
}

/* Places of points on a plane of their own: they fill it better than their longitudes and
 * latitudes do. */
static fg_status find_places(fg__map_places *out, fg_context *context,
                             const fg__sphere *sphere)
{
  *out = (fg__map_places){0};
  if (!fg__sphere_words(sphere)->projection)
    return FG_STATUS_OK;
  out->longitude = fg__allocate(MOST_PLACES, sizeof *out->longitude);
  out->latitude = fg__allocate(MOST_PLACES, sizeof *out->latitude);
  if (!out->longitude || !out->latitude)
    return fg__fail_memory(context, "places", 2 * MOST_PLACES * sizeof *out->longitude);
  out->count = fg__sphere_places(out->longitude, out->latitude, sphere, MOST_PLACES);
  return FG_STATUS_OK;
}

fg_status fg__sphere_project(fg_field **out, fg_context *context,
                             const fg__sphere *sphere, const fg_map_options *options,
                             int number, int count)
{
  fg__map_area area;
  fg__map_plane plane;
  fg__map *map = NULL;
  fg__map_places places = {0};
  fg_map_options chosen = *options;
  char projection[FG__MAP_STRING_BYTES];
  *out = NULL;
  fg_status status = check_options(context, options);
  if (status != FG_STATUS_OK)
    return status;
  find_area(&area, sphere, options);
  const char *own = find_own_plane(sphere, options);
  if (own)
    chosen.projection = own;
  status = fg__map_choose(projection, context, &chosen, &area);
  if (status == FG_STATUS_OK)
    status = fg__map_create(&map, context, projection);
  if (status == FG_STATUS_OK)
    status = find_places(&places, context, sphere);
  if (status == FG_STATUS_OK)
    status = fg__map_plane_find(&plane, context, map, &area, &places, options->has_region,
                                options->samples ? options->samples : SAMPLES);
  if (status == FG_STATUS_OK) {
    fg__sphere_extent extent;
    fg__sphere_extent_of(&extent, sphere);
    const double pixel = plane.spacing * fg__map_unit(map) / FG__DEGREE_METRES;
    const double parts = ceil(pixel / (PART_STEPS * extent.spacing) - 0.25);
    const int across = parts > 1.0 ? (int)fmin(parts, MOST_PARTS) : 1;
    status = make(out, context, sphere, &plane, fg__map_projection(map), across,
                  threads_for(options, &plane, across), number, count);
  }
  fg__map_destroy(map);
  free(places.longitude);
  free(places.latitude);
  return status;
}

fg_status fg_field_project(fg_field **out, fg_context *context, const fg_field *field,
                           const fg_map_options *options)
{
  static const fg_map_options defaults = {0};
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "map: no field to lay on it");
  *out = NULL;
  const fg_field_arrays *arrays = fg_field_contents(field);
  const bool on_plane = arrays->scale == FG_SCALE_MAP && arrays->projection;
  if (arrays->dimension != 2 || !(arrays->scale == FG_SCALE_GEO || on_plane) ||
      !fg__field_is_whole(field) || (options && !fg__map_is_asked(options)))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "map: a whole field in longitude and latitude, or on the plane of a "
                    "projection, is needed, and a projection");
  fg__sphere *sphere = NULL;
  fg_status status = on_plane ? fg__sphere_of_plane(&sphere, context, field)
                              : fg__sphere_of_field(&sphere, context, field);
  if (status == FG_STATUS_OK)
    status =
        fg__sphere_project(out, context, sphere, options ? options : &defaults, 0, 1);
  fg__sphere_destroy(sphere);
  return status;
}
