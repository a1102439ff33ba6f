/* The inside of a run, for the files that make it up. */
#ifndef FG__RUN_H
#define FG__RUN_H

#include "run/plan.h"

struct fg_run {
  fg_context *context;
  const fg_field *field;
  fg_evolution *evolution;
  fg__plan plan;
  fg_step step;  /* the last accepted one */
  fg_step first; /* the first with a number of clusters; step 0: none yet */
  int pending; /* wanted numbers that the present state is the scale of, not taken yet */
  bool extra;  /* the present state is one more scale, of no wanted number */
  bool closed; /* by fg_run_close */
  int taken;   /* scales */
  int last_clusters; /* of the last one taken */
  int64_t last_step; /* likewise */
  double max_time;
  int64_t max_steps;
  fg_run_outcome outcome;
  bool even_start;
  const fg_icons *first_icons; /* NULL: they are placed */
  fg_placement_options placement_options;

  /* of fg_run_next */
  fg_placement *placement; /* NULL: not begun */
  fg_run_scale scale;
  fg_density *density;
  fg_icons *icons, *finer;
};

/* Why the present state ends the run; FG_RUN_GO_ON: it does not. */
fg_run_outcome fg__run_ending(const fg_run *run);

#endif
