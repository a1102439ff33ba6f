/* Reads the run.json of an earlier run in a folder. */
#ifndef REPORT_PAST_RUN_H
#define REPORT_PAST_RUN_H

#include "option/settings.h"

/* How the run of a folder's run.json ended. */
typedef enum run_outcome {
  OUTCOME_NONE, /* there is no run.json */
  OUTCOME_INTERRUPTED,
  OUTCOME_LIMIT,   /* by --max-time or --max-steps */
  OUTCOME_COMPLETE /* or in a way that is not known here */
} run_outcome;

run_outcome report_outcome(const char *folder);

/* Whether the run has left a page for browsers there. */
bool report_has_page(const char *folder);

/* Whether the finished run in a folder is the one that the settings describe: the same
 * input and options. Else complains. */
bool report_is_of(const char *folder, const run_settings *settings);

/* Whether a report's `input` is the file that is given now; if not, complains. */
bool report_same_input(const void *input, const char *operand, const char *folder);

/* A finished run as `draw` needs it; texts are owned by it. */
typedef struct cli_report {
  void *tree;
  fg_read_options reading;
  fg_map_options map;         /* of `reading` */
  const char *input;          /* as it was given */
  const char *input_absolute; /* NULL: an analytic field */
  int dimension;
  int scale_count;
  bool placed; /* its arrows; else they are their clusters' own */
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
/* The density's file; NULL: none was saved. */
const char *report_scale_density(const cli_report *report, int index);
double report_scale_time(const cli_report *report, int index);
/* Whether a field has the grid and the scale of the one that the run was made of; if not,
 * complains. */
bool report_is_of_field(const cli_report *report, const char *folder, const char *input,
                        const fg_field *field);
void report_clear(cli_report *report);

/* Reads a regular file into a text; NULL: a complaint was printed. End with free. */
char *read_text(const char *path);

#endif
