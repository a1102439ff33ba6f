/* Where a field is missing. */
#ifndef FG__MASK_H
#define FG__MASK_H

#include "base/context.h"

/* Whether a sample of a field in 2D is there: any of a whole field, and on rank 0 any of
 * a joined one. */
bool fg__field_sample_is_valid(const fg_field *field, int i, int j);

#endif
