/* How a table is laid out: what the lines in its middle have in common. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "decode/table/table.h"
#include "file/number_text.h"

enum {
  LOOKED_AT = 64, /* lines */
  SHORT_FILE = 1 << 16,
  LEAST = 4,      /* columns: a place and a velocity */
  ROWS_TRIED = 4, /* after names; one may have units */
  SHOWN = 40      /* bytes of a text in a message */
};

/* Where several fit a line alike, the first is meant. */
static const fg__table_style STYLES[] = {{'\t', '.'}, {'\t', ','}, {';', '.'}, {';', ','},
                                         {',', '.'},  {'|', '.'},  {0, '.'},   {0, ','}};
enum { STYLE_COUNT = sizeof STYLES / sizeof *STYLES };

typedef struct fit {
  int columns; /* that most lines have; 0: none */
  double numbers;
} fit;

/* What the fields of a line are; those past the bound are not looked at. */
typedef struct kinds {
  int fields, numbers, missing;
  fg__table_value of[FG__TABLE_COLUMNS + 1];
} kinds;

static void find_kinds(kinds *out, const fg__table_line *line, fg__table_style style,
                       int most)
{
  fg__table_field field;
  double value;
  out->fields = out->numbers = out->missing = 0;
  for (size_t at = 0; out->fields <= most && fg__table_split(&field, line, &at, style);) {
    const fg__table_value kind = fg__table_number(&value, &field, style.decimal);
    out->numbers += kind == FG__TABLE_NUMBER_VALUE;
    out->missing += kind == FG__TABLE_MISSING;
    out->of[out->fields++] = kind;
  }
}

/* Counts fields and how many are numbers. */
static int count_fields(int *numbers, const fg__table_line *line, fg__table_style style)
{
  kinds found;
  find_kinds(&found, line, style, FG__TABLE_COLUMNS);
  *numbers = found.numbers;
  return found.fields;
}

static int by_size(const void *a, const void *b)
{
  return *(const int *)a - *(const int *)b;
}

static fit fit_style(const fg__table_line *line, int lines, fg__table_style style)
{
  int fields[LOOKED_AT] = {0}, sorted[LOOKED_AT] = {0}, numbers[LOOKED_AT] = {0};
  for (int i = 0; i < lines; ++i)
    sorted[i] = fields[i] = count_fields(&numbers[i], &line[i], style);
  qsort(sorted, (size_t)lines, sizeof *sorted, by_size);
  fit out = {.columns = sorted[lines / 2]};
  for (int i = 0; i < lines; ++i)
    out.numbers += fields[i] == out.columns ? numbers[i] : 0;
  return out;
}

/* Lines of data: some from the middle of the file on, which no header reaches. */
static int collect(fg__table_line line[LOOKED_AT], const fg__source *source)
{
  fg__table_cursor cursor = fg__table_begin(source);
  fg__table_line next;
  int count = 0;
  if (source->size > SHORT_FILE) {
    cursor.at = source->size / 2;
    fg__table_next(&next, &cursor); /* the rest of one */
  } else {
    int all = 0;
    while (fg__table_next_row(&next, &cursor))
      ++all;
    cursor = fg__table_begin(source);
    for (int skipped = 0; skipped < all / 2; ++skipped)
      fg__table_next_row(&next, &cursor);
  }
  while (count < LOOKED_AT && fg__table_next_row(&next, &cursor))
    if (next.size <= FG__TABLE_LINE)
      line[count++] = next;
  return count;
}

/* Whether a line has all columns, and numbers where the sampled line has them. */
static bool is_data(const fg__table *table, const fg__table_line *line,
                    const bool *is_number)
{
  kinds found;
  find_kinds(&found, line, table->style, table->columns);
  for (int c = 0; c < table->columns && c < found.fields; ++c)
    if (is_number[c] && found.of[c] == FG__TABLE_NO_NUMBER)
      return false;
  return found.fields == table->columns && found.numbers > 0;
}

