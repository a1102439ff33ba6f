#include "icon/shapes_test.h"

#include "icon/streamline.h"

#include <string.h>

static const double CORE[2] = {9.3, 21.7};

static void vortex(double x, double y, double v[2])
{
  v[0] = -3.7 * (y - CORE[1]);
  v[1] = 3.7 * (x - CORE[0]);
}

static void saddle(double x, double y, double v[2])
{
  v[0] = 0.2 * (x - CORE[0]);
  v[1] = -0.2 * (y - CORE[1]);
}

static void uniform(double x, double y, double v[2])
{
  (void)x, (void)y;
  v[0] = -1.2;
  v[1] = 0.5;
}

static void sink(double x, double y, double v[2])
{
  v[0] = -5 * (x - CORE[0]);
  v[1] = -5 * (y - CORE[1]);
}

static void reversal(double x, double y, double v[2])
{
  (void)y;
  v[0] = -2 * (x - CORE[0]);
  v[1] = 0;
}

/* Missing right of x = 20. */
static void half(double x, double y, double v[2])
{
  (void)y;
  v[0] = x > 20.5 ? (double)NAN : 2;
  v[1] = 0.1;
}

typedef struct test_bench {
  fg_context *context;
  fg_field *field;
  fg__window window;
  fg__streamline line;
} test_bench;

static double everywhere(double x, double y)
{
  (void)x, (void)y;
  return 1;
}

/* To the right of a slanting boundary: 0.8 x + 0.6 y = 14.2, linear like the window's
 * cells. */
static double beyond_line(double x, double y)
{
  return 0.8 * x + 0.6 * y - 14.2;
}

static test_bench bench_of(velocity_of velocity, depth_of depth)
{
  test_bench bench = {0};
  assert_int_equal(fg_context_create(&bench.context), FG_STATUS_OK);
  bench.field = field_of(bench.context, velocity);
  fg__window *window = &bench.window;
  *window = (fg__window){.cluster = 1,
                         .dimension = 2,
                         .nodes = {SHAPE_NODES_X, SHAPE_NODES_Y, 1},
                         .origin = {SHAPE_ORIGIN[0], SHAPE_ORIGIN[1]},
                         .spacing = {SHAPE_SPACING, SHAPE_SPACING},
                         .at_boundary = {true, true, true, true}};
  window->level = calloc((size_t)SHAPE_NODES_X * SHAPE_NODES_Y, sizeof(float));
  window->active = malloc((size_t)(SHAPE_NODES_X - 1) * (SHAPE_NODES_Y - 1));
  assert_non_null(window->level);
  assert_non_null(window->active);
  memset(window->active, 1, (size_t)(SHAPE_NODES_X - 1) * (SHAPE_NODES_Y - 1));
  for (int j = 0; j < SHAPE_NODES_Y; j++)
    for (int i = 0; i < SHAPE_NODES_X; i++)
      window->level[j * SHAPE_NODES_X + i] = (float)depth(
          SHAPE_ORIGIN[0] + SHAPE_SPACING * i, SHAPE_ORIGIN[1] + SHAPE_SPACING * j);
  return bench;
}

static void end_bench(test_bench *bench)
{
  fg__streamline_clear(&bench->line);
  free(bench->window.level);
  free(bench->window.active);
  fg_field_destroy(bench->field);
  fg_context_destroy(bench->context);
}

static void trace(test_bench *bench, double x, double y, double step)
{
  fg__streamline_limits limits = {step, 200, 5.236};
  double start[2] = {x, y};
  assert_int_equal(fg__streamline_trace(&bench->line, bench->context, bench->field,
                                        &bench->window, start, &limits),
                   FG_STATUS_OK);
}

/* Largest deviation from the circle, dense output included. */
static double circle_error(test_bench *bench, double radius)
{
  double worst = 0;
  int hint = 0;
  double length = fg__streamline_length(&bench->line);
  for (int i = 0; i <= 1000; i++) {
    double p[3], t[3];
    fg__streamline_at(&bench->line, length * i / 1000, &hint, p, t);
    worst = fmax(worst, fabs(hypot(p[0] - CORE[0], p[1] - CORE[1]) - radius));
    /* the tangent is across the radius, anticlockwise */
    double turn = (p[0] - CORE[0]) * t[1] - (p[1] - CORE[1]) * t[0];
    assert_true(turn / radius > 0.999);
  }
  return worst;
}

