/* A figure of several scales as panels. */
#ifndef DRAWN_PANELS_H
#define DRAWN_PANELS_H

#include "drawn/scale.h"

/* Runs, and the scales of them that are drawn. */
typedef struct drawn_panels {
  drawn_run **run;
  int runs;
  drawn_scale *scale;
  int scales;
} drawn_panels;

/* Opens the operands: runs, series of runs (all finished ones), and files of icons. Of
 * each run the scales that the options choose. Returns an exit code. */
int drawn_panels_open(drawn_panels *out, const draw_settings *settings);
void drawn_panels_close(drawn_panels *panels);

/* Refuses labels unless there is one for all panels or one for each. Returns an exit
 * code. */
int drawn_panels_check_labels(const drawn_panels *panels, const draw_settings *settings);

/* Reads all data of the panels. Returns an exit code. */
int drawn_panels_read(drawn_panels *panels, fg_context *context,
                      const draw_settings *settings);

/* Draws the figure after drawn_panels_read. */
fg_status drawn_panels_draw(const drawn_panels *panels, fg_context *context,
                            const draw_settings *settings, const char *path);

#endif
