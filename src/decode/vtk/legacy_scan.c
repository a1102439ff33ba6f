#include "decode/vtk/legacy_scan.h"

#include "file/number_text.h"

#include <limits.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

/* A legacy file's types: VTK File Formats, "Simple Legacy Formats", on the machines that
 * write them now, where a long has 8 bytes. */
typedef struct legacy_type {
  const char *name;
  fg__type type;
} legacy_type;

static const legacy_type TYPES[] = {
    {"float", FG__TYPE_FLOAT32},
    {"double", FG__TYPE_FLOAT64},
    {"int", FG__TYPE_INT32},
    {"unsigned_int", FG__TYPE_UINT32},
    {"short", FG__TYPE_INT16},
    {"unsigned_short", FG__TYPE_UINT16},
    {"char", FG__TYPE_INT8},
    {"signed_char", FG__TYPE_INT8},
    {"unsigned_char", FG__TYPE_UINT8},
    {"long", FG__TYPE_INT64},
    {"unsigned_long", FG__TYPE_UINT64},
    {"vtktypeint64", FG__TYPE_INT64},
    {"vtktypeuint64", FG__TYPE_UINT64},
    {"vtkidtype", FG__TYPE_INT32},
    {"long_long", FG__TYPE_INT64},
    {"unsigned_long_long", FG__TYPE_UINT64},
};

