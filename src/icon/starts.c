/* Where the streamlines begin that are tried for a cluster. */
#include "icon/choose.h"

#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places on the spine to start from beside its middle, in parts of its length. */
static const double PLACES[] = {0.35, 0.65, 0.2, 0.8};
static const double RING_PLACES[] = {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875};

/* Starts beside the spine, in distances to the boundary there. In a disc, at half radius,
 * an arrow round the core of a vortex has as much clearance inside as outside. */
static const double ASIDE = 0.45;
static const double HALF_RADIUS = 0.5;

/* A cluster whose spine is shorter than this many of its radii is a disc: the spine has
 * no direction worth the name. */
static const double DISC = 2.0;

/* Where the best arrow in 2D is shorter than this share of the spine, bends unevenly or
 * is slim (in lengths), the flow leaves the cluster across it or is rough: then points
 * all over the cluster are tried as well, at most so many. */
static const double SHORT = 0.65;
static const double UNEVEN = 1.25;
static const double SLIM = 0.045;
enum { EVERYWHERE_FLAT = 16 };

/* The best line in 2D is shifted sideways by this share of the distance to the boundary.
 */
static const double SHIFT = 0.2;

/* In 3D so many points all over the cluster are always tried, of at most so many. */
enum { EVERYWHERE_SOLID = 12, MOST_POINTS = 500 };

/* Tries a point in 2D where no line has passed. */
static fg_status try_unpassed(fg__choice *choice, double x, double y)
{
  const double start[3] = {x, y, 0};
  return fg__choice_has_passed(choice, start) ? FG_STATUS_OK
                                              : fg__choice_try(choice, start);
}

/* Tries points on either side of a point, along a direction. */
static fg_status try_aside(fg__choice *choice, const double center[2],
                           const double direction[2], double way)
{
  fg_status status = FG_STATUS_OK;
  for (int side = 1; side >= -1 && status == FG_STATUS_OK; side -= 2)
    status = try_unpassed(choice, center[0] + side * way * direction[0],
                          center[1] + side * way * direction[1]);
  return status;
}

/* Unit normal of the flow; the first axis where there is no flow. */
static void find_normal(const fg__choice *choice, const double position[3],
                        double normal[2])
{
  double tangent[3] = {0}, size = 0;
  if (fg_field_tangent(choice->field, position, tangent))
    size = hypot(tangent[0], tangent[1]);
  normal[0] = size > 0 ? -tangent[1] / size : 1;
  normal[1] = size > 0 ? tangent[0] / size : 0;
}

static fg_status try_spine(fg__choice *choice, const fg__spine *spine)
{
  const double *place = spine->closed ? RING_PLACES : PLACES;
  size_t count = spine->closed ? sizeof RING_PLACES / sizeof *RING_PLACES
                               : sizeof PLACES / sizeof *PLACES;
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < count && status == FG_STATUS_OK; i++) {
    int index = (int)lround(place[i] * (spine->count - 1));
    if (spine->closed)
      index = (spine->center + index) % spine->count;
    status = try_unpassed(choice, spine->point[index][0], spine->point[index][1]);
  }
  return status;
}

static fg_status try_middle(fg__choice *choice, const double middle[3], bool disc)
{
  fg_status status = fg__choice_try(choice, middle);
  if (status != FG_STATUS_OK)
    return status;
  double normal[2], radius = choice->radius;
  find_normal(choice, middle, normal);
  const double along[2] = {normal[1], -normal[0]};
  status = try_aside(choice, middle, normal, ASIDE * radius);
  if (status == FG_STATUS_OK && disc)
    status = try_aside(choice, middle, normal, HALF_RADIUS * radius);
  if (status == FG_STATUS_OK && disc)
    status = try_aside(choice, middle, along, HALF_RADIUS * radius);
  return status;
}

/* Tries some of the cluster's points, evenly taken from their list. */
static fg_status try_listed(fg__choice *choice)
{
  const fg__chooser *chooser = choice->chooser;
  int stride =
      chooser->point_count > EVERYWHERE_FLAT ? chooser->point_count / EVERYWHERE_FLAT : 1;
  fg_status status = FG_STATUS_OK;
  for (int i = stride / 2; i < chooser->point_count && status == FG_STATUS_OK;
       i += stride)
    status = try_unpassed(choice, chooser->point[i][0], chooser->point[i][1]);
  return status;
}

