/* Icons, tables and pictures of the scales, made while the evolution goes on. */
#ifndef RUN_DRAWING_H
#define RUN_DRAWING_H

#include "run/scale_maker.h"

typedef struct cli_drawing cli_drawing;

/* Starts a worker thread, or with `threads` 1 none: then drawing_keep_up and those that
 * wait draw. The field and output are borrowed; of a part of a field the whole is read
 * again. Returns an exit code. */
int drawing_start(cli_drawing **out, const run_settings *settings, const fg_field *field,
                  const cli_output *output);

/* Takes over a snapshot: the next scale. False: an earlier one has failed, or there is no
 * memory; its parts are destroyed all the same. */
bool drawing_add(cli_drawing *drawing, const scale_snapshot *snapshot, const int *wanted,
                 int wanted_count);

/* Without a worker thread: draws what was added. False: it has failed. */
bool drawing_keep_up(cli_drawing *drawing);

/* Waits until all that was added is drawn. False: it has failed. */
bool drawing_wait(cli_drawing *drawing);

/* Takes over what was drawn before: `count` scales, what they have in common, and the
 * seconds it took. Before anything is added. */
void drawing_restore(cli_drawing *drawing, const scale_result *results, int count,
                     const common_look *look, double icon_seconds,
                     double picture_seconds);

/* From here on an interrupt leaves out the scales that are not finished; once the
 * evolution has ended nothing else would stop. */
void drawing_heed_interrupts(cli_drawing *drawing);
bool drawing_was_cut(const cli_drawing *drawing); /* after drawing_finish */

/* Waits until all is drawn or some time has passed; returns whether all is. */
bool drawing_wait_for(cli_drawing *drawing, double seconds);

/* Waits until all is drawn; the failure, if there was one, is in the context. */
fg_status drawing_finish(cli_drawing *drawing);

/* The file of the next scale's density; NULL: no memory. */
char *drawing_density_path(const cli_drawing *drawing);

int drawing_count(const cli_drawing *drawing); /* scales added */
int drawing_ready(cli_drawing *drawing);       /* scales drawn */
bool drawing_failed(cli_drawing *drawing);     /* drawing_finish says why */
const scale_result *drawing_result(const cli_drawing *drawing, int index);

/* The field, whole. */
const fg_field *drawing_field(const cli_drawing *drawing);

const common_look *drawing_look(const cli_drawing *drawing);
double drawing_icon_seconds(const cli_drawing *drawing);
double drawing_picture_seconds(const cli_drawing *drawing);
fg_context *drawing_context(const cli_drawing *drawing);
void drawing_destroy(cli_drawing *drawing);

#endif
