/* Checkpoints: an evolution resumes in other processes, on any number of ranks, with the
 * same bits. All ranks must see the file. */
#ifndef FLOWGRAIN_CHECKPOINT_H
#define FLOWGRAIN_CHECKPOINT_H

#include "flowgrain/evolution.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_checkpoint fg_checkpoint;

/* Writes the state of an evolution, and a text of the caller's own (NULL: ""), which
 * fg_checkpoint_note gives back (that of rank 0). The file takes its name when it is
 * whole and on the disk; what had the name before is then called PATH.previous. On
 * failure both stay as they were and the evolution can go on. Collective. FILE_ACCESS,
 * ARGUMENT, MEMORY. */
FG_API fg_status fg_evolution_save(const fg_evolution *evolution, const char *path,
                                   const char *note);

/* Opens a checkpoint and checks every byte of it. When it is damaged or not there,
 * PATH.previous is opened instead, and fg_checkpoint_damage says why. Collective.
 * FILE_ACCESS, FILE_FORMAT (both are damaged), UNSUPPORTED (another format), MEMORY. */
FG_API fg_status fg_checkpoint_open(fg_checkpoint **out, fg_context *context,
                                    const char *path);
FG_API void fg_checkpoint_destroy(fg_checkpoint *checkpoint);

/* The text that was given to fg_evolution_save, borrowed. */
FG_API const char *fg_checkpoint_note(const fg_checkpoint *checkpoint);

/* Why the previous checkpoint was opened, "PATH: damaged: ...", or "". */
FG_API const char *fg_checkpoint_damage(const fg_checkpoint *checkpoint);

/* Puts an evolution, just created from the same field with the same options (threads may
 * differ), into the state of a checkpoint, its mesh coarsened as often: every later step
 * is the same to the last bit as without the interruption. `step` becomes the last
 * accepted one; it counts no cycles and rejections. After a failure the evolution can
 * only be destroyed. Collective. ARGUMENT (another field or option: the message names it
 * with both values), UNSUPPORTED (written by another version), FILE_ACCESS, FILE_FORMAT,
 * MEMORY. */
FG_API fg_status fg_evolution_resume(fg_evolution *evolution, fg_step *step,
                                     const fg_checkpoint *checkpoint);

#ifdef __cplusplus
}
#endif

#endif
