#include "sample/missing.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 8 }; /* a float has no more */

/* Codes for missing data have at least this size in the conventions of all formats. */
static const float SMALLEST_CODE = 99.0F;

/* Smaller ones are codes where they are a number of two bytes (32.767), or all components
 * have them together (-9). */
static const float SMALLEST_TOGETHER = 9.0F;

/* 270 beside 5 are directions. */
static const float LARGEST_DIRECTION = 360.0F;

/* A customary code lies apart from other values by this share of their range; any other
 * number is this many times as large as they are. */
static const double CUSTOMARY_GAP = 0.2, LEAST_RATIO = 10.0;

fg__raw_samples fg__raw_samples_of(const fg__dataset *data, const fg__pair *pair,
                                   int components, float *const *component, size_t count)
{
  fg__raw_samples raw = {.path = data->file[0].path,
                         .components = components,
                         .count = count,
                         .is_polar = pair->polar.sense != 0};
  for (int k = 0; k < components; ++k) {
    raw.name[k] = pair->component[k]->plain_name;
    raw.component[k] = component[k];
  }
  return raw;
}

fg_status fg__check_any(const fg__variable *v, const fg__missing_counts *missing,
                        size_t samples)
{
  if (missing->fill + missing->range + missing->not_a_number < samples)
    return FG_STATUS_OK;
  return fg__fail(v->owner->context, FG_STATUS_FILE_FORMAT,
                  "%s: all %zu samples of '%s' are missing (%zu fill values, %zu outside "
                  "the valid range, %zu not a number)",
                  v->path, samples, v->name, missing->fill, missing->range,
                  missing->not_a_number);
}

fg_status fg__missing_read(fg__missing_numbers *out, fg_context *context,
                           const char *missing)
{
  *out = (fg__missing_numbers){0};
  if (!missing)
    return FG_STATUS_OK;
  out->none = strcmp(missing, "none") == 0;
  for (const char *at = missing; !out->none; ++at) {
    char *end;
    const double number = strtod(at, &end);
    if (end == at || (*end && *end != ',') || out->count == FG__MOST_FILLS) {
      fg__fail(context, FG_STATUS_ARGUMENT, "'%.100s' lists no missing values", missing);
      fg__hint(context, "up to %d numbers with commas between, as -9999,1e20; or none",
               FG__MOST_FILLS);
      return FG_STATUS_ARGUMENT;
    }
    out->number[out->count++] = number;
    at = end;
    if (!*at)
      break;
  }
  return FG_STATUS_OK;
}

static void take_low(fg__extreme *e, float value)
{
  if (value < e->value) {
    *e = (fg__extreme){value, e->value, 1, 0};
  } else if (value > e->value) {
    e->next = value;
  } else {
    ++e->count;
  }
}

static void take_high(fg__extreme *e, float value)
{
  if (value > e->value) {
    *e = (fg__extreme){value, e->value, 1, 0};
  } else if (value < e->value) {
    e->next = value;
  } else {
    ++e->count;
  }
}

static bool is_present(const fg__raw_samples *s, size_t i)
{
  bool present = !s->valid || s->valid[i];
  for (int k = 0; k < s->components; ++k)
    present = present && isfinite(s->component[k][i]);
  return present;
}

/* Whether all components are one number. */
static bool is_together(const fg__raw_samples *s, size_t i)
{
  int k = 1;
  while (k < s->components && !(s->component[k][i] < s->component[0][i]) &&
         !(s->component[k][i] > s->component[0][i]))
    ++k;
  return k == s->components;
}

static void take_together(fg__extreme *e, float value)
{
  e->together += !(value < e->value) && !(value > e->value);
}

void fg__extremes_add(fg__extremes *extremes, const fg__raw_samples *samples)
{
  for (int k = 0; k < samples->components && extremes->count == 0; ++k) {
    extremes->low[k] = (fg__extreme){INFINITY, INFINITY, 0, 0};
    extremes->high[k] = (fg__extreme){-INFINITY, -INFINITY, 0, 0};
  }
  for (size_t i = 0; i < samples->count; ++i) {
    if (!is_present(samples, i))
      continue;
    ++extremes->count;
    for (int k = 0; k < samples->components; ++k) {
      const float value = samples->component[k][i];
      if (value <= extremes->low[k].value || value < extremes->low[k].next)
        take_low(&extremes->low[k], value);
      if (value >= extremes->high[k].value || value > extremes->high[k].next)
        take_high(&extremes->high[k], value);
    }
    for (int k = 0; k < samples->components && is_together(samples, i); ++k) {
      take_together(&extremes->low[k], samples->component[0][i]);
      take_together(&extremes->high[k], samples->component[0][i]);
    }
  }
}

/* Numbers that programs write for missing data and that may be near to other values:
 * nines alone, as -99.9 and 9999, and the ends of whole numbers in two bytes. */
