/* Points that fill a volume, and the nearest of them. */
#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "base/mix.h"
#include "sample/points/nearest.h"
#include "sample/points/points.h"

enum { POINTS = 5000, WANTED = FG__MOST_NEAREST };

static double dice(size_t i)
{
  return (double)(fg__mix(i) >> 11) * 0x1p-53;
}

static void linear(double out[3], const double p[3])
{
  out[0] = 1.0 + 2.0 * p[0] - p[1];
  out[1] = -3.0 + p[2];
  out[2] = 0.5 * p[0] + p[1] - 2.0 * p[2];
}

/* Arnold, Beltrami and Childress' flow, one wave a side. */
static void waves(double out[3], const double p[3])
{
  const double turn = 2.0 * acos(-1.0);
  const double x = turn * p[0], y = turn * p[1], z = turn * p[2];
  out[0] = sin(z) + 0.7 * cos(y);
  out[1] = 0.7 * sin(x) + 0.5 * cos(z);
  out[2] = 0.5 * sin(y) + cos(x);
}

/* Random places of a cube of side 1, those between two radii about its centre. */
static fg__scatter scatter_of(fg_context *context, double inner, double outer,
                              void (*flow)(double out[3], const double p[3]))
{
  fg__scatter s = {
      .context = context, .path = "points", .dimension = 3, .records = "line"};
  for (int k = 0; k < 3; ++k) {
    s.position[k] = calloc(POINTS, sizeof(double));
    s.velocity[k] = calloc(POINTS, sizeof(float));
    assert_true(s.position[k] && s.velocity[k]);
  }
  for (size_t i = 0; s.count < POINTS; i += 3) {
    const double p[3] = {dice(i), dice(i + 1), dice(i + 2)};
    const double r = hypot(hypot(p[0] - 0.5, p[1] - 0.5), p[2] - 0.5);
    double v[3];
    if (r < inner || r > outer)
      continue;
    flow(v, p);
    for (int k = 0; k < 3; ++k) {
      s.position[k][s.count] = p[k];
      s.velocity[k][s.count] = (float)v[k];
    }
    ++s.count;
  }
  return s;
}

static fg_field *field_of(fg__scatter *s)
{
  const fg_field_arrays words = {.scale = FG_SCALE_PLAIN};
  fg__scatter_between between;
  fg_field *field = NULL;
  if (fg__scatter_field(&field, &between, s, &words, (fg__slab_index){0, 1}))
    fail_msg("%s", fg_context_message(s->context));
  assert_true(between.points == POINTS && between.cells == 0);
  fg__scatter_clear(s);
  return field;
}

/* Root of the mean square of the error over that of the flow, of samples that lie `rim`
 * or more inside the cube; *held: the share of these that has a value. */
static double error_of(double *held, const fg_field *field, double rim,
                       void (*flow)(double out[3], const double p[3]))
{
  const fg_field_arrays *a = fg_field_contents(field);
  double square = 0.0, all = 0.0, samples = 0.0, present = 0.0;
  size_t n = 0;
  for (int z = 0; z < a->size[2]; ++z)
    for (int y = 0; y < a->size[1]; ++y)
      for (int x = 0; x < a->size[0]; ++x, ++n) {
        const double p[3] = {a->axis[0][x], a->axis[1][y], a->axis[2][z]};
        double v[3];
        if (fabs(p[0] - 0.5) > 0.5 - rim || fabs(p[1] - 0.5) > 0.5 - rim ||
            fabs(p[2] - 0.5) > 0.5 - rim)
          continue;
        samples += 1.0;
        if (a->valid && !a->valid[n])
          continue;
        present += 1.0;
        flow(v, p);
        for (int k = 0; k < 3; ++k) {
          square += pow((double)a->velocity[k][n] - v[k], 2.0);
          all += v[k] * v[k];
        }
      }
  *held = present / samples;
  return sqrt(square / all);
}

/* Linear interpolation in Delaunay's tetrahedra is off by 0.018 here within 0.05 of the
 * rim (SciPy 1.10), and by 0.039 out to it. */
