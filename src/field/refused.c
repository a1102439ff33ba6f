#include "field/refused.h"

#include <math.h>
#include <stdio.h>

const double fg__largest_number = 1e30;

/* What may stand for a missing number is larger: light makes 3e14 um/s, and what is seen
 * of the universe is 1e27 m wide, but 1e20 and more are customary fill values. */
static const double SUSPECT_SPEED = 1e15, SUSPECT_COORDINATE = 1e18;

/* Of a suspect speed, of an interval or of a coordinate, all others are below this
 * share. */
static const double APART = 1e-6;

bool fg__is_apart_coordinate(const double *x, size_t size, size_t i)
{
  const double length = fabs(x[i]);
  if (!(length > SUSPECT_COORDINATE) || size < 2)
    return false;
  if (i > 0 && i + 1 < size)
    return fabs(x[i - 1]) < APART * length && fabs(x[i + 1]) < APART * length;
  const double near = x[i == 0 ? 1 : size - 2], far = x[i == 0 ? size - 1 : 0];
  const double rest = size > 2 ? fabs(far - near) : fabs(near);
  return rest > 0.0 && APART * fabs(x[i] - near) > rest;
}

size_t fg__find_apart_position(const double *x, size_t step, size_t count)
{
  double largest = 0.0;
  size_t like = 0, first = count;
  for (size_t n = 0; n < count; ++n)
    largest = fmax(largest, fabs(x[n * step]));
  if (!(largest > SUSPECT_COORDINATE))
    return count;
  for (size_t n = count; n-- > 0;)
    if (fabs(x[n * step]) > APART * largest) {
      ++like;
      first = n;
    }
  return 2 * like < count ? first : count;
}

void fg__fastest_add(fg__fastest *fastest, double value, int component, size_t sample)
{
  const double speed = fabs(value);
  if (speed > fastest->speed)
    *fastest = (fg__fastest){speed, fastest->speed, component, sample};
  else if (speed < fastest->speed && speed > fastest->next)
    fastest->next = speed;
}

bool fg__fastest_is_none(const fg__fastest *fastest)
{
  return fastest->speed > fg__largest_number ||
         (fastest->speed > SUSPECT_SPEED && fastest->next > 0.0 &&
          fastest->next < APART * fastest->speed);
}

/* Numbers that stand for missing data in many files. */
static const float CODES[] = {-999.0F,  -9999.0F, -99999.0F, -999.9F,
                              -9999.9F, -999.99F, -32767.0F, -32768.0F,
                              999.9F,   9999.0F,  9999.9F,   99999.0F};
static const char HINT[] = "--missing=%g takes it for missing";
static const float SMALLEST_CODE = 999.0F; /* in size */

bool fg__is_missing_code(const float *const velocity[3], int dimension, size_t i)
{
  const float first = velocity[0][i];
  bool is_code = false;
  if (first > -SMALLEST_CODE && first < SMALLEST_CODE)
    return false;
  for (size_t n = 0; n < sizeof CODES / sizeof *CODES; ++n)
    is_code = is_code || (first <= CODES[n] && first >= CODES[n]);
  for (int k = 1; k < dimension; ++k)
    is_code = is_code && velocity[k][i] <= first && velocity[k][i] >= first;
  return is_code;
}

fg_status fg__refuse_missing_codes(fg_context *context, const char *path,
                                   float *const velocity[2], size_t count)
{
  const float *const both[3] = {velocity[0], velocity[1], NULL};
  for (size_t i = 0; i < count; ++i) {
    if (!fg__is_missing_code(both, 2, i))
      continue;
    fg__fail(context, FG_STATUS_FILE_FORMAT,
             "%s: both components are %g at a sample, which stands for missing data in "
             "many files",
             path, (double)velocity[0][i]);
    fg__hint(context, HINT, (double)velocity[0][i]);
    return FG_STATUS_FILE_FORMAT;
  }
  return FG_STATUS_OK;
}

enum { PLACE_BYTES = 80 };

/* "(3, 5)", of the whole field. */
static const char *place_of(char out[PLACE_BYTES], const fg_field *field, size_t i)
{
  const size_t row = (size_t)field->held[0];
  const size_t rows = (size_t)field->held[1];
  size_t at[3] = {i % row, i / row % rows, i / row / rows};
  const int last = fg__field_last_axis(field);
  at[last] = (at[last] + (size_t)field->first[last]) % (size_t)field->axis[last].samples;
  if (field->contents.dimension == 3)
    snprintf(out, PLACE_BYTES, "(%zu, %zu, %zu)", at[0], at[1], at[2]);
  else
    snprintf(out, PLACE_BYTES, "(%zu, %zu)", at[0], at[1]);
  return out;
}

fg_status fg__field_fail_speed(const fg_field *field, fg_context *context,
                               const fg__fastest *fastest)
{
  char place[PLACE_BYTES];
  const int k = fastest->component;
  const double value = (double)field->velocity[k][fastest->sample];
  place_of(place, field, fastest->sample);
  const fg_status status =
      fastest->speed > fg__largest_number
          ? fg__fail(context, FG_STATUS_ARGUMENT,
                     "field: %s is %g at sample %s; speeds up to %g are taken",
                     field->contents.velocity_name[k], value, place, fg__largest_number)
          : fg__fail(context, FG_STATUS_ARGUMENT,
                     "field: %s is %g at sample %s, and all others are %g at most",
                     field->contents.velocity_name[k], value, place, fastest->next);
  fg__hint(context, "--missing=%g takes it for missing", value);
  return status;
}

fg_status fg__field_fail_code(const fg_field *field, fg_context *context, double value,
                              size_t i)
{
  char place[PLACE_BYTES];
  const fg_status status = fg__fail(
      context, FG_STATUS_ARGUMENT,
      "field: every component is %g at sample %s, which stands for missing data in many "
      "files",
      value, place_of(place, field, i));
  fg__hint(context, HINT, value);
  return status;
}
