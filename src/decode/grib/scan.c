/* Messages, and the fields in them. */
#include "base/memory.h"
#include "decode/grib/grib.h"

#include <string.h>

/* What may stand between and behind messages: headings of telecommunication. */
enum { MOST_HEADING = 256 };

enum { SHORTEST_1 = 8 + 28 + 11 + 4, SHORTEST_2 = 16 + 21 + 4 };

static const unsigned char END[] = {'7', '7', '7', '7'};

uint64_t fg__grib_number(const unsigned char *at, int bytes)
{
  uint64_t number = 0;
  for (int k = 0; k < bytes; ++k)
    number = number << 8 | at[k];
  return number;
}

const unsigned char *fg__grib_section(const fg__grib_field *field, int n, size_t *size)
{
  *size = 0;
  if (field->section[n] == 0)
    return NULL;
  const unsigned char *at = field->message + field->section[n];
  if (field->edition == 2)
    *size = (size_t)fg__grib_number(at, 4);
  else if (n == 4) /* its length has no room in a large message */
    *size = field->size - sizeof END - field->section[n];
  else
    *size = (size_t)fg__grib_number(at, 3);
  return at;
}

typedef struct scan {
  fg__grib_file *file;
  const unsigned char *bytes;
  size_t size, at;
  size_t number; /* of the message at `at`, from 1 */
} scan;

static fg_status fail_length(const scan *s, uint64_t length)
{
  return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                  "%s: message %zu has %llu bytes from byte %zu on, the file %zu",
                  s->file->path, s->number, (unsigned long long)length, s->at, s->size);
}

static fg_status fail_section(const scan *s, int n, uint64_t length)
{
  return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                  "%s: section %d of message %zu has a length of %llu bytes",
                  s->file->path, n, s->number, (unsigned long long)length);
}

static fg_status add_field(scan *s, const fg__grib_field *field)
{
  fg__grib_file *file = s->file;
  void *fields = file->field;
  if (!fg__grow(&fields, &file->field_capacity, file->fields + 1, sizeof *file->field))
    return fg__fail_memory(file->context, "a list of fields",
                           (file->fields + 1) * sizeof *file->field);
  file->field = fields;
  file->field[file->fields++] = *field;
  return FG_STATUS_OK;
}

/* Sections 1 to 4 of edition 1; what is left before the end is the last one's. */
static fg_status scan_first_edition(scan *s, fg__grib_field *field)
{
  static const size_t least[] = {0, 28, 32, 6, 11};
  const unsigned char *message = field->message;
  const size_t end = field->size - sizeof END;
  size_t at = 8;
  bool there[5] = {false, true, false, false, true};
  for (int n = 1; n <= 4; ++n) {
    if (!there[n])
      continue;
    const uint64_t length = end - at < least[n] ? 0 : fg__grib_number(message + at, 3);
    if (n < 4 && (length < least[n] || length > end - at))
      return fail_section(s, n, length);
    if (n == 4 && length == 0)
      return fail_section(s, n, end - at);
    if (n == 1) {
      there[2] = message[at + 7] & 128;
      there[3] = message[at + 7] & 64;
    }
    field->section[n] = at;
    at += (size_t)length;
  }
  if (!there[2]) { /* it says the number of one in a catalogue */
    ++s->file->without_grid;
    return FG_STATUS_OK;
  }
  field->alone = true;
  return add_field(s, field);
}

/* A section 6 that says "as before" means the field's before. */
static bool take_bitmap(fg__grib_field *field, size_t at, size_t *before)
{
  const unsigned char indicator = field->message[at + 5];
  if (indicator == 0)
    *before = at;
  field->section[6] = indicator == 254 ? *before : at;
  return field->section[6] != 0;
}

