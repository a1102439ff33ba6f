/* What stands before the data: names of columns, with units. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "base/utf8.h"
#include "decode/table/table.h"
#include "file/number_text.h"
#include "terms/coordinates.h"
#include "terms/text.h"
#include "terms/units.h"
#include "terms/vectors.h"

enum { LOOKED_AT = 8 };

/* Copies a name or unit; control characters become blanks, and blanks at the ends are
 * left out. */
static void copy_text(char out[FG__TABLE_NAME], const char *text, size_t size)
{
  size_t n = 0;
  for (; size > 0 && *text == ' '; --size)
    ++text;
  fg__utf8_take(out, FG__TABLE_NAME, text, size);
  for (; out[n]; ++n)
    if ((unsigned char)out[n] < ' ' || out[n] == 0x7f)
      out[n] = ' ';
  while (n > 0 && out[n - 1] == ' ')
    out[--n] = '\0';
}

/* Whether a bracket holds the index of a component, as STAR-CCM+'s Velocity[i] (m/s). */
static bool is_index(const char *text, size_t size)
{
  return size > 2 && text[0] == '[' && text[1] && strchr("ijkIJK012", text[1]) &&
         text[2] == ']';
}

void fg__table_name(fg__table_column *column, const char *text, size_t size)
{
  size_t open = 0, end;
  while (open < size && (!strchr("[(", text[open]) || is_index(text + open, size - open)))
    ++open;
  for (end = open; end < size && !strchr("])", text[end]);)
    ++end;
  copy_text(column->units, "", 0);
  if (open == 0 && size > 0 && end + 1 == size) { /* "(cm/s)", below the names */
    copy_text(column->name, text + 1, end - 1);
  } else if (open > 0 && open < size) {
    copy_text(column->units, text + open + 1, end - open - 1);
    while (open > 0 && text[open - 1] == ' ')
      --open;
    copy_text(column->name, text, open);
  } else {
    copy_text(column->name, text, size);
    char *blank = strchr(column->name, ' ');
    if (blank && fg__is_unit_in_name(blank + 1)) {
      copy_text(column->units, blank + 1, strlen(blank + 1));
      *blank = '\0';
    }
  }
  if (strcmp(column->units, "-") == 0)
    column->units[0] = '\0';
}

/* Splits names at blanks, and leaves "[mm]" with the name before it. */
static bool next_name(fg__table_field *name, const fg__table_line *line, size_t *at)
{
  static const fg__table_style blanks = {0, '.'};
  fg__table_field unit;
  if (!fg__table_split(name, line, at, blanks))
    return false;
  for (size_t next = *at; fg__table_split(&unit, line, &next, blanks) && unit.size > 0 &&
                          strchr("[(", unit.text[0]);
       *at = next)
    name->size = (size_t)(unit.text + unit.size - name->text);
  return true;
}

/* Splits a line into names, as the data are parted or, `at_blanks`, at blanks; false when
 * they are not as many as the columns, or more numbers than a name may look like. */
static bool split_names(fg__table_column *out, const fg__table *table,
                        fg__table_line line, bool at_blanks, int *numbers)
{
  const bool is_comment = fg__table_is_comment(&line);
  size_t begin = 0, word = 0;
  while (begin < line.size && strchr("#% \t", line.text[begin]))
    ++begin;
  for (word = begin; word < line.size && !strchr(" \t", line.text[word]);)
    ++word;
  if (is_comment && word > begin && line.text[word - 1] == ':') /* %TableColumnTypes: */
    begin = word;
  line.text += begin;
  line.size -= begin;
  fg__table_field field;
  int count = 0;
  *numbers = 0;
  for (size_t at = 0; count <= table->columns &&
                      (at_blanks ? next_name(&field, &line, &at)
                                 : fg__table_split(&field, &line, &at, table->style));
       ++count) {
    double value;
    *numbers +=
        fg__table_number(&value, &field, table->style.decimal) == FG__TABLE_NUMBER_VALUE;
    if (count < table->columns)
      fg__table_name(&out[count], field.text, field.size);
  }
  /* "x,y,u,v," has an empty name too many, or the data have */
  return count == table->columns;
}

