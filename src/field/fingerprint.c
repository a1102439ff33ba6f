#include "field/fingerprint.h"

#include <math.h>

#include "base/mix.h"
#include "field/slab.h"

/* Keys of what enters: each kind has its own. */
enum { KEY_SHAPE, KEY_AXIS, KEY_PERIOD, KEY_VALID, KEY_VELOCITY = 8 };

static uint64_t key_of(int kind, int axis)
{
  return fg__mix((uint64_t)kind * 16 + (uint64_t)axis);
}

static uint64_t mix_double(uint64_t key, uint64_t place, double value)
{
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return fg__mix(fg__mix(key ^ place) ^ bits);
}

uint64_t fg__field_fingerprint_grid(const fg_field *field)
{
  const fg_field_arrays *f = &field->contents;
  uint64_t sum = fg__mix(key_of(KEY_SHAPE, f->dimension) ^ (uint64_t)f->scale);
  for (int k = 0; k < f->dimension; ++k) {
    sum += mix_double(key_of(KEY_PERIOD, k), 0, f->period[k]);
    for (int i = 0; i < f->size[k]; ++i)
      sum += mix_double(key_of(KEY_AXIS, k), (uint64_t)i, f->axis[k][i]);
  }
  return sum;
}

/* A part's own samples are in one piece of the whole. */
uint64_t fg__field_fingerprint_samples(const fg_field *field)
{
  const int last = fg__field_last_axis(field);
  const int rows = field->slab ? field->slab->own : field->held[last];
  const uint64_t row = fg__field_held(field) / (uint64_t)field->held[last];
  const uint64_t first = row * (uint64_t)field->first[last];
  const uint64_t samples = row * (uint64_t)rows;
  uint64_t sum = 0;
  for (int k = 0; k <= last; ++k)
    sum += fg__mix_floats(key_of(KEY_VELOCITY, k), first, field->velocity[k],
                          (size_t)samples);
  for (uint64_t n = 0; n < samples; ++n)
    if (isnan(field->velocity[0][n]))
      sum += fg__mix(key_of(KEY_VALID, 0) ^ (first + n));
  return sum;
}

uint64_t fg__field_fingerprint(const fg_field *field)
{
  if (field->slab)
    return field->slab->fingerprint;
  return fg__field_fingerprint_grid(field) + fg__field_fingerprint_samples(field);
}
