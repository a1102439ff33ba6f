/* The one source of the inner loops; see kernel.h. Included by generic_*.c, avx2_*.c and
 * avx512_*.c only, each of which is compiled for one vector width. */
#include "solver/kernel/boxes.h"
#include "solver/kernel/coarse_space.h"
#include "solver/kernel/pass.h"
#include "solver/kernel/sums.h"
#include "solver/kernel/sweep.h"

const fg__kernel FG__KERNEL = {.name = FG__KERNEL_NAME,
                               .dimension = FG__DIMENSION,
                               .smooth = smooth,
                               .smooth_linear = smooth_linear,
                               .restrict_residuals = restrict_residuals,
                               .smooth_restrict_linear = smooth_restrict_linear,
                               .find_scale = find_scale,
                               .find_curvature = find_curvature,
                               .find_relaxation = find_relaxation,
                               .unscale = unscale,
                               .correct_smooth = correct_smooth,
                               .correct_smooth_linear = correct_smooth_linear,
                               .correct_smooth_restrict = correct_smooth_restrict,
                               .evaluate = evaluate,
                               .explicit_part = explicit_part,
                               .subtract_potential_derivative =
                                   subtract_potential_derivative,
                               .changes = changes,
                               .extrapolate = extrapolate,
                               .predict = predict,
                               .shift = shift,
                               .smooth_rows_of = smooth_rows_of,
                               .find_residuals = find_residuals,
                               .restrict_arrays = restrict_arrays,
                               .correct = correct};
