/* The thickness of solid arrows that no cluster bounds. */
#ifndef FG__SLENDER_H
#define FG__SLENDER_H

#include "base/context.h"

/* Gives an icon in 3D the widths of a slender arrow. lambda: the side of the cube that is
 * each icon's fair share, (volume / icons)^(1/3), input coordinates: the head is
 * 0.2 lambda long, less on arrows shorter than half of lambda and where the line under it
 * turns. The body's radius stays below 0.7 of the curve's. An icon without length, or a
 * lambda that is not positive, gives widths of 0. */
void fg__solid_set_slender(fg_icon *icon, double lambda);

/* Makes an arrow thinner that is more than half as thick again; it stays inside its
 * former self. Without width nothing is done. */
void fg__solid_slim(fg_icon *icon, double lambda);

#endif
