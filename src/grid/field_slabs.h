/* A field whose samples several ranks share: facts about all of it, and windows of it. */
#ifndef FG__FIELD_SLABS_H
#define FG__FIELD_SLABS_H

#include "field/slab.h"
#include "grid/exchange/regions.h"

/* fg_field_join for given ranks. */
fg_status fg__field_join(fg_context *context, const fg__ranks *ranks, fg_field *field);

/* Makes out[n] of region n, in samples, where that is this rank's; other entries become
 * NULL. The regions are the same on all ranks and begin within the grid; the field is a
 * joined slab. End each with fg_field_destroy, before the field. Collective. MEMORY,
 * UNSUPPORTED (more than 2^31 samples to or from a rank). */
fg_status fg__field_windows(fg_field *out[], fg_context *context, const fg__ranks *ranks,
                            const fg_field *field, const fg__region *region, int count);

/* Ends `count` windows and the array of them; NULL is accepted. */
void fg__field_windows_destroy(fg_field **window, int count);

/* Fails, on all ranks, unless the field is whole or a joined slab of as many as there are
 * ranks. ARGUMENT. */
fg_status fg__field_check_shared(fg_context *context, const fg__ranks *ranks,
                                 const fg_field *field);

#endif
