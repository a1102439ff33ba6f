/* Rows of points, about a pole of their own or of different lengths, as a mesh: positions
 * on the sphere, and the faces between the points. */
#include "base/memory.h"
#include "base/vector.h"
#include "decode/grib/grib.h"
#include "sphere/sphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In rows: a pole that is no further from the last row belongs to the grid. */
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

typedef struct building {
  const fg__grib_grid *grid;
  fg__grib_mesh *mesh;
  turn turn;
  size_t *start; /* the first point of each row, from the south */
} building;

static size_t row_length(const fg__grib_grid *grid, size_t j)
{
  return grid->row ? grid->row[j] : grid->size[0];
}

static double longitude_in(const building *b, size_t j, size_t i)
{
  const fg__grib_grid *grid = b->grid;
  return grid->row ? grid->west[j] + (double)i * grid->step[j] : grid->axis[0][i];
}

/* Sets the position of a point to that of a unit vector. */
static void set_position(const building *b, size_t n, const double up[3])
{
  b->mesh->position[0][n] = atan2(up[1], up[0]) / FG__RADIANS;
  b->mesh->position[1][n] = atan2(up[2], hypot(up[0], up[1])) / FG__RADIANS;
}

static void place_point(const building *b, size_t n, double longitude, double latitude)
{
  fg__grib_mesh *mesh = b->mesh;
  const fg__sphere_frame own = fg__sphere_frame_at(longitude, latitude);
  double up[3], east[3];
  mesh->position[0][n] = longitude;
  mesh->position[1][n] = latitude;
  if (!b->grid->rotated)
    return;
  apply(up, &b->turn, own.up);
  apply(east, &b->turn, own.east);
  set_position(b, n, up);
  const fg__sphere_frame there =
      fg__sphere_frame_at(mesh->position[0][n], mesh->position[1][n]);
  mesh->turn[0][n] = fg__dot(east, there.east);
  mesh->turn[1][n] = fg__dot(east, there.north);
}

static void place_pole(const building *b, size_t n, double z)
{
  double up[3];
  apply(up, &b->turn, (const double[3]){0.0, 0.0, z});
  set_position(b, n, up);
  if (b->grid->rotated)
    b->mesh->turn[0][n] = 1.0;
}

static void add_face(fg__grib_mesh *mesh, size_t a, size_t b, size_t c, int d)
{
  int *corner = mesh->corner + 4 * mesh->faces++;
  corner[0] = (int)a;
  corner[1] = (int)b;
  corner[2] = (int)c;
  corner[3] = d;
}

/* Point i of a row; after its last one comes its first. */
static size_t point_of(const building *b, size_t j, size_t i)
{
  return b->start[j] + (i < row_length(b->grid, j) ? i : 0);
}

/* Steps from point to point along a row: where it closes, one more than between. */
static size_t steps_in(const fg__grib_grid *grid, size_t j)
{
  return row_length(grid, j) - (grid->period > 0.0 ? 0 : 1);
}

static void join_equal_rows(const building *b, size_t j)
{
  for (size_t i = 0; i < steps_in(b->grid, j); ++i)
    add_face(b->mesh, point_of(b, j, i), point_of(b, j, i + 1), point_of(b, j + 1, i + 1),
             (int)point_of(b, j + 1, i));
}

/* Triangles between rows of different lengths: each takes the next point to the east. */
static void join_rows(const building *b, size_t j)
{
  const size_t last_i = steps_in(b->grid, j), last_k = steps_in(b->grid, j + 1);
  size_t i = 0, k = 0;
  while (i < last_i || k < last_k) {
    const size_t below = point_of(b, j, i), above = point_of(b, j + 1, k);
    if (k == last_k ||
        (i < last_i && longitude_in(b, j, i + 1) <= longitude_in(b, j + 1, k + 1)))
      add_face(b->mesh, below, point_of(b, j, ++i), above, -1);
    else
      add_face(b->mesh, below, point_of(b, j + 1, ++k), above, -1);
  }
}

static void join_pole(const building *b, size_t n, size_t row)
{
  for (size_t i = 0; i < row_length(b->grid, row); ++i)
    add_face(b->mesh, b->start[row] + i, point_of(b, row, i + 1), n, -1);
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

void fg__grib_mesh_count(fg__grib_mesh *out, const fg__grib_grid *grid)
{
  const size_t last = grid->size[1] - 1, ends[2] = {0, last};
  *out = (fg__grib_mesh){0};
  for (size_t j = 0; j < last; ++j)
    out->faces += steps_in(grid, j) + (grid->row ? steps_in(grid, j + 1) : 0);
  for (int k = 0; k < 2; ++k)
    if (has_pole(grid, ends[k])) {
      ++out->poles;
      out->faces += row_length(grid, ends[k]);
    }
  out->nodes = grid->points + out->poles;
}

static fg_status allocate(building *b, fg_context *context)
{
  const fg__grib_grid *grid = b->grid;
  fg__grib_mesh *mesh = b->mesh;
  const size_t rows = grid->size[1], turned = grid->rotated ? mesh->nodes : 0;
  bool memory = true;
  b->start = fg__allocate(rows, sizeof *b->start);
  mesh->corner = fg__allocate(mesh->faces, 4 * sizeof *mesh->corner);
  for (int k = 0; k < 2; ++k) {
    mesh->position[k] = fg__allocate(mesh->nodes, sizeof(double));
    mesh->turn[k] = fg__allocate(turned, sizeof(double));
    memory = memory && mesh->position[k] && mesh->turn[k];
  }
  if (!memory || !b->start || !mesh->corner)
    return fg__fail_memory(context, "points and cells",
                           mesh->nodes * 32 + mesh->faces * 16);
  size_t at = 0;
  for (size_t k = 0; k < rows; ++k) { /* a reduced grid's points are as in the file */
    const size_t j = grid->row && grid->y_descends ? rows - 1 - k : k;
    b->start[j] = at;
    at += row_length(grid, j);
  }
  mesh->faces = 0;
  return FG_STATUS_OK;
}

fg_status fg__grib_mesh_make(fg__grib_grid *grid, fg_context *context)
{
  const size_t last = grid->size[1] - 1;
  building b = {.grid = grid, .mesh = &grid->mesh, .turn = turn_of(grid)};
  const fg_status status = allocate(&b, context);
  size_t pole = grid->points;
  for (size_t j = 0; j <= last && status == FG_STATUS_OK; ++j)
    for (size_t i = 0; i < row_length(grid, j); ++i)
      place_point(&b, b.start[j] + i, longitude_in(&b, j, i), grid->axis[1][j]);
  for (size_t j = 0; j < last && status == FG_STATUS_OK; ++j)
    (grid->row ? join_rows : join_equal_rows)(&b, j);
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k) {
    const size_t row = k == 0 ? 0 : last;
    if (!has_pole(grid, row))
      continue;
    place_pole(&b, pole, k == 0 ? -1.0 : 1.0);
    join_pole(&b, pole++, row);
  }
  free(b.start);
  return status;
}
