/* A run on several times or levels: a folder each, as a run by itself leaves it, and an
 * index that names them. */
#ifndef SERIES_SERIES_H
#define SERIES_SERIES_H

#include "series/places.h"

/* The index, in DIR. */
#define SERIES_NAME "series.json"

enum { MEMBER_NAME_BYTES = 48 };

/* Name of a member's folder in DIR: "time-0011", "level-003", "time-0011-level-003". */
void series_member_name(char out[MEMBER_NAME_BYTES], const chosen_places *places,
                        int time, int level);

/* Whether a folder holds a series. */
bool series_is_there(const char *folder);

/* Complains of a folder that holds one, where a run by itself is to go. Returns an exit
 * code. */
int series_refuse(const char *folder);

/* Does a run for each time and level; those that are finished are not done again when it
 * is resumed. All have one colour range. Collective. Returns an exit code: that of the
 * first that was interrupted, EXIT_FAILED where one or more failed. */
int series_run(const run_settings *settings, const chosen_places *places,
               int (*run)(const run_settings *settings));

#endif
