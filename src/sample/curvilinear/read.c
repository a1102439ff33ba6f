/* Points and cells of a mesh: components interpolated to the centres and rotated to east
 * and north. */
#include "base/angle.h"
#include "base/memory.h"
#include "field/refused.h"
#include "sample/curvilinear/points.h"
#include "sample/missing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The angle in the file is used with the opposite sign where only that agrees with the
 * grid; where neither agrees it has another meaning. The limit is the cosine of the mean
 * difference. */
static const double FITS = 0.985; /* 10 degrees */

/* Number of rows and columns compared. */
enum { COMPARED = 100 };

/* At most, while points and cells are made. */
static const double POINT_BYTES = 90.0;

typedef struct centre_values {
  const fg__curvilinear *mesh;
  size_t count;
  float *component[2];
  unsigned char *wet; /* NULL: no mask */
  fg__positions at;
  size_t repeated;
  bool closed;
} centre_values;

static void clear(centre_values *all)
{
  free(all->component[0]);
  free(all->component[1]);
  free(all->wet);
  fg__positions_clear(&all->at);
}

static fg_status read_part(float **out, const fg__dataset *data,
                           const fg__curvilinear_part *part, size_t time, size_t level)
{
  fg__missing_counts ignored = {0};
  *out = fg__allocate(part->grid.samples, sizeof **out);
  if (!*out)
    return fg__fail_memory(data->context, "the velocity",
                           part->grid.samples * sizeof **out);
  return fg__read_values(*out, &ignored, data, part->variable, &part->grid,
                         part->grid.time >= 0 ? time : 0,
                         part->grid.level >= 0 ? level : 0);
}

/* The faces of a centre along direction k, as indices of the component's samples; -1
 * beyond its ends. */
static void faces_of(ptrdiff_t face[2], const centre_values *all, int k, size_t i,
                     size_t j)
{
  const fg__curvilinear *mesh = all->mesh;
  const fg__grid_axis *axis = mesh->part[k].grid.axis;
  const size_t at[2] = {i, j};
  const ptrdiff_t length = (ptrdiff_t)axis[k].size;
  const ptrdiff_t turn = (ptrdiff_t)(mesh->size[0] - all->repeated);
  for (int side = 0; side < 2; ++side) {
    ptrdiff_t n = (ptrdiff_t)at[k] + side - (mesh->shift[k] > 0 ? 1 : 0);
    const bool round = k == 0 && all->closed && axis[0].size == mesh->size[0];
    if (round && n < 0)
      n += turn;
    if (round && n >= length)
      n -= turn;
    face[side] = n < 0 || n >= length ? -1
                 : k == 0             ? (ptrdiff_t)(j * axis[0].size) + n
                                      : n * (ptrdiff_t)axis[0].size + (ptrdiff_t)i;
  }
}

/* The mean of both faces; NaN where the grid has only one. A missing face beside a
 * present one is a wall (0). *any is set where a face is present. */
static float mean_of(const float *component, const ptrdiff_t face[2], bool *any)
{
  double sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    if (face[side] < 0)
      return NAN;
    const float value = component[face[side]];
    sum += isfinite(value) ? (double)value : 0.0;
    *any = *any || isfinite(value);
  }
  return (float)(sum / 2.0);
}

/* A centre at the grid's edge with one face only is missing. */
static void interpolate_to_centre(centre_values *all, float *const part[2], size_t n)
{
  const fg__curvilinear *mesh = all->mesh;
  const size_t i = n % mesh->size[0], j = n / mesh->size[0];
  bool any = false;
  for (int k = 0; k < 2; ++k) {
    ptrdiff_t face[2] = {(ptrdiff_t)n, (ptrdiff_t)n};
    if (mesh->shift[k] != 0)
      faces_of(face, all, k, i, j);
    if (face[0] < 0 || face[1] < 0) {
      all->at.longitude[n] = (double)NAN;
      any = false;
      break;
    }
    all->component[k][n] = mean_of(part[k], face, &any);
  }
  if (!any)
    all->component[0][n] = NAN;
}

