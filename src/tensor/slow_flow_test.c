/* The anisotropy of the flow energy where the flow is slow. */
#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "tensor/tensor.h"

enum { SIDE = 41, DEPTH = 9, CELLS_X = 80, CELLS_Y = 64, CELLS_Z = 16 };

static const double anisotropy = 0.2, below = 3.0;
static const double along[3] = {0.48, -0.64, 0.6}; /* in 2D without the last */

/* From 0 at the left to three times the speed below which a tends to 1. */
static double speed_at(double x)
{
  return 3.0 * below * (x - 5.0) / 4.0;
}

static fg_field *make_field(fg_context *context, int dimension)
{
  static double x[SIDE], y[SIDE], z[DEPTH];
  static float v[3][SIDE * SIDE * DEPTH];
  double flat = dimension == 3 ? 1.0 : hypot(along[0], along[1]);
  for (int i = 0; i < SIDE; ++i) {
    x[i] = 5.0 + 4.0 * i / (SIDE - 1);
    y[i] = -1.0 + 3.2 * i / (SIDE - 1);
  }
  for (int k = 0; k < DEPTH; ++k)
    z[k] = 0.8 * k / (DEPTH - 1);
  for (int n = 0; n < SIDE * SIDE * DEPTH; ++n)
    for (int k = 0; k < 3; ++k)
      v[k][n] = (float)(speed_at(x[n % SIDE]) * along[k] / flat);
  fg_field_arrays arrays = {.dimension = dimension,
                            .size = {SIDE, SIDE, dimension == 3 ? DEPTH : 1},
                            .axis = {x, y, dimension == 3 ? z : NULL},
                            .velocity = {v[0], v[1], dimension == 3 ? v[2] : NULL}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

typedef struct grid {
  float *value[6];
  unsigned char *active;
  fg__cells cells;
  size_t count;
} grid;

static grid fill(fg_context *context, const fg_field *field, int dimension,
                 const fg_energy_law *law)
{
  grid g = {.cells = {.dimension = dimension,
                      .count = {CELLS_X, CELLS_Y, CELLS_Z},
                      .origin = {5.0, -1.0, 0.0},
                      .spacing = {0.05, 0.05, 0.05}}};
  const bool periodic[3] = {false, false, false};
  g.count = fg__cell_count(&g.cells);
  for (int k = 0; k < 6; ++k)
    assert_non_null(g.value[k] = calloc(g.count, sizeof *g.value[k]));
  assert_non_null(g.active = calloc(g.count, 1));
  fg__tensor tensor = {g.value[0], g.value[1], g.value[2], g.value[3],
                       g.value[4], g.value[5], g.active};
  assert_int_equal(fg__tensor_fill_box(&tensor, context, field, law, anisotropy, &g.cells,
                                       periodic, 0.06, NULL),
                   FG_STATUS_OK);
  return g;
}

static void discard(grid *g)
{
  for (int k = 0; k < 6; ++k)
    free(g->value[k]);
  free(g->active);
}

/* n.A n for n along the flow or across it. */
static double cost(const grid *g, size_t cell, int dimension, bool across)
{
  double flat = dimension == 3 ? 1.0 : hypot(along[0], along[1]), n[3] = {0.0};
  for (int k = 0; k < dimension; ++k)
    n[k] = along[k] / flat;
  if (across) {
    double old = n[0];
    n[0] = -n[1];
    n[1] = old;
    n[2] = 0.0;
    double length = hypot(n[0], n[1]);
    n[0] /= length;
    n[1] /= length;
  }
  double a[6];
  for (int k = 0; k < 6; ++k)
    a[k] = (double)g->value[k][cell];
  return a[0] * n[0] * n[0] + a[2] * n[1] * n[1] + a[3] * n[2] * n[2] +
         2.0 * (a[1] * n[0] * n[1] + a[4] * n[0] * n[2] + a[5] * n[1] * n[2]);
}

static void assert_anisotropy(int dimension)
{
  fg_context *context = NULL;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  fg_field *field = make_field(context, dimension);
  fg_energy_law law = fg__law_flow;
  law.data = &below;
  grid slow = fill(context, field, dimension, &law);
  grid usual = fill(context, field, dimension, &fg__law_flow);
  for (size_t n = 0; n < slow.count; ++n) {
    int i = (int)(n % CELLS_X);
    double speed = speed_at(5.0 + 0.05 * (i + 0.5));
    double a = 1.0 - (1.0 - anisotropy) * fmin(speed / below, 1.0);
    /* at the boundary the mean is one-sided, and at the bend it is rounded */
    bool clear = i > 4 && fabs(speed - below) > 0.3 * below;
    assert_true(fabs(cost(&slow, n, dimension, false) - 1.0) < 1e-5);
    assert_true(fabs(cost(&slow, n, dimension, true) - a) < (clear ? 2e-5 : 0.1));
    assert_true(fabs(cost(&usual, n, dimension, true) - anisotropy) < 2e-5);
    if (clear && speed > below)
      for (int k = 0; k < 6; ++k)
        assert_true(fabs((double)(slow.value[k][n] - usual.value[k][n])) < 1e-6);
  }
  discard(&slow);
  discard(&usual);
  fg_field_destroy(field);
  fg_context_destroy(context);
}

static void in_2d_the_anisotropy_follows_the_speed(void **state)
{
  (void)state;
  assert_anisotropy(2);
}

static void in_3d_the_anisotropy_follows_the_speed(void **state)
{
  (void)state;
  assert_anisotropy(3);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(in_2d_the_anisotropy_follows_the_speed),
      cmocka_unit_test(in_3d_the_anisotropy_follows_the_speed),
  };
  return cmocka_run_group_tests_name("tensor/slow_flow", tests, NULL, NULL);
}
