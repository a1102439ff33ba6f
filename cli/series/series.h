/* A run on several times or levels: one folder for each, as of a single run, and an
 * index. */
#ifndef SERIES_SERIES_H
#define SERIES_SERIES_H

#include "series/places.h"

/* The index in DIR. */
#define SERIES_NAME "series.json"

enum { MEMBER_NAME_BYTES = 48 };

/* Name of a member's folder in DIR: "time-0011", "level-003", "time-0011-level-003". */
void series_member_name(char out[MEMBER_NAME_BYTES], const chosen_places *places,
                        int time, int level);

/* Whether a folder contains a series. */
bool series_is_there(const char *folder);

/* Refuses the folder of a series for a single run. Returns an exit code. */
int series_refuse(const char *folder);

/* Runs each time and level; on resume finished ones are kept. All have one colour range.
 * Collective. Returns an exit code: that of the first interrupted run, EXIT_FAILED where
 * any failed. */
int series_run(const run_settings *settings, const chosen_places *places,
               int (*run)(const run_settings *settings));

#endif
