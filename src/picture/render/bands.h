/* Triangles sorted by the bands of rows that they touch: a thread draws a band. */
#ifndef FG__BANDS_H
#define FG__BANDS_H

#include "base/context.h"
#include "base/vector.h"

enum { FG__BAND = 8 }; /* rows */

/* The rows that a triangle may touch; first > last: none. */
typedef struct fg__band_rows {
  int first, last;
} fg__band_rows;

/* Triangles thread[first[b]] to thread[first[b + 1] - 1] touch band b; they keep their
 * order. */
typedef struct fg__bands {
  int count;
  size_t *first;
  int *member;
} fg__bands;

/* rows: of each of `triangles`; height: all rows. `out` is to be cleared also after a
 * failure. MEMORY. */
fg_status fg__bands_make(fg__bands *out, fg_context *context, const fg__band_rows *rows,
                         size_t triangles, int height);
void fg__bands_clear(fg__bands *bands);

/* The rows, of 0 to height - 1, that an interval touches. */
fg__band_rows fg__rows_between(double low, double high, int height);

#endif
