/* Lines, their fields, and numbers in them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "decode/table/table.h"
#include "terms/text.h"

fg__table_cursor fg__table_begin(const fg__source *source)
{
  static const char mark[] = {'\xEF', '\xBB', '\xBF'};
  const bool marked =
      source->size >= sizeof mark && memcmp(source->bytes, mark, sizeof mark) == 0;
  return (fg__table_cursor){(const char *)source->bytes, source->size,
                            marked ? sizeof mark : 0, 0};
}

bool fg__table_next(fg__table_line *line, fg__table_cursor *cursor)
{
  if (cursor->at >= cursor->size)
    return false;
  const char *start = cursor->text + cursor->at;
  const size_t left = cursor->size - cursor->at;
  const char *end = memchr(start, '\n', left);
  size_t size = end ? (size_t)(end - start) : left;
  const char *carriage = memchr(start, '\r', size); /* before \n, or alone */
  if (carriage)
    size = (size_t)(carriage - start);
  cursor->at += size + 1;
  if (carriage && size + 1 < left && start[size + 1] == '\n')
    ++cursor->at;
  *line = (fg__table_line){start, size, ++cursor->line};
  return true;
}

static bool is_space(char c)
{
  return c == ' ' || c == '\t';
}

static size_t skip_space(const fg__table_line *line, size_t at)
{
  while (at < line->size && is_space(line->text[at]))
    ++at;
  return at;
}

bool fg__table_is_blank(const fg__table_line *line)
{
  return skip_space(line, 0) == line->size;
}

bool fg__table_is_comment(const fg__table_line *line)
{
  const size_t at = skip_space(line, 0);
  return at < line->size && (line->text[at] == '#' || line->text[at] == '%');
}

bool fg__table_next_row(fg__table_line *line, fg__table_cursor *cursor)
{
  bool found;
  do
    found = fg__table_next(line, cursor);
  while (found && (fg__table_is_blank(line) || fg__table_is_comment(line)));
  return found;
}

static void trim(fg__table_field *field)
{
  while (field->size > 0 && is_space(field->text[0])) {
    ++field->text;
    --field->size;
  }
  while (field->size > 0 && is_space(field->text[field->size - 1]))
    --field->size;
}

/* A quoted field ends at the quote that no other follows. */
static size_t end_of_quoted(const fg__table_line *line, size_t at)
{
  for (++at; at < line->size; ++at)
    if (line->text[at] == '"') {
      if (at + 1 < line->size && line->text[at + 1] == '"')
        ++at;
      else
        return at;
    }
  return at;
}

bool fg__table_split(fg__table_field *field, const fg__table_line *line, size_t *at,
                     fg__table_style style)
{
  const char delimiter = style.delimiter;
  size_t start = *at;
  if (start > line->size)
    return false;
  if (delimiter != '\t')
    start = skip_space(line, start);
  if (!delimiter && start == line->size)
    return false;
  if (start < line->size && line->text[start] == '"') {
    size_t end = end_of_quoted(line, start);
    *field = (fg__table_field){line->text + start + 1, end - start - 1};
    for (end += end < line->size; end < line->size; ++end)
      if (delimiter ? line->text[end] == delimiter : is_space(line->text[end]))
        break;
    *at = end + 1;
  } else {
    size_t end = start;
    while (end < line->size &&
           (delimiter ? line->text[end] != delimiter : !is_space(line->text[end])))
      ++end;
    *field = (fg__table_field){line->text + start, end - start};
    *at = end + 1;
  }
  trim(field);
  return true;
}

fg__table_field fg__table_field_at(const fg__table_line *line, fg__table_style style,
                                   int column)
{
  fg__table_field field = {"", 0};
  size_t at = 0;
  for (int c = 0; c <= column && fg__table_split(&field, line, &at, style); ++c)
    ;
  return field;
}

static bool is_missing(const fg__table_field *field)
{
  return fg__is_one_of("|nan|na|n/a|null|none|-|--|---|nil|-nan|+nan|masked|m|mm|#n/a|"
                       "-nan(ind)|nan(ind)|1.#qnan|-1.#qnan|1.#ind|-1.#ind",
                       field->text, field->size);
}

static bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

/* Copies a decimal number, with a point and an e, whatever it was written with; false
 * when it is none. */
static bool copy_number(char out[FG__TABLE_NUMBER], const fg__table_field *field,
                        char decimal)
{
  const char *text = field->text;
  size_t n = 0, digits = 0;
  if (field->size >= FG__TABLE_NUMBER)
    return false;
  if (text[0] == '-' || text[0] == '+')
    out[n] = text[n], ++n;
  for (bool fraction = false; n < field->size; ++n) {
    const bool mark = text[n] == decimal && !fraction;
    if (!mark && !is_digit(text[n]))
      break;
    digits += !mark;
    fraction = fraction || mark;
    out[n] = mark ? '.' : text[n];
  }
  /* "1," ends a list, and is no number */
  if (digits == 0 || (decimal == ',' && out[n - 1] == '.'))
    return false;
  if (n < field->size && text[n] && strchr("eEdD", text[n])) {
    out[n++] = 'e';
    if (n < field->size && (text[n] == '-' || text[n] == '+'))
      out[n] = text[n], ++n;
    if (n == field->size)
      return false;
    while (n < field->size && is_digit(text[n]))
      out[n] = text[n], ++n;
  }
  out[n] = '\0';
  return n == field->size;
}

/* Up to 15 digits and a power of ten up to 22 are exact in double precision, and so is
 * their rounded quotient (Clinger 1990): faster than strtod. */
static bool read_short(double *out, const char *text)
{
  static const double power[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = *text == '-';
  size_t digits = 0, behind = 0;
  bool fraction = false;
  double number = 0.0;
  for (text += negative || *text == '+'; *text; ++text) {
    if (*text == '.') {
      fraction = true;
      continue;
    }
    if (!is_digit(*text) || ++digits > 15)
      return false;
    number = 10.0 * number + (double)(*text - '0');
    behind += fraction;
  }
  *out = (negative ? -number : number) / power[behind];
  return true;
}

fg__table_value fg__table_number(double *out, const fg__table_field *field, char decimal)
{
  char number[FG__TABLE_NUMBER];
  *out = (double)NAN;
  if (is_missing(field))
    return FG__TABLE_MISSING;
  if (!copy_number(number, field, decimal)) {
    const size_t sign = field->text[0] == '-' || field->text[0] == '+';
    if ((field->size != 3 + sign || strncasecmp(field->text + sign, "inf", 3) != 0) &&
        (field->size != 8 + sign || strncasecmp(field->text + sign, "infinity", 8) != 0))
      return FG__TABLE_NO_NUMBER;
    *out = field->text[0] == '-' ? -HUGE_VAL : HUGE_VAL;
    return FG__TABLE_NUMBER_VALUE;
  }
  if (!read_short(out, number))
    *out = strtod(number, NULL);
  return FG__TABLE_NUMBER_VALUE;
}
