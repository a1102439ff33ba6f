/* Tables of numbers in text, a point a line: CSV and the like, exports of PIV programs,
 * Tecplot's point format. In the order a file passes through the parts: lines, layout,
 * header, columns, rows. */
#ifndef FG__TABLE_H
#define FG__TABLE_H

#include "read/format.h"
#include "sample/points/points.h"
#include "terms/polar.h"

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

/* The field from *at on, which is moved behind it; false when there is none. */
bool fg__table_split(fg__table_field *field, const fg__table_line *line, size_t *at,
                     fg__table_style style);

/* Reads a field as a number; NaN when it is missing or none. Needs the locale of
 * fg__number_locale_begin. */
fg__table_value fg__table_number(double *out, const fg__table_field *field, char decimal);

typedef struct fg__table_column {
  char name[FG__TABLE_NAME], units[FG__TABLE_NAME];
  char plain[FG__TABLE_NAME]; /* the name in small letters, words parted by _ */
} fg__table_column;

typedef enum fg__table_kind {
  FG__TABLE_PLAIN = 0,
  FG__TABLE_TECPLOT,
  FG__TABLE_DAVIS /* its invalid vectors are (0, 0) */
} fg__table_kind;

typedef struct fg__table {
  fg_context *context;
  const char *path;
  fg__table_cursor data; /* the first line of data is next */
  fg__table_style style;
  fg__table_kind kind;
  bool placeless; /* a velocity needs no columns of places */
  bool named;     /* columns have names of the file's; else their numbers from 1 */
  int columns;
  fg__table_column *column; /* [columns] */
} fg__table;

/* Finds how the table is laid out and what its columns are called. FILE_FORMAT (no
 * table), UNSUPPORTED, MEMORY. To be cleared even after a failure. */
fg_status fg__table_open(fg__table *out, fg_context *context, const fg__source *source);
void fg__table_clear(fg__table *table);

/* layout.c. The style of the lines, how many columns, and where data begin. */
fg_status fg__table_find_layout(fg__table *table, const fg__source *source);

/* header.c. Names and units of the columns, from what stands before the data. */
fg_status fg__table_find_names(fg__table *table, const fg__source *source);

/* Sets a column's name and units from "u (m/s)", "x [mm]", "X mm", "U[i] (m/s)". */
void fg__table_name(fg__table_column *column, const char *text, size_t size);

/* Columns of a vector and what else a row has; -1: none. */
typedef struct fg__table_vector {
  int dimension; /* of velocity and position */
  int velocity[3];
  int position[3];
  int valid[2]; /* columns that say whether the row counts */
  int mask;
  int time;  /* when the row was measured */
  int level; /* in 2D: at which height or depth */
  bool geographic;
  fg__polar polar; /* velocity is speed and direction */
  const char *found_by;
} fg__table_vector;

enum { FG__TABLE_VECTORS = 16 };

/* columns.c. Lists the vectors that columns may be, those of the best evidence. At most
 * FG__TABLE_VECTORS. MEMORY. */
fg_status fg__table_vectors(fg__table_vector out[FG__TABLE_VECTORS], int *count,
                            const fg__table *table);

/* What a column is called, and its units. */
fg__term fg__table_term(const fg__table *table, int column);

/* The columns of places alone. */
void fg__table_places(fg__table_vector *out, const fg__table *table);

/* Picks the one that vars names (U,V; U,V,W; X,Y,U,V; X,Y,Z,U,V,W), or the only one.
 * ARGUMENT, UNSUPPORTED. */
fg_status fg__table_choose(fg__table_vector *out, const fg__table *table,
                           const fg_read_options *options);

/* The column of that name or number; -1: none. */
int fg__table_find(const fg__table *table, const char *name);

/* The column whose plain name this is; -1: none. */
int fg__table_find_plain(const fg__table *table, const char *plain);

/* polar.c. Makes a named pair of a length and its direction, in either order, polar.
 * ARGUMENT (a speed beside what is no direction), UNSUPPORTED (not on the globe). */
fg_status fg__table_settle_polar(fg__table_vector *vector, const fg__table *table,
                                 bool on_globe);

/* rows.c. Reads a vector's rows. FILE_FORMAT (naming line and column), MEMORY. */
fg_status fg__table_rows(fg__scatter *out, const fg__table *table,
                         const fg__table_vector *vector);

#endif
