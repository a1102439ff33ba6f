#include "sample/points/points.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/weighted.h"
#include "field/refused.h"
#include "sample/points/delaunay.h"
#include "terms/units.h"

/* The largest share of points that may have another value than one at the same place. */
static const double FEW = 0.1;

/* Longitudes are cut in a gap of at least these degrees, else where their values end.
 */
static const double WIDE_GAP = 30.0;

/* Coordinates whose products are far from overflow. */
static const double FARTHEST = 1e60;

void fg__scatter_clear(fg__scatter *points)
{
  for (int k = 0; k < 3; ++k) {
    free(points->position[k]);
    free(points->velocity[k]);
  }
  free(points->record);
  *points = (fg__scatter){0};
}

static int record_of(const fg__scatter *points, size_t i)
{
  return points->record ? points->record[i] : (int)i;
}

static fg_status fail_code(const fg__scatter *points, size_t i)
{
  const fg_status status =
      fg__fail(points->context, FG_STATUS_FILE_FORMAT,
               "%s: %s %d: both components are %g, which stands for missing data in "
               "many files",
               points->path, points->records, record_of(points, i),
               (double)points->velocity[0][i]);
  fg__hint(points->context, "leave such values empty, or write nan");
  return status;
}

static fg_status check_points(const fg__scatter *points)
{
  const float *const across[3] = {points->velocity[0], points->velocity[1], NULL};
  if (points->count > FG__DELAUNAY_MOST)
    return fg__fail(points->context, FG_STATUS_UNSUPPORTED,
                    "%s: %zu points; at most %d can be read", points->path, points->count,
                    FG__DELAUNAY_MOST);
  if (points->count < 3)
    return fg__fail(points->context, FG_STATUS_FILE_FORMAT,
                    "%s: %zu points with a place; a field needs three at least",
                    points->path, points->count);
  for (int k = 0; k < points->dimension && k < 3; ++k) {
    const size_t apart = fg__find_apart_position(points->position[k], 1, points->count);
    for (size_t i = 0; i < points->count; ++i)
      if (!(fabs(points->position[k][i]) < FARTHEST) || i == apart)
        return fg__fail(points->context, FG_STATUS_FILE_FORMAT,
                        "%s: %s %d: the point's coordinate %d is %g", points->path,
                        points->records, record_of(points, i), k + 1,
                        points->position[k][i]);
  }
  for (size_t i = 0; i < points->count; ++i)
    if (fg__is_missing_code(across, 2, i))
      return fail_code(points, i);
  if (!points->geographic)
    return FG_STATUS_OK;
  for (size_t i = 0; i < points->count; ++i)
    if (fabs(points->position[1][i]) > 90.0 || fabs(points->position[0][i]) > 720.0)
      return fg__fail(points->context, FG_STATUS_FILE_FORMAT,
                      "%s: %s %d: longitude %g, latitude %g is no place on the globe",
                      points->path, points->records, record_of(points, i),
                      points->position[0][i], points->position[1][i]);
  return fg__check_degrees(points->context, points->path, points->position[0],
                           points->position[1], points->count);
}

/* Longitudes begin behind their widest gap, where it is wide, so that those round the
 * antimeridian hang together. */
static fg_status unwrap(const fg__scatter *points)
{
  double *longitude = points->position[0];
  double *order = fg__allocate(points->count, sizeof *order);
  if (!order)
    return fg__fail_memory(points->context, "longitudes", points->count * sizeof *order);
  memcpy(order, longitude, points->count * sizeof *order);
  qsort(order, points->count, sizeof *order, fg__by_size);
  double widest = 360.0 - (order[points->count - 1] - order[0]), first = order[0];
  const bool goes_round = widest >= 0.0;
  widest = fmax(WIDE_GAP, widest);
  for (size_t i = 1; i < points->count && goes_round; ++i)
    if (order[i] - order[i - 1] > widest) {
      widest = order[i] - order[i - 1];
      first = order[i];
    }
  free(order);
  for (size_t i = 0; i < points->count; ++i)
    if (longitude[i] < first)
      longitude[i] += 360.0;
  return FG_STATUS_OK;
}

typedef struct spot {
  double at[3];
  size_t point;
} spot;

static int by_spot(const void *a, const void *b)
{
  const spot *p = a, *q = b;
  for (int k = 0; k < 3; ++k)
    if (p->at[k] != q->at[k])
      return p->at[k] > q->at[k] ? 1 : -1;
  return (p->point > q->point) - (p->point < q->point);
}

