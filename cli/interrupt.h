/* SIGINT, SIGTERM and SIGHUP: the first stops the evolution after its step, the second
 * also the drawing. SIGBUS: see below. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include "program.h"

/* Starts to handle signals, except ignored ones. The first signal stops work of this
 * context. */
void interrupt_start(fg_context *first);

/* Sets the context that the second signal stops; NULL: none. */
void interrupt_second(fg_context *second);

/* Whether the first signal from now on also stops the second context. */
void interrupt_second_at_once(bool at_once);

/* Whether a signal has arrived, and how many. */
bool interrupt_came(void);
int interrupt_count(void);

/* From here on signals do not stop any context. */
void interrupt_end(void);

/* Files are mapped into memory, and reading one beyond its end is a SIGBUS: from here on
 * it ends the program with EXIT_FAILED and the file's name. */
void interrupt_at_lost_bytes(void);

#endif
