/* Standard input, called "-", the format that is forced, and the memory that a field may
 * take: the same for all contexts of the program. */
#ifndef INPUTS_H
#define INPUTS_H

#include "option/settings.h"

/* Takes a command's settings, and reads standard input where that is an input. Complains
 * of a terminal, of too much, and on several ranks; an exit code. */
int inputs_prepare(const input_settings *settings, const char *const *inputs, int count);

/* Sets these for a context (fg_context_set_input). */
void inputs_give(fg_context *context);

/* Bytes of standard input; NULL where it is no input. */
const unsigned char *inputs_bytes(size_t *size);

bool inputs_is_standard(const char *input);

/* How an input is called in messages. */
const char *inputs_name(const char *input);

/* Reads a number of bytes: "500M", "1.5GB", "2e9", at least 1; false for other words. */
bool inputs_read_size(double *out, const char *text);

#endif
