/* Draws scales (icons, tables, pictures) while the evolution continues. */
#ifndef RUN_DRAWING_H
#define RUN_DRAWING_H

#include "run/scale_maker.h"

typedef struct cli_drawing cli_drawing;

/* Starts a worker thread, or none with `threads` 1: then drawing_keep_up and the
 * functions that wait do the work. Field and output are borrowed; if the field is a slab,
 * the whole one is read again. Returns an exit code. */
int drawing_start(cli_drawing **out, const run_settings *settings, const fg_field *field,
                  const cli_output *output);

/* Adds a snapshot as the next scale and takes ownership of its parts. False: an earlier
 * scale has failed, or memory is lacking. */
bool drawing_add(cli_drawing *drawing, const scale_snapshot *snapshot, const int *wanted,
                 int wanted_count);

/* Without a worker thread: draws what was added. False after a failure. */
bool drawing_keep_up(cli_drawing *drawing);

/* Waits until all added scales are drawn. False after a failure. */
bool drawing_wait(cli_drawing *drawing);

/* Restores `count` scales drawn before, their common look, and the seconds they took. To
 * be called before drawing_add. */
void drawing_restore(cli_drawing *drawing, const scale_result *results, int count,
                     const common_look *look, double icon_seconds,
                     double picture_seconds);

/* From here on an interrupt drops unfinished scales; to be called when the evolution has
 * ended. */
void drawing_heed_interrupts(cli_drawing *drawing);
bool drawing_was_cut(const cli_drawing *drawing); /* after drawing_finish */

/* Waits until all is drawn or the time has passed; returns whether all is drawn. */
bool drawing_wait_for(cli_drawing *drawing, double seconds);

/* Waits until all is drawn; a failure is recorded in the context. */
fg_status drawing_finish(cli_drawing *drawing);

/* Path of the next scale's density; NULL: no memory. */
char *drawing_density_path(const cli_drawing *drawing);

int drawing_count(const cli_drawing *drawing); /* scales added */
int drawing_ready(cli_drawing *drawing);       /* scales drawn */
bool drawing_failed(cli_drawing *drawing);     /* drawing_finish says why */
const scale_result *drawing_result(const cli_drawing *drawing, int index);

/* The whole field. */
const fg_field *drawing_field(const cli_drawing *drawing);

const common_look *drawing_look(const cli_drawing *drawing);
double drawing_icon_seconds(const cli_drawing *drawing);
double drawing_picture_seconds(const cli_drawing *drawing);
fg_context *drawing_context(const cli_drawing *drawing);
void drawing_destroy(cli_drawing *drawing);

#endif
