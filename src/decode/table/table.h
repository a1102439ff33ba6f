/* Tables of numbers in text, a point a line: CSV and the like, exports of PIV programs,
 * Tecplot's point format. In the order a file passes through the parts: lines, layout,
 * header, file; Tecplot's zones through tecplot. */
#ifndef FG__TABLE_H
#define FG__TABLE_H

#include "decode/openers.h"

enum {
  FG__TABLE_COLUMNS = 1024, /* more than any table of vectors has */
  FG__TABLE_LINE = 1 << 20, /* bytes of the longest line */
  FG__TABLE_NAME = 64,      /* bytes of a column's name or unit */
  FG__TABLE_NUMBER = 64     /* bytes of the longest number */
};

/* How the fields of a line are parted: by a delimiter, or by blanks where it is 0. */
typedef struct fg__table_style {
  char delimiter, decimal;
} fg__table_style;

typedef struct fg__table_line {
  const char *text; /* not ended by a NUL; without the line's end */
  size_t size;
  int number; /* from 1 */
} fg__table_line;

/* A place in the text. */
typedef struct fg__table_cursor {
  const char *text;
  size_t size, at;
  int line; /* the last one's number */
} fg__table_cursor;

/* A field without blanks or quotes round it. */
typedef struct fg__table_field {
  const char *text;
  size_t size;
} fg__table_field;

typedef enum fg__table_value {
  FG__TABLE_NUMBER_VALUE,
  FG__TABLE_MISSING, /* empty, or a word for it: NaN, NA, null, - */
  FG__TABLE_NO_NUMBER
} fg__table_value;

/* lines.c. The beginning of a file, behind the mark of UTF-8. */
fg__table_cursor fg__table_begin(const fg__source *source);

/* The next line; false at the end. */
bool fg__table_next(fg__table_line *line, fg__table_cursor *cursor);
bool fg__table_is_blank(const fg__table_line *line);

/* Whether the line begins with # or %, or blanks and one. */
bool fg__table_is_comment(const fg__table_line *line);

/* The next line that is neither. */
bool fg__table_next_row(fg__table_line *line, fg__table_cursor *cursor);

/* The field from *at on, which is moved behind it; false when there is none. */
bool fg__table_split(fg__table_field *field, const fg__table_line *line, size_t *at,
                     fg__table_style style);

/* The field of a column, from 0. */
fg__table_field fg__table_field_at(const fg__table_line *line, fg__table_style style,
                                   int column);

/* Reads a field as a number; NaN when it is missing or none. Needs the locale of
 * fg__number_locale_begin. */
fg__table_value fg__table_number(double *out, const fg__table_field *field, char decimal);

typedef struct fg__table_column {
  char name[FG__TABLE_NAME], units[FG__TABLE_NAME];
} fg__table_column;

typedef enum fg__table_kind {
  FG__TABLE_PLAIN = 0,
  FG__TABLE_DAVIS /* its invalid vectors are (0, 0) */
} fg__table_kind;

typedef struct fg__table {
  fg_context *context;
  const char *path;
  fg__table_cursor data; /* the first line of data is next */
  fg__table_style style;
  fg__table_kind kind;
  bool named;      /* columns have names of the file's; else their numbers from 1 */
  bool has_places; /* a line before the data has words for two coordinates */
  int columns;
  fg__table_column *column; /* [columns] */
} fg__table;

/* layout.c. The style of the lines, how many columns, and where data begin. */
fg_status fg__table_find_layout(fg__table *table, const fg__source *source);

/* header.c. Names and units of the columns, from what stands before the data. */
fg_status fg__table_find_names(fg__table *table, const fg__source *source);

/* Sets a column's name and units from "u (m/s)", "x [mm]", "X mm", "U[i] (m/s)". */
void fg__table_name(fg__table_column *column, const char *text, size_t size);

/* tecplot.c. Whether a text is Tecplot's and has several zones, one of a time, of cells,
 * or packed by variables. */
bool fg__has_zones(const fg__source *source);

/* Names of at most `most` columns behind VARIABLES = in a text; returns how many it has;
 * -1: it has no such word. */
int fg__tecplot_header(fg__table_column *out, int most, fg__table_cursor text);

/* Adds such a file to a dataset. FILE_FORMAT, UNSUPPORTED (other cells, shared
 * variables), MEMORY. */
fg_status fg__tecplot_open(fg__dataset *dataset, fg_context *context,
                           const fg__source *source);

#endif
