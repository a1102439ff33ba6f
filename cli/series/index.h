/* series.json: the runs of a series, and what they share. */
#ifndef SERIES_INDEX_H
#define SERIES_INDEX_H

#include "series/series.h"

typedef struct series_member {
  char name[MEMBER_NAME_BYTES];
  int time, level;
} series_member;

typedef struct series_index {
  const run_settings *settings;
  const chosen_places *places;
  series_member *member;
  int count;
  double speeds[2];
  int panel_scales;       /* number of scales with a figure of all members */
  unsigned panel_formats; /* bits */
} series_index;

/* Writes DIR/series.json. Returns an exit code. */
int index_write(const series_index *index);

/* Whether DIR/series.json has the same input, options and members; otherwise prints an
 * error. Copies its colour range to index->speeds. */
bool index_matches(series_index *index);

/* Reads the colour range only, for ranks other than 0. Returns an exit code. */
int index_read_speeds(double speeds[2], const char *folder);

/* The members of DIR/series.json, *names[0] to [count - 1], to be freed; names with other
 * paths are dropped. *count is 0 without an index. Returns an exit code. */
int index_names(char (**names)[MEMBER_NAME_BYTES], int *count, const char *folder);

/* Whether DIR/series.json names this figure. */
bool index_has_panels(const char *folder, const char *name);

#endif
