/* Streamlines in arc length, by Bogacki and Shampine's embedded 3(2) pair (1989). */
#ifndef FG__PLACE_STREAMLINE_H
#define FG__PLACE_STREAMLINE_H

#include "place/domain/domain.h"

typedef struct fg__place_tip {
  double position[3];
  double direction[3]; /* the flow's, whichever way the tip goes */
} fg__place_tip;

typedef struct fg__place_tracing {
  const fg__place_domain *domain;
  double error;        /* of a step, input coordinates */
  double step;         /* the last accepted one */
  double least_cosine; /* of the angle by which a move may turn */
} fg__place_tracing;

/* Moves a tip by an arc length, negative against the flow, in as many steps as it takes.
 * False where it leaves the domain, meets a place where the flow reverses or turns too
 * far. */
bool fg__place_move(fg__place_tracing *with, fg__place_tip *out,
                    const fg__place_tip *from, double way);

#endif
