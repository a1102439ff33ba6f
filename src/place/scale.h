/* The lengths and weights of a placement of N icons: everything that is a share of the
 * fair-share length. docs/method/placement.md gives the energy and the reasons. */
#ifndef FG__PLACE_SCALE_H
#define FG__PLACE_SCALE_H

#include "place/domain.h"

typedef struct fg__place_scale {
  int dimension, count;
  double lambda;   /* (|domain| / N)^(1/dimension) */
  double cell;     /* of the raster on which readers are asked */
  double sampling; /* along a line */
  double reach;    /* R: what an icon tells, and no farther */
  double clearance, shortest;
  double turning;     /* either way from the seed, radians */
  double longest;     /* the sum of both ways */
  double crowding;    /* mu */
  double crowd_range; /* s */
  double ends;        /* price of an end that lies on another line, */
  double end_gap;     /* and falls to 0 at this distance */
  double diffusion;   /* what a degree of the diffusion reader counts */
  double touch;       /* price of a line as long as lambda that lies on another one, */
  double touch_gap;   /* and falls to 0 at this distance */
  double far;         /* kappa: price of distance */
  double brevity;     /* nu */
  double ink;         /* p */
  bool free;          /* each icon has a length of its own */
} fg__place_scale;

/* `measure` is what fg__place_domain calls so. */
fg__place_scale fg__place_scale_of(int dimension, int count, double measure, bool free);

/* Allows shorter lines; false where they are as short as may be. */
bool fg__place_shorten(fg__place_scale *scale);

#endif
