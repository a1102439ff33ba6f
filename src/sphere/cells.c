/* Spheres of points and cells. */
#include "base/memory.h"
#include "sphere/inside.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* The cosine of what a cell's corners may lie apart: no model's cells are so large, and
 * what is has a corner at a place that was never set. */
static const double LEAST_COSINE = 0.8660254037844387; /* 30 degrees */

/* Of a point, or of a cell with its places in the squares of locate.c. */
static const double CELL_BYTES = 40.0;

/* Cells of positions that are no grid's lie on each other, and finding one among them
 * would take for ever. */
static const double MOST_LAYERS = 4.0;
enum { FEWEST_CELLS = 100 };

/* Points that are worth a thread: some 10 milliseconds of work. */
static const size_t THREAD_POINTS = (size_t)1 << 16;

typedef struct building {
  fg__sphere *sphere;
  const fg__sphere_cells *cells;
  size_t faulty[FG__MOST_THREADS]; /* a corner that is none, or SIZE_MAX */
  bool missing[FG__MOST_THREADS];
  size_t kept[FG__MOST_THREADS]; /* cells of the thread's part, moved to its beginning */
} building;

/* A thread's part of the corners: the first that is no point. */
static void check_corners(void *argument, const fg__thread *thread)
{
  building *work = argument;
  const fg__sphere_cells *cells = work->cells;
  int begin, end;
  fg__threads_range(thread, (int)cells->count, 1, &begin, &end);
  work->faulty[thread->index] = SIZE_MAX;
  for (size_t n = 4 * (size_t)begin; n < 4 * (size_t)end; ++n)
    if (cells->corner[n] >= (int)cells->points ||
        cells->corner[n] < (n % 4 == 3 ? -1 : 0)) {
      work->faulty[thread->index] = n;
      return;
    }
}

static fg_status check_cells(fg_context *context, building *work, fg__threads *threads)
{
  const fg__sphere_cells *cells = work->cells;
  fg__threads_run(threads, check_corners, work);
  for (int k = 0; k < fg__threads_count(threads); ++k)
    if (work->faulty[k] < SIZE_MAX)
      return fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "field: cell %zu has corner %d, but there are %zu points",
                      work->faulty[k] / 4, cells->corner[work->faulty[k]], cells->points);
  return FG_STATUS_OK;
}

static void set_part(void *argument, const fg__thread *thread)
{
  building *work = argument;
  const fg__sphere_cells *cells = work->cells;
  fg__sphere *sphere = work->sphere;
  int begin, end;
  bool all = true;
  fg__threads_range(thread, (int)cells->points, 1, &begin, &end);
  for (size_t n = (size_t)begin; n < (size_t)end; ++n) {
    const fg__sphere_frame at =
        fg__sphere_frame_at(cells->longitude[n], cells->latitude[n]);
    for (size_t k = 0; k < 3; ++k)
      sphere->position[3 * n + k] = at.up[k];
    const bool there = isfinite(cells->longitude[n]) && fabs(cells->latitude[n]) <= 90.0;
    all &= fg__sphere_set(sphere, n, &at, there ? cells->east[n] : NAN, cells->north[n]);
    if (!there)
      sphere->position[3 * n] = (double)NAN;
  }
  work->missing[thread->index] = !all;
}

static fg_status set_points(building *work, fg_context *context, fg__threads *threads)
{
  fg__sphere *sphere = work->sphere;
  const size_t points = work->cells->points;
  const fg_status status = fg__sphere_begin(sphere, context, points, work->cells->words);
  if (status != FG_STATUS_OK)
    return status;
  sphere->position = fg__allocate(points, 3 * sizeof *sphere->position);
  if (!sphere->position)
    return fg__fail_memory(context, "positions on the sphere",
                           points * 3 * sizeof *sphere->position);
  fg__threads_run(threads, set_part, work);
  bool missing = false;
  for (int k = 0; k < fg__threads_count(threads); ++k)
    missing = missing || work->missing[k];
  fg__sphere_all_set(sphere, missing);
  return FG_STATUS_OK;
}

static bool is_kept(const fg__sphere *sphere, size_t n)
{
  int point[4];
  const int corners = fg__sphere_corners(sphere, n, point);
  const double *first = sphere->position + 3 * (size_t)point[0];
  bool present = false;
  for (int k = 0; k < corners; ++k) {
    const double *other = sphere->position + 3 * (size_t)point[k];
    if (!(fg__dot(first, other) >= LEAST_COSINE * fg__dot(first, first)))
      return false; /* NaN, too */
    present = present || !sphere->missing || !sphere->missing[point[k]];
  }
  return present;
}

static void keep_part(void *argument, const fg__thread *thread)
{
  building *work = argument;
  fg__sphere *sphere = work->sphere;
  int begin, end;
  fg__threads_range(thread, (int)sphere->count, 1, &begin, &end);
  size_t kept = (size_t)begin;
  for (size_t n = (size_t)begin; n < (size_t)end; ++n) {
    if (!is_kept(sphere, n))
      continue;
    for (size_t k = 0; k < 4 && kept != n; ++k)
      sphere->corner[4 * kept + k] = sphere->corner[4 * n + k];
    ++kept;
  }
  work->kept[thread->index] = kept - (size_t)begin;
}