static const char *find_word(const char *text, const char *end, const char *word)
{
  const size_t length = strlen(word);
  for (; text + length <= end; ++text)
    if (strncasecmp(text, word, length) == 0)
      return text;
  return NULL;
}

/* A Tecplot file's header, up to the data; *found: it is one. */
static fg_status read_tecplot(bool *found, fg__table *table, fg__table_cursor text)
{
  text.size = table->data.at;
  const int count = fg__tecplot_header(table->column, table->columns, text);
  *found = count >= 0;
  if (*found && count != table->columns)
    return fg__fail(table->context, FG_STATUS_FILE_FORMAT,
                    "%s: %d variables in the header, and %d columns in line %d",
                    table->path, count, table->columns, table->data.line + 1);
  table->named = table->named || *found;
  return FG_STATUS_OK;
}

/* #DaVis 8.1.2 2D-vector 8 205 324 "position" "mm" "position" "mm" "velocity" "m/s" */
static bool read_davis(fg__table *table, const char *text, const char *end)
{
  static const char *const names[] = {"x", "y", "u", "v"};
  static const int unit_of[] = {1, 3, 5, 5};
  if (table->columns != 4 || text == end || *text != '#' ||
      !find_word(text, end, "DaVis") || !find_word(text, end, "vector"))
    return false;
  const char *quoted[6] = {NULL};
  size_t size[6] = {0};
  int count = 0;
  for (const char *at = text; count < 6; ++count) {
    const char *open = memchr(at, '"', (size_t)(end - at));
    const char *close = open ? memchr(open + 1, '"', (size_t)(end - open - 1)) : NULL;
    if (!close)
      break;
    quoted[count] = open + 1;
    size[count] = (size_t)(close - open - 1);
    at = close + 1;
  }
  for (int c = 0; c < 4; ++c) {
    fg__table_name(&table->column[c], names[c], 1);
    if (unit_of[c] < count)
      copy_text(table->column[c].units, quoted[unit_of[c]], size[unit_of[c]]);
  }
  table->kind = FG__TABLE_DAVIS;
  table->named = true;
  return true;
}

static bool has_use(const fg__table *table, const fg__table_column *names,
                    fg__column_use use)
{
  for (int c = 0; c < table->columns; ++c)
    if (fg__column_fits(names[c].name, use))
      return true;
  return false;
}

/* Whether names are those of a vector and its place. */
static fg_status tell_vectors(bool *out, const fg__table *table,
                              const fg__table_column *names)
{
  static const fg__vector_rules rules = {.at_points = true};
  const size_t columns = (size_t)table->columns;
  fg__term *term = fg__allocate(columns, sizeof *term);
  fg__vector *found = NULL;
  size_t count = 0;
  int places = has_use(table, names, FG__COLUMN_LONGITUDE) +
               has_use(table, names, FG__COLUMN_LATITUDE);
  for (int k = 0; k < 3 && places < 2; ++k)
    places += has_use(table, names, (fg__column_use)(FG__COLUMN_X + k));
  for (size_t c = 0; c < columns && term; ++c)
    term[c] = (fg__term){.name = names[c].name, .units = names[c].units, .file = -1};
  const bool memory = term && fg__vectors_find(&found, &count, term, columns, &rules);
  *out = count > 0 && places >= 2;
  free(term);
  free(found);
  return memory ? FG_STATUS_OK : fg__fail_memory(table->context, "vectors", columns * 64);
}

static fg_status fail_first(const fg__table *table, const fg__table_line *line)
{
  fg__table_field field;
  double value;
  int column = 1;
  for (size_t at = 0; fg__table_split(&field, line, &at, table->style); ++column)
    if (fg__table_number(&value, &field, table->style.decimal) == FG__TABLE_NO_NUMBER)
      return fg__fail(table->context, FG_STATUS_FILE_FORMAT,
                      "%s: line %d, column %d: \"%.*s\" is no number", table->path,
                      line->number, column, (int)(field.size < 40 ? field.size : 40),
                      field.text);
  return FG_STATUS_OK;
}

