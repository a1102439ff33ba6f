/* A run of the main job while it goes on, for the files that do it. */
#ifndef RUN_RUN_H
#define RUN_RUN_H

#include "folder/results.h"
#include "progress.h"
#include "report/report.h"
#include "report/table.h"
#include "run/drawing.h"

typedef struct cli_run {
  const run_settings *settings;
  fg_context *context;
  fg_field *field;
  fg_tensors *tensors;  /* of which the energy is, or NULL */
  fg_run *scales;       /* NULL once the evolution is not needed any more */
  fg_run_record record; /* of the scales, from then on */
  cli_drawing *drawing;
  cli_output output;
  char *checkpoint; /* its path */
  cli_table table;  /* evolution.csv */
  cli_progress progress;
  run_facts facts;
  fg_step step;          /* the last accepted one */
  double start;          /* of the process */
  double evolving_since; /* clock of the process */
  double earlier_evolve; /* seconds of the runs that this one goes on from */
  double earlier_total;
  double density_due; /* clock when the density is sent next (evolving.h) */
  double save_tried;  /* clock when a checkpoint was last tried */
  int64_t saved_step; /* of the last checkpoint; 0: none */
  bool finished;      /* nothing is left to go on from */
  bool save_failed;   /* the last try failed, with a warning */
} cli_run;

#endif
