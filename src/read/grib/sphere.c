/* Points on the sphere and the cells between them: grids with a pole of their own, and
 * rows of different lengths. */
#include "base/angle.h"
#include "base/memory.h"
#include "base/vector.h"
#include "read/grib/grib.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A pole within so many rows of the last one belongs to the grid. */
static const double POLE_WITHIN = 1.01;

/* The rotation that moves a grid's own pole to the Earth's. */
typedef struct turn {
  double row[3][3];
} turn;

/* The rotation of ecCodes: about the y axis, then about the Earth's. */
static turn turn_of(const fg__grib_grid *grid)
{
  const double t = grid->rotated ? -(90.0 + grid->pole_latitude) * FG__RADIANS : 0.0;
  const double o =
      grid->rotated ? (grid->pole_angle - grid->pole_longitude) * FG__RADIANS : 0.0;
  const double ct = cos(t), st = sin(t), co = cos(o), so = sin(o);
  return (turn){{{ct * co, so, st * co}, {-ct * so, co, -st * so}, {-st, 0.0, ct}}};
}

static void apply(double out[3], const turn *r, const double a[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = fg__dot(r->row[k], a);
}

/* Sets the position of a point to that of a unit vector. */
static void set_position(fg__sphere_cells *cells, size_t n, const double up[3])
{
  cells->longitude[n] = atan2(up[1], up[0]) / FG__RADIANS;
  cells->latitude[n] = atan2(up[2], hypot(up[0], up[1])) / FG__RADIANS;
}

typedef struct building {
  fg__sphere_cells *cells;
  const fg__grib_grid *grid;
  turn turn;
  bool turns;    /* components are along the grid's own east and north */
  size_t *start; /* REDUCED: the first point of each row, from the south */
} building;

static size_t row_length(const building *b, size_t j)
{
  return b->grid->row ? b->grid->row[j] : b->grid->size[0];
}

static double longitude_in(const building *b, size_t j, size_t i)
{
  const fg__grib_grid *grid = b->grid;
  return grid->row ? grid->west[j] + (double)i * grid->step[j] : grid->axis[0][i];
}

static void place_point(building *b, size_t n, double longitude, double latitude, float u,
                        float v)
{
  fg__sphere_cells *cells = b->cells;
  const fg__sphere_frame own = fg__sphere_frame_at(longitude, latitude);
  double up[3], vector[3], turned[3];
  cells->east[n] = u;
  cells->north[n] = v;
  cells->longitude[n] = longitude;
  cells->latitude[n] = latitude;
  if (!b->grid->rotated)
    return;
  apply(up, &b->turn, own.up);
  set_position(cells, n, up);
  if (!b->turns)
    return;
  const fg__sphere_frame there =
      fg__sphere_frame_at(cells->longitude[n], cells->latitude[n]);
  for (int k = 0; k < 3; ++k)
    vector[k] = (double)u * own.east[k] + (double)v * own.north[k];
  apply(turned, &b->turn, vector);
  cells->east[n] = (float)fg__dot(turned, there.east);
  cells->north[n] = (float)fg__dot(turned, there.north);
}

static void place_points(building *b, const float *const velocity[2])
{
  for (size_t j = 0; j < b->grid->size[1]; ++j)
    for (size_t i = 0; i < row_length(b, j); ++i) {
      const size_t n = b->start[j] + i;
      place_point(b, n, longitude_in(b, j, i), b->grid->axis[1][j], velocity[0][n],
                  velocity[1][n]);
    }
}

/* The mean vector of a row, as that of its pole: point n. */
static void place_pole(building *b, size_t n, size_t row)
{
  fg__sphere_cells *cells = b->cells;
  const double own[3] = {0.0, 0.0, row == 0 ? -1.0 : 1.0};
  double sum[3] = {0.0, 0.0, 0.0}, up[3];
  size_t count = 0;
  for (size_t i = 0; i < row_length(b, row); ++i) {
    const size_t from = b->start[row] + i;
    const fg__sphere_frame there =
        fg__sphere_frame_at(cells->longitude[from], cells->latitude[from]);
    const double east = (double)cells->east[from], north = (double)cells->north[from];
    if (!isfinite(east) || !isfinite(north))
      continue;
    for (int k = 0; k < 3; ++k)
      sum[k] += east * there.east[k] + north * there.north[k];
    ++count;
  }
  apply(up, &b->turn, own);
  set_position(cells, n, up);
  const fg__sphere_frame there =
      fg__sphere_frame_at(cells->longitude[n], cells->latitude[n]);
  cells->east[n] = count > 0 ? (float)(fg__dot(sum, there.east) / (double)count) : NAN;
  cells->north[n] = count > 0 ? (float)(fg__dot(sum, there.north) / (double)count) : NAN;
}

static void add_cell(fg__sphere_cells *cells, size_t a, size_t b, size_t c, int d)
{
  int *corner = cells->corner + 4 * cells->count++;
  corner[0] = (int)a;
  corner[1] = (int)b;
  corner[2] = (int)c;
  corner[3] = d;
}

static void join_equal_rows(building *b, size_t j)
{
  const size_t columns = b->grid->size[0], below = b->start[j], above = b->start[j + 1];
  for (size_t i = 0; i + 1 < columns; ++i)
    add_cell(b->cells, below + i, below + i + 1, above + i + 1, (int)(above + i));
  if (b->grid->period > 0.0)
    add_cell(b->cells, below + columns - 1, below, above, (int)(above + columns - 1));
}

/* Point i of a row; after its last one comes its first. */
static size_t point_of(const building *b, size_t j, size_t i)
{
  return b->start[j] + (i < row_length(b, j) ? i : 0);
}

/* Triangles between rows of different lengths: each takes the next point to the east. */
static void join_rows(building *b, size_t j)
{
  const size_t open = b->grid->period > 0.0 ? 0 : 1;
  const size_t last_i = row_length(b, j) - open, last_k = row_length(b, j + 1) - open;
  size_t i = 0, k = 0;
  while (i < last_i || k < last_k) {
    const size_t below = point_of(b, j, i), above = point_of(b, j + 1, k);
    if (k == last_k ||
        (i < last_i && longitude_in(b, j, i + 1) <= longitude_in(b, j + 1, k + 1)))
      add_cell(b->cells, below, point_of(b, j, ++i), above, -1);
    else
      add_cell(b->cells, below, point_of(b, j + 1, ++k), above, -1);
  }
}

static void join_pole(building *b, size_t n, size_t row)
{
  for (size_t i = 0; i < row_length(b, row); ++i)
    add_cell(b->cells, b->start[row] + i, point_of(b, row, i + 1), n, -1);
}

/* Whether all longitudes of the last row are there, and the pole is next to it. */
static bool has_pole(const fg__grib_grid *grid, size_t row)
{
  const double *y = grid->axis[1];
  const size_t rows = grid->size[1];
  const double step = row == 0 ? y[1] - y[0] : y[rows - 1] - y[rows - 2];
  const double rest = 90.0 - fabs(y[row]);
  return grid->period > 0.0 && (row == 0) == (y[row] < 0.0) && rest > 1e-6 &&
         rest <= POLE_WITHIN * step;
}

static fg_status allocate(building *b, fg_context *context, size_t poles)
{
  const fg__grib_grid *grid = b->grid;
  const size_t rows = grid->size[1], points = grid->points + poles;
  const size_t most = 2 * grid->points + 2 * grid->size[0];
  b->start = fg__allocate(rows, sizeof *b->start);
  if (!fg__sphere_cells_allocate(b->cells, points, most) || !b->start)
    return fg__fail_memory(context, "points and cells",
                           points * 24 + most * 4 * sizeof *b->cells->corner);
  size_t at = 0;
  for (size_t k = 0; k < rows; ++k) { /* a reduced grid's points are as in the file */
    const size_t j = grid->row && grid->y_descends ? rows - 1 - k : k;
    b->start[j] = at;
    at += row_length(b, j);
  }
  return FG_STATUS_OK;
}

fg_status fg__grib_cells(fg__sphere_cells *out, fg_context *context,
                         const fg__grib_grid *grid, const float *const velocity[2])
{
  const size_t last = grid->size[1] - 1;
  const bool south = has_pole(grid, 0), north = has_pole(grid, last);
  building b = {.cells = out,
                .grid = grid,
                .turn = turn_of(grid),
                .turns = grid->rotated && grid->relative};
  memset(out, 0, sizeof *out);
  fg_status status = allocate(&b, context, (size_t)south + north);
  if (status == FG_STATUS_OK) {
    place_points(&b, velocity);
    for (size_t j = 0; j < last; ++j)
      (grid->row ? join_rows : join_equal_rows)(&b, j);
    size_t pole = grid->points;
    if (south) {
      place_pole(&b, pole, 0);
      join_pole(&b, pole++, 0);
    }
    if (north) {
      place_pole(&b, pole, last);
      join_pole(&b, pole, last);
    }
  }
  free(b.start);
  if (status != FG_STATUS_OK)
    fg__sphere_cells_clear(out);
  return status;
}
