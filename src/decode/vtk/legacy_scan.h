/* Words, lines and arrays of a legacy VTK file, whose bytes nothing ends. */
#ifndef FG__VTK_LEGACY_SCAN_H
#define FG__VTK_LEGACY_SCAN_H

#include "decode/vtk/vtk.h"

enum { FG__LEGACY_WORD = 256 };

typedef struct fg__legacy_cursor {
  fg_context *context;
  const char *path;
  const char *bytes;
  size_t size, at;
  bool binary;
} fg__legacy_cursor;

/* Copies the next word, parted by white space, and moves behind it. False at the end of
 * the file or when it does not fit, which no word of the format does. */
bool fg__legacy_word(fg__legacy_cursor *cursor, char word[FG__LEGACY_WORD]);

/* The same within the line: false at its end. */
bool fg__legacy_word_of_line(fg__legacy_cursor *cursor, char word[FG__LEGACY_WORD]);

/* Whether two words are the same but for capitals, as VTK compares them. */
bool fg__legacy_is(const char *word, const char *keyword);

/* Moves to the start of the next line. */
void fg__legacy_skip_line(fg__legacy_cursor *cursor);

/* The next word as a whole number from `least` on that fits an int, or as a finite one.
 * `what` names it in messages. FILE_FORMAT. */
fg_status fg__legacy_whole(fg__legacy_cursor *cursor, int *out, int least,
                           const char *what);
fg_status fg__legacy_number(fg__legacy_cursor *cursor, double *out, const char *what);

fg_status fg__legacy_fail(const fg__legacy_cursor *cursor, const char *what,
                          const char *word);

/* Sets where the array's numbers lie, `count` of the type called `type`, and moves behind
 * them and the METADATA that may follow; the line that announces them is left first.
 * FILE_FORMAT when the file ends before they do, or for an unknown type. */
fg_status fg__legacy_take(fg__legacy_cursor *cursor, fg__vtk_array *array,
                          const char *type, size_t count);

/* Reads POINTS, with which the file's one piece begins, the word itself left behind.
 * FILE_FORMAT, MEMORY. */
fg_status fg__legacy_points(fg__vtk *vtk, fg__legacy_cursor *cursor);

/* The same of CELLS and CELL_TYPES, or of polygonal data VERTICES, LINES, POLYGONS and
 * TRIANGLE_STRIPS; for other words *known becomes false. */
fg_status fg__legacy_cells_line(fg__vtk *vtk, fg__legacy_cursor *cursor, bool polygons,
                                const char *keyword, bool *known);

#endif
