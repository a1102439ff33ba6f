#include <math.h>

#include "base/context_test.h"
#include "tensor/eigenvalues.h"

/* V diag(e) V^T for the orthonormal columns of a rotation by Euler angles. */
static void matrix_of(double matrix[6], const double e[3], const double angle[3])
{
  double c[3], s[3];
  for (int k = 0; k < 3; ++k) {
    c[k] = cos(angle[k]);
    s[k] = sin(angle[k]);
  }
  const double v[3][3] = {
      {c[0] * c[1] * c[2] - s[0] * s[2], -c[0] * c[1] * s[2] - s[0] * c[2], c[0] * s[1]},
      {s[0] * c[1] * c[2] + c[0] * s[2], -s[0] * c[1] * s[2] + c[0] * c[2], s[0] * s[1]},
      {-s[1] * c[2], s[1] * s[2], c[1]}};
  static const int place[6][2] = {{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}};
  for (int n = 0; n < 6; ++n) {
    matrix[n] = 0.0;
    for (int k = 0; k < 3; ++k)
      matrix[n] += e[k] * v[place[n][0]][k] * v[place[n][1]][k];
  }
}

static void what_went_in_comes_out(void **state)
{
  (void)state;
  const struct {
    double e[3], tolerance;
  } cases[] = {{{3.0, 1.25, -2.0}, 1e-14},    {{7e5, 3e4, 0.5}, 1e-9},
               {{2e-7, 1e-7, -3e-7}, 1e-21},  {{0.75, 0.75, -1.5}, 3e-8},
               {{1.0, 0.25, 0.25}, 3e-8},     {{-4.0, -4.0, -4.0}, 1e-7},
               {{1.0, 1.0 - 1e-5, 0.0}, 1e-9}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
    for (int turn = 0; turn < 12; ++turn) {
      double matrix[6], e[3], angle[3] = {0.3 + turn, 0.7 * turn, 1.9 - 0.4 * turn};
      matrix_of(matrix, cases[n].e, angle);
      fg__eigenvalues(e, matrix);
      for (int k = 0; k < 3; ++k)
        assert_true(fabs(e[k] - cases[n].e[k]) <= cases[n].tolerance);
    }
}

static void diagonal_matrices_are_sorted(void **state)
{
  (void)state;
  double e[3];
  fg__eigenvalues(e, (double[6]){-2.0, 0.0, 5.0, 1.0, 0.0, 0.0});
  assert_true(fabs(e[0] - 5.0) < 1e-14 && fabs(e[1] - 1.0) < 1e-14 &&
              fabs(e[2] + 2.0) < 1e-14);
  fg__eigenvalues(e, (double[6]){0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  assert_true(e[0] == 0.0 && e[1] == 0.0 && e[2] == 0.0);
  fg__eigenvalues(e, (double[6]){2.5, 0.0, 2.5, 2.5, 0.0, 0.0});
  assert_true(e[0] == 2.5 && e[1] == 2.5 && e[2] == 2.5);
}

/* Powers of entries this small vanish in double. */
static void tiny_entries_give_numbers(void **state)
{
  (void)state;
  for (double size = 1e-90; size > 1e-320; size *= 1e-10) {
    double e[3];
    fg__eigenvalues(e, (double[6]){size, 0.5 * size, -size, 0.0, 0.0, size});
    for (int k = 0; k < 3; ++k)
      assert_true(fabs(e[k]) <= 3.0 * size + 1e-160);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_went_in_comes_out),
      cmocka_unit_test(diagonal_matrices_are_sorted),
      cmocka_unit_test(tiny_entries_give_numbers),
  };
  return cmocka_run_group_tests_name("tensor/eigenvalues", tests, NULL, NULL);
}
