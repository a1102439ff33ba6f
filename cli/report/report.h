/* run.json: what a run was and did (past_run.h reads it). */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "run/drawing.h"

enum { MOST_COARSENINGS = 16 };

typedef struct run_facts {
  const run_settings *settings;
  const fg_field *field;
  fg_mesh_info mesh; /* the first */
  fg_coarsening coarsening[MOST_COARSENINGS];
  int coarsening_count;
  cli_drawing *drawing;
  fg_run_outcome ended;
  int time_count, level_count; /* of the input; 0: not known */
  long accepted, rejected;
  double mass_drift;
  bool energy_monotone; /* in steps, between coarsenings */
  bool has_page;        /* for browsers */
  double seconds_read, seconds_evolve, seconds_total;
  int ranks;
  fg_communication communication[FG_PHASES], most_communication[FG_PHASES];
} run_facts;

/* How it ended, in a word: "scales", "time", "steps", "stationary", "interrupted". */
const char *report_ending_word(fg_run_outcome ended);

/* Writes run.json. Returns an exit code. */
int report_write(const char *path, const run_facts *facts);

#endif
