/* Standard input ("-"), a format given by option, and the memory limit of a field: the
 * same for all contexts of the program. */
#ifndef INPUTS_H
#define INPUTS_H

#include "option/settings.h"

/* Stores a command's settings, and reads standard input where it is an input. Refuses a
 * terminal, too many bytes, and standard input with several ranks. Returns an exit
 * code. */
int inputs_prepare(const input_settings *settings, const char *const *inputs, int count,
                   int ranks);

/* Passes these to a context (fg_context_set_input). */
void inputs_give(fg_context *context);

/* Creates a context with these, or prints an error. Returns an exit code. */
int create_context(fg_context **out);

#endif
