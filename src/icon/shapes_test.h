/* What the icon tests share: fields and clusters from formulas, and judges of outlines.
 */
#ifndef FG__SHAPES_TEST_H
#define FG__SHAPES_TEST_H

#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "icon/measure.h"

/* A domain with an origin, a size and a spacing that are nothing special. */
enum { SHAPE_NODES_X = 161, SHAPE_NODES_Y = 121, DATA_X = 41, DATA_Y = 31 };
static const double SHAPE_ORIGIN[2] = {-10, 5};
static const double SHAPE_SPACING = 0.25;
static const double DATA_SPACING = 1.0;

typedef void (*velocity_of)(double x, double y, double velocity[2]);
typedef double (*depth_of)(double x, double y); /* distance to the boundary, > 0 inside */

/* The field of a formula; linear ones are met exactly by the bilinear samples. Samples
 * that are NAN are missing. */
static inline fg_field *field_of(fg_context *context, velocity_of velocity)
{
  static float sample[2][DATA_X * DATA_Y];
  static double axis[2][DATA_X];
  for (int i = 0; i < DATA_X; i++)
    axis[0][i] = SHAPE_ORIGIN[0] + DATA_SPACING * i;
  for (int j = 0; j < DATA_Y; j++)
    axis[1][j] = SHAPE_ORIGIN[1] + DATA_SPACING * j;
  for (int j = 0; j < DATA_Y; j++)
    for (int i = 0; i < DATA_X; i++) {
      double v[2];
      velocity(axis[0][i], axis[1][j], v);
      sample[0][j * DATA_X + i] = (float)v[0];
      sample[1][j * DATA_X + i] = (float)v[1];
    }
  fg_field_arrays arrays = {.dimension = 2,
                            .size = {DATA_X, DATA_Y, 1},
                            .axis = {axis[0], axis[1]},
                            .velocity = {sample[0], sample[1]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

/* The density of a shape: its depth, in cells, cut at one cell. active may be NULL. */
static inline fg_density *density_of(fg_context *context, depth_of depth,
                                     const unsigned char *active)
{
  float *u = calloc((size_t)SHAPE_NODES_X * SHAPE_NODES_Y, sizeof *u);
  assert_non_null(u);
  for (int j = 0; j < SHAPE_NODES_Y; j++)
    for (int i = 0; i < SHAPE_NODES_X; i++) {
      double d = depth(SHAPE_ORIGIN[0] + SHAPE_SPACING * i,
                       SHAPE_ORIGIN[1] + SHAPE_SPACING * j) /
                 SHAPE_SPACING;
      u[j * SHAPE_NODES_X + i] = (float)fmax(fmin(d, 1), -1);
    }
  fg_density_arrays arrays = {.dimension = 2,
                              .nodes = {SHAPE_NODES_X, SHAPE_NODES_Y, 1},
                              .origin = {SHAPE_ORIGIN[0], SHAPE_ORIGIN[1], 0},
                              .spacing = {SHAPE_SPACING, SHAPE_SPACING, 1},
                              .u = u,
                              .active = active,
                              .debris_area = 2 * SHAPE_SPACING * SHAPE_SPACING};
  fg_density *density = NULL;
  assert_int_equal(fg_density_create_from_arrays(&density, context, &arrays),
                   FG_STATUS_OK);
  free(u);
  return density;
}

static inline double cross_of(const double a[2], const double b[2], const double c[2])
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline bool edges_cross(const double a[2], const double b[2], const double c[2],
                               const double d[2])
{
  return cross_of(a, b, c) * cross_of(a, b, d) < 0 &&
         cross_of(c, d, a) * cross_of(c, d, b) < 0;
}

/* No two edges of the polygon meet but at shared vertices. */
static inline bool is_simple(const double (*vertex)[2], int count)
{
  for (int i = 0; i < count; i++)
    for (int j = i + 2; j < count; j++) {
      if (i == 0 && j == count - 1)
        continue;
      if (edges_cross(vertex[i], vertex[(i + 1) % count], vertex[j],
                      vertex[(j + 1) % count]))
        return false;
    }
  return true;
}

/* Every edge, sampled a hundred times, lies where the depth is positive. */
static inline bool is_within(const double (*vertex)[2], int count, depth_of depth)
{
  for (int i = 0; i < count; i++)
    for (int k = 0; k < 100; k++) {
      const double *a = vertex[i], *b = vertex[(i + 1) % count];
      double t = k / 100.0;
      if (!(depth(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) > 0))
        return false;
    }
  return true;
}

/* Sum of the signed angles between successive pieces, radians. */
static inline double icon_turning(const fg_icon *icon)
{
  double turning = 0;
  for (int i = 1; i + 1 < icon->point_count; i++) {
    double a[2] = {icon->points[i][0] - icon->points[i - 1][0],
                   icon->points[i][1] - icon->points[i - 1][1]};
    double b[2] = {icon->points[i + 1][0] - icon->points[i][0],
                   icon->points[i + 1][1] - icon->points[i][1]};
    turning += atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
  }
  return turning;
}

/* Mean angle, degrees, between the centreline and the flow, by arc length; against the
 * flow it is beyond 90. */
static inline double icon_tangency(const fg_icon *icon, const fg_field *field)
{
  double sum = 0, length = 0;
  for (int i = 1; i < icon->point_count; i++) {
    const double *a = icon->points[i - 1], *b = icon->points[i];
    double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}, tangent[3];
    assert_true(fg_field_tangent(field, middle, tangent));
    double dx = b[0] - a[0], dy = b[1] - a[1], piece = hypot(dx, dy);
    sum += piece * fabs(atan2(dx * tangent[1] - dy * tangent[0],
                              dx * tangent[0] + dy * tangent[1]));
    length += piece;
  }
  return sum / length * 57.29577951308232;
}

#endif
