/* run.json: settings and results of a run (past_run.h reads it). */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "report/reading.h"
#include "run/drawing.h"

enum { MOST_COARSENINGS = 16 };

typedef struct run_facts {
  const run_settings *settings;
  reading_facts reading;
  const fg_field *field;
  fg_mesh_info mesh; /* before coarsening */
  fg_coarsening coarsening[MOST_COARSENINGS];
  int coarsening_count;
  cli_drawing *drawing;
  fg_run_outcome ended;
  long accepted, rejected;
  double mass_drift, largest_residual;
  bool energy_monotone; /* at every step, except for coarsenings */
  bool has_page;        /* index.html */
  double seconds_read, seconds_evolve, seconds_total;
  int ranks;
  fg_communication communication[FG_PHASES], most_communication[FG_PHASES];
} run_facts;

/* The word for how a run ended: "scales", "time", "steps", "stationary",
 * "interrupted". */
const char *report_ending_word(fg_run_outcome ended);

/* Writes run.json. Returns an exit code. */
int report_write(const char *path, const run_facts *facts);

#endif
