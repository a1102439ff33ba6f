/* State of the command `run`, for the files that implement it. */
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
  fg_input *input; /* NULL: not opened yet, or read */
  fg_field *field;
  fg_tensors *tensors;  /* for the energy, or NULL */
  fg_run *scales;       /* NULL once the evolution has ended */
  fg_run_record record; /* copy of the scales' record, from then on */
  cli_drawing *drawing;
  cli_output output;
  char *checkpoint; /* path */
  cli_table table;  /* evolution.csv */
  cli_progress progress;
  run_facts facts;
  fg_step step;          /* the last accepted one */
  double start;          /* of the process */
  double evolving_since; /* by the process's clock */
  double earlier_evolve; /* seconds of the earlier runs that this one resumes */
  double earlier_total;
  double density_due; /* clock of the next density to be sent (evolving.h) */
  double save_tried;  /* clock of the last attempt to save a checkpoint */
  int64_t saved_step; /* of the last checkpoint; 0: none */
  bool finished;      /* no resume is possible or needed */
  bool save_failed;   /* the last attempt failed, with a warning */
} cli_run;

#endif
