/* Cuts through fields in 3D: the plane's own samples where it is along two axes, else a
 * raster in the plane. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/weighted.h"
#include "field/field.h"
#include "field/plane.h"
#include "field/slab.h"

enum { MOST_SAMPLES = 1 << 22, NAME_BYTES = 256, WORDS_BYTES = 512 };

/* Of an axis' length: a point so far outside is at the end, for it was rounded. */
static const double ROUNDING = 1e-9;

/* A raster has so many samples for one of the volume while it stays within FINE along its
 * longer side. */
static const double MOST_BETWEEN = 8.0, FINE = 512.0;

/* Of uneven steps the one that so many are shorter than. */
static const double SHORTER = 0.25;

/* What a cut is made of. */
typedef struct cut {
  fg_context *context;
  const fg_field *volume;
  fg__plane_basis basis;
  double offset; /* of the plane along its normal */
  bool along_axes;
  fg_field_arrays arrays;
  double *axis[2];
  float *velocity[3]; /* the third stays NULL */
  char name[2][NAME_BYTES], component[2][NAME_BYTES], level[WORDS_BYTES];
  double normal_sum, sum; /* squares of the velocity */
} cut;

static double end_of(const fg_field *volume, int k)
{
  return volume->axis[k].coordinate[volume->axis[k].cells];
}

static bool is_sample(const fg_field *volume, size_t n)
{
  return !isnan(volume->velocity[0][n]);
}

/* In-plane components of a velocity, and what is normal to it. */
static void keep(cut *c, size_t to, const double velocity[3])
{
  const double normal = fg__dot(velocity, c->basis.normal);
  c->normal_sum += normal * normal;
  c->sum += fg__dot(velocity, velocity);
  for (int k = 0; k < 2; ++k)
    c->velocity[k][to] = (float)fg__dot(velocity, c->basis.direction[k]);
}

static void miss(cut *c, size_t to)
{
  c->velocity[0][to] = c->velocity[1][to] = NAN;
}

static fg_status allocate(cut *c, const int size[2])
{
  const size_t count = (size_t)size[0] * (size_t)size[1];
  bool whole = true;
  for (int k = 0; k < 2; ++k) {
    c->arrays.size[k] = size[k];
    c->axis[k] = fg__allocate((size_t)size[k], sizeof(double));
    c->velocity[k] = fg__allocate(count, sizeof(float));
    c->arrays.axis[k] = c->axis[k];
    c->arrays.velocity[k] = c->velocity[k];
    whole = whole && c->axis[k] && c->velocity[k];
  }
  return whole ? FG_STATUS_OK
               : fg__fail_memory(c->context, "a cut", count * 2 * sizeof(float));
}

/* The two planes of samples beside the cut, and how far it lies from the first; one when
 * it lies on it. */
static fg_status find_planes(int plane[2], double *share, const cut *c, double at)
{
  const int k = c->basis.across;
  const fg__axis *axis = &c->volume->axis[k];
  const int cell = fg__axis_cell(axis, at, share);
  if (cell < 0) {
    const fg_field_arrays *a = &c->volume->contents;
    return fg__fail(c->context, FG_STATUS_ARGUMENT,
                    "field: a cut at %s = %g, and the field is from %g to %g",
                    a->axis_name[k], at, axis->coordinate[0], end_of(c->volume, k));
  }
  plane[0] = cell;
  plane[1] = cell + 1 == axis->samples ? 0 : cell + 1;
  if (*share <= 0.0)
    plane[1] = plane[0];
  else if (*share >= 1.0)
    plane[0] = plane[1];
  return FG_STATUS_OK;
}

