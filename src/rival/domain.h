/* The domain as the rivals see it: a raster of cells, each valid or masked, with the
 * direction of the flow in it. */
#ifndef FG__RIVAL_DOMAIN_H
#define FG__RIVAL_DOMAIN_H

#include "base/context.h"
#include "cluster/raster.h"

typedef struct fg__domain {
  const fg_field *field;
  int cells[2];
  double origin[2], spacing[2]; /* input coordinates, as all that follows */
  double period[2];             /* 0: none */
  unsigned char *valid;         /* a byte a cell: its centre has a velocity */
  double (*direction)[2];       /* a unit vector a cell, zero where masked or still */
  int valid_count;
  double area;       /* of the valid cells */
  double trace_step; /* longest step of a streamline */
  fg__window all;    /* positive everywhere, with periods to spare: masks end streamlines
                        by themselves */
  float all_level[4];
  unsigned char all_active;
} fg__domain;

/* Lays cells over the field's box, as near to square as fills it: nodes - 1 along its
 * longest side. `out` must stay where it is. MEMORY. */
fg_status fg__domain_create(fg__domain *out, fg_context *context, const fg_field *field,
                            int nodes);
void fg__domain_clear(fg__domain *domain);

/* The part of the box in which an arrow of this half width through `middle` may lie: it
 * keeps off periodic borders, since a map ends there, by that or half of the middle's own
 * way to them. Where an axis is open the field ends by itself. Positive all over; it
 * borrows from the domain. */
fg__window fg__domain_room(const fg__domain *domain, const double middle[2],
                           double half_width);

/* Centre of a cell. */
void fg__domain_center(const fg__domain *domain, int cell, double center[2]);

/* The cell of a point, periods taken off; -1 outside the box. It may be masked. */
int fg__domain_cell(const fg__domain *domain, const double point[2]);

/* Whether the flow has a direction at a point. */
bool fg__domain_moves(const fg__domain *domain, const double point[2]);

/* How many periods a point lies from the box along each axis. */
void fg__domain_turns(const fg__domain *domain, const double point[2], int turns[2]);

/* The same difference of two points, by the shortest way round the periods. */
void fg__domain_shortest(const fg__domain *domain, double difference[2]);

#endif
