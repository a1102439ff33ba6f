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
  int due;       /* numbers that the present state is the scale of, still to be taken */
  bool rest;     /* the present state is one more, of no number */
  bool closed;
  int taken, last_clusters;
  double max_time;
  int64_t max_steps;
  fg_run_outcome outcome;
  bool even_start;
  const fg_icons *first_icons; /* NULL: they are placed */
  fg_placement_options how;

  /* of fg_run_next */
  fg_placement *placement; /* NULL: not begun */
  fg_run_scale scale;
  fg_density *density;
  fg_icons *icons, *finer;
};

/* Why the present state ends it, if it does. */
fg_run_outcome fg__run_ending(const fg_run *run);

#endif
