#include "field/region.h"

#include "base/memory.h"
#include "field/field.h"
#include "field/slab.h"
#include "terms/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Of an axis' mean interval: a region that ends so near to a sample ends at it, since
 * both were rounded. */
static const double ROUNDING = 1e-9;

fg_status fg__region_clip(double *low, double *high, fg_context *context,
                          const char *path, const fg__field_region *region, int k,
                          const char *axis, const char *units)
{
  const double first = *low, last = *high;
  if (k >= region->axes)
    return FG_STATUS_OK;
  const fg__measure m = fg__measure_of(units);
  const double from = fg__measure_coordinate(&m, region->low[k]),
               to = fg__measure_coordinate(&m, region->high[k]);
  *low = fmax(first, fmin(from, to));
  *high = fmin(last, fmax(from, to));
  if (*low < *high)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "%s: nothing lies in the region: it goes from %s = %g to %g, and the "
                  "field from %g to %g",
                  path, axis, region->low[k], region->high[k],
                  fg__measure_value(&m, first), fg__measure_value(&m, last));
}

fg_status fg__region_find(fg__region_range *out, fg_context *context, const char *path,
                          const fg__field_region *region, int k, const char *axis,
                          const char *units, const double *x, size_t size)
{
  size_t a = 0, b = size - 1;
  *out = (fg__region_range){0, size, x[0], x[b]};
  const double near = ROUNDING * (x[b] - x[0]) / (double)b;
  const fg_status status =
      fg__region_clip(&out->low, &out->high, context, path, region, k, axis, units);
  if (status != FG_STATUS_OK || k >= region->axes)
    return status;
  while (a + 1 < size && x[a + 1] <= out->low + near)
    ++a;
  while (b > 0 && x[b - 1] >= out->high - near)
    --b;
  if (x[a] >= out->low - near)
    out->low = x[a];
  if (x[b] <= out->high + near)
    out->high = x[b];
  if (b > a + 1 || (b > a && (x[a] >= out->low || x[b] <= out->high))) {
    out->first = a;
    out->count = b - a + 1;
    return FG_STATUS_OK;
  }
  const fg__measure m = fg__measure_of(units);
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "%s: no sample lies in the region: it goes from %s = %g to %g, and "
                  "samples lie at %g and %g (of %g to %g)",
                  path, axis, region->low[k], region->high[k],
                  fg__measure_value(&m, x[a < b ? a : b]),
                  fg__measure_value(&m, x[a < b ? b : a]), fg__measure_value(&m, x[0]),
                  fg__measure_value(&m, x[size - 1]));
}

/* A part of a field that is being made. */
typedef struct part {
  const fg_field *whole;
  fg__region_range range[3];
  fg_field_arrays arrays;
  double *axis[3];
  float *velocity[3];
} part;

static void clear(part *p)
{
  for (int k = 0; k < 3; ++k) {
    free(p->axis[k]);
    free(p->velocity[k]);
  }
}

/* The range along each axis; a periodic one ends where its first sample comes again. */
static fg_status find_ranges(part *p, fg_context *context, const char *path,
                             const fg__field_region *region)
{
  const fg_field *whole = p->whole;
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < whole->contents.dimension && status == FG_STATUS_OK; ++k) {
    const fg__axis *axis = &whole->axis[k];
    const bool cut = k < region->axes;
    const size_t samples = (size_t)(cut ? axis->cells + 1 : axis->samples);
    status = fg__region_find(&p->range[k], context, path, region, k,
                             whole->contents.axis_name[k], whole->contents.axis_units[k],
                             axis->coordinate, samples);
    p->arrays.size[k] = (int)p->range[k].count;
    if (cut)
      p->arrays.period[k] = 0.0;
  }
  return status;
}

static bool is_all(const part *p)
{
  bool all = true;
  for (int k = 0; k < p->arrays.dimension; ++k) {
    const fg__region_range *r = &p->range[k];
    const double *x = p->whole->axis[k].coordinate;
    all = all && r->count == (size_t)p->whole->axis[k].samples && r->low <= x[0] &&
          r->high >= x[r->count - 1];
  }
  return all;
}

static fg_status allocate(part *p, fg_context *context)
{
  size_t samples = 1;
  bool there = true;
  for (int k = 0; k < p->arrays.dimension; ++k)
    samples *= p->range[k].count;
  for (int k = 0; k < p->arrays.dimension && k < 3; ++k) {
    p->axis[k] = fg__allocate(p->range[k].count, sizeof *p->axis[k]);
    p->velocity[k] = fg__allocate(samples, sizeof *p->velocity[k]);
    there = there && p->axis[k] && p->velocity[k];
    p->arrays.axis[k] = p->axis[k];
    p->arrays.velocity[k] = p->velocity[k];
  }
  return there ? FG_STATUS_OK
               : fg__fail_memory(context, "a part of a field", samples * sizeof(float));
}

/* The two samples of the whole beside sample i of the part, and the share of the second;
 * both are one where it lies on it. */
