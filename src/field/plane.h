/* Planes in space and coordinates in them. */
#ifndef FG__PLANE_H
#define FG__PLANE_H

#include "base/context.h"
#include "base/vector.h"

/* Two directions of length 1 in a plane, perpendicular to each other, and the axes of
 * space that they are nearest to, ascending. A point's coordinates in the plane are its
 * products with the two, so that a direction which is an axis keeps that axis'
 * coordinates. */
typedef struct fg__plane_basis {
  double direction[2][3];
  int axis[2];
  double normal[3]; /* of length 1 */
  int across;       /* the remaining axis */
} fg__plane_basis;

/* Of the axes the one nearest to the normal is left out. Of the other two, the one nearer
 * to the plane (of equals the first) gives its projection as a direction, and the second
 * direction is perpendicular to that, on the other axis' side. False for a normal of no
 * length, or one that is no number. */
bool fg__plane_basis_of(fg__plane_basis *out, const double normal[3]);

/* Whether a direction of the basis is the very axis it is nearest to. */
bool fg__plane_is_axis(const fg__plane_basis *basis, int k);

#endif
