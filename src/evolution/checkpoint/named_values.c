#include "evolution/checkpoint/named_values.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "file/number_text.h"

static size_t size_of(fg__value_kind kind)
{
  switch (kind) {
  case FG__VALUE_REAL:
    return sizeof(double);
  case FG__VALUE_INTEGER:
    return sizeof(int);
  case FG__VALUE_INT64:
    return sizeof(int64_t);
  case FG__VALUE_FLAG:
    return sizeof(bool);
  case FG__VALUE_COUNT:
  case FG__VALUE_BITS:
    break;
  }
  return sizeof(uint64_t);
}

static const void *at(const fg__named_value *value, const void *from)
{
  return (const char *)from + value->place;
}

static void print(char text[FG__VALUE_TEXT_BYTES], const fg__named_value *value,
                  const void *from)
{
  uint64_t bits = 0;
  int64_t number = 0;
  const void *source = at(value, from);
  switch (value->kind) {
  case FG__VALUE_REAL:
  case FG__VALUE_BITS:
    memcpy(&bits, source, sizeof bits);
    snprintf(text, FG__VALUE_TEXT_BYTES, "%016" PRIx64, bits);
    return;
  case FG__VALUE_COUNT:
    memcpy(&bits, source, sizeof bits);
    snprintf(text, FG__VALUE_TEXT_BYTES, "%" PRIu64, bits);
    return;
  case FG__VALUE_INTEGER:
    number = *(const int *)source;
    break;
  case FG__VALUE_INT64:
    number = *(const int64_t *)source;
    break;
  case FG__VALUE_FLAG:
    number = *(const bool *)source;
    break;
  }
  snprintf(text, FG__VALUE_TEXT_BYTES, "%" PRId64, number);
}

void fg__values_print(FILE *stream, const fg__named_value *values, size_t count,
                      const void *from)
{
  for (size_t n = 0; n < count; ++n) {
    char text[FG__VALUE_TEXT_BYTES];
    print(text, &values[n], from);
    fprintf(stream, "%s %s\n", values[n].name, text);
  }
}

const char *fg__value_find(const char *text, const char *name, size_t *length)
{
  size_t name_length = strlen(name);
  for (const char *line = text; *line && *line != '\n';) {
    size_t bytes = strcspn(line, "\n");
    if (bytes > name_length && strncmp(line, name, name_length) == 0 &&
        line[name_length] == ' ') {
      *length = bytes - name_length - 1;
      return line + name_length + 1;
    }
    line += bytes + (line[bytes] == '\n');
  }
  return NULL;
}

static bool scan_bits(uint64_t *bits, const char *text)
{
  char *end;
  *bits = strtoumax(text, &end, 16);
  return strspn(text, "0123456789abcdef") == 16 && !*end;
}

static bool scan_count(uint64_t *count, const char *text)
{
  char *end;
  errno = 0;
  uintmax_t value = strtoumax(text, &end, 10);
  *count = (uint64_t)value;
  return strspn(text, "0123456789") == strlen(text) && end != text && !errno &&
         value <= UINT64_MAX;
}

static bool scan_number(int64_t *number, int64_t least, int64_t most, const char *text)
{
  char *end;
  errno = 0;
  *number = strtoll(text, &end, 10);
  return end != text && !*end && !errno && *number >= least && *number <= most;
}

static bool scan(const char *text, const fg__named_value *value, void *to)
{
  void *target = (char *)to + value->place;
  uint64_t bits;
  int64_t number;
  switch (value->kind) {
  case FG__VALUE_REAL:
  case FG__VALUE_BITS:
    if (!scan_bits(&bits, text))
      return false;
    memcpy(target, &bits, sizeof bits);
    return true;
  case FG__VALUE_COUNT:
    if (!scan_count(&bits, text))
      return false;
    memcpy(target, &bits, sizeof bits);
    return true;
  case FG__VALUE_INTEGER:
    if (!scan_number(&number, INT_MIN, INT_MAX, text))
      return false;
    *(int *)target = (int)number;
    return true;
  case FG__VALUE_INT64:
    if (!scan_number(&number, INT64_MIN, INT64_MAX, text))
      return false;
    *(int64_t *)target = number;
    return true;
  case FG__VALUE_FLAG:
    if (!scan_number(&number, 0, 1, text))
      return false;
    *(bool *)target = number != 0;
    return true;
  }
  return false;
}

fg_status fg__values_scan(const char *text, const char *path, fg_context *context,
                          const fg__named_value *values, size_t count, void *to)
{
  for (size_t n = 0; n < count; ++n) {
    size_t length;
    const char *found = fg__value_find(text, values[n].name, &length);
    if (!found)
      return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: it lacks the value of '%s'",
                      path, values[n].name);
    char word[FG__VALUE_TEXT_BYTES];
    int kept = length < sizeof word ? (int)length : (int)sizeof word - 1;
    snprintf(word, sizeof word, "%.*s", kept, found);
    if (length >= sizeof word || !scan(word, &values[n], to))
      return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: '%s' is no value of '%s'",
                      path, word, values[n].name);
  }
  return FG_STATUS_OK;
}

const fg__named_value *fg__values_difference(const fg__named_value *values, size_t count,
                                             const void *one, const void *other)
{
  for (size_t n = 0; n < count; ++n)
    if (memcmp(at(&values[n], one), at(&values[n], other), size_of(values[n].kind)) != 0)
      return &values[n];
  return NULL;
}

void fg__value_describe(char text[FG__VALUE_TEXT_BYTES], const fg__named_value *value,
                        const void *from)
{
  if (value->kind != FG__VALUE_REAL) {
    print(text, value, from);
    return;
  }
  double number;
  memcpy(&number, at(value, from), sizeof number);
  fg__number_locale locale; /* the user's may part numbers by a comma */
  const bool plain = fg__number_locale_begin(&locale);
  snprintf(text, FG__VALUE_TEXT_BYTES, "%.15g", number);
  if (memcmp(&number, &(double){strtod(text, NULL)}, sizeof number) != 0)
    snprintf(text, FG__VALUE_TEXT_BYTES, "%.17g", number);
  if (plain)
    fg__number_locale_end(&locale);
}