static bool is_same_place(const spot *a, const spot *b)
{
  return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

static bool is_same_value(const fg__scatter *points, size_t a, size_t b)
{
  for (int k = 0; k < points->dimension && k < 3; ++k) {
    const float x = points->velocity[k][a], y = points->velocity[k][b];
    if (!(x == y || (isnan(x) && isnan(y))))
      return false;
  }
  return true;
}

/* The first of points at one place gets the mean of those that have a value. */
static void take_mean(const fg__scatter *points, const spot *spots, size_t count)
{
  for (int k = 0; k < points->dimension && k < 3; ++k) {
    double sum = 0.0, values = 0.0;
    for (size_t i = 0; i < count; ++i) {
      const double value = (double)points->velocity[k][spots[i].point];
      sum += isfinite(value) ? value : 0.0;
      values += isfinite(value);
    }
    if (values > 0.0)
      points->velocity[k][spots[0].point] = (float)(sum / values);
  }
}

static fg_status fail_doubled(const fg__scatter *points, size_t doubled, size_t a,
                              size_t b)
{
  fg__fail(points->context, FG_STATUS_FILE_FORMAT,
           "%s: %zu of %zu points lie where another does and have other values: %ss %d "
           "and %d, both at (%g, %g)",
           points->path, doubled, points->count, points->records, record_of(points, a),
           record_of(points, b), points->position[0][a], points->position[1][a]);
  fg__hint(points->context,
           "name the column of times or levels t or z, or leave one time "
           "and one level in the file");
  return FG_STATUS_FILE_FORMAT;
}

static void keep(fg__scatter *points, const unsigned char *is_kept)
{
  size_t kept = 0;
  for (size_t i = 0; i < points->count; ++i) {
    if (!is_kept[i])
      continue;
    for (int k = 0; k < points->dimension && k < 3; ++k) {
      points->position[k][kept] = points->position[k][i];
      points->velocity[k][kept] = points->velocity[k][i];
    }
    if (points->record)
      points->record[kept] = points->record[i];
    ++kept;
  }
  points->count = kept;
}

/* The points in the order of their places. */
static fg_status sort_spots(spot **out, const fg__scatter *points)
{
  const size_t count = points->count;
  spot *spots = *out = fg__allocate(count, sizeof *spots);
  if (!spots)
    return fg__fail_memory(points->context, "points", count * sizeof *spots);
  for (size_t i = 0; i < count; ++i) {
    spots[i].point = i;
    for (int k = 0; k < points->dimension && k < 3; ++k)
      spots[i].at[k] = points->position[k][i];
  }
  qsort(spots, count, sizeof *spots, by_spot);
  return FG_STATUS_OK;
}

static fg_status merge_doubled(fg__scatter *points)
{
  const size_t count = points->count;
  spot *spots = NULL;
  unsigned char *is_kept = fg__allocate(count, 1);
  fg_status status = sort_spots(&spots, points);
  if (status == FG_STATUS_OK && !is_kept)
    status = fg__fail_memory(points->context, "points", count);
  size_t doubled = 0, example[2] = {0, 0};
  for (size_t i = 0, end; i < count && status == FG_STATUS_OK; i = end) {
    is_kept[spots[i].point] = 1;
    for (end = i + 1; end < count && is_same_place(&spots[i], &spots[end]); ++end)
      if (!is_same_value(points, spots[i].point, spots[end].point) && ++doubled == 1) {
        example[0] = spots[i].point;
        example[1] = spots[end].point;
      }
  }
  if (status == FG_STATUS_OK && (double)doubled > FEW * (double)count)
    status = fail_doubled(points, doubled, example[0], example[1]);
  for (size_t i = 0, end; i < count && status == FG_STATUS_OK; i = end) {
    for (end = i + 1; end < count && is_same_place(&spots[i], &spots[end]);)
      ++end;
    if (end > i + 1)
      take_mean(points, spots + i, end - i);
  }
  if (status == FG_STATUS_OK)
    keep(points, is_kept);
  free(spots);
  free(is_kept);
  return status;
}

static fg_status add_cells(fg__cell_set *set, const fg__triangles *triangles)
{
  fg_status status = FG_STATUS_OK;
  for (size_t t = 0; t < triangles->count && status == FG_STATUS_OK; ++t)
    status = fg__cell_set_add_points(set, FG__CELL_TRIANGLE, triangles->corner + 3 * t,
                                     (int)t);
  set->numbers = triangles->count;
  return status;
}

static fg_status triangulate(fg__cell_set *set, fg__scatter_between *between,
                             const fg__scatter *points)
{
  fg__triangles triangles = {0};
  set->position = fg__allocate(3 * points->count, sizeof *set->position);
  if (!set->position)
    return fg__fail_memory(points->context, "points", 3 * points->count * 8);
  set->points = points->count;
  for (size_t i = 0; i < points->count; ++i)
    for (int k = 0; k < 2; ++k)
      set->position[3 * i + (size_t)k] = points->position[k][i];
  fg_status status =
      fg__scatter_triangulate(&triangles, between, points, points->position[0],
                              points->position[1], set->position, -1);
  if (status == FG_STATUS_OK)
    status = add_cells(set, &triangles);
  fg__triangles_clear(&triangles);
  return status;
}

fg_status fg__point_grid_sample(fg__point_grid *out, const fg__cell_set *set,
                                float *const velocity[2])
{
  *out = (fg__point_grid){.dimension = 2, .cells = set->count};
  const size_t samples = (size_t)set->size[0] * (size_t)set->size[1];
  const fg_status status =
      fg__check_memory(set->context, set->path, (double)samples, 2.0 * sizeof(float));
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 2; ++k) {
    out->size[k] = set->size[k];
    out->axis[k] = fg__allocate((size_t)set->size[k], sizeof *out->axis[k]);
    out->velocity[k] = fg__allocate(samples, sizeof *out->velocity[k]);
    if (!out->axis[k] || !out->velocity[k])
      return fg__fail_memory(set->context, "a field's samples", samples * 4);
    for (int i = 0; i < set->size[k]; ++i)
      out->axis[k][i] = set->origin[k] + set->spacing[k] * i;
    fg__cell_set_sample(out->velocity[k], set, velocity[k], 0, samples);
  }
  return FG_STATUS_OK;
}

