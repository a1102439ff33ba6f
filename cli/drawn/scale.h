/* Scales of finished runs, read to be drawn. */
#ifndef DRAWN_SCALE_H
#define DRAWN_SCALE_H

#include "report/past_run.h"

/* A run; its scales share the field. */
typedef struct drawn_run {
  char *folder;
  cli_report report;
  fg_field *field; /* NULL until a scale was read */
} drawn_run;

/* A scale of a run, or icons of another file that are drawn on its field. */
typedef struct drawn_scale {
  drawn_run *run; /* borrowed */
  int index;      /* -1: icons of another file */
  const char *file;
  fg_icons *icons;
  fg_density *density; /* of its clusters, if the picture needs them */
  fg_density *regions; /* of placed arrows, if the picture shows them */
} drawn_scale;

/* Reads the report of the run in a folder. Returns an exit code. */
int drawn_run_open(drawn_run *out, const char *folder);
void drawn_run_close(drawn_run *run);

/* The map that is drawn on. What is not given for another than the run's is as in the
 * run, but for the middle, which follows from what is shown. */
fg_map_options drawn_run_map(const drawn_run *run, const draw_settings *settings);

/* The index of the scale that the options choose, with at most `arrows` or `clusters`
 * where these are not 0; -1 after an error was printed. */
int drawn_scale_choose(const drawn_run *run, const draw_settings *settings, int arrows,
                       int clusters);

/* Reads all that is drawn of a scale, with the run's field. The scale's run, and its
 * index or file, are set before. Returns an exit code. */
int drawn_scale_read(drawn_scale *scale, fg_context *context,
                     const draw_settings *settings);
void drawn_scale_clear(drawn_scale *scale);

/* Refuses options that need the density on another map than the run's. Returns an exit
 * code. */
int drawn_check_map(const draw_settings *settings);

/* The simulated time of a scale of clusters; 0 for placed arrows. */
double drawn_scale_time(const drawn_scale *scale);

#endif
