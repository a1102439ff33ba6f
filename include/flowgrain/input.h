/* Inputs that are opened once for all that is asked of them. */
#ifndef FLOWGRAIN_INPUT_H
#define FLOWGRAIN_INPUT_H

#include "flowgrain/inventory.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fg_input fg_input;

/* Opens an input to read one vector of it, at any of its times and levels: those of the
 * options do not count. input and options->... are borrowed until fg_input_close; options
 * may be NULL. The calls below return what the functions for one question return, but
 * the file is opened, and the vector in it found, once. Statuses as fg_field_read. */
FG_API fg_status fg_input_open(fg_input **out, fg_context *context, const char *input,
                               const fg_read_options *options);
FG_API void fg_input_close(fg_input *input);

/* The vector, listed as by fg_inventory_read_chosen; the inventory is the input's own. */
FG_API fg_status fg_input_inventory(const fg_inventory **out, fg_context *context,
                                    fg_input *input);

/* All vectors of the file, likewise as by fg_inventory_read. */
FG_API fg_status fg_input_vectors(const fg_inventory **out, fg_context *context,
                                  fg_input *input);

/* Its defaults (fg_read_defaults_find). */
FG_API fg_status fg_input_defaults(fg_read_defaults *out, fg_context *context,
                                   fg_input *input);

/* Its field at a time and level (fg_field_read), or a slab of it (fg_field_read_slab);
 * slab 0 of 1 is all. */
FG_API fg_status fg_input_field(fg_field **out, fg_context *context, fg_input *input,
                                int time, int level, int slab, int slabs);

#ifdef __cplusplus
}
#endif

#endif
