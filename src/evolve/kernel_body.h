/* The one source of the inner loops; see kernel.h. Included by kernel_*.c only, each of
 * which is compiled for one vector width. */
#include "evolve/kernel_boxes.h"
#include "evolve/kernel_sums.h"
#include "evolve/kernel_sweep.h"
#include "evolve/kernel_transfer.h"

const fg__kernel FG__KERNEL = {.name = FG__KERNEL_NAME,
                               .dimension = FG__DIMENSION,
                               .smooth = smooth,
                               .smooth_linear = smooth_linear,
                               .smooth_restrict = smooth_restrict,
                               .smooth_restrict_linear = smooth_restrict_linear,
                               .prolong_smooth = prolong_smooth,
                               .prolong_smooth_linear = prolong_smooth_linear,
                               .prolong_array = prolong_array,
                               .restrict_defect = restrict_defect,
                               .evaluate = evaluate,
                               .explicit_part = explicit_part,
                               .subtract_wells = subtract_wells,
                               .changes = changes,
                               .extrapolate = extrapolate,
                               .shift = shift,
                               .smooth_one_colour = smooth_one_colour,
                               .find_residuals = find_residuals,
                               .find_defect = find_defect,
                               .restrict_arrays = restrict_arrays};
