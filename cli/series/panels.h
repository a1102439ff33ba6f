/* The figures of a series: for each scale its pictures of all times and levels as panels,
 * with one key. */
#ifndef SERIES_PANELS_H
#define SERIES_PANELS_H

#include "series/index.h"

/* "panels-00.svg" of the finest scale. */
enum { PANELS_NAME_BYTES = 24 };
void panels_name(char out[PANELS_NAME_BYTES], int scale, const char *format);

/* Complains of a file in DIR with such a name that no series is known to have made.
 * Returns an exit code. */
int panels_refuse_foreign(const char *folder);

/* Removes those that DIR/series.json names, and what a run was killed in writing. Returns
 * an exit code. */
int panels_remove(const char *folder);

/* Draws them when the runs are done, where there are few enough of them, and names them
 * in the index. Runs that do not go together have none, which is said. Returns an exit
 * code. */
int panels_draw(series_index *index);

#endif
