/* A run on several times or levels: one folder for each, as of a single run, and an
 * index. */
#ifndef SERIES_SERIES_H
#define SERIES_SERIES_H

#include "series/places.h"

/* Refuses the folder of a series for a single run. Returns an exit code. */
int series_refuse(const char *folder);

/* Runs each time and level; on resume finished ones are kept. All have one colour range.
 * Collective. Returns an exit code: that of the first interrupted run, EXIT_FAILED where
 * any failed. */
int series_run(const run_settings *settings, const chosen_places *places,
               int (*run)(const run_settings *settings));

#endif