/* Interpolates both components to the centres; samples that are already there are
 * moved. */
static fg_status interpolate_to_centres(centre_values *all, const fg__dataset *data,
                                        float *part[2])
{
  const fg__curvilinear *mesh = all->mesh;
  if (mesh->shift[0] == 0 && mesh->shift[1] == 0) {
    for (int k = 0; k < 2; ++k) {
      all->component[k] = part[k];
      part[k] = NULL;
    }
    return FG_STATUS_OK;
  }
  for (int k = 0; k < 2; ++k) {
    all->component[k] = fg__allocate(all->count, sizeof *all->component[k]);
    if (!all->component[k])
      return fg__fail_memory(data->context, "the velocity",
                             all->count * sizeof *all->component[k]);
  }
  for (size_t n = 0; n < all->count; ++n)
    interpolate_to_centre(all, part, n);
  return FG_STATUS_OK;
}

static fg_status read_mask(centre_values *all, const fg__dataset *data, const char *name,
                           size_t time, size_t level)
{
  const fg__curvilinear *mesh = all->mesh;
  const fg__curvilinear_part *at = &mesh->at;
  const fg__variable *mask = name ? fg__dataset_find(data, name) : mesh->mask;
  if (name && !mask)
    return fg__fail(data->context, FG_STATUS_ARGUMENT,
                    "%s: has no variable '%s' for the mask", data->file[0].path, name);
  if (!mask)
    return FG_STATUS_OK;
  all->wet = fg__allocate(all->count, 1);
  if (!all->wet)
    return fg__fail_memory(data->context, "the mask", all->count);
  return fg__read_mask(all->wet, data, mask, &at->grid, at->variable, time, level);
}

/* The derivative of the position along i: centred, or at an end by the parabola through
 * two neighbours where there are such. unit: positions of the row. */
static void differ(double along[3], const centre_values *all, const double *unit,
                   size_t i)
{
  const size_t columns = all->mesh->size[0];
  const size_t round = all->closed ? columns - all->repeated - 1 : 0;
  size_t low = i > 0 ? i - 1 : i + round;
  size_t high = i + 1 < columns ? i + 1 : i - (all->repeated ? 0 : round);
  low = isfinite(unit[3 * low]) ? low : i;
  high = isfinite(unit[3 * high]) ? high : i;
  const bool after = low == i && i + 2 < columns && isfinite(unit[3 * (i + 2)]);
  const bool before = high == i && i >= 2 && isfinite(unit[3 * (i - 2)]);
  for (size_t c = 0; c < 3; ++c) {
    along[c] = unit[3 * high + c] - unit[3 * low + c];
    if (high != low && after)
      along[c] = 4.0 * along[c] - (unit[3 * (i + 2) + c] - unit[3 * i + c]);
    else if (high != low && before)
      along[c] = 4.0 * along[c] - (unit[3 * i + c] - unit[3 * (i - 2) + c]);
  }
}

/* The direction of i at a point of row j: cosine and sine of its angle from east; false
 * without a neighbour. */
static bool direction_at(double turn[2], const centre_values *all, const double *unit,
                         size_t i, size_t j)
{
  double along[3];
  const size_t n = j * all->mesh->size[0] + i;
  differ(along, all, unit, i);
  const double longitude = all->at.longitude[n] * FG__RADIANS;
  const double latitude = all->at.latitude[n] * FG__RADIANS;
  const double s = sin(longitude), c = cos(longitude);
  const double east = c * along[1] - s * along[0];
  const double north =
      cos(latitude) * along[2] - sin(latitude) * (c * along[0] + s * along[1]);
  const double length = hypot(east, north);
  turn[0] = east / length;
  turn[1] = north / length;
  return length > 0.0;
}

