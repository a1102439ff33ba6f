/* Spheres of longitude-latitude grids. */
#include "base/memory.h"
#include "field/field.h"
#include "sphere/inside.h"

/* A last row this many rows or less off the pole reaches it: Gaussian grids' do. */
static const double NEAR_POLE = 1.01;

/* Positions a rounding error beyond the grid are at its end. */
static const double ROUNDING = 1e-9;

static int columns_of(const fg_field *field)
{
  return field->contents.size[0];
}

void fg__sphere_grid_corners(const fg__sphere *sphere, size_t cell, int point[4])
{
  const fg_field_arrays *grid = fg_field_contents(sphere->field);
  const size_t columns = (size_t)grid->size[0];
  const size_t across = grid->period[0] > 0.0 ? columns : columns - 1;
  const size_t i = cell % across, next = i + 1 == columns ? 0 : i + 1;
  const size_t row = cell / across * columns;
  point[0] = (int)(row + i);
  point[1] = (int)(row + next);
  point[2] = (int)(row + columns + next);
  point[3] = (int)(row + columns + i);
}

/* The row of a grid nearest the pole, and how far off it is from that in rows. */
static int last_row(const fg_field *field, bool north, double *rows_off)
{
  const fg__axis *y = &field->axis[1];
  const int last = y->samples - 1, row = north ? last : 0;
  const double off = north ? 90.0 - y->coordinate[last] : y->coordinate[0] + 90.0;
  const double step = north ? y->coordinate[last] - y->coordinate[last - 1]
                            : y->coordinate[1] - y->coordinate[0];
  *rows_off = off / step;
  return row;
}

/* A Gaussian grid's distance to the pole is a little over a half of its step; a grid of
 * cell centres' is a half. */
static void add_pole(fg__sphere *sphere, bool north)
{
  double off, sum[3] = {0.0, 0.0, 0.0};
  const fg_field *field = sphere->field;
  const size_t row = (size_t)last_row(field, north, &off);
  if (field->axis[0].period <= 0.0 || off > NEAR_POLE || off <= 0.0)
    return;
  size_t count = 0;
  const size_t columns = (size_t)columns_of(field);
  for (size_t n = row * columns; n < (row + 1) * columns; ++n) {
    if (sphere->missing && sphere->missing[n])
      continue;
    for (size_t k = 0; k < 3; ++k)
      sum[k] += (double)sphere->vector[3 * n + k];
    ++count;
  }
  if (count == 0)
    return;
  sphere->has_pole[north] = true;
  for (int k = 0; k < 3; ++k)
    sphere->pole[north][k] = (float)(sum[k] / (double)count);
}

static fg_status set_vectors(fg__sphere *sphere, fg_context *context)
{
  const fg_field *field = sphere->field;
  const fg_field_arrays *arrays = fg_field_contents(field);
  const int columns = columns_of(field);
  fg_status status = fg__sphere_begin(sphere, context,
                                      (size_t)columns * (size_t)arrays->size[1], arrays);
  bool all = true;
  for (int j = 0; j < arrays->size[1] && status == FG_STATUS_OK; ++j)
    for (int i = 0; i < columns; ++i) {
      const size_t n = (size_t)j * (size_t)columns + (size_t)i;
      const fg__sphere_frame at =
          fg__sphere_frame_at(arrays->axis[0][i], arrays->axis[1][j]);
      all &=
          fg__sphere_set(sphere, n, &at, arrays->velocity[0][n], arrays->velocity[1][n]);
    }
  fg__sphere_all_set(sphere, !all);
  sphere->count = (size_t)field->axis[0].cells * (size_t)field->axis[1].cells;
  return status;
}

fg_status fg__sphere_of_field(fg__sphere **out, fg_context *context,
                              const fg_field *field)
{
  *out = NULL;
  const fg_field_arrays *arrays = fg_field_contents(field);
  if (arrays->scale != FG_SCALE_GEO || arrays->dimension != 2 ||
      !fg__field_is_whole(field))
    return fg__fail(
        context, FG_STATUS_ARGUMENT,
        "field: a sphere needs all of a field in 2D in longitude and latitude");
  fg__sphere *sphere = fg__allocate(1, sizeof *sphere);
  if (!sphere)
    return fg__fail_memory(context, "a sphere", sizeof *sphere);
  sphere->field = field;
  fg_status status = set_vectors(sphere, context);
  if (status == FG_STATUS_OK)
    status = fg__sphere_fill(sphere, context);
  if (status == FG_STATUS_OK) {
    double layers;
    add_pole(sphere, false);
    add_pole(sphere, true);
    status = fg__sphere_measure(&layers, sphere, context, NULL, NULL, NULL);
  }
  if (status != FG_STATUS_OK) {
    fg__sphere_destroy(sphere);
    return status;
  }
  *out = sphere;
  return FG_STATUS_OK;
}

/* Brings a longitude to where the grid's are, whatever turn it was in. */
static double turn_to(const fg__axis *x, double longitude)
{
  const double first = x->coordinate[0];
  double offset = longitude - first;
  if (!(offset >= 0.0 && offset < 360.0))
    offset = fmod(offset, 360.0);
  if (offset < 0.0)
    offset += 360.0;
  const double length = x->coordinate[x->cells] - first;
  if (offset > length && offset <= length + ROUNDING)
    offset = length;
  if (offset > length && offset >= 360.0 - ROUNDING)
    offset = 0.0;
  return first + offset;
}

/* Between the last row and the pole. */
static bool place_at_pole(fg__sphere_place *out, const fg__sphere *sphere, int column,
                          double s, double latitude)
{
  const bool north = latitude > 0.0;
  const fg_field *field = sphere->field;
  const fg__axis *y = &field->axis[1];
  if (!sphere->has_pole[north])
    return false;
  double off;
  const int row = last_row(field, north, &off);
  const double edge = y->coordinate[row];
  const double t = (latitude - edge) / ((north ? 90.0 : -90.0) - edge);
  const int next = column + 1 == columns_of(field) ? 0 : column + 1;
  const int first = row * columns_of(field);
  *out = (fg__sphere_place){
      {first + column, first + next, north ? FG__SPHERE_NORTH : FG__SPHERE_SOUTH, 0},
      {(1.0 - s) * (1.0 - t), s * (1.0 - t), t, 0.0}};
  return true;
}

bool fg__sphere_place_in_grid(fg__sphere_place *out, const fg__sphere *sphere,
                              double longitude, double latitude)
{
  const fg_field *field = sphere->field;
  const fg__axis *x = &field->axis[0], *y = &field->axis[1];
  double s, t;
  const int i = fg__axis_cell(x, turn_to(x, longitude), &s);
  if (i < 0)
    return false;
  const double south = y->coordinate[0], north = y->coordinate[y->cells];
  if (latitude < south && latitude >= south - ROUNDING)
    latitude = south;
  if (latitude > north && latitude <= north + ROUNDING)
    latitude = north;
  const int j = fg__axis_cell(y, latitude, &t);
  if (j < 0)
    return place_at_pole(out, sphere, i, s, latitude);
  size_t corner[FG__FIELD_CORNERS];
  fg__field_corners_of(field, i, j, 0, corner);
  for (int k = 0; k < 4; ++k) {
    out->point[k] = (int)corner[k];
    out->weight[k] = (k & 1 ? s : 1.0 - s) * (k & 2 ? t : 1.0 - t);
  }
  return true;
}
