#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "tensor/tensor.h"

/* Speeds are stored in float; a difference over a cell of a tenth of the domain loses a
 * digit of them. */
static const double ROUNDING = 2e-5;
static const double ANISOTROPY = 0.23;

enum { N = 9, CELLS = 7, MOST_CELLS = CELLS * CELLS * CELLS };

typedef struct filled {
  fg__cells cells;
  float entry[6][MOST_CELLS];
  unsigned char active[MOST_CELLS];
  fg__tensor tensor;
} filled;

typedef double speed_law(double x, double y, double z);

/* A field that points anywhere with the given speed, on the box [1, 3] x [-2, 0.5] x
 * [0, 4]; sample `hole` is missing. */
static fg_field *field_with_speed(fg_context *context, int dimension, speed_law *speed,
                                  size_t hole)
{
  static const double low[3] = {1.0, -2.0, 0.0}, high[3] = {3.0, 0.5, 4.0};
  static double axis[3][N];
  static float velocity[3][N * N * N];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < N; ++i)
      axis[k][i] = low[k] + (high[k] - low[k]) * i / (N - 1);
  size_t n = 0;
  for (int k = 0; k < (dimension == 3 ? N : 1); ++k)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i, ++n) {
        double s = speed(axis[0][i], axis[1][j], dimension == 3 ? axis[2][k] : 0.0);
        velocity[0][n] = (float)(s * (dimension == 3 ? 0.48 : 0.6));
        velocity[1][n] = (float)(s * (dimension == 3 ? -0.64 : -0.8));
        velocity[2][n] = (float)(s * 0.6);
        if (n == hole)
          velocity[0][n] = NAN;
      }
  fg_field_arrays arrays = {.dimension = dimension,
                            .size = {N, N, N},
                            .axis = {axis[0], axis[1], axis[2]},
                            .velocity = {velocity[0], velocity[1], velocity[2]}};
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, &arrays), FG_STATUS_OK);
  return field;
}

static void fill(filled *f, fg_context *context, const fg_field *field,
                 const fg_energy_law *law)
{
  const fg_field_arrays *a = fg_field_contents(field);
  memset(f, 0, sizeof *f);
  f->cells = (fg__cells){.dimension = a->dimension, .count = {CELLS, CELLS, CELLS}};
  for (int k = 0; k < a->dimension; ++k) {
    f->cells.origin[k] = a->axis[k][0];
    f->cells.spacing[k] = (a->axis[k][a->size[k] - 1] - a->axis[k][0]) / CELLS;
  }
  f->tensor = (fg__tensor){f->entry[0], f->entry[1], f->entry[2], f->entry[3],
                           f->entry[4], f->entry[5], f->active};
  assert_int_equal(
      fg__tensor_fill(&f->tensor, context, field, law, ANISOTROPY, &f->cells, NULL),
      FG_STATUS_OK);
}

/* A d = factor d for a unit vector d. */
static void assert_eigenvector(const filled *f, size_t n, const double d[3],
                               double factor)
{
  double a[6];
  for (int k = 0; k < 6; ++k)
    a[k] = (double)f->entry[k][n];
  double out[3] = {a[0] * d[0] + a[1] * d[1] + a[4] * d[2],
                   a[1] * d[0] + a[2] * d[1] + a[5] * d[2],
                   a[4] * d[0] + a[5] * d[1] + a[3] * d[2]};
  for (int k = 0; k < f->cells.dimension; ++k)
    assert_true(fabs(out[k] - factor * d[k]) < ROUNDING);
}

static double ramp(double x, double y, double z)
{
  return 20.0 + 3.0 * x - 1.5 * y + 2.0 * z;
}

/* Also beside a hole and at the domain's ends, where differences are one-sided. */
static void the_gradient_is_cheap_to_cross(void **state)
{
  fg_context *context = *state;
  static filled f;
  for (int dimension = 2; dimension <= 3; ++dimension) {
    fg_field *field = field_with_speed(context, dimension, ramp, 40);
    double z = dimension == 3 ? 2.0 : 0.0, length = hypot(hypot(3.0, 1.5), z);
    double e[3] = {3.0 / length, -1.5 / length, z / length};
    double across[3] = {1.5 / hypot(3.0, 1.5), 3.0 / hypot(3.0, 1.5), 0.0};
    fill(&f, context, field, &fg__law_gradient);
    size_t inactive = 0;
    for (size_t n = 0; n < fg__cell_count(&f.cells); ++n) {
      inactive += !f.active[n];
      if (!f.active[n])
        continue;
      assert_eigenvector(&f, n, e, ANISOTROPY);
      assert_eigenvector(&f, n, across, 1.0);
    }
    assert_true(inactive > 0 && inactive < fg__cell_count(&f.cells) / 4);
    fg_field_destroy(field);
  }
}

static double steady(double x, double y, double z)
{
  (void)x;
  (void)y;
  (void)z;
  return 7.5;
}

static void where_the_speed_is_even_nothing_is_preferred(void **state)
{
  fg_context *context = *state;
  static filled f;
  fg_field *field = field_with_speed(context, 2, steady, SIZE_MAX);
  fill(&f, context, field, &fg__law_gradient);
  for (size_t n = 0; n < fg__cell_count(&f.cells); ++n) {
    assert_true(f.entry[0][n] == 1.0F && f.entry[2][n] == 1.0F);
    assert_true(f.entry[1][n] == 0.0F);
  }
  fg_field_destroy(field);
}

/* In a vortex the level sets of the speed are the streamlines. */
static void in_a_vortex_both_energies_agree(void **state)
{
  fg_context *context = *state;
  static filled flow, gradient;
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, context, "vortex", 65), FG_STATUS_OK);
  fill(&flow, context, field, &fg__law_flow);
  fill(&gradient, context, field, &fg__law_gradient);
  for (size_t n = 0; n < fg__cell_count(&flow.cells); ++n)
    for (int k = 0; k < 3 && n != CELLS * CELLS / 2; ++k) /* the core has no direction */
      assert_true(fabs((double)(flow.entry[k][n] - gradient.entry[k][n])) < 0.02);
  fg_field_destroy(field);
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(the_gradient_is_cheap_to_cross),
      CASE(where_the_speed_is_even_nothing_is_preferred),
      CASE(in_a_vortex_both_energies_agree),
  };
  return cmocka_run_group_tests_name("tensor/gradient", tests, NULL, NULL);
}
