/* The domain as the rivals see it: a raster of cells in 2D or 3D, each valid or masked,
 * with the direction of the flow in it. In 2D the third axis has one cell, and points
 * have z = 0 where they have a z. */
#ifndef FG__RIVAL_DOMAIN_H
#define FG__RIVAL_DOMAIN_H

#include "base/context.h"
#include "cluster/raster.h"

typedef struct fg__domain {
  const fg_field *field;
  int dimension; /* 2 or 3 */
  int cells[3];
  double origin[3], spacing[3]; /* input coordinates, as all that follows */
  double period[3];             /* 0: none */
  unsigned char *valid;         /* a byte a cell: its centre has a velocity */
  double *direction;            /* a unit vector a cell, zero where masked or still */
  int valid_count;
  double area;       /* of the valid cells; volume in 3D */
  double trace_step; /* longest step of a streamline */
} fg__domain;

/* A box with sides along the axes. */
typedef struct fg__extent {
  double origin[3], side[3];
} fg__extent;

/* Lays cells over the field's box, as near to square as fills it: nodes - 1 along its
 * longest side. MEMORY. */
fg_status fg__domain_create(fg__domain *out, fg_context *context, const fg_field *field,
                            int nodes);
void fg__domain_clear(fg__domain *domain);

/* Where streamlines may lie when only masks and the field's own ends stop them: the box
 * with periods to spare along periodic axes. */
fg__extent fg__domain_all(const fg__domain *domain);

/* The part of the box in which an arrow of this half width through `middle` may lie: it
 * keeps off periodic boundaries, since a map ends there, by that or half of the middle's
 * own way to them. Where an axis is open the field ends by itself. */
fg__extent fg__domain_room(const fg__domain *domain, const double middle[],
                           double half_width);

static inline int fg__domain_cell_count(const fg__domain *domain)
{
  return domain->cells[0] * domain->cells[1] * domain->cells[2];
}

static inline const double *fg__domain_direction(const fg__domain *domain, int cell)
{
  return domain->direction + (size_t)cell * (size_t)domain->dimension;
}

/* Shortest side of a cell. */
double fg__domain_cell_size(const fg__domain *domain);

/* Side of the square (cube) that is the share of one of `count` arrows. */
double fg__domain_fair_share(const fg__domain *domain, int count);

/* Centre of a cell: dimension numbers. */
void fg__domain_center(const fg__domain *domain, int cell, double center[]);

/* The cell of a point, periods taken off; -1 outside the box. It may be masked. */
int fg__domain_cell(const fg__domain *domain, const double point[]);

/* Unit vector of the flow at a point; false where it has no direction. */
bool fg__domain_flow(const fg__domain *domain, const double point[], double ahead[3]);

/* Whether the flow has a direction at a point, or in a cell's centre. */
bool fg__domain_moves(const fg__domain *domain, const double point[]);
bool fg__domain_cell_moves(const fg__domain *domain, int cell);

/* |v| at a point; 0 outside the domain. */
double fg__domain_speed(const fg__domain *domain, const double point[]);

/* How many periods a point lies from the box along each axis. */
void fg__domain_turns(const fg__domain *domain, const double point[], int turns[]);

/* Takes those periods off. */
void fg__domain_wrap(const fg__domain *domain, double point[]);

/* The same difference of two points, by the shortest way round the periods. */
void fg__domain_shortest(const fg__domain *domain, double difference[]);

#endif