/* Looks through the lines right before the data, the last first: for one that names a
 * vector, else for one with as many names. The line below names may have units. */
static fg_status read_line_of_names(fg__table *table, const fg__table_line *line,
                                    int lines)
{
  const size_t bytes = (size_t)table->columns * sizeof *table->column;
  fg__table_column *names = fg__allocate(1, bytes), *below = fg__allocate(1, bytes);
  fg_status status = FG_STATUS_OK;
  bool has_below = false, done = false;
  if (!names || !below)
    status = fg__fail_memory(table->context, "names of columns", 2 * bytes);
  for (int i = lines - 1; i >= 0 && status == FG_STATUS_OK && !done; --i)
    for (int at_blanks = 0; at_blanks < 2 && !done; ++at_blanks) {
      int numbers = 0;
      if (!split_names(names, table, line[i], at_blanks == 1, &numbers))
        continue;
      if (2 * numbers >= table->columns) {
        if (!fg__table_is_comment(&line[i]) && i == lines - 1)
          status = fail_first(table, &line[i]);
        continue;
      }
      status = tell_vectors(&done, table, names);
      if (done || !table->named)
        memcpy(table->column, names, bytes);
      table->named = true;
      for (int c = 0; done && has_below && c < table->columns; ++c)
        if (!table->column[c].units[0])
          memcpy(table->column[c].units, below[c].name, FG__TABLE_NAME);
      if (!has_below)
        memcpy(below, names, bytes);
      has_below = true;
    }
  free(names);
  free(below);
  return status;
}

/* Whether a line has words for two coordinates: names, however they are parted. */
static bool names_places(const fg__table_line *line)
{
  bool has[FG__COLUMN_LATITUDE + 1] = {false};
  int found = 0;
  for (size_t at = 0, size; at < line->size; at += size + 1) {
    char word[FG__TABLE_NAME];
    for (size = 0;
         at + size < line->size &&
         (isalnum((unsigned char)line->text[at + size]) || line->text[at + size] == '_');)
      ++size;
    copy_text(word, line->text + at, size);
    for (int use = 0; word[0] && use <= FG__COLUMN_LATITUDE; ++use)
      if (!has[use] && fg__column_fits(word, (fg__column_use)use) > 0)
        found += has[use] = true;
  }
  return found >= 2;
}

fg_status fg__table_find_names(fg__table *table, const fg__source *source)
{
  fg__table_cursor cursor = fg__table_begin(source);
  fg__table_line line[LOOKED_AT], next;
  int lines = 0;
  const char *text = cursor.text + cursor.at, *end = cursor.text + table->data.at;
  for (int c = 0; c < table->columns; ++c) {
    char number[16];
    snprintf(number, sizeof number, "%d", c + 1);
    fg__table_name(&table->column[c], number, strlen(number));
  }
  bool found = false;
  fg_status status = FG_STATUS_OK;
  if (end > text)
    status = read_tecplot(&found, table, cursor);
  if (status != FG_STATUS_OK || found || (end > text && read_davis(table, text, end)))
    return status;
  while (cursor.at < table->data.at && fg__table_next(&next, &cursor)) {
    if (fg__table_is_blank(&next) || next.size > FG__TABLE_LINE)
      continue;
    table->has_places = table->has_places || names_places(&next);
    if (lines == LOOKED_AT)
      memmove(line, line + 1, (size_t)--lines * sizeof *line);
    line[lines++] = next;
  }
  fg__number_locale locale;
  if (!fg__number_locale_begin(&locale))
    return fg__fail_memory(table->context, "a locale", 1);
  status = read_line_of_names(table, line, lines);
  fg__number_locale_end(&locale);
  return status;
}
