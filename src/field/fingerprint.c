#include "field/fingerprint.h"

#include "base/mix.h"

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

uint64_t fg__field_fingerprint(const fg_field *field)
{
  const fg_field_arrays *f = fg_field_contents(field);
  uint64_t sum = fg__mix(key_of(KEY_SHAPE, f->dimension) ^ (uint64_t)f->scale);
  uint64_t samples = 1;
  for (int k = 0; k < f->dimension; ++k) {
    samples *= (uint64_t)f->size[k];
    sum += mix_double(key_of(KEY_PERIOD, k), 0, f->period[k]);
    for (int i = 0; i < f->size[k]; ++i)
      sum += mix_double(key_of(KEY_AXIS, k), (uint64_t)i, f->axis[k][i]);
  }
  for (int k = 0; k < f->dimension; ++k)
    sum += fg__mix_floats(key_of(KEY_VELOCITY, k), 0, f->velocity[k], (size_t)samples);
  for (uint64_t n = 0; f->valid && n < samples; ++n)
    if (!f->valid[n])
      sum += fg__mix(key_of(KEY_VALID, 0) ^ n);
  return sum;
}
