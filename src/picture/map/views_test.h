/* Planes of all kinds. */
#ifndef FG__MAP_VIEWS_TEST_H
#define FG__MAP_VIEWS_TEST_H

#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "flowgrain/flowgrain.h"
#include "picture/map/plane.h"
#include "picture/page/page.h"

enum { SIDE = 61 };

typedef struct view {
  const char *projection; /* NULL: degrees */
  double low[2], high[2]; /* of the field's axes */
  bool disc;              /* corners are missing */
} view;

static const view world = {
    "+proj=eqearth +R=6371000 +units=km", {-17300, -8400}, {17300, 8400}, false};
static const view pacific = {"+proj=eqearth +lon_0=200 +R=6371000 +units=km",
                             {-17300, -8400},
                             {17300, 8400},
                             false};
static const view south = {
    "+proj=laea +lat_0=-90 +R=6371000 +units=km", {-7000, -7000}, {7000, 7000}, true};
static const view north = {"+proj=stere +lat_0=90 +lon_0=-30 +R=6371000 +units=km",
                           {-5000, -5000},
                           {5000, 5000},
                           true};
static const view atlantic = {
    "+proj=lcc +lat_1=28 +lat_2=62 +lat_0=45 +lon_0=-35 +R=6371000 +units=m",
    {-4e6, -3.6e6},
    {4e6, 3.5e6},
    false};
/* its antipode lies in Asia */
static const view oblique = {"+proj=laea +lat_0=-35 +lon_0=-100 +R=6371000 +units=km",
                             {-12742, -12742},
                             {12742, 12742},
                             true};
static const view globe = {"+proj=ortho +lat_0=40 +lon_0=10 +R=6371000 +units=km",
                           {-6371, -6371},
                           {6371, 6371},
                           true};
/* inside one continent: no coast is to be seen */
static const view sahara = {"+proj=laea +lat_0=22 +lon_0=10 +R=6371000 +units=km",
                            {-300, -300},
                            {300, 300},
                            false};
static const view degrees = {NULL, {21.0, -89.0}, {379.0, 89.0}, false};

/* round the globe and less than half as high */
static const view tropics = {
    "+proj=eqearth +R=6371000 +units=km", {-17300, -3500}, {17300, 3500}, false};

/* a box whose lower side is the pole, but for half a sample */
static const view plate = {
    "+proj=eqc +R=6371000 +units=km", {-20016, -10030}, {20016, 10030}, false};
/* the pole is an arc */
static const view cone = {"+proj=aea +lat_1=29.5 +lat_2=45.5 +R=6371000 +units=km",
                          {-16899, -4614},
                          {16899, 17650},
                          false};
static const view *const views[] = {&world,    &pacific, &south, &north,
                                    &atlantic, &oblique, &globe, &sahara,
                                    &degrees,  &tropics, &plate, &cone};
enum { VIEWS = sizeof views / sizeof *views };

static inline fg_field *make_field(fg_context *context, const view *v,
                                   bool (*there)(double x, double y))
{
  static double axis[2][SIDE];
  static float u[SIDE * SIDE], zero[SIDE * SIDE];
  for (int k = 0; k < 2; ++k)
    for (int n = 0; n < SIDE; ++n)
      axis[k][n] = v->low[k] + (v->high[k] - v->low[k]) * n / (SIDE - 1);
  const double radius = 0.5 * (v->high[0] - v->low[0]);
  for (int n = 0; n < SIDE * SIDE; ++n) {
    const double x = axis[0][n % SIDE], y = axis[1][n / SIDE];
    const bool inside = !v->disc || hypot(x, y) <= radius;
    u[n] = inside && (!there || there(x, y)) ? 1.0F : NAN;
  }
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {SIDE, SIDE, 0},
                                  .axis = {axis[0], axis[1], NULL},
                                  .velocity = {u, zero, NULL},
                                  .scale = v->projection ? FG_SCALE_MAP : FG_SCALE_GEO,
                                  .projection = v->projection};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static inline void make_plane(fg__plane *plane, fg_context *context, const view *v)
{
  double low[2] = {v->low[0], v->low[1]}, high[2] = {v->high[0], v->high[1]};
  fg_field *field = make_field(context, v, NULL);
  assert_int_equal(fg__plane_create(plane, context, field, low, high), FG_STATUS_OK);
  assert_int_equal(plane->kind == FG__PLANE_DEGREES, v->projection == NULL);
  assert_int_equal(plane->disc, v->disc);
  fg_field_destroy(field);
}

/* Of a page that shows a plane alone. */
static inline fg__page_plan plan_of(const fg__plane *plane,
                                    const struct fg__graticule *graticule)
{
  fg__page_plan plan = {.graticule = graticule, .outlined = plane->whole};
  for (int k = 0; k < 2; ++k) {
    plan.axis[k].low = plane->low[k];
    plan.axis[k].high = plane->high[k];
  }
  return plan;
}

#endif
