/* The domain of a placement: where the field has a direction, how far walls are, and how
 * much each point of it counts. It does not depend on the number of arrows. */
#ifndef FG__PLACE_DOMAIN_H
#define FG__PLACE_DOMAIN_H

#include "base/context.h"

/* A connected subdomain. */
typedef struct fg__place_subdomain {
  double measure; /* area or volume */
  double widest;  /* greatest clearance in it */
} fg__place_subdomain;

typedef struct fg__place_domain {
  const fg_field *field; /* without gaps */
  const fg_field *given;
  fg_field *filled; /* NULL: the given one has no gaps */
  int dimension;
  double low[3], high[3]; /* the box, input coordinates as all that follows */
  double data_step;       /* the smallest of the mean distances between samples */
  /* The map: square cells over the box. */
  int cells[3];
  double spacing;
  float *clearance; /* a cell: from its centre to the nearest wall, mask or frame; 0
                       outside the domain */
  int *subdomain;   /* a cell: which subdomain from 1 on, 0 outside */
  fg__place_subdomain *subdomains;
  int subdomain_count;
  double whole;     /* area or volume of the domain */
  int small_arrows; /* fair lengths are halved so often, where no longer lines fit */
  /* of what counts: less than the whole where half of it is dead or still */
  double measure;
  double top;              /* speed (field/still.h) */
  double fast;             /* speed exceeded by a twentieth */
  double root_mean_square; /* of speeds up to the top */
  bool rests;              /* some of the domain is still */
  bool slow;               /* more than half of the domain is (field/still.h) */
  bool dead;               /* and is a volume: speed weighs */
} fg__place_domain;

/* Maps the domain of a field; gaps (gaps.h) are no walls. The field must outlive it.
 * MEMORY, STOPPED. */
fg_status fg__place_domain_create(fg__place_domain *out, fg_context *context,
                                  const fg_field *field);
void fg__place_domain_clear(fg__place_domain *domain);

/* The field that lines go over: *out is NULL where that is the given one. MEMORY. */
fg_status fg__place_without_gaps(fg_field **out, fg_context *context,
                                 const fg_field *field);

/* The unit direction of the flow as seen on the page; false outside the domain and where
 * the velocity vanishes. `direction` has 3 components, the third 0 in 2D. */
bool fg__place_direction(const fg__place_domain *domain, const double position[3],
                         double direction[3]);

/* |v| in the input's units; 0 outside. */
double fg__place_speed(const fg__place_domain *domain, const double position[3]);

/* Distance to the nearest wall, interpolated; 0 outside the box. */
double fg__place_clearance(const fg__place_domain *domain, const double position[3]);

/* The subdomain that holds a point, NULL outside the domain. */
const fg__place_subdomain *fg__place_subdomain_at(const fg__place_domain *domain,
                                                  const double position[3]);

/* Whether a speed is enough for a direction to be read. */
bool fg__place_moves(const fg__place_domain *domain, double speed);

/* Whether it is in an arrow's mean speed: what is still is not, nor, where most of the
 * domain is slow, its noise. */
bool fg__place_has_speed(const fg__place_domain *domain, double speed);

/* What a point counts in (0, 1], by its speed. */
double fg__place_weight(const fg__place_domain *domain, double speed);

#endif
