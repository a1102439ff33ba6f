/* Standard input ("-"), a format given by option, and the memory limit of a field: the
 * same for all contexts of the program. */
#ifndef INPUTS_H
#define INPUTS_H

#include "option/settings.h"

/* Stores a command's settings, and reads standard input where it is an input. Refuses a
 * terminal, too many bytes, and standard input with several ranks. Returns an exit
 * code. */
int inputs_prepare(const input_settings *settings, const char *const *inputs, int count);

/* Passes these to a context (fg_context_set_input). */
void inputs_give(fg_context *context);

/* Bytes of standard input; NULL where no input is "-". */
const unsigned char *inputs_bytes(size_t *size);

bool inputs_is_standard(const char *input);

/* Name of an input in messages. */
const char *inputs_name(const char *input);

/* Parses a number of bytes, at least 1: "500M", "1.5GB", "2e9". False for other text. */
bool inputs_read_size(double *out, const char *text);

#endif