static fg_status interpolate(fg__point_grid *out, fg__scatter_between *between,
                             const fg__scatter *points)
{
  fg__cell_set set = {.context = points->context, .path = points->path};
  if (points->region.axes == 2)
    set.region = points->region;
  fg_status status = triangulate(&set, between, points);
  if (status == FG_STATUS_OK)
    status = fg__cell_set_locate(&set);
  if (status == FG_STATUS_OK)
    status = fg__point_grid_sample(out, &set, points->velocity);
  fg__cell_set_clear(&set);
  return status;
}

/* Puts points in order, and on their grid when there is one. */
static fg_status arrange(fg__point_grid *out, bool *found, fg__scatter *points,
                         fg__flat_words *words)
{
  *out = (fg__point_grid){0};
  *found = false;
  fg_status status = check_points(points);
  if (status == FG_STATUS_OK)
    fg__scatter_flatten(points, words);
  if (status == FG_STATUS_OK && points->geographic)
    status = unwrap(points);
  if (status == FG_STATUS_OK)
    status = merge_doubled(points);
  if (status == FG_STATUS_OK)
    status = fg__scatter_find_grid(out, found, points);
  if (status != FG_STATUS_OK || *found || points->dimension < 3 ||
      fg__scatter_fills_space(points))
    return status;
  fg__fail(points->context, FG_STATUS_UNSUPPORTED,
           "%s: its %zu points in space lie neither on a grid along the axes nor in a "
           "plane%s",
           points->path, points->count,
           points->geographic ? ", and not on one level" : ", and are too few");
  fg__hint(points->context, "interpolate them to a grid, or give the cells between them, "
                            "as .vtu");
  return FG_STATUS_UNSUPPORTED;
}

fg_status fg__scatter_field(fg_field **out, fg__scatter_between *between,
                            fg__scatter *points, const fg_field_arrays *words,
                            fg__slab_index slab)
{
  fg__point_grid grid;
  fg__sphere *sphere = NULL;
  bool found;
  *between = (fg__scatter_between){0};
  fg__flat_words flat = {.all = *words};
  fg_status status = arrange(&grid, &found, points, &flat);
  words = &flat.all;
  if (status == FG_STATUS_OK && !found && points->geographic) {
    status = fg__scatter_on_sphere(&sphere, between, points, words);
    if (status == FG_STATUS_OK)
      status = fg__globe_field(out, points->context, sphere, slab);
    fg__sphere_destroy(sphere);
    return status;
  }
  if (status == FG_STATUS_OK && !found)
    status = points->dimension == 3 ? fg__scatter_fit(&grid, points)
                                    : interpolate(&grid, between, points);
  between->points = grid.points;
  if (found)
    between->gaps = grid.gaps;
  if (status == FG_STATUS_OK)
    status = fg__point_grid_straighten(&grid, points->context, points->path,
                                       points->geographic);
  if (status == FG_STATUS_OK)
    status = fg__point_grid_field(out, points->context, &grid, words, slab);
  fg__point_grid_clear(&grid);
  return status;
}

fg_status fg__scatter_sphere(fg__sphere **out, fg__scatter_between *between,
                             fg__scatter *points, const fg_field_arrays *words)
{
  fg__point_grid grid;
  bool found;
  *out = NULL;
  *between = (fg__scatter_between){0};
  fg__flat_words flat = {.all = *words};
  fg_status status = arrange(&grid, &found, points, &flat);
  fg__point_grid_clear(&grid);
  return status == FG_STATUS_OK && !found
             ? fg__scatter_on_sphere(out, between, points, words)
             : status;
}
