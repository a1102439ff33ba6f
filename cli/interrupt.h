/* SIGINT, SIGTERM and SIGHUP: the first asks the evolution to end its step and stop, the
 * second also the drawing. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include "program.h"

/* Begins to take signals, except for those that are ignored. What belongs to the context
 * is stopped by the first. */
void interrupt_start(fg_context *first);

/* What the second stops; NULL: nothing. */
void interrupt_second(fg_context *second);

/* Whether the first signal from now on stops that, too. */
void interrupt_second_at_once(bool at_once);

/* Whether a signal has come, and how many. */
bool interrupt_came(void);
int interrupt_count(void);

/* From here on signals stop nothing. */
void interrupt_end(void);

#endif
