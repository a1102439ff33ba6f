/* Fields read by parts: several ranks share the samples of one field, so that none holds
 * them all. Included by flowgrain.h. */
#ifndef FLOWGRAIN_PARTS_H
#define FLOWGRAIN_PARTS_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads part `part` of `parts` of a field: rows along its last axis, evenly dealt, and
 * the next row where there is one. Sizes, axes and words are the whole field's; what has
 * to be seen in all parts together is left to fg_field_join. A synthetic field, one of
 * fewer rows than parts, and the only part of one come whole. Not collective. ARGUMENT
 * (no such part); statuses as fg_field_read. */
FG_API fg_status fg_field_read_part(fg_field **out, fg_context *context,
                                    const char *input, const fg_read_options *options,
                                    int part, int parts);

/* Makes one field of the parts that all ranks have read, part `rank` each: finds what
 * fg_field_read would have found wrong with it, and tells all. From then on it can be
 * given to fg_evolution_create and, with a shared density, to fg_icons_create, which hand
 * its samples round. On rank 0 it can be drawn. What asks it for a velocity, or writes
 * it, gets what its own rows hold or is refused. A field that is whole stays as it is.
 * Collective. ARGUMENT (parts of different fields), FILE_FORMAT, MEMORY, MPI. */
FG_API fg_status fg_field_join(fg_context *context, fg_field *field);

/* True when other ranks hold samples of the field that this one does not. Its contents
 * then have the samples of its own rows alone: those from row *first on along the last
 * axis, *count of them (both may be NULL). */
FG_API bool fg_field_is_part(const fg_field *field, int *first, int *count);

#ifdef __cplusplus
}
#endif

#endif
