/* A field on the sphere as a longitude-latitude grid of its own mean spacing. */
#include "sample/globe.h"
#include "base/angle.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Samples per point: a grid round points that fill little of it is coarser. */
static const double MOST_SAMPLES = 16.0;

/* Between scattered points samples are finer, each way, as long as they are not many. */
static const double FINEST = 8.0, MANY = 262144.0;

/* Samples along an axis: no model has so many. A sliver, for which that may be any
 * number, has no more than its points allow. */
static const double MOST_ALONG = 1 << 22;

typedef struct raster {
  int size[2];
  double first[2], step[2];
  bool closed; /* all longitudes */
} raster;

/* Samples at both ends, `spacing` or less apart where that makes no more than `most`. */
static int count_along(double length, double spacing, double most)
{
  const double cells = ceil(length / spacing - 1e-6);
  return !(cells >= 1.0) ? 2 : 1 + (int)fmin(cells, fmin(most, MOST_ALONG));
}

static double least_cosine_inverse(const fg__sphere_extent *extent)
{
  const double nearest = extent->south > 0.0   ? extent->south
                         : extent->north < 0.0 ? extent->north
                                               : 0.0;
  const double cosine = cos(nearest * FG__RADIANS);
  return cosine > 1e-3 ? 1.0 / cosine : 1e3;
}

static raster raster_of(const fg__sphere_extent *extent)
{
  const double width = extent->east - extent->west,
               height = extent->north - extent->south;
  const double wider = least_cosine_inverse(extent);
  double spacing = extent->spacing;
  double samples = (width / (spacing * wider) + 1.0) * (height / spacing + 1.0);
  const double most = MOST_SAMPLES * (double)extent->points + 4.0;
  if (samples > most) {
    spacing *= sqrt(samples / most);
    samples = most;
  }
  const double finer =
      extent->scattered ? fmin(FINEST, fmax(1.0, sqrt(MANY / samples))) : 1.0;
  spacing /= finer;
  raster out = {.closed = width >= 360.0, .first = {extent->west, extent->south}};
  out.size[0] = count_along(width, spacing * wider, finer * most);
  out.size[1] = count_along(height, spacing, finer * most);
  out.step[0] = width / (out.size[0] - 1);
  out.step[1] = height / (out.size[1] - 1);
  out.size[0] -= out.closed && out.size[0] > 3;
  return out;
}

static double *make_axis(const raster *r, int k)
{
  double *axis = fg__allocate((size_t)r->size[k], sizeof *axis);
  for (int n = 0; axis && n < r->size[k]; ++n)
    axis[n] = r->first[k] + n * r->step[k];
  return axis;
}

typedef struct samples {
  double *axis[2], *latitude;
  float *velocity[3];
} samples;

static void clear(samples *all)
{
  for (int k = 0; k < 2; ++k) {
    free(all->axis[k]);
    free(all->velocity[k]);
  }
  free(all->latitude);
}

static fg_status sample(samples *out, fg_context *context, const raster *r,
                        const fg__sphere *sphere, const fg__rows *rows)
{
  const size_t columns = (size_t)r->size[0], count = columns * (size_t)rows->held;
  fg_status status =
      fg__check_memory(context, "field", (double)count, 2.0 * sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  out->latitude = fg__allocate(columns, sizeof *out->latitude);
  for (int k = 0; k < 2; ++k) {
    out->axis[k] = make_axis(r, k);
    out->velocity[k] = fg__allocate(count, sizeof *out->velocity[k]);
  }
  if (!out->latitude || !out->axis[0] || !out->axis[1] || !out->velocity[0] ||
      !out->velocity[1])
    return fg__fail_memory(context, "samples of the sphere", 2 * count * sizeof(float));
  for (int j = 0; j < rows->held && status == FG_STATUS_OK; ++j) {
    const size_t start = (size_t)j * columns;
    const double latitude = fmin(out->axis[1][rows->first + j], 90.0);
    for (size_t i = 0; i < columns; ++i)
      out->latitude[i] = latitude;
    fg__sphere_sample(out->velocity[0] + start, out->velocity[1] + start, sphere, columns,
                      out->axis[0], out->latitude);
    status = fg__check_stop(context);
  }
  return status;
}

static bool has_area(const fg__sphere_extent *extent)
{
  return extent->spacing > 0.0 && extent->north > extent->south &&
         extent->east > extent->west;
}

void fg__globe_describe(fg_inventory_vector *vector, const fg__sphere_extent *extent)
{
  const raster r = has_area(extent) ? raster_of(extent) : (raster){0};
  vector->size[0] = r.size[0];
  vector->size[1] = r.size[1];
  vector->axis_name[0] = "longitude";
  vector->axis_name[1] = "latitude";
  vector->bounds[0] = extent->west;
  vector->bounds[1] = extent->east;
  vector->bounds[2] = extent->south;
  vector->bounds[3] = extent->north;
  vector->periodic[0] = extent->east - extent->west >= 360.0;
}

fg_status fg__globe_field(fg_field **out, fg_context *context, const fg__sphere *sphere,
                          fg__slab_index slab)
{
  fg__sphere_extent extent;
  fg__sphere_extent_of(&extent, sphere);
  if (!has_area(&extent))
    return fg__fail(context, FG_STATUS_FILE_FORMAT,
                    "field: its cells have no area: longitudes %g to %g, latitudes %g "
                    "to %g",
                    extent.west, extent.east, extent.south, extent.north);
  const raster r = raster_of(&extent);
  const fg__rows rows = fg__rows_of(&slab, r.size[1], false);
  samples all = {0};
  fg_status status = sample(&all, context, &r, sphere, &rows);
  if (status == FG_STATUS_OK) {
    fg_field_arrays arrays = *fg__sphere_words(sphere);
    arrays.dimension = 2;
    arrays.scale = FG_SCALE_GEO;
    arrays.projection = NULL;
    for (int k = 0; k < 2; ++k) {
      arrays.size[k] = r.size[k];
      arrays.axis[k] = all.axis[k];
      arrays.velocity[k] = all.velocity[k];
      arrays.axis_name[k] = k == 0 ? "longitude" : "latitude";
      arrays.axis_units[k] = k == 0 ? "°E" : "°N";
    }
    arrays.period[0] = r.closed ? 360.0 : 0.0;
    status = fg__field_of_rows(out, context, &arrays, all.velocity, &slab);
  }
  clear(&all);
  return status;
}