static fg_status keep_cells(building *work, fg_context *context, fg__threads *threads)
{
  fg__sphere *sphere = work->sphere;
  const int count = fg__threads_count(threads);
  const size_t all = sphere->count;
  fg__threads_run(threads, keep_part, work);
  size_t kept = 0;
  for (int k = 0; k < count; ++k) {
    const fg__thread thread = {.index = k, .count = count};
    int begin, end;
    fg__threads_range(&thread, (int)all, 1, &begin, &end);
    memmove(sphere->corner + 4 * kept, sphere->corner + 4 * (size_t)begin,
            4 * work->kept[k] * sizeof *sphere->corner);
    kept += work->kept[k];
  }
  sphere->count = kept;
  if (kept > 0)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "field: none of %zu cells has a value and corners within 30 degrees",
                  all);
}

static fg_status measure(building *work, fg_context *context, fg__threads *threads)
{
  fg__sphere *sphere = work->sphere;
  double layers = 0.0;
  const fg_status status = fg__sphere_measure(
      &layers, sphere, context, threads, work->cells->longitude, work->cells->latitude);
  if (status != FG_STATUS_OK || !(layers > MOST_LAYERS) || sphere->count < FEWEST_CELLS)
    return status;
  const fg__sphere_extent *extent = &sphere->extent;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "field: its cells lie on each other: they are %.3g times as large as "
                  "the longitudes %g to %g and latitudes %g to %g that they cover",
                  layers, extent->west, extent->east, extent->south, extent->north);
}

static fg_status make(fg__sphere *sphere, fg_context *context, fg__sphere_cells *cells,
                      fg__threads *threads)
{
  building work = {.sphere = sphere, .cells = cells};
  fg_status status = check_cells(context, &work, threads);
  if (status != FG_STATUS_OK)
    return status;
  sphere->corner = cells->corner;
  sphere->count = cells->count;
  cells->corner = NULL;
  status = set_points(&work, context, threads);
  free(cells->east);
  free(cells->north);
  cells->east = cells->north = NULL;
  if (status == FG_STATUS_OK)
    status = keep_cells(&work, context, threads);
  if (status == FG_STATUS_OK)
    status = fg__sphere_fill(sphere, context);
  if (status == FG_STATUS_OK)
    status = measure(&work, context, threads);
  free(cells->longitude);
  free(cells->latitude);
  cells->longitude = cells->latitude = NULL;
  if (status == FG_STATUS_OK)
    status = fg__sphere_sort_cells(sphere, context, threads);
  return status;
}

static fg_status check_size(fg_context *context, const fg__sphere_cells *cells)
{
  if (cells->points >= INT_MAX || cells->count >= INT_MAX)
    return fg__fail(
        context, FG_STATUS_UNSUPPORTED,
        "field: %zu points and %zu cells are more than the %d that are handled",
        cells->points, cells->count, INT_MAX - 1);
  return fg__check_memory(context, "field", (double)cells->points + (double)cells->count,
                          CELL_BYTES);
}

bool fg__sphere_cells_allocate(fg__sphere_cells *out, size_t points, size_t cells)
{
  out->points = points;
  out->longitude = fg__allocate(points, sizeof *out->longitude);
  out->latitude = fg__allocate(points, sizeof *out->latitude);
  out->east = fg__allocate(points, sizeof *out->east);
  out->north = fg__allocate(points, sizeof *out->north);
  out->corner = fg__allocate(cells, 4 * sizeof *out->corner);
  return out->longitude && out->latitude && out->east && out->north && out->corner;
}

void fg__sphere_cells_clear(fg__sphere_cells *cells)
{
  free(cells->longitude);
  free(cells->latitude);
  free(cells->east);
  free(cells->north);
  free(cells->corner);
  *cells = (fg__sphere_cells){0};
}

static int threads_for(const fg__sphere_cells *cells)
{
  const size_t useful = cells->points / THREAD_POINTS + 1;
  const int most = fg__threads_available();
  return cells->threads > 0 ? cells->threads : useful < (size_t)most ? (int)useful : most;
}

fg_status fg__sphere_of_cells(fg__sphere **out, fg_context *context,
                              fg__sphere_cells *taken)
{
  *out = NULL;
  fg__threads *threads = NULL;
  fg__sphere *sphere = NULL;
  fg_status status = check_size(context, taken);
  if (status == FG_STATUS_OK)
    status = fg__threads_create(&threads, context, threads_for(taken));
  if (status != FG_STATUS_OK)
    goto cleanup;
  sphere = fg__allocate(1, sizeof *sphere);
  status = sphere ? make(sphere, context, taken, threads)
                  : fg__fail_memory(context, "a sphere", sizeof *sphere);

cleanup:
  fg__threads_destroy(threads);
  fg__sphere_cells_clear(taken);
  if (status != FG_STATUS_OK) {
    fg__sphere_destroy(sphere);
    sphere = NULL;
  }
  *out = sphere;
  return status;
}
