/* Several scales in one figure. */
#ifndef DRAWN_PANELS_H
#define DRAWN_PANELS_H

#include "drawn/scale.h"

/* Runs and what is drawn of them. */
typedef struct drawn_panels {
  drawn_run **run;
  int runs;
  drawn_scale *scale;
  int scales;
} drawn_panels;

/* Opens what the operands name: of each run, of each finished run of a series, the scales
 * that the options choose; files of icons. Returns an exit code. */
int drawn_panels_open(drawn_panels *out, const draw_settings *settings);
void drawn_panels_close(drawn_panels *panels);

/* Refuses labels that are neither one for all panels nor one for each. Returns an exit
 * code. */
int drawn_panels_check_labels(const drawn_panels *panels, const draw_settings *settings);

/* Reads what is drawn. Returns an exit code. */
int drawn_panels_read(drawn_panels *panels, fg_context *context,
                      const draw_settings *settings);

/* Draws all, once they are read, in one figure. */
fg_status drawn_panels_draw(const drawn_panels *panels, fg_context *context,
                            const draw_settings *settings, const char *path);

#endif
