/* Inputs that are read in a child process.
 *
 * HDF5 (under NetCDF-4) can crash on damaged metadata, or allocate any amount of memory;
 * so can ecCodes on damaged messages. A child process therefore reads files of these
 * kinds and answers for them; what it finds comes over a socket. */
#ifndef FG__ISOLATE_H
#define FG__ISOLATE_H

#include "read/input.h"

/* Finds which library is to be isolated, if any. */
void fg__isolation_find(fg__isolation *out, const fg_input *input);

/* Answers a question in the child process, which starts with the first one; in this
 * process where there can be none. FILE_ACCESS: the library did not survive, for this
 * question or one before. */
fg_status fg__isolation_ask(fg__answer *out, fg_context *context, fg_input *input,
                            const fg__question *question);
void fg__isolation_end(fg__isolation *isolation);

#endif
