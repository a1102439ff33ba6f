/* Between which speeds most of a field lies. */
#include "base/memory.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>

/* Of larger fields so many samples are looked at, evenly through all. */
enum { MOST_SAMPLES = 1 << 20 };

/* Share of the area that is slower than the low end, and faster than the high one. An
 * arrow has the mean speed along it: of 40 on the winds of COADS none had that of the
 * fastest twentieth, of 200 on a global wind a few. */
static const double beyond = 0.05;

typedef struct weighed_speed {
  double speed, weight;
} weighed_speed;

static int compare_speeds(const void *a, const void *b)
{
  const double one = ((const weighed_speed *)a)->speed;
  const double other = ((const weighed_speed *)b)->speed;
  return (one > other) - (one < other);
}

/* The area that a sample stands for, but for a constant; axes are taken as even. */
static double area_of(const fg_field_arrays *field, size_t n)
{
  if (field->scale != FG_SCALE_GEO)
    return 1.0;
  const double latitude = field->axis[1][n / (size_t)field->size[0]];
  return fmax(cos(latitude * acos(-1.0) / 180.0), 0.0);
}

static size_t collect(weighed_speed *out, const fg_field_arrays *field, size_t samples,
                      size_t step)
{
  size_t count = 0;
  for (size_t n = 0; n < samples; n += step) {
    double square = 0.0;
    for (int k = 0; k < field->dimension && k < 3; ++k)
      square += (double)field->velocity[k][n] * (double)field->velocity[k][n];
    if (isfinite(square) && (!field->valid || field->valid[n]))
      out[count++] = (weighed_speed){sqrt(square), area_of(field, n)};
  }
  return count;
}

/* Sorted speeds, the first beyond whose weight `share` of all lies. */
static double quantile(const weighed_speed *speeds, size_t count, double share)
{
  double all = 0.0, sum = 0.0;
  for (size_t n = 0; n < count; ++n)
    all += speeds[n].weight;
  for (size_t n = 0; n < count; ++n) {
    sum += speeds[n].weight;
    if (sum >= share * all)
      return speeds[n].speed;
  }
  return count ? speeds[count - 1].speed : 0.0;
}

fg_status fg_field_speed_range(double range[2], fg_context *context,
                               const fg_field *field)
{
  if (!range || !field || field->slab)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "speeds of no field, or of one that ranks share");
  const fg_field_arrays *arrays = fg_field_contents(field);
  size_t samples = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    samples *= (size_t)arrays->size[k];
  const size_t step = samples / MOST_SAMPLES + 1, room = samples / step + 1;
  weighed_speed *speeds = fg__allocate(room, sizeof *speeds);
  if (!speeds)
    return fg__fail_memory(context, "a field's speeds", room * sizeof *speeds);
  const size_t count = collect(speeds, arrays, samples, step);
  qsort(speeds, count, sizeof *speeds, compare_speeds);
  range[0] = quantile(speeds, count, beyond);
  range[1] = quantile(speeds, count, 1.0 - beyond);
  free(speeds);
  return FG_STATUS_OK;
}