static void follows_a_circle(void **state)
{
  (void)state;
  test_bench bench = bench_of(vortex, everywhere);
  trace(&bench, CORE[0] + 4.2, CORE[1], SHAPE_SPACING);
  const fg__streamline *line = &bench.line;
  assert_int_equal(line->end[0], FG__STREAMLINE_TURNED);
  assert_int_equal(line->end[1], FG__STREAMLINE_TURNED);
  assert_true(circle_error(&bench, 4.2) < 6e-4 * SHAPE_SPACING);
  const fg__streamline_node *last = &line->node[line->count - 1];
  /* arc length and turning of a circle */
  assert_true(fabs(last->turning - line->node[0].turning - last->s / 4.2) < 1e-4);
  assert_true(fabs(line->node[line->start].position[0] - (CORE[0] + 4.2)) < 1e-12);
  for (int i = 1; i < line->count; i++)
    assert_true(line->node[i].s > line->node[i - 1].s);
  end_bench(&bench);
}

static void is_of_third_order(void **state)
{
  (void)state;
  test_bench bench = bench_of(vortex, everywhere);
  double error[2], radius = 7.9;
  for (int i = 0; i < 2; i++) {
    trace(&bench, CORE[0], CORE[1] - radius, 0.7 / (1 << i));
    error[i] = circle_error(&bench, radius);
  }
  assert_true(error[0] < 1e-3);
  assert_true(log2(error[0] / error[1]) > 2.6);
  end_bench(&bench);
}

static void follows_a_hyperbola_to_the_domain_boundary(void **state)
{
  (void)state;
  test_bench bench = bench_of(saddle, everywhere);
  trace(&bench, CORE[0] + 0.9, CORE[1] + 1.3, SHAPE_SPACING);
  const fg__streamline *line = &bench.line;
  for (int i = 0; i < line->count; i++) {
    const double *p = line->node[i].position;
    double product = (p[0] - CORE[0]) * (p[1] - CORE[1]);
    /* as a distance: across the curve the product grows by the distance to the saddle */
    double away = hypot(p[0] - CORE[0], p[1] - CORE[1]);
    assert_true(fabs(product - 0.9 * 1.3) / away < 2.5e-4 * SHAPE_SPACING);
  }
  /* it comes from the upper boundary and leaves by the right one */
  assert_true(35 - line->node[0].position[1] < 0.02 * SHAPE_SPACING);
  assert_true(30 - line->node[line->count - 1].position[0] < 0.02 * SHAPE_SPACING);
  end_bench(&bench);
}

static void ends_on_the_zero_set(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, beyond_line);
  trace(&bench, 20.1, 12.3, SHAPE_SPACING);
  const fg__streamline *line = &bench.line;
  const double *tip = line->node[line->count - 1].position;
  assert_int_equal(line->end[1], FG__STREAMLINE_LEFT);
  assert_true(beyond_line(tip[0], tip[1]) > 0);
  assert_true(beyond_line(tip[0], tip[1]) < 1e-5);
  /* straight: the cross product with the velocity stays */
  assert_true(fabs((tip[0] - 20.1) * 0.5 + (tip[1] - 12.3) * 1.2) < 1e-6);
  end_bench(&bench);
}

static void ends_where_the_flow_does(void **state)
{
  (void)state;
  velocity_of cases[] = {sink, reversal};
  for (int i = 0; i < 2; i++) {
    test_bench bench = bench_of(cases[i], everywhere);
    trace(&bench, CORE[0] + 3.1, CORE[1] - 0.4, SHAPE_SPACING);
    const fg__streamline *line = &bench.line;
    const double *tip = line->node[line->count - 1].position;
    assert_int_equal(line->end[1], FG__STREAMLINE_SINGULAR);
    assert_true(fabs(tip[0] - CORE[0]) < 0.05 * SHAPE_SPACING);
    assert_true(tip[0] > CORE[0] - 1e-9); /* never back from the other side */
    end_bench(&bench);
  }
}

static void ends_at_missing_data_and_masks(void **state)
{
  (void)state;
  test_bench bench = bench_of(half, everywhere);
  trace(&bench, 14.7, 18.2, SHAPE_SPACING);
  const fg__streamline *line = &bench.line;
  double x = line->node[line->count - 1].position[0];
  assert_true(x <= 20 && x > 20 - 0.05 * SHAPE_SPACING);

  /* the cell from 17 to 17.25 of every row is masked */
  for (int j = 0; j < SHAPE_NODES_Y - 1; j++)
    bench.window.active[j * (SHAPE_NODES_X - 1) + 108] = 0;
  trace(&bench, 14.7, 18.2, SHAPE_SPACING);
  x = line->node[line->count - 1].position[0];
  assert_true(x <= 17 && x > 17 - 1e-4);
  end_bench(&bench);
}

