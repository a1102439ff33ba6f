#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "field/noise.h"

static void test_a_row_in_pieces_is_the_row(void **state)
{
  (void)state;
  const int cells[3] = {60, 7, 9};
  const double spacing[3] = {0.1, 0.13, 0.07};
  const bool periodic[3] = {true, false, true};
  for (int dimension = 2; dimension <= 3; ++dimension) {
    fg__noise noise =
        fg__noise_of(dimension, cells, spacing, periodic, 0.2, 1.5, 0.037 * dimension, 9);
    float whole[60], piece[60];
    int k = dimension == 3 ? 5 : 0;
    fg__noise_row(&noise, 3, k, 0, 60, whole);
    fg__noise_row(&noise, 3, k, 0, 17, piece);
    fg__noise_row(&noise, 3, k, 17, 1, piece + 17);
    fg__noise_row(&noise, 3, k, 18, 42, piece + 18);
    for (int i = 0; i < 60; ++i)
      assert_true(whole[i] == piece[i]);
  }
}

/* Every second node of twice the cells is a node of the coarse grid. */
static void test_belongs_to_the_place(void **state)
{
  (void)state;
  const int coarse_cells[3] = {30, 22, 18}, fine_cells[3] = {60, 44, 36};
  const double coarse_spacing[3] = {0.5, 0.25, 1.0}, fine_spacing[3] = {0.25, 0.125, 0.5};
  const bool periodic[3] = {false, true, false};
  fg__noise coarse =
      fg__noise_of(3, coarse_cells, coarse_spacing, periodic, 0, 1.5, 0.7, 3);
  fg__noise fine = fg__noise_of(3, fine_cells, fine_spacing, periodic, 0, 1.5, 0.7, 3);
  float row[31], fine_row[61];
  for (int k = 0; k <= 18; ++k) {
    fg__noise_row(&coarse, (5 * k) % 22, k, 0, 31, row);
    fg__noise_row(&fine, 2 * ((5 * k) % 22), 2 * k, 0, 61, fine_row);
    for (int i = 0; i <= 30; ++i)
      assert_true(row[i] == fine_row[2 * i]);
  }
}

static void test_closes_on_a_periodic_axis(void **state)
{
  (void)state;
  const int cells[3] = {20, 24, 28};
  const double spacing[3] = {0.05, 0.05, 0.05};
  const bool periodic[3] = {true, true, true};
  fg__noise noise = fg__noise_of(3, cells, spacing, periodic, 0.1, 1.5, 0.06, 1);
  float row[41], same[41], other[41];
  fg__noise_row(&noise, 3, 4, 0, 41, row);
  fg__noise_row(&noise, 3 + 24, 4 - 28, 0, 41, same);
  fg__noise_row(&noise, 4, 4, 0, 41, other);
  double change = 0.0;
  for (int i = 0; i < 20; ++i) {
    assert_true(fabsf(row[i] - row[i + 20]) < 1e-5F);
    assert_true(fabsf(row[i] - same[i]) < 1e-5F);
    change += fabs((double)(row[i] - other[i])) / 20.0;
  }
  assert_true(change > 0.1);
}

typedef struct moments {
  double mean, deviation, next; /* next: correlation with the next node along z (y) */
} moments;

static moments measure(int dimension, double amplitude, double length, uint64_t seed)
{
  enum { N = 64 };
  const int cells[3] = {N, dimension == 3 ? N : N * N, N};
  const double spacing[3] = {1.0, 1.0, 1.0};
  const bool periodic[3] = {true, true, true};
  fg__noise noise =
      fg__noise_of(dimension, cells, spacing, periodic, 0.25, amplitude, length, seed);
  double sum = 0.0, squares = 0.0, product = 0.0;
  for (int m = 0; m < N * N; ++m) {
    int j = dimension == 3 ? m % N : m, k = dimension == 3 ? m / N : 0;
    float row[N], beyond[N];
    fg__noise_row(&noise, j, k, 0, N, row);
    fg__noise_row(&noise, j + (dimension == 2), k + (dimension == 3), 0, N, beyond);
    for (int i = 0; i < N; ++i) {
      double a = (double)row[i] - 0.25, b = (double)beyond[i] - 0.25;
      sum += a;
      squares += a * a;
      product += a * b;
    }
  }
  double count = (double)N * N * N;
  return (moments){sum / count, sqrt(squares / count), product / squares};
}

/* Uniform numbers in [-1.5, 1.5) have the deviation 1.5 / sqrt(3), and scaling gives back
 * what smoothing takes. */
static void test_has_one_deviation_in_2d_and_3d(void **state)
{
  (void)state;
  const double length = 1.37; /* nodes meet all phases of the lattice */
  moments plane = measure(2, 1.5, length, 11), space = measure(3, 1.5, length, 11);
  moments weak = measure(2, 0.15, length, 11);
  assert_true(fabs(plane.mean) < 0.02 && fabs(space.mean) < 0.02);
  assert_true(fabs(plane.deviation - 1.5 / sqrt(3.0)) < 0.03 * 1.5);
  assert_true(fabs(space.deviation - plane.deviation) < 0.02 * plane.deviation);
  assert_true(fabs(space.next - plane.next) < 0.02);
  assert_true(plane.next > 0.2);
  assert_true(fabs(10.0 * weak.deviation - plane.deviation) < 1e-4 * plane.deviation);
  assert_true(fabs(10.0 * weak.mean - plane.mean) < 1e-5); /* off the same 0.25 */
}

static void test_another_seed_is_another_noise(void **state)
{
  (void)state;
  const int cells[3] = {200, 4, 4};
  const double spacing[3] = {1.0, 1.0, 1.0};
  const bool periodic[3] = {false, false, false};
  double product = 0.0, squares = 0.0;
  fg__noise a = fg__noise_of(3, cells, spacing, periodic, 0.0, 1.5, 0.9, 1);
  fg__noise b = fg__noise_of(3, cells, spacing, periodic, 0.0, 1.5, 0.9, 2);
  for (int k = 0; k < 5; ++k) {
    float one[201], two[201];
    fg__noise_row(&a, 2, k, 0, 201, one);
    fg__noise_row(&b, 2, k, 0, 201, two);
    for (int i = 0; i <= 200; ++i) {
      product += (double)one[i] * (double)two[i];
      squares += (double)one[i] * (double)one[i];
    }
  }
  assert_true(fabs(product) < 0.15 * squares);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_a_row_in_pieces_is_the_row),
      cmocka_unit_test(test_belongs_to_the_place),
      cmocka_unit_test(test_closes_on_a_periodic_axis),
      cmocka_unit_test(test_has_one_deviation_in_2d_and_3d),
      cmocka_unit_test(test_another_seed_is_another_noise),
  };
  return cmocka_run_group_tests_name("field/noise", tests, NULL, NULL);
}
