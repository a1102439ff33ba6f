/* A first reading in a process of its own. */
#ifndef REHEARSE_H
#define REHEARSE_H

#include "program.h"

/* Does the work in a child process, silently and within some seconds of CPU time; returns
 * the number of the signal that ended it, or 0. Must be called before there are threads.
 */
int signal_that_ends(void (*work)(void *), void *data, unsigned seconds);

/* The HDF5 library under NetCDF-4 can crash on damaged metadata. So a file of that kind
 * is first read by a child process: when that dies, complains and returns EXIT_FAILED,
 * else EXIT_DONE. With options as fg_field_read would, with NULL as fg_inventory_read. */
int rehearse_reading(const char *input, const fg_read_options *options);

/* The same for fg_field_read_part; options must not be NULL. */
int rehearse_reading_part(const char *input, const fg_read_options *options, int part,
                          int parts);

#endif
