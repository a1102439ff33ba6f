/* Spines of shapes on the unit square, and what every spine promises. */
#ifndef FG__SPINE_SHAPES_TEST_H
#define FG__SPINE_SHAPES_TEST_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "cluster/labels_test.h"
#include "skeleton/spine.h"

#define assert_near(value, expected, tolerance)                                          \
  assert_true(fabs((value) - (expected)) <= (tolerance))

/* Shapes on the unit square, positive inside; H is a cell of the grid they are put on. */
enum { N = 81 };
static const double H = 1.0 / (N - 1);

typedef double shape(double x, double y);

typedef struct made {
  fg__window window;
  fg__spine spine;
} made;

/* `turn`: 0 as it is, 1 turned by a quarter, 2 mirrored at x = 1/2, 3 at the diagonal. */
static inline void turned(int turn, double x, double y, double out[2])
{
  out[0] = turn == 1 ? y : turn == 2 ? 1.0 - x : turn == 3 ? y : x;
  out[1] = turn == 1 ? 1.0 - x : turn == 3 ? x : y;
}

static inline made make_masked(shape *level, int turn, const unsigned char *active)
{
  float *u = malloc(sizeof *u * N * N);
  for (int k = 0; k < N * N; ++k) {
    double place[2];
    turned(turn, k % N * H, k / N * H, place);
    u[k] = (float)(20.0 * level(place[0], place[1]));
  }
  fg_density_arrays density = {.dimension = 2,
                               .nodes = {N, N},
                               .spacing = {H, H},
                               .u = u,
                               .active = active,
                               .debris_area = 2 * H * H};
  fg__labels labels;
  made result;
  label_arrays(&labels, &density);
  assert_int_equal(labels.count, 1);
  assert_int_equal(fg__window_create(&result.window, NULL, &density, &labels, 1),
                   FG_STATUS_OK);
  size_t nodes = (size_t)(result.window.nodes[0] * result.window.nodes[1]);
  double *distance = malloc(nodes * sizeof *distance);
  assert_int_equal(fg__march(distance, NULL, &result.window, true), FG_STATUS_OK);
  assert_int_equal(fg__spine_create(&result.spine, NULL, &result.window, distance),
                   FG_STATUS_OK);
  free(distance);
  free(u);
  fg__labels_clear(&labels);
  return result;
}

static inline void clear(made *made_spine)
{
  fg__window_clear(&made_spine->window);
  fg__spine_clear(&made_spine->spine);
}

static inline double between(const double a[2], const double b[2])
{
  return hypot(a[0] - b[0], a[1] - b[1]);
}

static inline double side_of(const double a[2], const double b[2], const double c[2])
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline bool segments_cross(const double a[2], const double b[2], const double c[2],
                                  const double d[2])
{
  return side_of(a, b, c) * side_of(a, b, d) < 0.0 &&
         side_of(c, d, a) * side_of(c, d, b) < 0.0;
}

/* What every spine promises. */
static inline void assert_sound(const made *made_spine)
{
  const fg__spine *spine = &made_spine->spine;
  assert_true(spine->count >= 1);
  assert_in_range(spine->center, 0, spine->count - 1);
  int segments = spine->closed ? spine->count : spine->count - 1;
  double length = 0.0;
  for (int k = 0; k < segments; ++k) {
    const double *a = spine->point[k];
    const double *b = spine->point[(k + 1) % spine->count];
    double piece = between(a, b);
    length += piece;
    assert_true(piece < 1.7 * H);
    assert_true(spine->count < 4 || piece > 0.5 * H);
    for (int m = k + 2; m < segments; ++m)
      assert_false(
          segments_cross(a, b, spine->point[m], spine->point[(m + 1) % spine->count]));
  }
  assert_near(length, spine->length, 1e-9);
  for (int k = 0; k < spine->count; ++k) {
    bool end = !spine->closed && (k == 0 || k == spine->count - 1);
    double level = fg__window_level(&made_spine->window, spine->point[k]);
    if (!end)
      assert_true(level > -0.5);
    else if (spine->count > 2)
      assert_true(spine->distance[k] < H); /* it goes on to the boundary */
  }
  if (!spine->closed)
    assert_in_range(2 * spine->center, spine->count - 2, spine->count);
}

static inline double distance_to(const fg__spine *spine, const double point[2])
{
  double least = HUGE_VAL;
  int segments = spine->closed ? spine->count : spine->count - 1;
  for (int k = 0; k < segments; ++k) {
    const double *a = spine->point[k];
    const double *b = spine->point[(k + 1) % spine->count];
    double square = pow(between(a, b), 2);
    double share =
        ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / square;
    share = fmin(fmax(share, 0.0), 1.0);
    const double foot[2] = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    least = fmin(least, between(point, foot));
  }
  return least;
}

/* The spine of the turned and mirrored shape is the turned and mirrored spine. */
static inline made make(shape *level)
{
  made first = make_masked(level, 0, NULL);
  assert_sound(&first);
  for (int turn = 1; turn <= 3; ++turn) {
    made other = make_masked(level, turn, NULL);
    assert_sound(&other);
    assert_int_equal(other.spine.closed, first.spine.closed);
    assert_near(other.spine.length, first.spine.length, 0.02 * first.spine.length + H);
    for (int k = 0; k < other.spine.count; ++k) {
      double place[2];
      turned(turn, other.spine.point[k][0], other.spine.point[k][1], place);
      /* ends may differ more: where nodes tie, their order decides */
      bool end = !other.spine.closed && (k < 5 || k >= other.spine.count - 5);
      assert_true(distance_to(&first.spine, place) < (end ? H : 0.5 * H));
    }
    clear(&other);
  }
  return first;
}

/* A line of points, t from 0 to 1. */
typedef void curve(double t, double point[2]);

static inline double distance_to_line(curve *line, int steps, const double place[2])
{
  double least = HUGE_VAL;
  for (int m = 0; m <= steps; ++m) {
    double point[2];
    line((double)m / steps, point);
    least = fmin(least, between(point, place));
  }
  return least;
}

/* The largest distance of a point of the spine from a line. */
static inline double farthest_from(const fg__spine *spine, curve *line)
{
  double most = 0.0;
  for (int k = 0; k < spine->count; ++k)
    most = fmax(most, distance_to_line(line, 4000, spine->point[k]));
  return most;
}

static const double pi = 3.14159265358979323846;

static inline double stroke(curve *line, double width, double x, double y)
{
  return width - distance_to_line(line, 300, (const double[2]){x, y});
}

/* The spine of a shape that has an axis: near it, and as long. */
static inline made make_along(shape *level, curve *axis, double off, double length,
                              double slack)
{
  made result = make(level);
  assert_true(farthest_from(&result.spine, axis) < off);
  assert_near(result.spine.length, length, slack);
  return result;
}

/* Half axes 0.4 and 0.13, turned by atan(5/12). */
static inline double ellipse(double x, double y)
{
  double along = (12 * (x - 0.5) + 5 * (y - 0.48)) / 13;
  double across = (-5 * (x - 0.5) + 12 * (y - 0.48)) / 13;
  return 0.13 - hypot(along * 0.13 / 0.4, across);
}

#endif