static bool is_space(char c)
{
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

static bool read_word(fg__legacy_cursor *c, char word[FG__LEGACY_WORD])
{
  size_t length = 0;
  for (; c->at < c->size && !is_space(c->bytes[c->at]); ++c->at)
    if (length < FG__LEGACY_WORD)
      word[length++] = c->bytes[c->at];
  word[length < FG__LEGACY_WORD ? length : FG__LEGACY_WORD - 1] = '\0';
  return length > 0 && length < FG__LEGACY_WORD;
}

bool fg__legacy_word(fg__legacy_cursor *cursor, char word[FG__LEGACY_WORD])
{
  while (cursor->at < cursor->size && is_space(cursor->bytes[cursor->at]))
    ++cursor->at;
  return read_word(cursor, word);
}

bool fg__legacy_word_of_line(fg__legacy_cursor *cursor, char word[FG__LEGACY_WORD])
{
  word[0] = '\0';
  while (cursor->at < cursor->size && is_space(cursor->bytes[cursor->at]) &&
         cursor->bytes[cursor->at] != '\n')
    ++cursor->at;
  return cursor->at < cursor->size && cursor->bytes[cursor->at] != '\n' &&
         read_word(cursor, word);
}

bool fg__legacy_is(const char *word, const char *keyword)
{
  return strcasecmp(word, keyword) == 0;
}

void fg__legacy_skip_line(fg__legacy_cursor *cursor)
{
  const char *end = memchr(cursor->bytes + cursor->at, '\n', cursor->size - cursor->at);
  cursor->at = end ? (size_t)(end - cursor->bytes) + 1 : cursor->size;
}

/* METADATA may follow any array, and ends with an empty line. */
static void skip_metadata(fg__legacy_cursor *cursor)
{
  fg__legacy_cursor ahead = *cursor;
  char word[FG__LEGACY_WORD];
  if (!fg__legacy_word(&ahead, word) || !fg__legacy_is(word, "METADATA"))
    return;
  do
    fg__legacy_skip_line(&ahead);
  while (ahead.at < ahead.size && (fg__legacy_word_of_line(&ahead, word) || word[0]));
  *cursor = ahead;
}

fg_status fg__legacy_fail(const fg__legacy_cursor *cursor, const char *what,
                          const char *word)
{
  char shown[41] = "";
  for (size_t i = 0; i < sizeof shown - 1 && word[i]; ++i)
    shown[i] = word[i] >= ' ' && word[i] <= '~' ? word[i] : '?';
  return fg__fail(cursor->context, FG_STATUS_FILE_FORMAT,
                  "%s: before byte %zu of %zu: %s \"%s\"", cursor->path, cursor->at,
                  cursor->size, what, shown);
}

fg_status fg__legacy_number(fg__legacy_cursor *cursor, double *out, const char *what)
{
  char word[FG__LEGACY_WORD];
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(cursor->context, "a locale", sizeof locale);
  bool good = fg__legacy_word(cursor, word) && fg__number_read_list(out, 1, word);
  fg__number_locale_end(&locale);
  return good ? FG_STATUS_OK : fg__legacy_fail(cursor, what, word);
}

fg_status fg__legacy_whole(fg__legacy_cursor *cursor, int *out, int least,
                           const char *what)
{
  char word[FG__LEGACY_WORD];
  bool good = fg__legacy_word(cursor, word) && fg__number_read_integers(out, 1, word);
  return good && *out >= least ? FG_STATUS_OK : fg__legacy_fail(cursor, what, word);
}

static fg_status fail_short(const fg__legacy_cursor *cursor, const fg__vtk_array *array,
                            size_t count, const char *what, size_t there)
{
  return fg__fail(cursor->context, FG_STATUS_FILE_FORMAT,
                  "%s: array \"%.100s\" is cut short: %zu %s promised, %zu there",
                  cursor->path, array->name, count, what, there);
}

/* Words, not yet known to be numbers; each takes a character and a space at least. */
static fg_status take_words(fg__legacy_cursor *c, fg__vtk_array *array, size_t count)
{
  size_t found = 0, start = c->at;
  if (count > (c->size - c->at) / 2 + 1)
    return fail_short(c, array, count, "numbers", (c->size - c->at) / 2 + 1);
  for (; found < count; ++found) {
    while (c->at < c->size && is_space(c->bytes[c->at]))
      ++c->at;
    if (c->at == c->size)
      return fail_short(c, array, count, "numbers", found);
    while (c->at < c->size && !is_space(c->bytes[c->at]))
      ++c->at;
  }
  array->storage = FG__VTK_TOKENS;
  array->text = c->bytes + start;
  array->text_size = c->at - start;
  return FG_STATUS_OK;
}

static fg_status take_bytes(fg__legacy_cursor *c, fg__vtk_array *array, size_t count,
                            size_t size)
{
  if (count > (c->size - c->at) / size)
    return fail_short(c, array, count, "numbers", (c->size - c->at) / size);
  array->storage = FG__VTK_RAW;
  array->text = c->bytes + c->at;
  array->text_size = count * size;
  c->at += count * size;
  return FG_STATUS_OK;
}

/* In binary a string's first two bits say how many bytes its length has (vtkDataReader):
 * 11 one, 10 two, 01 four, 00 eight. In text each is a line. */
static fg_status skip_strings(fg__legacy_cursor *c, const fg__vtk_array *array,
                              size_t count)
{
  static const unsigned char bytes[4] = {8, 4, 2, 1};
  if (count > c->size - c->at)
    return fail_short(c, array, count, "texts", c->size - c->at);
  for (size_t i = 0; i < count; ++i) {
    if (!c->binary) {
      fg__legacy_skip_line(c);
      continue;
    }
    if (c->at == c->size)
      return fail_short(c, array, count, "texts", i);
    size_t width = bytes[(unsigned char)c->bytes[c->at] >> 6];
    uint64_t length = (unsigned char)c->bytes[c->at] & 0x3f;
    if (width > c->size - c->at)
      return fail_short(c, array, count, "texts", i);
    for (size_t k = 1; k < width; ++k)
      length = length << 8 | (unsigned char)c->bytes[c->at + k];
    c->at += width;
    if (length > c->size - c->at)
      return fail_short(c, array, count, "texts", i);
    c->at += (size_t)length;
  }
  return FG_STATUS_OK;
}

static fg_status take(fg__legacy_cursor *cursor, fg__vtk_array *array, const char *type,
                      size_t count)
{
  if (fg__legacy_is(type, "string") || fg__legacy_is(type, "utf8_string"))
    return skip_strings(cursor, array, count);
  bool bits = fg__legacy_is(type, "bit");
  for (size_t i = 0; i < sizeof TYPES / sizeof TYPES[0]; ++i)
    if (fg__legacy_is(type, TYPES[i].name))
      array->type = TYPES[i].type;
  if (array->type == FG__TYPE_OTHER && !bits)
    return fg__legacy_fail(cursor, "an array of the unknown type", type);
  if (!cursor->binary)
    return take_words(cursor, array, count);
  if (bits)
    return take_bytes(cursor, array, count / CHAR_BIT + (count % CHAR_BIT != 0), 1);
  return take_bytes(cursor, array, count, fg__type_bytes(array->type));
}

fg_status fg__legacy_take(fg__legacy_cursor *cursor, fg__vtk_array *array,
                          const char *type, size_t count)
{
  fg__legacy_skip_line(cursor);
  fg_status status = take(cursor, array, type, count);
  if (status == FG_STATUS_OK)
    skip_metadata(cursor);
  return status;
}