static fg_status scan_second_edition(scan *s, fg__grib_field *field)
{
  static const size_t least[] = {0, 21, 5, 14, 9, 11, 6, 5};
  const size_t end = field->size - sizeof END;
  const size_t first = s->file->fields;
  size_t at = 16, bitmap = 0;
  int before = 0;
  fg_status status = FG_STATUS_OK;
  while (at < end && status == FG_STATUS_OK) {
    const uint64_t length = end - at < 5 ? 0 : fg__grib_number(field->message + at, 4);
    const int n = end - at < 5 ? 0 : field->message[at + 4];
    const bool follows =
        n == before + 1 || (n == 3 && before == 1) || (before == 7 && n >= 2 && n <= 4);
    if (!follows || n > 7)
      return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                      "%s: section %d of message %zu is followed by one that says %d",
                      s->file->path, before, s->number, n);
    if (length < least[n] || length > end - at)
      return fail_section(s, n, length);
    field->section[n] = at;
    if (n == 6 && !take_bitmap(field, at, &bitmap))
      return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                      "%s: message %zu takes its bitmap from an earlier field, and there "
                      "is none",
                      s->file->path, s->number);
    if (n == 7)
      status = add_field(s, field);
    at += (size_t)length;
    before = n;
  }
  if (status == FG_STATUS_OK && before != 7)
    return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                    "%s: message %zu ends with section %d", s->file->path, s->number,
                    before);
  for (size_t i = first; i < s->file->fields; ++i)
    s->file->field[i].alone = s->file->fields == first + 1;
  return status;
}

/* The length of a message of edition 1 has 23 bits, or is a multiple of 120 less what its
 * last section says instead of its own length. */
static uint64_t length_of_first_edition(const unsigned char *at, size_t size)
{
  uint64_t length = fg__grib_number(at + 4, 3);
  if (!(length & 0x800000))
    return length;
  size_t section = 8;
  const unsigned char flags = at[8 + 7];
  const bool there[3] = {true, flags & 128, flags & 64};
  for (int n = 0; n < 3; ++n)
    if (there[n] && section + 3 <= size)
      section += (size_t)fg__grib_number(at + section, 3);
  if (section + 3 > size)
    return length;
  const uint64_t last = fg__grib_number(at + section, 3);
  return last < 120 ? (length & 0x7fffff) * 120 - last + 4 : length;
}

static fg_status scan_message(scan *s)
{
  const unsigned char *at = s->bytes + s->at;
  const size_t left = s->size - s->at;
  fg__grib_field field = {.message = at, .number = s->number, .edition = at[7]};
  const size_t least = field.edition == 1 ? SHORTEST_1 : SHORTEST_2;
  if (field.edition != 1 && field.edition != 2)
    return fg__fail(s->file->context, FG_STATUS_UNSUPPORTED,
                    "%s: message %zu is of GRIB's edition %d; 1 and 2 are known",
                    s->file->path, s->number, field.edition);
  if (left < least)
    return fail_length(s, least);
  const uint64_t length =
      field.edition == 1 ? length_of_first_edition(at, left) : fg__grib_number(at + 8, 8);
  if (length < least || length > left)
    return fail_length(s, length);
  field.size = (size_t)length;
  if (memcmp(at + field.size - sizeof END, END, sizeof END) != 0)
    return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                    "%s: message %zu, %zu bytes from byte %zu on, does not end with 7777",
                    s->file->path, s->number, field.size, s->at);
  s->at += field.size;
  return field.edition == 1 ? scan_first_edition(s, &field)
                            : scan_second_edition(s, &field);
}

/* Skips zeros and headings up to the next message. */
static fg_status find_message(scan *s)
{
  const int most = s->number == 0 ? FG__GRIB_WITHIN : MOST_HEADING;
  int heading = 0;
  for (; s->at < s->size; ++s->at) {
    const unsigned char *at = s->bytes + s->at;
    if ((s->number == 0 && heading > 0 ? fg__is_grib_message : fg__is_grib_start)(
            at, s->size - s->at)) /* the first heading may have the letters */
      return FG_STATUS_OK;
    if (*at != 0 && ++heading > most)
      return fg__fail(s->file->context, FG_STATUS_FILE_FORMAT,
                      "%s: more than %d bytes before byte %zu are no part of a message, "
                      "after %zu messages",
                      s->file->path, most, s->at, s->number);
  }
  return FG_STATUS_OK;
}

fg_status fg__grib_scan(fg__grib_file *file)
{
  scan s = {.file = file, .bytes = file->source.bytes, .size = file->source.size};
  fg_status status = find_message(&s);
  while (s.at < s.size && status == FG_STATUS_OK) {
    ++s.number;
    status = scan_message(&s);
    if (status == FG_STATUS_OK)
      status = find_message(&s);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(file->context);
  }
  return status;
}