static void gives_nothing_outside_and_at_rest(void **state)
{
  (void)state;
  test_bench bench = bench_of(uniform, beyond_line);
  trace(&bench, 2, 8, SHAPE_SPACING);
  assert_int_equal(bench.line.count, 0);
  end_bench(&bench);
  bench = bench_of(vortex, everywhere);
  bench.line.count = 7; /* of a line traced before */
  trace(&bench, 300, 20, SHAPE_SPACING);
  assert_int_equal(bench.line.count, 0);
  end_bench(&bench);
}

/* Round an upright axis at (0.1, -0.2), rising by 0.3 a radian; linear, so that samples
 * carry it exactly. */
static fg_field *helix_field(void)
{
  enum { SIDE = 5 };
  static float sample[3][SIDE * SIDE * SIDE];
  double axis[SIDE];
  for (int n = 0; n < SIDE; n++)
    axis[n] = -1 + 2.0 * n / (SIDE - 1);
  for (int n = 0; n < SIDE * SIDE * SIDE; n++) {
    sample[0][n] = (float)-(axis[n / SIDE % SIDE] + 0.2);
    sample[1][n] = (float)(axis[n % SIDE] - 0.1);
    sample[2][n] = 0.3F;
  }
  fg_field_arrays arrays = {.dimension = 3,
                            .size = {SIDE, SIDE, SIDE},
                            .axis = {axis, axis, axis},
                            .velocity = {sample[0], sample[1], sample[2]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  return field;
}

/* The window is one cell that is positive below z = 0.61. In 3D the turning is curvature
 * times length. */
static void follows_a_helix(void **state)
{
  (void)state;
  float level[8];
  unsigned char active = 1;
  for (int n = 0; n < 8; n++)
    level[n] = n < 4 ? 1.51F : -0.29F;
  const fg__window window = {.dimension = 3,
                             .nodes = {2, 2, 2},
                             .origin = {-0.9, -0.9, -0.9},
                             .spacing = {1.8, 1.8, 1.8},
                             .level = level,
                             .active = &active};
  const double start[3] = {0.1, 0.4, -0.23}, radius = 0.6;
  const fg__streamline_limits limits = {0.05, 5, 20};
  fg_field *field = helix_field();
  fg__streamline line = {0};
  assert_int_equal(fg__streamline_trace(&line, NULL, field, &window, start, &limits),
                   FG_STATUS_OK);
  double size = hypot(radius, 0.3), length = fg__streamline_length(&line);
  double curvature = radius / (size * size), before = line.node[line.start].s;
  assert_true(fabs(before - (0.9 - 0.23) * size / 0.3) < 2e-3);
  assert_true(fabs(length - 1.51 * size / 0.3) < 3e-3);
  assert_int_equal(line.end[0], FG__STREAMLINE_LEFT);
  assert_int_equal(line.end[1], FG__STREAMLINE_LEFT);
  int hint = 0;
  for (int i = 0; i <= 300; i++) {
    double p[3], t[3], s = length * i / 300;
    double turning = fg__streamline_at(&line, s, &hint, p, t);
    assert_true(fabs(hypot(p[0] - 0.1, p[1] + 0.2) - radius) < 1e-3);
    assert_true(fabs(p[2] + 0.23 - (s - before) * 0.3 / size) < 1e-3);
    assert_true(fabs(t[2] - 0.3 / size) < 2e-3);
    assert_true(fabs(turning - curvature * s) < 0.02);
  }
  fg__streamline_clear(&line);
  fg_field_destroy(field);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(follows_a_circle),
      cmocka_unit_test(follows_a_helix),
      cmocka_unit_test(is_of_third_order),
      cmocka_unit_test(follows_a_hyperbola_to_the_domain_boundary),
      cmocka_unit_test(ends_on_the_zero_set),
      cmocka_unit_test(ends_where_the_flow_does),
      cmocka_unit_test(ends_at_missing_data_and_masks),
      cmocka_unit_test(gives_nothing_outside_and_at_rest),
  };
  return cmocka_run_group_tests_name("icon/streamline", tests, NULL, NULL);
}
