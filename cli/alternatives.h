/* Errors of reading, with the times and levels that an input has besides. */
#ifndef ALTERNATIVES_H
#define ALTERNATIVES_H

#include "option/settings.h"

/* Prints the error of reading a field. Where it is what the samples are (all missing or
 * zero), advises another time or level, if there is one. Returns the exit code. input:
 * NULL, it was not opened. */
int complain_of_field(const fg_context *failed, fg_status status, fg_input *input,
                      const reading_settings *settings);

#endif