static void find_row(double *unit, const centre_values *all, size_t j)
{
  const size_t columns = all->mesh->size[0];
  for (size_t i = 0; i < columns; ++i)
    fg__unit_vector(unit + 3 * i, &all->at, j * columns + i);
}

/* Cosines and sines of the angle in the file; NULL where it has none. */
static fg_status read_angle(double *given[2], const centre_values *all,
                            const fg__dataset *data, size_t time)
{
  const fg__curvilinear *mesh = all->mesh;
  const fg__curvilinear_part *at = &mesh->at;
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2 && mesh->turn >= FG__TURN_ANGLE; ++k) {
    given[k] = fg__allocate(all->count, sizeof *given[k]);
    if (!given[k])
      return fg__fail_memory(data->context, "angles", all->count * sizeof *given[k]);
    if (mesh->angle[k] && status == FG_STATUS_OK)
      status = fg__read_doubles(given[k], data, mesh->angle[k], &at->grid, at->variable,
                                time, 0);
  }
  if (status != FG_STATUS_OK || mesh->turn != FG__TURN_ANGLE)
    return status;
  const bool degrees = fg__units_of(mesh->angle[0], NULL, 0) == FG__QUANTITY_DEGREES;
  for (size_t n = 0; n < all->count; ++n) {
    const double angle = given[0][n] * (degrees ? FG__RADIANS : 1.0);
    given[0][n] = cos(angle);
    given[1][n] = sin(angle);
  }
  return FG_STATUS_OK;
}

/* Compares the angle in the file with the grid's: 1 equal, -1 opposite, 0 neither. */
static int sense_of(double *const given[2], const centre_values *all, double *unit)
{
  const size_t *size = all->mesh->size;
  double same = 0.0, opposite = 0.0;
  size_t count = 0;
  for (size_t j = 0; j < size[1]; j += size[1] / COMPARED + 1) {
    find_row(unit, all, j);
    for (size_t i = 0; i < size[0]; i += size[0] / COMPARED + 1) {
      const size_t n = j * size[0] + i;
      double turn[2];
      if (!isfinite(given[0][n]) || !isfinite(given[1][n]) ||
          !direction_at(turn, all, unit, i, j))
        continue;
      same += given[0][n] * turn[0] + given[1][n] * turn[1];
      opposite += given[0][n] * turn[0] - given[1][n] * turn[1];
      ++count;
    }
  }
  if (count == 0 || (same < FITS * (double)count && opposite < FITS * (double)count))
    return 0;
  return same >= opposite ? 1 : -1;
}

static void turn_row(const centre_values *all, double *const given[2], int sense,
                     const double *unit, size_t j)
{
  const size_t columns = all->mesh->size[0];
  for (size_t i = 0; i < columns; ++i) {
    const size_t n = j * columns + i;
    double turn[2] = {0.0, 0.0};
    bool known = false;
    if (sense != 0) {
      turn[0] = given[0][n];
      turn[1] = sense * given[1][n];
      known = isfinite(turn[0]) && isfinite(turn[1]);
    }
    known = known || direction_at(turn, all, unit, i, j);
    const double u = known ? (double)all->component[0][n] : (double)NAN;
    const double v = (double)all->component[1][n];
    all->component[0][n] = (float)(u * turn[0] - v * turn[1]);
    all->component[1][n] = (float)(u * turn[1] + v * turn[0]);
  }
}

static fg_status turn_components(const centre_values *all, const fg__dataset *data,
                                 double *const given[2], int *sense)
{
  const size_t columns = all->mesh->size[0];
  double *unit = fg__allocate(columns, 3 * sizeof *unit);
  if (!unit)
    return fg__fail_memory(data->context, "a row's positions",
                           columns * 3 * sizeof *unit);
  *sense = given[0] ? sense_of(given, all, unit) : 0;
  for (size_t j = 0; j < all->mesh->size[1]; ++j) {
    find_row(unit, all, j);
    turn_row(all, given, *sense, unit, j);
  }
  free(unit);
  return FG_STATUS_OK;
}