static double samples_beside(size_t beside[2], const part *p, int k, size_t i)
{
  const fg__region_range *r = &p->range[k];
  const fg__axis *axis = &p->whole->axis[k];
  const size_t n = r->first + i - (i > 0 && i + 1 == r->count);
  const double from = axis->coordinate[n], to = axis->coordinate[n + 1];
  const bool first = i == 0 && r->low > from;
  const bool last = i > 0 && i + 1 == r->count;
  double share = 0.0;
  if (first)
    share = (r->low - from) / (to - from);
  else if (last)
    share = r->high < to ? (r->high - from) / (to - from) : 1.0;
  const size_t samples = (size_t)axis->samples;
  beside[0] = (share < 1.0 ? n : n + 1) % samples;
  beside[1] = (share > 0.0 ? n + 1 : n) % samples;
  return share;
}

static void fill_axes(part *p)
{
  for (int k = 0; k < p->arrays.dimension && k < 3; ++k) {
    const fg__region_range *r = &p->range[k];
    for (size_t i = 0; i < r->count; ++i)
      p->axis[k][i] = p->whole->axis[k].coordinate[r->first + i];
    p->axis[k][0] = r->low;
    p->axis[k][r->count - 1] = r->high;
  }
}

/* One sample between the eight of the whole round it, of which several may be one. */
static void fill_sample(part *p, size_t to, const size_t at[3])
{
  const int dimension = p->arrays.dimension;
  size_t beside[3][2] = {{0}};
  double share[3] = {0.0};
  for (int k = 0; k < dimension; ++k)
    share[k] = samples_beside(beside[k], p, k, at[k]);
  const size_t columns = (size_t)p->whole->contents.size[0];
  const size_t rows = (size_t)p->whole->contents.size[1];
  for (int c = 0; c < dimension; ++c) {
    double sum = 0.0;
    for (int corner = 0; corner < 1 << dimension; ++corner) {
      size_t n[3] = {0, 0, 0};
      double weight = 1.0;
      for (int k = 0; k < dimension; ++k) {
        const int side = corner >> k & 1;
        n[k] = beside[k][side];
        weight *= side ? share[k] : 1.0 - share[k];
      }
      const size_t from = (n[2] * rows + n[1]) * columns + n[0];
      if (weight > 0.0)
        sum += weight * (double)p->whole->velocity[c][from];
    }
    p->velocity[c][to] = (float)sum;
  }
}

static void fill(part *p)
{
  const size_t depth = p->arrays.dimension == 3 ? p->range[2].count : 1;
  size_t to = 0, at[3];
  fill_axes(p);
  for (at[2] = 0; at[2] < depth; ++at[2])
    for (at[1] = 0; at[1] < p->range[1].count; ++at[1])
      for (at[0] = 0; at[0] < p->range[0].count; ++at[0])
        fill_sample(p, to++, at);
}

static fg_status make(fg_field **out, fg_context *context, part *p)
{
  fg_status status = allocate(p, context);
  if (status != FG_STATUS_OK)
    return status;
  fill(p);
  status = fg__field_take(out, context, &p->arrays, p->velocity);
  if (status == FG_STATUS_ARGUMENT)
    fg__hint(context,
             "that is so in the region; the field goes from %g to %g and from %g "
             "to %g",
             p->whole->axis[0].coordinate[0],
             p->whole->axis[0].coordinate[p->whole->axis[0].cells],
             p->whole->axis[1].coordinate[0],
             p->whole->axis[1].coordinate[p->whole->axis[1].cells]);
  if (status == FG_STATUS_OK) {
    (*out)->normal_share = p->whole->normal_share;
    (*out)->infinite = p->whole->infinite;
  }
  return status;
}

fg_status fg__region_cut(fg_field **field, fg_context *context, const char *path,
                         const fg__field_region *region)
{
  part p = {.whole = *field, .arrays = (*field)->contents};
  fg_field *cut = NULL;
  p.arrays.valid = NULL;
  if (region->axes == 0)
    return FG_STATUS_OK;
  if (region->axes > p.arrays.dimension)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: a region of six numbers, and the field is a plane along %s and "
                    "%s",
                    path, p.arrays.axis_name[0], p.arrays.axis_name[1]);
  fg_status status = find_ranges(&p, context, path, region);
  if (status == FG_STATUS_OK && is_all(&p))
    return FG_STATUS_OK;
  if (status == FG_STATUS_OK)
    status = make(&cut, context, &p);
  clear(&p);
  if (status == FG_STATUS_OK) {
    fg_field_destroy(*field);
    *field = cut;
  }
  return status;
}

double fg_field_measured(const fg_field *field, int axis, double coordinate)
{
  const fg__measure measure = fg__measure_of(fg_field_contents(field)->axis_units[axis]);
  return fg__measure_value(&measure, coordinate);
}

void fg_field_measured_units(char *out, size_t size, const fg_field *field, int axis)
{
  const fg__measure measure = fg__measure_of(fg_field_contents(field)->axis_units[axis]);
  snprintf(out, size, "%s", measure.units);
}
