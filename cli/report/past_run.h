/* Reads run.json of an earlier run. */
#ifndef REPORT_PAST_RUN_H
#define REPORT_PAST_RUN_H

#include "option/settings.h"

/* How a run ended, by its run.json. */
typedef enum run_outcome {
  OUTCOME_NONE, /* no run.json */
  OUTCOME_INTERRUPTED,
  OUTCOME_LIMIT,   /* by --max-time or --max-steps */
  OUTCOME_COMPLETE /* or an unknown word */
} run_outcome;

run_outcome report_outcome(const char *folder);

/* Whether the folder has a page of the run for browsers. */
bool report_has_page(const char *folder);

/* Whether the finished run in a folder has the input and options of the settings.
 * Otherwise prints an error. */
bool report_is_of(const char *folder, const run_settings *settings);

/* A finished run, for `draw`; it owns its texts. */
typedef struct cli_report {
  void *tree;
  fg_read_options reading;
  fg_map_options map;         /* of `reading` */
  const char *input;          /* as given to the run */
  const char *input_absolute; /* NULL: an analytic field */
  int dimension;
  int scale_count;
  bool placed; /* arrows are placed; false: one for each cluster */
  fg_lengths lengths;
  double speeds[2];
  bool has_view;  /* in 3D */
  double view[2]; /* azimuth, elevation */
} cli_report;

/* Reads DIR/run.json. Returns an exit code. */
int report_read(cli_report *out, const char *folder);
int report_scale_clusters(const cli_report *report, int index);
int report_scale_arrows(const cli_report *report, int index);
const char *report_scale_icons(const cli_report *report, int index); /* file's name */
/* The density's file; NULL: not saved. */
const char *report_scale_density(const cli_report *report, int index);
double report_scale_time(const cli_report *report, int index);
/* Whether a field has the grid and scale of the run's field; otherwise prints an
 * error. */
bool report_is_of_field(const cli_report *report, const char *folder, const char *input,
                        const fg_field *field);
void report_clear(cli_report *report);

/* Reads a regular file as a text; NULL after an error was printed. To be freed. */
char *read_text(const char *path);

#endif