static fg_status turn(centre_values *all, fg__curvilinear *mesh, const fg__dataset *data,
                      size_t time)
{
  if (mesh->turn == FG__TURN_NONE)
    return FG_STATUS_OK;
  double *given[2] = {NULL, NULL};
  int sense = 0;
  fg_status status = read_angle(given, all, data, time);
  if (status == FG_STATUS_OK)
    status = turn_components(all, data, given, &sense);
  if (status == FG_STATUS_OK && given[0] && sense <= 0)
    snprintf(mesh->rule, sizeof mesh->rule,
             sense < 0 ? "along the grid, turned by '%.60s', which is the angle from "
                         "the grid to east"
                       : "along the grid, turned by its positions: '%.60s' is not its "
                         "angle from east",
             mesh->angle[0]->plain_name);
  free(given[0]);
  free(given[1]);
  return status;
}

static fg_status fill(centre_values *all, fg__curvilinear *mesh, const fg__dataset *data,
                      size_t time, size_t level, const char *mask)
{
  float *part[2] = {NULL, NULL};
  fg_status status = fg__centres_read(&all->at, data, mesh, time);
  if (status == FG_STATUS_OK)
    fg__rows_closure(&all->repeated, &all->closed, &all->at, mesh->size);
  for (int k = 0; k < 2 && status == FG_STATUS_OK; ++k)
    status = read_part(&part[k], data, &mesh->part[k], time, level);
  if (status == FG_STATUS_OK)
    status = interpolate_to_centres(all, data, part);
  free(part[0]);
  free(part[1]);
  if (status == FG_STATUS_OK)
    status = read_mask(all, data, mask, time, level);
  for (size_t n = 0; n < all->count && status == FG_STATUS_OK && all->wet; ++n)
    if (!all->wet[n])
      all->component[0][n] = NAN;
  const fg__raw_samples raw = {
      .path = data->file[0].path,
      .name = {mesh->part[0].variable->plain_name, mesh->part[1].variable->plain_name},
      .component = {all->component[0], all->component[1]},
      .components = 2,
      .count = all->count,
      .is_polar = mesh->polar.sense != 0};
  if (status == FG_STATUS_OK)
    status = fg__missing_settle(data->context, &raw, &data->missing);
  if (status == FG_STATUS_OK)
    status = fg__polar_turn_all(data->context, all->component, all->count, &mesh->polar,
                                data->file[0].path, mesh->part[1].variable->plain_name);
  if (status == FG_STATUS_OK)
    status = fg__refuse_missing_codes(data->context, data->file[0].path, all->component,
                                      all->count);
  return status == FG_STATUS_OK ? turn(all, mesh, data, time) : status;
}

fg_status fg__curvilinear_read(fg__sphere_cells *out, fg__curvilinear *mesh,
                               const fg__dataset *data, size_t time, size_t level,
                               const char *mask)
{
  centre_values all = {.mesh = mesh, .count = mesh->size[0] * mesh->size[1]};
  *out = (fg__sphere_cells){0};
  fg_status status =
      fg__check_memory(data->context, data->file[0].path, (double)all.count, POINT_BYTES);
  if (status == FG_STATUS_OK)
    status = fill(&all, mesh, data, time, level, mask);
  if (status == FG_STATUS_OK)
    status = fg__cells_make(&out->corner, &out->count, &mesh->left_out, data, &all.at,
                            mesh->size, all.repeated, all.closed);
  if (status == FG_STATUS_OK) {
    out->points = all.count;
    out->longitude = all.at.longitude;
    out->latitude = all.at.latitude;
    out->east = all.component[0];
    out->north = all.component[1];
    all.at = (fg__positions){0};
    all.component[0] = all.component[1] = NULL;
  }
  clear(&all);
  return status;
}
