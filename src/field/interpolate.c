/* Velocity and direction between the samples. */
#include "base/angle.h"
#include "field/field.h"

#include <math.h>

/* cos(latitude) is kept above that of a hundredth of a degree off the pole, nearer than
 * the rows of any grid in use: the direction there is east or west, its limit, and
 * finite. */
static const double SMALLEST_COSINE = 1.745e-4;

/* The sample after n, round a periodic axis. */
static int next_sample(const fg__axis *axis, int n)
{
  return n + 1 == axis->samples ? 0 : n + 1;
}

static size_t place(const fg_field *field, int k, int n)
{
  return (size_t)fg__field_place(field, k, n);
}

void fg__field_corners_of(const fg_field *field, int i, int j, int k,
                          size_t corner[FG__FIELD_CORNERS])
{
  const size_t left = place(field, 0, i);
  const size_t right = place(field, 0, next_sample(&field->axis[0], i));
  const size_t row = (size_t)field->held[0];
  const size_t lower = place(field, 1, j) * row;
  const size_t upper = place(field, 1, next_sample(&field->axis[1], j)) * row;
  corner[0] = lower + left;
  corner[1] = lower + right;
  corner[2] = upper + left;
  corner[3] = upper + right;
  if (field->contents.dimension == 2)
    return;
  const size_t plane = row * (size_t)field->held[1];
  const size_t above = place(field, 2, next_sample(&field->axis[2], k)) * plane;
  const size_t below = place(field, 2, k) * plane;
  for (int c = 0; c < 4; ++c) {
    corner[4 + c] = corner[c] + above;
    corner[c] += below;
  }
}

/* Brings x into [first, first + period); fmod is exact, so that any x is wrapped without
 * drift. */
static double wrap(const fg__axis *axis, double x)
{
  const double first = axis->coordinate[0];
  if (x >= first && x < axis->coordinate[axis->cells])
    return x;
  double offset = fmod(x - first, axis->period);
  if (offset < 0.0)
    offset += axis->period;
  x = first + offset;
  return x < axis->coordinate[axis->cells] ? x : first;
}

static inline int find_cell(const fg__axis *axis, double x, double *fraction)
{
  const double *coordinate = axis->coordinate;
  if (axis->period > 0.0 && isfinite(x))
    x = wrap(axis, x);
  if (!(x >= coordinate[0] && x <= coordinate[axis->cells]))
    return -1;
  int cell;
  if (axis->even) {
    cell = (int)((x - coordinate[0]) * axis->inverse_spacing);
    cell = cell < axis->cells ? cell : axis->cells - 1;
    while (cell > 0 && x < coordinate[cell])
      --cell;
    while (cell < axis->cells - 1 && x >= coordinate[cell + 1])
      ++cell;
  } else {
    cell = 0;
    int beyond = axis->cells;
    while (beyond - cell > 1) {
      const int middle = cell + (beyond - cell) / 2;
      if (x >= coordinate[middle])
        cell = middle;
      else
        beyond = middle;
    }
  }
  const double inside = (x - coordinate[cell]) * axis->inverse_width[cell];
  *fraction = inside < 1.0 ? inside : 1.0;
  return cell;
}

int fg__axis_cell(const fg__axis *axis, double x, double *fraction)
{
  return find_cell(axis, x, fraction);
}

/* A point of a grid along axis k; one a rounding error beyond the axis is at its end. */
static int cell_of(const fg__axis *axis, const fg__field_points *points, int n)
{
  double ignored, x = points->origin + n * points->spacing;
  const int cell = fg__axis_cell(axis, x, &ignored);
  return cell >= 0 ? cell : x < axis->coordinate[0] ? 0 : axis->cells - 1;
}

void fg__field_span(int *first_sample, int *samples, const fg_field *field, int k,
                    const fg__field_points *points)
{
  const fg__axis *axis = &field->axis[k];
  const int all = points->all, n = axis->samples;
  int first = points->first, last = points->first + points->count - 1;
  *first_sample = 0;
  *samples = n;
  if (points->count >= all)
    return;
  if (!(axis->period > 0.0)) {
    const int low = cell_of(axis, points, first > 0 ? first : 0);
    const int high = cell_of(axis, points, last < all - 1 ? last : all - 1);
    *first_sample = low > 0 ? low - 1 : 0;
    *samples = (high + 3 < n ? high + 3 : n) - *first_sample;
    return;
  }
  first = (first % all + all) % all;
  last = (last % all + all) % all;
  const int low = cell_of(axis, points, first), high = cell_of(axis, points, last);
  const int count = high - low + 4 + (first > last ? n : 0);
  if (count >= n)
    return;
  *first_sample = (low - 1 + n) % n;
  *samples = count;
}

