/* The lengths and weights of a placement of N icons: everything that is a share of the
 * fair-share length. docs/method/placement.md gives the energy and the reasons. */
#ifndef FG__PLACE_SCALE_H
#define FG__PLACE_SCALE_H

#include "place/domain/domain.h"

typedef struct fg__place_scale {
  int dimension, count;
  double lambda;      /* (|domain| / N)^(1/dimension), without axes it is longer than */
  double cell;        /* of the raster on which readers are evaluated */
  double origin[3];   /* of the raster: its one cell is in the middle of a thin axis */
  double sampling;    /* along a line */
  double reach;       /* R: readers take nothing from an icon farther away */
  double clearance;   /* least distance to a wall */
  double shortest;    /* least length of a line */
  double longest;     /* greatest sum of both ways (line.h) */
  double first_way;   /* each way of a new icon */
  double turning;     /* greatest turn on either side of the seed, radians */
  double crowding;    /* mu: penalty for lines that lie close together, */
  double crowd_range; /* s: as a Gaussian of this width */
  double ends;        /* chi: penalty for an end that lies on another line, */
  double end_gap;     /* which falls to 0 at this distance */
  double diffusion;   /* weight of the diffusion reader beside the others' 1 */
  double touch;       /* tau: penalty for a length lambda that lies on another line, */
  double touch_gap;   /* which falls to 0 at this distance */
  double far;         /* kappa: weight of the distance to the nearest line */
  double brevity;     /* nu: penalty for short lines */
  double ink;         /* p: penalty for length, */
  double first_ink;   /* which begins with this */
  bool free;          /* each icon has a length of its own */
} fg__place_scale;

/* How finely readers are evaluated: in a step of a chain of scales that is not its last
 * on larger cells in 2D. */
typedef enum fg__place_grain { FG__PLACE_FINE, FG__PLACE_COARSE } fg__place_grain;

fg__place_scale fg__place_scale_of(const fg__place_domain *domain, int count, bool free,
                                   fg__place_grain grain);

/* Lowers the least length of lines; false where it is as low as it may be. */
bool fg__place_shorten(fg__place_scale *scale);

#endif