static bool is_customary(float value)
{
  const float size = fabsf(value);
  if (size >= 32767.0F && size <= 32768.0F)
    return true;
  double nines = 9.0;
  for (int n = 1; n < DIGITS; ++n, nines = 10.0 * nines + 9.0)
    for (double scale = 1.0; scale < 1e6; scale *= 10.0)
      if (size >= (float)(nines / scale) && size <= (float)(nines / scale))
        return true;
  return false;
}

/* Whether a number is an end of whole numbers in two bytes, times a power of ten. */
static bool is_of_two_bytes(float value)
{
  static const double ends[] = {32767.0, 32768.0, 65535.0};
  const float size = fabsf(value);
  for (int n = 0; n < 3; ++n)
    for (double scale = 1.0; scale < 1e6; scale *= 10.0)
      if (size >= (float)(ends[n] / scale) && size <= (float)(ends[n] / scale))
        return true;
  return false;
}

/* Whether all components have a whole number below 0, as -1, and none has it alone. */
static bool is_agreed(const fg__extreme *e)
{
  return e->together == e->count && e->value < 0.0F && !(e->value > floorf(e->value));
}

/* Whether an extreme that recurs may be a code, whatever others are. */
static bool may_be_code(const fg__extreme *e)
{
  return e->count > 1 &&
         (fabsf(e->value) >= SMALLEST_CODE || is_of_two_bytes(e->value) || is_agreed(e) ||
          (e->together == e->count && fabsf(e->value) >= SMALLEST_TOGETHER &&
           is_customary(e->value)));
}

bool fg__extremes_are_suspect(const fg__extremes *extremes, int components)
{
  bool suspect = false;
  for (int k = 0; k < components && extremes->count > 0; ++k)
    suspect =
        suspect || may_be_code(&extremes->low[k]) || may_be_code(&extremes->high[k]);
  return suspect;
}

/* Whether an extreme stands for missing data; `other` is the opposite end of all others,
 * `largest_value` the size up to which only customary codes are. */
static bool is_code(const fg__extreme *e, float other, float largest_value)
{
  if (!may_be_code(e) || !isfinite(e->next))
    return false;
  const double gap = fabs((double)e->value - (double)e->next);
  const double range = fabs((double)e->next - (double)other);
  const double largest = fmax(fabs((double)e->next), fabs((double)other));
  if (is_agreed(e) && range > 0.0 && gap >= CUSTOMARY_GAP * range)
    return true;
  return is_customary(e->value) || is_of_two_bytes(e->value)
             ? gap >= CUSTOMARY_GAP * range && fabs((double)e->value) > largest
             : largest > 0.0 && fabsf(e->value) > largest_value &&
                   fabs((double)e->value) >= LEAST_RATIO * largest;
}

static fg_status refuse(fg_context *context, const fg__raw_samples *s, int k,
                        const fg__extreme *e, size_t all, float other)
{
  const double a = (double)e->next, b = (double)other;
  fg__fail(context, FG_STATUS_ARGUMENT,
           "%s: '%.100s' is %.7g at %zu of %zu samples (%.2g %%) and otherwise from %.4g "
           "to %.4g: missing data that the file does not declare",
           s->path, s->name[k], (double)e->value, e->count, all,
           100.0 * (double)e->count / (double)all, fmin(a, b), fmax(a, b));
  fg__hint(context,
           "--missing=%.7g takes it for missing; --missing none takes it for a value",
           (double)e->value);
  return FG_STATUS_ARGUMENT;
}

void fg__missing_mask(const fg__raw_samples *samples, const fg__missing_numbers *given)
{
  for (int k = 0; k < samples->components && given->count > 0; ++k)
    for (size_t i = 0; i < samples->count; ++i)
      if (fg__is_given_missing(given, (double)samples->component[k][i]))
        samples->component[k][i] = NAN;
}

fg_status fg__missing_decide(fg_context *context, const fg__extremes *extremes,
                             const fg__raw_samples *samples,
                             const fg__missing_numbers *given)
{
  for (int k = 0; k < samples->components && extremes->count > 0 && !given->none; ++k) {
    const fg__extreme *low = &extremes->low[k], *high = &extremes->high[k];
    const float most = samples->is_polar && k == 1 ? LARGEST_DIRECTION : 0.0F;
    if (is_code(high, low->value, most))
      return refuse(context, samples, k, high, extremes->count, low->value);
    if (is_code(low, high->value, most))
      return refuse(context, samples, k, low, extremes->count, high->value);
  }
  return FG_STATUS_OK;
}

fg_status fg__missing_settle(fg_context *context, const fg__raw_samples *samples,
                             const fg__missing_numbers *given)
{
  fg__extremes extremes = {.count = 0};
  fg__missing_mask(samples, given);
  fg__extremes_add(&extremes, samples);
  return fg__missing_decide(context, &extremes, samples, given);
}
