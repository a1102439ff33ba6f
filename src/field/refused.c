#include "field/refused.h"

#include <stdio.h>

const double fg__field_largest_speed = 1e15;

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

fg_status fg__field_fail_speed(const fg_field *field, fg_context *context, int k,
                               double value, size_t i)
{
  char place[PLACE_BYTES];
  const fg_status status =
      fg__fail(context, FG_STATUS_ARGUMENT,
               "field: %s is %g at sample %s; speeds up to %g are taken",
               field->contents.velocity_name[k], value, place_of(place, field, i),
               fg__field_largest_speed);
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
