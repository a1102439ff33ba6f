/* Interpolation from the next coarser level on a level with a mask.
 *
 * A node between coarse nodes follows those that the Laplacian couples it to, straight or
 * by way of its neighbours between them, each by its share of the couplings: nothing is
 * interpolated across a wall, so that parts of the domain, and what narrow passages join,
 * stay apart on coarse levels (after Alcouffe, Brandt, Dendy and Painter 1981, The
 * multi-grid method for the diffusion equation with strongly discontinuous coefficients,
 * and Dendy 1982, Black box multigrid). Far from the mask this is multilinear. */
#ifndef FG__INTERPOLATION_H
#define FG__INTERPOLATION_H

#include "solver/level.h"

/* Finds level->interpolation at the own nodes that are odd along `stage` axes, from the
 * Laplacian and what was found for less, ghosts included: stages run from 0 to the number
 * of dimensions. */
void fg__interpolation_find(const fg__level *level, int stage);

/* Corrects copied ghosts beyond natural boundaries: they follow the mirror images of
 * their sources' coarse nodes. */
void fg__interpolation_mirror(const fg__level *level);

#endif
