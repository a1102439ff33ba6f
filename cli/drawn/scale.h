/* Scales of finished runs, read to be drawn again. */
#ifndef DRAWN_SCALE_H
#define DRAWN_SCALE_H

#include "report/past_run.h"

/* A run, whose field several of its scales share. */
typedef struct drawn_run {
  char *folder;
  cli_report report;
  fg_field *field; /* NULL until a scale was read */
} drawn_run;

/* A scale of it, or icons from another file that are drawn on its field. */
typedef struct drawn_scale {
  drawn_run *run; /* borrowed */
  int index;      /* -1: of another file */
  const char *file;
  fg_icons *icons;
  fg_density *density; /* of its clusters, where the picture needs it */
  fg_density *regions; /* that placed arrows stand for, likewise */
} drawn_scale;

/* Reads the report of the run in a folder. Returns an exit code. */
int drawn_run_open(drawn_run *out, const char *folder);
void drawn_run_close(drawn_run *run);

/* The scale that the options choose, with at most `arrows` or `clusters` where these are
 * not 0; -1 after a complaint. */
int drawn_scale_choose(const drawn_run *run, const draw_settings *settings, int arrows,
                       int clusters);

/* Reads all that is drawn of a scale whose run, and index or file, are set, the run's
 * field too. Returns an exit code. */
int drawn_scale_read(drawn_scale *scale, fg_context *context,
                     const draw_settings *settings);
void drawn_scale_clear(drawn_scale *scale);

/* Refuses what needs the density of the run's own map on another. Returns an exit code.
 */
int drawn_check_map(const draw_settings *settings);

/* The simulated scale's time, which is one of clusters, not of placed arrows: then 0. */
double drawn_scale_time(const drawn_scale *scale);

#endif
