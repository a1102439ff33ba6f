/* Spheres of points and cells. */
#include "base/memory.h"
#include "sphere/inside.h"

#include <limits.h>
#include <stdlib.h>

/* The cosine of what a cell's corners may lie apart: no model's cells are so large, and
 * what is has a corner at a place that was never set. */
static const double LEAST_COSINE = 0.8660254037844387; /* 30 degrees */

/* Of a point, or of a cell with its places in the squares of locate.c. */
static const double CELL_BYTES = 40.0;

/* Cells of positions that are no grid's lie on each other, and finding one among them
 * would take for ever. */
static const double MOST_LAYERS = 4.0;
enum { FEWEST_CELLS = 100 };

int fg__sphere_corners(const fg__sphere *sphere, size_t cell, int point[4])
{
  if (sphere->field) {
    const fg_field_arrays *grid = fg_field_contents(sphere->field);
    const size_t columns = (size_t)grid->size[0];
    const size_t across = grid->period[0] > 0.0 ? columns : columns - 1;
    const size_t i = cell % across, next = i + 1 == columns ? 0 : i + 1;
    const size_t row = cell / across * columns;
    point[0] = (int)(row + i);
    point[1] = (int)(row + next);
    point[2] = (int)(row + columns + next);
    point[3] = (int)(row + columns + i);
    return 4;
  }
  for (int k = 0; k < 4; ++k)
    point[k] = sphere->corner[4 * cell + (size_t)k];
  return point[3] < 0 ? 3 : 4;
}

static fg_status check_cells(fg_context *context, const fg__sphere_cells *cells)
{
  if (cells->points >= INT_MAX || cells->count >= INT_MAX)
    return fg__fail(
        context, FG_STATUS_UNSUPPORTED,
        "field: %zu points and %zu cells are more than the %d that are handled",
        cells->points, cells->count, INT_MAX - 1);
  for (size_t n = 0; n < 4 * cells->count; ++n)
    if (cells->corner[n] >= (int)cells->points ||
        cells->corner[n] < (n % 4 == 3 ? -1 : 0))
      return fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "field: cell %zu has corner %d, but there are %zu points", n / 4,
                      cells->corner[n], cells->points);
  return FG_STATUS_OK;
}

static fg_status set_points(fg__sphere *sphere, fg_context *context,
                            const fg__sphere_cells *cells)
{
  fg_status status = fg__sphere_begin(sphere, context, cells->points, cells->words);
  sphere->position = fg__allocate(cells->points, 3 * sizeof *sphere->position);
  if (!sphere->position && status == FG_STATUS_OK)
    status = fg__fail_memory(context, "positions on the sphere",
                             cells->points * 3 * sizeof *sphere->position);
  for (size_t n = 0; n < cells->points && status == FG_STATUS_OK; ++n) {
    const fg__sphere_frame at =
        fg__sphere_frame_at(cells->longitude[n], cells->latitude[n]);
    for (size_t k = 0; k < 3; ++k)
      sphere->position[3 * n + k] = at.up[k];
    const bool there = isfinite(cells->longitude[n]) && fabs(cells->latitude[n]) <= 90.0;
    status = fg__sphere_set(sphere, context, n, &at, there ? cells->east[n] : NAN,
                            cells->north[n]);
    if (!there)
      sphere->position[3 * n] = (double)NAN;
  }
  return status;
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

static fg_status keep_cells(fg__sphere *sphere, fg_context *context)
{
  size_t kept = 0;
  for (size_t n = 0; n < sphere->count; ++n) {
    if (!is_kept(sphere, n))
      continue;
    for (size_t k = 0; k < 4; ++k)
      sphere->corner[4 * kept + k] = sphere->corner[4 * n + k];
    ++kept;
  }
  const size_t all = sphere->count;
  sphere->count = kept;
  if (kept > 0)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "field: none of %zu cells has a value and corners within 30 degrees",
                  all);
}

static fg_status make(fg__sphere *sphere, fg_context *context, fg__sphere_cells *cells)
{
  fg_status status = fg__check_memory(
      context, "field", (double)cells->points + (double)cells->count, CELL_BYTES);
  if (status == FG_STATUS_OK)
    status = check_cells(context, cells);
  if (status != FG_STATUS_OK)
    return status;
  sphere->corner = cells->corner;
  sphere->count = cells->count;
  cells->corner = NULL;
  status = set_points(sphere, context, cells);
  if (status == FG_STATUS_OK)
    status = keep_cells(sphere, context);
  if (status == FG_STATUS_OK)
    status = fg__sphere_fill(sphere, context);
  if (status != FG_STATUS_OK)
    return status;
  const double layers = fg__sphere_measure(sphere, cells->longitude, cells->latitude);
  if (!(layers > MOST_LAYERS) || sphere->count < FEWEST_CELLS)
    return FG_STATUS_OK;
  const fg__sphere_extent *extent = &sphere->extent;
  return fg__fail(context, FG_STATUS_FILE_FORMAT,
                  "field: its cells lie on each other: they are %.3g times as large as "
                  "the longitudes %g to %g and latitudes %g to %g that they cover",
                  layers, extent->west, extent->east, extent->south, extent->north);
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

fg_status fg__sphere_of_cells(fg__sphere **out, fg_context *context,
                              fg__sphere_cells *taken)
{
  *out = NULL;
  fg__sphere *sphere = fg__allocate(1, sizeof *sphere);
  fg_status status = sphere ? make(sphere, context, taken)
                            : fg__fail_memory(context, "a sphere", sizeof *sphere);
  fg__sphere_cells_clear(taken);
  if (status == FG_STATUS_OK)
    status = fg__sphere_sort_cells(sphere, context);
  if (status == FG_STATUS_OK)
    *out = sphere;
  else
    fg__sphere_destroy(sphere);
  return status;
}
