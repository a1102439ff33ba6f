/* series.json: the runs of a series, and what they share. */
#ifndef REPORT_SERIES_INDEX_H
#define REPORT_SERIES_INDEX_H

#include "option/settings.h"

/* The index in DIR. */
#define SERIES_NAME "series.json"

/* A run of the series: its folder in DIR, its time and level. */
enum { MEMBER_NAME_BYTES = 48 };
typedef struct series_member {
  char name[MEMBER_NAME_BYTES];
  int time, level;
  const char *time_words, *level_words; /* NULL: not known */
} series_member;

typedef struct series_index {
  const run_settings *settings;
  series_member *member;
  int count;
  double speeds[2];
  int panel_scales;       /* number of scales with a figure of all members */
  unsigned panel_formats; /* bits */
} series_index;

/* Whether a folder contains a series. */
bool series_is_there(const char *folder);

/* The name of a scale's figure, "panels-00.svg" for the finest. */
enum { PANELS_NAME_BYTES = 24 };
void panels_name(char out[PANELS_NAME_BYTES], int scale, const char *format);

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