/* The volume's samples in the plane, or between those of the two beside it. */
static fg_status cut_along_axes(cut *c)
{
  const fg_field *volume = c->volume;
  const fg_field_arrays *a = &volume->contents;
  const int across = c->basis.across;
  const int *along = c->basis.axis;
  const size_t step[3] = {1, (size_t)a->size[0], (size_t)a->size[0] * (size_t)a->size[1]};
  int plane[2] = {0, 0};
  double share = 0.0;
  fg_status status = find_planes(plane, &share, c, c->offset * c->basis.normal[across]);
  if (status == FG_STATUS_OK)
    status = allocate(c, (int[2]){a->size[along[0]], a->size[along[1]]});
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 2; ++k) {
    c->arrays.period[k] = a->period[along[k]];
    for (int i = 0; i < c->arrays.size[k]; ++i)
      c->axis[k][i] = a->axis[along[k]][i];
  }
  const size_t low = (size_t)plane[0] * step[across],
               high = (size_t)plane[1] * step[across];
  size_t to = 0;
  for (int j = 0; j < c->arrays.size[1]; ++j)
    for (int i = 0; i < c->arrays.size[0]; ++i, ++to) {
      const size_t at = (size_t)i * step[along[0]] + (size_t)j * step[along[1]];
      double velocity[3];
      if (!is_sample(volume, at + low) || !is_sample(volume, at + high)) {
        miss(c, to);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        velocity[k] = low == high
                          ? (double)volume->velocity[k][at + low]
                          : (1.0 - share) * (double)volume->velocity[k][at + low] +
                                share * (double)volume->velocity[k][at + high];
      keep(c, to, velocity);
    }
  return FG_STATUS_OK;
}

/* Extends what the cut covers by where the plane meets an edge of the box. */
static void meet_edge(double low[2], double high[2], const cut *c, const double a[3],
                      const double b[3])
{
  const double *n = c->basis.normal;
  const double from = fg__dot(a, n) - c->offset;
  const double to = fg__dot(b, n) - c->offset;
  if (!(from * to <= 0.0))
    return;
  const double share = from - to > 0.0 || from - to < 0.0 ? from / (from - to) : 0.0;
  double at[3];
  for (int k = 0; k < 3; ++k)
    at[k] = a[k] + share * (b[k] - a[k]);
  for (int k = 0; k < 2; ++k) {
    const double s = fg__dot(at, c->basis.direction[k]);
    low[k] = fmin(low[k], s);
    high[k] = fmax(high[k], s);
  }
}

/* The rectangle round what the plane has in common with the volume. */
static fg_status find_extent(double low[2], double high[2], const cut *c)
{
  const fg_field *volume = c->volume;
  low[0] = low[1] = HUGE_VAL;
  high[0] = high[1] = -HUGE_VAL;
  for (int k = 0; k < 3; ++k) /* edges along axis k */
    for (int corner = 0; corner < 4; ++corner) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      double a[3], b[3];
      a[k] = volume->axis[k].coordinate[0];
      b[k] = end_of(volume, k);
      a[i] = b[i] = corner & 1 ? end_of(volume, i) : volume->axis[i].coordinate[0];
      a[j] = b[j] = corner & 2 ? end_of(volume, j) : volume->axis[j].coordinate[0];
      meet_edge(low, high, c, a, b);
    }
  if (low[0] < high[0] && low[1] < high[1])
    return FG_STATUS_OK;
  return fg__fail(
      c->context, FG_STATUS_ARGUMENT,
      "field: the plane with normal (%g, %g, %g) at %g along it misses the field, which "
      "is from (%g, %g, %g) to (%g, %g, %g)",
      c->basis.normal[0], c->basis.normal[1], c->basis.normal[2], c->offset,
      volume->axis[0].coordinate[0], volume->axis[1].coordinate[0],
      volume->axis[2].coordinate[0], end_of(volume, 0), end_of(volume, 1),
      end_of(volume, 2));
}

/* A step of an axis that a quarter are shorter than; of an even one any. */
static fg_status find_step(double *out, const cut *c, int k)
{
  const fg__axis *axis = &c->volume->axis[k];
  double *width = fg__allocate((size_t)axis->cells, sizeof *width);
  if (!width)
    return fg__fail_memory(c->context, "an axis", (size_t)axis->cells * sizeof *width);
  for (int i = 0; i < axis->cells; ++i)
    width[i] = axis->coordinate[i + 1] - axis->coordinate[i];
  qsort(width, (size_t)axis->cells, sizeof *width, fg__by_size);
  *out = width[(int)(SHORTER * axis->cells)];
  free(width);
  return FG_STATUS_OK;
}

/* Along each direction a sample wherever it has gone on by a step of some axis, and some
 * between, so that where the plane leaves the box, aslant, are fine stairs. */
