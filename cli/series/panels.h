/* Figures of a series: for each scale the pictures of all times and levels as panels,
 * with a common colour key. */
#ifndef SERIES_PANELS_H
#define SERIES_PANELS_H

#include "report/series_index.h"

/* Prints an error if DIR has a file with the name of a figure that no series has made.
 * Returns an exit code. */
int panels_refuse_foreign(const char *folder);

/* Removes the figures that DIR/series.json names, and temporary files of a killed run.
 * Returns an exit code. */
int panels_remove(const char *folder);

/* Draws the figures after all runs, if there are few enough, and adds them to the index.
 * Prints why runs have no common figure. Returns an exit code. */
int panels_draw(series_index *index);

#endif
