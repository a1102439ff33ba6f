/* Fields read in slabs: ranks share the samples of one field. Included by flowgrain.h. */
#ifndef FLOWGRAIN_SLABS_H
#define FLOWGRAIN_SLABS_H

#include "flowgrain/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Reads slab `slab` of `slabs` of a field: rows along its last axis, evenly divided, and
 * the next row where there is one. Sizes, axes and words are the whole field's;
 * fg_field_join checks what concerns all slabs. An analytic field, one with fewer rows
 * than slabs, and the only slab of one are read whole. Not collective. ARGUMENT (no such
 * slab); statuses as fg_field_read. */
FG_API fg_status fg_field_read_slab(fg_field **out, fg_context *context,
                                    const char *input, const fg_read_options *options,
                                    int slab, int slabs);

/* Makes one field of the slabs that all ranks have read, slab `rank` each: checks it as
 * fg_field_read does, on all ranks. From then on it can be given to fg_evolution_create
 * and, with a distributed density, to fg_icons_create, which exchange its samples. On
 * rank 0 it can be drawn. Functions that evaluate or write it use the rank's rows alone,
 * or fail. A field that one rank holds whole stays as it is. Collective. ARGUMENT (slabs
 * of different fields), FILE_FORMAT, MEMORY, MPI. */
FG_API fg_status fg_field_join(fg_context *context, fg_field *field);

/* True when other ranks hold samples of the field that this one does not. Its contents
 * then have the samples of its own rows alone: those from row *first on along the last
 * axis, *count of them (both may be NULL). */
FG_API bool fg_field_is_slab(const fg_field *field, int *first, int *count);

#ifdef __cplusplus
}
#endif

#endif