/* Columns that have a number in one of the lines, and a number or none in all. */
static void find_numbers(bool *is_number, const fg__table *table,
                         const fg__table_line *lines, int count)
{
  bool is_text[FG__TABLE_COLUMNS] = {false};
  kinds found;
  for (int i = 0; i < count; ++i) {
    find_kinds(&found, &lines[i], table->style, table->columns);
    for (int c = 0; c < table->columns && c < found.fields; ++c) {
      is_number[c] = is_number[c] || found.of[c] == FG__TABLE_NUMBER_VALUE;
      is_text[c] = is_text[c] || found.of[c] == FG__TABLE_NO_NUMBER;
    }
  }
  for (int c = 0; c < table->columns; ++c)
    is_number[c] = is_number[c] && !is_text[c];
}

/* Whether most of the lines with all columns are points: numbers, or words for missing
 * ones, at least two of them numbers. */
static bool has_points(const fg__table *table, const fg__table_line *lines, int count)
{
  int rows = 0, points = 0;
  kinds found;
  for (int i = 0; i < count; ++i) {
    find_kinds(&found, &lines[i], table->style, table->columns);
    const bool is_row = found.fields == table->columns;
    rows += is_row;
    /* a damaged one is told by its place */
    points += is_row && found.numbers >= 2 && found.numbers + found.missing >= LEAST - 1;
  }
  return 2 * points >= rows;
}

/* Whether text is a number but for marks of thousands or a hemisphere: 1.000,5 or 51.2N.
 */
static bool is_nearly_number(const fg__table_field *field)
{
  bool has_digit = false;
  for (size_t i = 0; i < field->size; ++i) {
    const char c = field->text[i];
    const bool sign = i == 0 && (c == '+' || c == '-');
    const bool hemisphere = i + 1 == field->size && c && strchr("NSEWnsew", c);
    const bool digit = c >= '0' && c <= '9';
    const bool other = (c && strchr(".,' ", c)) || (c & 0x80); /* as a degree's sign */
    if (!sign && !hemisphere && !digit && !other)
      return false;
    has_digit = has_digit || digit;
  }
  return has_digit;
}

/* The style in which both lines have `columns` fields and this one the most numbers, at
 * least one; -1: none. */
static int style_of_row(const fg__table_line *names, const fg__table_line *row,
                        int columns)
{
  int best = -1, most = 0;
  for (int s = 0; s < STYLE_COUNT; ++s) {
    int none, numbers;
    if (count_fields(&none, names, STYLES[s]) == columns &&
        count_fields(&numbers, row, STYLES[s]) == columns && numbers > most) {
      best = s;
      most = numbers;
    }
  }
  return best;
}

/* The column of a row whose text is no number: nearly one, or the first; -1: none. */
static int find_no_number(const fg__table_line *row, fg__table_style style)
{
  fg__table_field field;
  int first = -1, column = 0;
  for (size_t at = 0; fg__table_split(&field, row, &at, style); ++column) {
    double value;
    if (fg__table_number(&value, &field, style.decimal) != FG__TABLE_NO_NUMBER)
      continue;
    if (is_nearly_number(&field))
      return column;
    first = first < 0 ? column : first;
  }
  return first;
}

static void hint_at_number(const fg__table *table, const fg__table_field *field)
{
  const char last = field->size > 0 ? field->text[field->size - 1] : '\0';
  if (!is_nearly_number(field))
    fg__hint(table->context, "a line a point, with %d columns at least: x, y, u, v",
             LEAST);
  else if (last >= '0' && last <= '9')
    fg__hint(table->context,
             "numbers have a decimal point or comma and no marks of thousands");
  else
    fg__hint(table->context, "write degrees as numbers, west and south below 0");
}

/* Refuses the first row with a number, for a text in it that is none; false where no such
 * row is soon after the names. */
