/* Between which speeds most of a field lies. */
#include "base/memory.h"
#include "base/weighted.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>

/* Of larger fields so many samples are looked at, evenly through all. */
enum { MOST_SAMPLES = 1 << 20 };

/* Share of the area that is slower than the low end, and faster than the high one. An
 * arrow has the mean speed along it: of 40 on the winds of COADS none had that of the
 * fastest twentieth, of 200 on a global wind a few. */
static const double beyond = 0.05;

/* The area that a sample stands for, but for a constant; axes are taken as even. */
static double area_of(const fg_field_arrays *field, size_t n)
{
  if (field->scale != FG_SCALE_GEO)
    return 1.0;
  const double latitude = field->axis[1][n / (size_t)field->size[0]];
  return fmax(cos(latitude * acos(-1.0) / 180.0), 0.0);
}

static size_t collect(fg__weighted *out, const fg_field_arrays *field, size_t samples,
                      size_t step)
{
  size_t count = 0;
  for (size_t n = 0; n < samples; n += step) {
    double square = 0.0;
    for (int k = 0; k < field->dimension && k < 3; ++k)
      square += (double)field->velocity[k][n] * (double)field->velocity[k][n];
    if (isfinite(square) && (!field->valid || field->valid[n]))
      out[count++] = (fg__weighted){sqrt(square), area_of(field, n)};
  }
  return count;
}

fg_status fg_field_speed_range(double range[2], fg_context *context,
                               const fg_field *field)
{
  if (!range || !field || field->slab)
    return fg__fail(context, FG_STATUS_ARGUMENT, "speed range: %s",
                    field && field->slab
                        ? "of a part of a field that ranks share; the whole is needed"
                        : "a NULL argument");
  const fg_field_arrays *arrays = fg_field_contents(field);
  size_t samples = 1;
  for (int k = 0; k < arrays->dimension; ++k)
    samples *= (size_t)arrays->size[k];
  const size_t step = samples / MOST_SAMPLES + 1, most = samples / step + 1;
  fg__weighted *speeds = fg__allocate(most, sizeof *speeds);
  if (!speeds)
    return fg__fail_memory(context, "a field's speeds", most * sizeof *speeds);
  const size_t count = collect(speeds, arrays, samples, step);
  fg__weighted_range(range, speeds, count, beyond);
  free(speeds);
  return FG_STATUS_OK;
}

double fg_field_missing_share(const fg_field *field)
{
  double samples = 1.0;
  for (int k = 0; k < field->contents.dimension; ++k)
    samples *= (double)field->contents.size[k];
  return (double)field->missing / samples;
}
