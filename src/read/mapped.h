/* Fields of files on the plane of a map. */
#ifndef FG__MAPPED_H
#define FG__MAPPED_H

#include "read/format.h"

/* Reads a slab of a file's field as its format does, and lays it on the map that
 * options->map asks for: what stands on longitudes and latitudes is projected. A file's
 * own plane, and what is on no globe, stays as it is under "auto"; the latter is refused
 * by other maps. Statuses as fg_field_read. */
fg_status fg__field_read_mapped(fg_field **out, fg_context *context,
                                const fg__format *format, const fg__source *source,
                                const fg_read_options *options, fg__slab_index slab);

#endif