/* Between the four corners of a face across z; s along x, t along y. */
static double bilinear(const float *sample, const size_t corner[4], double s, double t)
{
  const double lower =
      (1.0 - s) * (double)sample[corner[0]] + s * (double)sample[corner[1]];
  const double upper =
      (1.0 - s) * (double)sample[corner[2]] + s * (double)sample[corner[3]];
  return (1.0 - t) * lower + t * upper;
}

/* Whether a part or window has a cell, and no corner of it is missing. */
static bool has_cell(const fg_field *field, const int at[3])
{
  for (int k = 0; k < field->contents.dimension; ++k)
    if (fg__field_place(field, k, at[k]) >= field->held[k] ||
        fg__field_place(field, k, next_sample(&field->axis[k], at[k])) >= field->held[k])
      return false;
  size_t corner[FG__FIELD_CORNERS];
  fg__field_corners_of(field, at[0], at[1], at[2], corner);
  for (int c = 0; c < fg__field_corners(field); ++c)
    if (isnan(field->velocity[0][corner[c]]))
      return false;
  return true;
}

/* The same as below of a whole field in 2D, from which nearly all lines are traced,
 * without calls and loops. */
static bool velocity_in_2d(const fg_field *field, const double position[],
                           double velocity[])
{
  const fg__axis *x = &field->axis[0], *y = &field->axis[1];
  double s, t;
  const int i = find_cell(x, position[0], &s);
  const int j = i < 0 ? -1 : find_cell(y, position[1], &t);
  if (j < 0 ||
      (field->valid_cell && !field->valid_cell[(size_t)j * (size_t)x->cells + (size_t)i]))
    return false;
  const size_t row = (size_t)x->samples, right = (size_t)next_sample(x, i);
  const size_t lower = (size_t)j * row, upper = (size_t)next_sample(y, j) * row;
  const size_t corner[4] = {lower + (size_t)i, lower + right, upper + (size_t)i,
                            upper + right};
  velocity[0] = bilinear(field->velocity[0], corner, s, t);
  velocity[1] = bilinear(field->velocity[1], corner, s, t);
  return true;
}

bool fg_field_velocity(const fg_field *field, const double position[], double velocity[])
{
  const int dimension = field->contents.dimension;
  if (dimension == 2 && fg__field_is_whole(field))
    return velocity_in_2d(field, position, velocity);
  double inside[3];
  int at[3] = {0};
  size_t cell = 0;
  for (int k = 0; k < dimension; ++k) {
    at[k] = fg__axis_cell(&field->axis[k], position[k], &inside[k]);
    if (at[k] < 0)
      return false;
  }
  for (int k = dimension - 1; k >= 0; --k)
    cell = cell * (size_t)field->axis[k].cells + (size_t)at[k];
  if (field->valid_cell && !field->valid_cell[cell])
    return false;
  if (!fg__field_is_whole(field) && !has_cell(field, at))
    return false;
  size_t corner[FG__FIELD_CORNERS];
  fg__field_corners_of(field, at[0], at[1], at[2], corner);
  for (int k = 0; k < dimension; ++k) {
    const float *sample = field->velocity[k];
    velocity[k] = bilinear(sample, corner, inside[0], inside[1]);
    if (dimension == 3) {
      const double above = bilinear(sample, corner + 4, inside[0], inside[1]);
      velocity[k] = (1.0 - inside[2]) * velocity[k] + inside[2] * above;
    }
  }
  return true;
}

bool fg_field_tangent(const fg_field *field, const double position[], double tangent[])
{
  if (!fg_field_velocity(field, position, tangent))
    return false;
  if (field->contents.scale == FG_SCALE_GEO) {
    /* dlon/dt = u / (R cos latitude), dlat/dt = v / R */
    const double cosine = cos(position[1] * FG__RADIANS);
    tangent[0] /= cosine > SMALLEST_COSINE ? cosine : SMALLEST_COSINE;
  }
  return true;
}
