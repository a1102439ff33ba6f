/* The times and levels that an input has besides the one that is read. */
#ifndef ALTERNATIVES_H
#define ALTERNATIVES_H

#include "program.h"

/* Counts the times and levels of the vector that the options choose; leaves both as they
 * are where that is unknown. */
void count_alternatives(int *times, int *levels, const char *input,
                        const fg_read_options *options);

/* After reading has failed by what the samples are (all missing or zero), and without a
 * hint: advises another time or level where there is one. */
void advise_alternatives(const fg_context *failed, fg_status status, const char *input,
                         const fg_read_options *options);

#endif
