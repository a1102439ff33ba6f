/* run.json: what a run was and did, written by `run` and read by `draw`. */
#ifndef JSON_REPORT_H
#define JSON_REPORT_H

#include "drawing.h"

typedef struct run_facts {
  const cli_settings *settings;
  const fg_field *field;
  const fg_mesh_info *mesh;
  cli_drawing *drawing;
  const char *ended; /* "scales", "time", "steps", "stationary", "interrupted" */
  int time_count, level_count; /* of the input; 0: not known */
  long accepted, rejected;
  double mass_drift;
  bool energy_monotone;
  double seconds_read, seconds_evolve, seconds_total;
  int ranks;
  fg_traffic traffic[FG_ACTIVITIES], most_traffic[FG_ACTIVITIES];
} run_facts;

/* How the run ended that a folder's run.json tells of. */
typedef enum run_ending {
  ENDING_NONE, /* there is no run.json */
  ENDING_INTERRUPTED,
  ENDING_LIMIT,   /* by --max-time or --max-steps */
  ENDING_COMPLETE /* or in a way that is not known here */
} run_ending;

run_ending report_ending(const char *folder);

/* Whether the finished run in a folder is the one that is asked for now: the same input
 * and options. Else complains. */
bool report_is_of(const char *folder, const cli_settings *settings);

/* Writes run.json. Returns an exit code. */
int report_write(const char *path, const run_facts *facts);

/* A finished run as `draw` needs it; texts are owned by it. */
typedef struct cli_report {
  void *tree;
  fg_read_options reading;
  const char *input;          /* as it was given */
  const char *input_absolute; /* NULL: an analytic field */
  int dimension;
  int scale_count;
  double speeds[2];
} cli_report;

/* Reads DIR/run.json. Returns an exit code. */
int report_read(cli_report *out, const char *folder);
int report_scale_clusters(const cli_report *report, int index);
const char *report_scale_icons(const cli_report *report, int index); /* file's name */
double report_scale_time(const cli_report *report, int index);
void report_clear(cli_report *report);

/* Reads a whole file into a text; NULL: a complaint was printed. End with free. */
char *read_text(const char *path);

#endif
