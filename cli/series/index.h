/* series.json: which runs a series has, and what they have in common. */
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
  int panel_scales;       /* that have a figure of all members */
  unsigned panel_formats; /* bits */
} series_index;

/* Writes DIR/series.json. Returns an exit code. */
int index_write(const series_index *index);

/* Whether DIR/series.json is of the same input, options and members; if not, complains.
 * Its colour range goes to index->speeds. */
bool index_matches(series_index *index);

/* The range alone, for ranks other than the one that wrote it. Returns an exit code. */
int index_read_speeds(double speeds[2], const char *folder);

/* Names of the members of DIR/series.json, *names[0] to [count - 1], to be
 * freed; names that lead elsewhere are left out. *count is 0 where there is no
 * index. Returns an exit code. */
int index_names(char (**names)[MEMBER_NAME_BYTES], int *count, const char *folder);

/* Whether DIR/series.json names a figure of all members so. */
bool index_has_panels(const char *folder, const char *name);

#endif