/* Shifts the best line to either side of its middle. */
static fg_status shift_best(fg__choice *choice)
{
  fg_status status = FG_STATUS_OK;
  if (!(choice->arrow.width > 0))
    return status;
  double position[3], tangent[3], tail = choice->arrow.tail, tip = choice->arrow.tip;
  fg__streamline_at(&choice->chooser->best, (tail + tip) / 2, NULL, position, tangent);
  double local =
      fmax(fg__interior_distance(choice->interior, position), choice->radius / 2);
  for (int side = -1; side <= 1 && status == FG_STATUS_OK; side += 2) {
    double shift = side * SHIFT * local;
    const double start[3] = {position[0] - shift * tangent[1],
                             position[1] + shift * tangent[0], 0};
    status = fg__choice_try(choice, start);
  }
  return status;
}

static bool is_poor(const fg__choice *choice, const fg__spine *spine)
{
  const fg__arrow *arrow = &choice->arrow;
  double length = arrow->tip - arrow->tail;
  return !(length > SHORT * spine->length) || arrow->bending > UNEVEN ||
         arrow->width < SLIM * length;
}

static fg_status try_flat(fg__choice *choice, const fg__spine *spine)
{
  fg_status status =
      try_middle(choice, spine->middle, spine->length < DISC * choice->radius);
  if (status == FG_STATUS_OK)
    status = try_spine(choice, spine);
  if (status == FG_STATUS_OK && is_poor(choice, spine))
    status = try_listed(choice);
  if (status == FG_STATUS_OK)
    status = shift_best(choice);
  return status;
}

/* A point of the spine in 3D, and four points round it across the flow. */
static fg_status try_around(fg__choice *choice, const double center[3])
{
  fg_status status = fg__choice_try(choice, center);
  double tangent[3], normal[2][3];
  if (status != FG_STATUS_OK || !fg_field_tangent(choice->field, center, tangent) ||
      !fg__normalise(tangent))
    return status;
  fg__any_normal(tangent, normal[0]);
  fg__cross(tangent, normal[0], normal[1]);
  double way = ASIDE * fg__interior_distance(choice->interior, center);
  for (int side = 0; side < 4 && status == FG_STATUS_OK; side++) {
    double start[3];
    fg__add_scaled(center, side < 2 ? way : -way, normal[side % 2], start);
    status = fg__choice_try(choice, start);
  }
  return status;
}

/* Tries points of the cluster, each as far as can be from the spine's middle and from
 * those before it. */
static fg_status try_farthest(fg__choice *choice, const double middle[3])
{
  const fg__chooser *chooser = choice->chooser;
  double away[MOST_POINTS];
  int count = chooser->point_count < MOST_POINTS ? chooser->point_count : MOST_POINTS;
  for (int i = 0; i < count; i++)
    away[i] = fg__distance(chooser->point[i], middle);
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < EVERYWHERE_SOLID && n < count && status == FG_STATUS_OK; n++) {
    int farthest = 0;
    for (int i = 1; i < count; i++)
      farthest = away[i] > away[farthest] ? i : farthest;
    double start[3];
    memcpy(start, chooser->point[farthest], sizeof start);
    for (int i = 0; i < count; i++)
      away[i] = fmin(away[i], fg__distance(chooser->point[i], start));
    status = fg__choice_try(choice, start);
  }
  return status;
}

static fg_status try_solid(fg__choice *choice, const fg__spine *spine)
{
  fg_status status = try_around(choice, spine->middle);
  for (size_t i = 0; i < sizeof PLACES / sizeof *PLACES && status == FG_STATUS_OK; i++)
    status =
        try_around(choice, spine->point[(int)lround(PLACES[i] * (spine->count - 1))]);
  if (status == FG_STATUS_OK)
    status = try_farthest(choice, spine->middle);
  return status;
}

fg_status fg__choice_try_starts(fg__choice *choice, const fg__spine *spine)
{
  return choice->interior->window->dimension == 2 ? try_flat(choice, spine)
                                                  : try_solid(choice, spine);
}
