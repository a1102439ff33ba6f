/* Fields of files, on the plane of a map where the options choose one. */
#ifndef FG__MAPPED_H
#define FG__MAPPED_H

#include "field/region.h"
#include "read/format.h"

/* A field as its file has it: on axes, or on the sphere. */
typedef struct fg__file_field {
  fg_field *field;    /* NULL: */
  fg__sphere *sphere; /* of points that lie on no two axes */
} fg__file_field;

/* Reads what a slab of the field needs of a file. To be cleared, also after a failure.
 * Statuses as fg_field_read. */
fg_status fg__file_field_read(fg__file_field *out, fg_context *context,
                              const fg__format *format, const fg__source *source,
                              const fg_read_options *options, fg__slab_index slab);

/* The part of a field on no map that options ask for; a cut by a plane has a region in
 * its own two axes. */
fg__field_region fg__region_asked(const fg_read_options *options);

/* Makes a slab of the field. Where options->map chooses a map, a field in longitude and
 * latitude is projected to it; a file's own plane stays as it is under "auto" alone, and
 * what is on no globe is then left, too, but refused by other maps. Without a map the
 * sphere is sampled onto longitudes and latitudes. May take over samples->field. Statuses
 * as fg_field_read. */
fg_status fg__file_field_place(fg_field **out, fg_context *context,
                               fg__file_field *samples, const char *path,
                               const fg_read_options *options, fg__slab_index slab);
void fg__file_field_clear(fg__file_field *samples);

#endif