static fg_status choose_raster(int size[2], const cut *c, const double low[2],
                               const double high[2])
{
  double step[3], intervals[2];
  for (int k = 0; k < 3; ++k) {
    fg_status status = find_step(&step[k], c, k);
    if (status != FG_STATUS_OK)
      return status;
  }
  for (int d = 0; d < 2; ++d) {
    double steps = 0.0; /* a unit of length */
    for (int k = 0; k < 3; ++k)
      steps = fmax(steps, fabs(c->basis.direction[d][k]) / step[k]);
    intervals[d] = ceil((high[d] - low[d]) * steps * (1.0 - ROUNDING));
  }
  const double more = floor(FINE / fmax(intervals[0], intervals[1]));
  for (int d = 0; d < 2; ++d)
    intervals[d] *= fmax(1.0, fmin(more, MOST_BETWEEN));
  const double all = (intervals[0] + 1.0) * (intervals[1] + 1.0);
  const double less = all > MOST_SAMPLES ? sqrt(MOST_SAMPLES / all) : 1.0;
  for (int d = 0; d < 2; ++d)
    size[d] = 1 + (int)fmax(1.0, fmin(floor(intervals[d] * less), MOST_SAMPLES));
  return (double)size[0] * size[1] <= 2.0 * MOST_SAMPLES
             ? FG_STATUS_OK
             : fg__fail(c->context, FG_STATUS_ARGUMENT,
                        "field: a cut of %d x %d samples; it is too narrow", size[0],
                        size[1]);
}

/* What rounding has put outside lies at the end. */
static void come_in(double at[3], const fg_field *volume)
{
  for (int k = 0; k < 3; ++k) {
    const double first = volume->axis[k].coordinate[0], last = end_of(volume, k);
    const double most = ROUNDING * (last - first);
    if (at[k] < first && first - at[k] <= most)
      at[k] = first;
    if (at[k] > last && at[k] - last <= most)
      at[k] = last;
    if (volume->axis[k].period > 0.0 && (at[k] < first || at[k] > last))
      at[k] = (double)NAN; /* the cut ends where the box does */
  }
}

static fg_status cut_across(cut *c)
{
  double low[2], high[2];
  int size[2];
  fg_status status = find_extent(low, high, c);
  if (status == FG_STATUS_OK)
    status = choose_raster(size, c, low, high);
  if (status == FG_STATUS_OK)
    status = allocate(c, size);
  if (status != FG_STATUS_OK)
    return status;
  for (int k = 0; k < 2; ++k) {
    c->arrays.period[k] = 0.0;
    for (int i = 0; i < size[k]; ++i)
      c->axis[k][i] = low[k] + (high[k] - low[k]) * i / (size[k] - 1);
  }
  size_t to = 0;
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i, ++to) {
      double at[3], velocity[3];
      for (int k = 0; k < 3; ++k)
        at[k] = c->offset * c->basis.normal[k] +
                c->axis[0][i] * c->basis.direction[0][k] +
                c->axis[1][j] * c->basis.direction[1][k];
      come_in(at, c->volume);
      if (fg_field_velocity(c->volume, at, velocity))
        keep(c, to, velocity);
      else
        miss(c, to);
    }
  return FG_STATUS_OK;
}

/* Axes that the cut keeps keep their words; a turned one is named after that nearest to
 * it, with a prime. */
static void name_all(cut *c)
{
  const fg_field_arrays *a = &c->volume->contents;
  for (int k = 0; k < 2; ++k) {
    const int axis = c->basis.axis[k];
    const char *prime = fg__plane_is_axis(&c->basis, k) ? "" : "'";
    snprintf(c->name[k], NAME_BYTES, "%.200s%s", a->axis_name[axis], prime);
    snprintf(c->component[k], NAME_BYTES, "%.200s%s", a->velocity_name[axis], prime);
    c->arrays.axis_name[k] = c->name[k];
    c->arrays.axis_units[k] = a->axis_units[axis];
    c->arrays.velocity_name[k] = c->component[k];
  }
  const double *n = c->basis.normal;
  const char *level = a->level ? a->level : "", *gap = a->level ? ", " : "";
  const char *units = a->axis_units[c->basis.across];
  if (c->along_axes)
    snprintf(c->level, WORDS_BYTES, "%.200s%s%.100s = %g%s%.60s", level, gap,
             a->axis_name[c->basis.across], c->offset * n[c->basis.across],
             *units ? " " : "", units);
  else
    snprintf(c->level, WORDS_BYTES, "%.200s%splane (%.3g, %.3g, %.3g) at %g", level, gap,
             n[0], n[1], n[2], c->offset);
  c->arrays.level = c->level;
}

