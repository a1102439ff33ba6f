/* What the boxes of a mesh see of a field that ranks share. */
#ifndef FG__FIELD_BOXES_H
#define FG__FIELD_BOXES_H

#include "evolve/cells.h"
#include "mesh/field_parts.h"

/* Gives each of this rank's boxes of the finest level a window of recipe->field that
 * holds all that fg__cells_for_box takes from it; *out is NULL when the field is whole.
 * End with fg__field_windows_destroy. Collective. MEMORY, UNSUPPORTED (see
 * fg__field_windows). */
fg_status fg__field_of_boxes(fg_field ***out, fg_context *context,
                             const fg__tensor_recipe *recipe,
                             const fg__partition *partition);

#endif
