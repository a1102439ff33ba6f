/* Fields of files, on the plane of a map where the options choose one. */
#ifndef FG__MAPPED_H
#define FG__MAPPED_H

#include "read/format.h"

/* Reads a slab of a file's field as its format does. Where options->map chooses a map,
 * a field in longitude and latitude is laid on it; a file's own plane stays as it
 * is under "auto" alone, and what is on no globe is then left, too, but refused by other
 * maps. Without a map points on no two axes are sampled onto such ones. Statuses as
 * fg_field_read. */
fg_status fg__field_read_known(fg_field **out, fg_context *context,
                               const fg__format *format, const fg__source *source,
                               const fg_read_options *options, fg__slab_index slab);

#endif