static void a_smooth_flow_is_kept(void **state)
{
  double held;
  fg__scatter s = scatter_of(*state, 0.0, 2.0, waves);
  fg_field *field = field_of(&s);
  assert_true(error_of(&held, field, 0.05, waves) < 0.02);
  assert_true(held > 0.99999);
  assert_true(error_of(&held, field, 0.0, waves) < 0.025);
  assert_true(held > 0.99);
  fg_field_destroy(field);
  s = scatter_of(*state, 0.0, 2.0, linear);
  field = field_of(&s);
  assert_true(error_of(&held, field, 0.0, linear) < 1e-4);
  fg_field_destroy(field);
}

/* Of a hollow ball in a box. */
static void what_is_far_from_points_is_missing(void **state)
{
  static const double inner = 0.3, outer = 0.5;
  fg__scatter s = scatter_of(*state, inner, outer, waves);
  fg_field *field = field_of(&s);
  const fg_field_arrays *a = fg_field_contents(field);
  assert_non_null(a->valid);
  size_t n = 0, lost = 0, within = 0;
  for (int z = 0; z < a->size[2]; ++z)
    for (int y = 0; y < a->size[1]; ++y)
      for (int x = 0; x < a->size[0]; ++x, ++n) {
        const double r =
            hypot(hypot(a->axis[0][x] - 0.5, a->axis[1][y] - 0.5), a->axis[2][z] - 0.5);
        if (r > outer + 0.09 || r < inner - 0.1)
          assert_false(a->valid[n]);
        if (r < outer - 0.05 && r > inner + 0.05) {
          ++within;
          lost += !a->valid[n];
        }
      }
  assert_true(within > 1000 && lost < within / 1000);
  fg_field_destroy(field);
}

/* A value that is missing leaves its surroundings so, not those of others. */
static void missing_values_stay_missing(void **state)
{
  fg__scatter s = scatter_of(*state, 0.0, 2.0, linear);
  for (size_t i = 0; i < POINTS; ++i)
    if (s.position[0][i] > 0.6)
      s.velocity[1][i] = NAN;
  fg_field *field = field_of(&s);
  const fg_field_arrays *a = fg_field_contents(field);
  for (size_t n = 0; n < (size_t)a->size[0] * (size_t)a->size[1] * (size_t)a->size[2];
       ++n) {
    const double x = a->axis[0][n % (size_t)a->size[0]];
    if (x > 0.7)
      assert_false(a->valid[n]);
  }
  double held;
  assert_true(error_of(&held, field, 0.0, linear) < 1e-3);
  assert_true(held > 0.5 && held < 0.65);
  fg_field_destroy(field);
}

/* The nearest are those that a look at all points finds, also among places that agree in
 * a coordinate. */
static void the_nearest_are_found(void **state)
{
  fg__scatter s = scatter_of(*state, 0.0, 2.0, linear);
  for (size_t i = 0; i < POINTS; i += 2)
    s.position[i % 3][i] = floor(8.0 * s.position[i % 3][i]) / 8.0;
  fg__point_tree tree;
  assert_int_equal(
      fg__point_tree_create(&tree, *state, (const double *const *)s.position, POINTS),
      FG_STATUS_OK);
  for (size_t q = 0; q < 200; ++q) {
    const double at[3] = {1.2 * dice(3 * q) - 0.1, dice(3 * q + 1), dice(3 * q + 2)};
    fg__nearest_points found;
    assert_true(fg__point_tree_find(&found, &tree, at, WANTED));
    size_t nearer = 0;
    for (size_t i = 0; i < POINTS; ++i) {
      double d = 0.0;
      for (int k = 0; k < 3; ++k)
        d += pow(s.position[k][i] - at[k], 2.0);
      nearer += d < found.distance[WANTED - 1];
    }
    assert_int_equal(nearer, WANTED - 1);
    for (int n = 1; n < WANTED; ++n)
      assert_true(found.distance[n - 1] <= found.distance[n]);
  }
  fg__point_tree_clear(&tree);
  fg__scatter_clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_smooth_flow_is_kept),
      cmocka_unit_test(what_is_far_from_points_is_missing),
      cmocka_unit_test(missing_values_stay_missing),
      cmocka_unit_test(the_nearest_are_found),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}
