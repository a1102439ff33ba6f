/* Titles of fields, for captions. */
#ifndef FG__TITLE_H
#define FG__TITLE_H

#include "read/format.h"

/* Whether a title tells what a field is: not so names of its components, one or two
 * letters, or words as "vectors". */
bool fg__title_tells(const char *title, const fg_field_arrays *field);

/* Gives a field whose title does not tell that the name of its file, without ending.
 * MEMORY. */
fg_status fg__title_from_file(fg_field *field, fg_context *context,
                              const fg__source *source, const fg_read_options *options);

#endif