static bool fail_row(const fg__table *table, const fg__table_line *names,
                     fg__table_cursor cursor, int columns)
{
  fg__table_line row;
  int style = -1;
  for (int rows = 0; style < 0 && rows < ROWS_TRIED && fg__table_next_row(&row, &cursor);
       ++rows)
    style = style_of_row(names, &row, columns);
  const int column = style < 0 ? -1 : find_no_number(&row, STYLES[style]);
  if (column < 0)
    return false;
  const fg__table_field name = fg__table_field_at(names, STYLES[style], column),
                        field = fg__table_field_at(&row, STYLES[style], column);
  fg__fail(table->context, FG_STATUS_FILE_FORMAT,
           "%s: is text, but no table of points: line %d, column %d (%.*s): \"%.*s\" is "
           "no number",
           table->path, row.number, column + 1,
           (int)(name.size < SHOWN ? name.size : SHOWN), name.text,
           (int)(field.size < SHOWN ? field.size : SHOWN), field.text);
  hint_at_number(table, &field);
  return true;
}

static fg_status fail_no_table(const fg__table *table, const fg__source *source)
{
  fg__table_cursor cursor = fg__table_begin(source);
  fg__table_line line = {"", 0, 0};
  fg__table_next_row(&line, &cursor);
  int best = 0, numbers = 0;
  for (int s = 0; s < STYLE_COUNT; ++s) {
    int found;
    const int fields = count_fields(&found, &line, STYLES[s]);
    if (fields > best) {
      best = fields;
      numbers = found;
    }
  }
  if (best >= LEAST && numbers == 0 && fail_row(table, &line, cursor, best))
    return FG_STATUS_FILE_FORMAT;
  fg__table_line next;
  const bool more = fg__table_next_row(&next, &cursor);
  if (!more && best >= LEAST && numbers == 0)
    return fg__fail(table->context, FG_STATUS_FILE_FORMAT,
                    "%s: a table with the names of %d columns, and without rows",
                    table->path, best);
  fg__fail(table->context, FG_STATUS_FILE_FORMAT,
           "%s: is text, but no table of points: line %d has %d column%s, %d of them "
           "numbers",
           table->path, line.number, best, best == 1 ? "" : "s", numbers);
  fg__hint(table->context, "a line a point, with %d columns at least: x, y, u, v", LEAST);
  return FG_STATUS_FILE_FORMAT;
}

static fg_status find_style(fg__table *table, const fg__source *source,
                            bool is_number[FG__TABLE_COLUMNS])
{
  fg__table_line line[LOOKED_AT];
  const int lines = collect(line, source);
  double most = 0.0;
  for (int s = 0; s < STYLE_COUNT && lines > 0; ++s) {
    const fit found = fit_style(line, lines, STYLES[s]);
    if (found.columns > FG__TABLE_COLUMNS)
      return fg__fail(table->context, FG_STATUS_UNSUPPORTED,
                      "%s: line %d has more than %d columns", table->path, line[0].number,
                      FG__TABLE_COLUMNS);
    if (found.columns >= LEAST && found.numbers > most) {
      most = found.numbers;
      table->style = STYLES[s];
      table->columns = found.columns;
    }
  }
  if (most < LEAST || !has_points(table, line, lines))
    return fail_no_table(table, source);
  find_numbers(is_number, table, line, lines);
  return FG_STATUS_OK;
}

fg_status fg__table_find_layout(fg__table *table, const fg__source *source)
{
  bool is_number[FG__TABLE_COLUMNS] = {false};
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(table->context, "a locale", 1);
  fg_status status = find_style(table, source, is_number);
  fg__table_line line;
  fg__table_cursor cursor = fg__table_begin(source);
  bool found = false;
  while (status == FG_STATUS_OK && !found) {
    table->data = cursor;
    if (!fg__table_next(&line, &cursor))
      status = fail_no_table(table, source);
    else
      found = !fg__table_is_blank(&line) && !fg__table_is_comment(&line) &&
              is_data(table, &line, is_number);
  }
  fg__number_locale_end(&locale);
  return status;
}
