#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "icon/outline/smooth_line.h"

enum { POINTS = 301 };

/* y of x from 0 to 3. */
static void draw(double out[POINTS][3], double (*y)(double x))
{
  for (int n = 0; n < POINTS; ++n) {
    out[n][0] = 3.0 * n / (POINTS - 1);
    out[n][1] = y(out[n][0]);
    out[n][2] = 0.0;
  }
}

/* About as straight as an even arc: its least radius is 2. */
static double parabola(double x)
{
  return 0.25 * (x - 1.2) * (x - 1.2);
}

static double elbow(double x)
{
  return x < 1.4 ? 0.1 * x : 0.14 + 1.5 * (x - 1.4);
}

/* Waves of a fifth of the reach. */
static double wiggle(double x)
{
  return 0.3 * x + 0.02 * sin(x * 2.0 * acos(-1.0) / 0.12);
}

/* The largest angle between pieces next to each other, radians. */
static double sharpest(const double (*points)[3], int count)
{
  double most = 0.0;
  for (int n = 1; n + 1 < count; ++n) {
    const double a =
        atan2(points[n][1] - points[n - 1][1], points[n][0] - points[n - 1][0]);
    const double b =
        atan2(points[n + 1][1] - points[n][1], points[n + 1][0] - points[n][0]);
    most = fmax(most, fabs(a - b));
  }
  return most;
}

/* One that is tighter than the reach, too. */
static void even_arcs_stay(void **state)
{
  (void)state;
  double line[POINTS][3], (*smooth)[3];
  int count;
  draw(line, parabola);
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 0.6, 1e-3));
  assert_null(smooth);
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 0.6, 0.0));
  assert_non_null(smooth);
  for (int n = 0; n < count; ++n)
    assert_true(fabs(smooth[n][1] - parabola(smooth[n][0])) < 1e-3);
  free(smooth);
  for (int n = 0; n < POINTS; ++n) {
    line[n][0] = 0.3 * cos(5.0 * n / (POINTS - 1));
    line[n][1] = 0.3 * sin(5.0 * n / (POINTS - 1));
  }
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 0.6, 3e-3));
  assert_null(smooth);
}

static void kinks_are_rounded_and_ends_stay(void **state)
{
  (void)state;
  double line[POINTS][3], (*smooth)[3];
  int count;
  draw(line, elbow);
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 0.6, 0.01));
  assert_non_null(smooth);
  assert_true(sharpest((const double(*)[3])line, POINTS) > 0.8);
  assert_true(sharpest((const double(*)[3])smooth, count) < 0.2);
  for (int k = 0; k < 2; ++k) {
    assert_true(fabs(smooth[0][k] - line[0][k]) < 1e-12);
    assert_true(fabs(smooth[count - 1][k] - line[POINTS - 1][k]) < 1e-12);
  }
  for (int n = 0; n < count; ++n)
    assert_true(fabs(smooth[n][1] - elbow(smooth[n][0])) < 0.12);
  free(smooth);
}

static void wiggles_vanish(void **state)
{
  (void)state;
  double line[POINTS][3], (*smooth)[3];
  int count;
  draw(line, wiggle);
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 0.6, 0.01));
  assert_non_null(smooth);
  for (int n = 0; n < count; ++n)
    if (smooth[n][0] > 0.6 && smooth[n][0] < 2.4)
      assert_true(fabs(smooth[n][1] - 0.3 * smooth[n][0]) < 0.004);
  free(smooth);
}

/* A dot, and a line of a thousand reaches. */
static void what_is_no_stroke_stays(void **state)
{
  (void)state;
  static const double dot[2][3] = {{1.0, 2.0, 0.0}, {1.0, 2.0, 0.0}};
  double line[POINTS][3], (*smooth)[3];
  int count;
  draw(line, wiggle);
  assert_true(fg__smooth_line(&smooth, &count, dot, 2, 0.6, 0.0));
  assert_null(smooth);
  assert_true(
      fg__smooth_line(&smooth, &count, (const double(*)[3])line, POINTS, 3e-3, 0.0));
  assert_null(smooth);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(even_arcs_stay),
      cmocka_unit_test(kinks_are_rounded_and_ends_stay),
      cmocka_unit_test(wiggles_vanish),
      cmocka_unit_test(what_is_no_stroke_stays),
  };
  return cmocka_run_group_tests_name("picture/smooth_line", tests, NULL, NULL);
}