static fg_status check_units(const cut *c)
{
  const fg_field_arrays *a = &c->volume->contents;
  for (int k = 1; k < 3 && !c->along_axes; ++k)
    if (strcmp(a->axis_units[k], a->axis_units[0]) != 0)
      return fg__fail(
          c->context, FG_STATUS_ARGUMENT,
          "field: a tilted cut needs axes of the same units; %s is in \"%.60s\", "
          "%s in \"%.60s\"",
          a->axis_name[0], a->axis_units[0], a->axis_name[k], a->axis_units[k]);
  return FG_STATUS_OK;
}

static fg_status begin(cut *c, const fg_plane *plane)
{
  const fg_field_arrays *a = &c->volume->contents;
  if (a->dimension != 3)
    return fg__fail(c->context, FG_STATUS_ARGUMENT,
                    "field: a cut through a field in %d dimensions; it needs 3",
                    a->dimension);
  if (!fg__field_is_whole(c->volume))
    return fg__fail(
        c->context, FG_STATUS_ARGUMENT,
        "field: a cut through a part of a field that ranks share; the whole is needed");
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
    size += fabs(plane->point[k]);
  if (!fg__plane_basis_of(&c->basis, plane->normal) || !isfinite(size))
    return fg__fail(c->context, FG_STATUS_ARGUMENT,
                    "field: a cut with normal (%g, %g, %g) through (%g, %g, %g)",
                    plane->normal[0], plane->normal[1], plane->normal[2], plane->point[0],
                    plane->point[1], plane->point[2]);
  c->offset = fg__dot(plane->point, c->basis.normal);
  c->along_axes = fg__plane_is_axis(&c->basis, 0) && fg__plane_is_axis(&c->basis, 1);
  if (c->along_axes) /* as given, unrounded */
    c->offset = plane->point[c->basis.across] * c->basis.normal[c->basis.across];
  c->arrays = *a;
  c->arrays.dimension = 2;
  c->arrays.size[2] = 1;
  c->arrays.period[2] = 0.0;
  c->arrays.axis[2] = NULL;
  c->arrays.velocity[2] = NULL;
  c->arrays.valid = NULL;
  if (!c->along_axes || c->basis.across != 2) {
    c->arrays.scale = FG_SCALE_PLAIN;
    c->arrays.projection = NULL;
  }
  return check_units(c);
}

/* Of single precision and its sums: a smaller share of squares is rounding. */
static const double NO_SHARE = 1e-12;

fg_status fg__field_check_plane(fg_context *context, double normal, double all,
                                const char *const axis[2])
{
  if (!(all > 0.0) || normal < (1.0 - NO_SHARE) * all)
    return FG_STATUS_OK;
  return fg__fail(
      context, FG_STATUS_ARGUMENT,
      "field: all vectors are normal to the plane of %s and %s, so that there "
      "is nothing of them in it",
      axis[0], axis[1]);
}

fg_status fg_field_slice(fg_field **out, fg_context *context, const fg_field *volume,
                         const fg_plane *plane)
{
  if (out)
    *out = NULL;
  if (!out || !volume || !plane)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: no field or no plane to cut");
  cut c = {.context = context, .volume = volume};
  fg_status status = begin(&c, plane);
  if (status == FG_STATUS_OK)
    status = c.along_axes ? cut_along_axes(&c) : cut_across(&c);
  if (status == FG_STATUS_OK) {
    name_all(&c);
    status = fg__field_check_plane(context, c.normal_sum, c.sum, c.arrays.axis_name);
  }
  if (status == FG_STATUS_OK)
    status = fg__field_take(out, context, &c.arrays, c.velocity);
  if (status == FG_STATUS_OK)
    (*out)->normal_share = c.sum > 0.0 ? c.normal_sum / c.sum : 0.0;
  for (int k = 0; k < 2; ++k) {
    free(c.axis[k]);
    free(c.velocity[k]);
  }
  return status;
}

double fg_field_normal_share(const fg_field *field)
{
  return field ? field->normal_share : 0.0;
}
