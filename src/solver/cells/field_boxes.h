/* Tensors of a block from a field that ranks share. */
#ifndef FG__FIELD_BOXES_H
#define FG__FIELD_BOXES_H

#include "grid/field_slabs.h"
#include "solver/cells/cells.h"

/* Asks the law of a recipe for all cells round this rank's block, so that
 * fg__cells_for_box can do without the field: layer by layer, from windows that are each
 * about a quarter as large as this rank's part. Where the field is whole *out becomes
 * empty, and nothing is done. Collective. MEMORY, UNSUPPORTED (see fg__field_windows),
 * the statuses of the law. */
fg_status fg__wide_of_block(fg__wide_tensor *out, fg_context *context,
                            const fg__tensor_recipe *recipe,
                            const fg__partition *partition);

#endif
