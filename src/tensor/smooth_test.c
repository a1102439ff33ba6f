#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "tensor/tensor.h"

enum { COLUMNS = 46, ROWS = 30, COUNT = COLUMNS * ROWS };

static const double ANISOTROPY = 0.17;
static const double PI = 3.14159265358979323846;

typedef struct grid {
  fg__cells cells;
  float xx[COUNT], xy[COUNT], yy[COUNT];
  unsigned char active[COUNT];
  fg__tensor tensor;
} grid;

static size_t at(int i, int j)
{
  return (size_t)(j * COLUMNS + i);
}

static void set_angle(grid *g, int i, int j, double angle)
{
  double tensor[6], tangent[3] = {3.0 * cos(angle), 3.0 * sin(angle), 0.0};
  fg__tensor_along(tensor, tangent, ANISOTROPY);
  g->xx[at(i, j)] = (float)tensor[0];
  g->xy[at(i, j)] = (float)tensor[1];
  g->yy[at(i, j)] = (float)tensor[2];
  g->active[at(i, j)] = 1;
}

static grid *grid_of(double (*angle)(int i, int j))
{
  grid *g = calloc(1, sizeof *g);
  assert_non_null(g);
  g->cells = (fg__cells){.dimension = 2,
                         .count = {COLUMNS, ROWS},
                         .origin = {2.0, -1.0},
                         .spacing = {0.5, 0.4}};
  g->tensor = (fg__tensor){.xx = g->xx, .xy = g->xy, .yy = g->yy, .active = g->active};
  for (int j = 0; j < ROWS; ++j)
    for (int i = 0; i < COLUMNS; ++i)
      set_angle(g, i, j, angle(i, j));
  return g;
}

static void smooth(grid *g, bool x_periodic, double width)
{
  bool periodic[3] = {x_periodic, false, false};
  assert_int_equal(
      fg__tensor_smooth(&g->tensor, NULL, ANISOTROPY, &g->cells, periodic, width, NULL),
      0);
}

/* Eigenvalues and the angle of the larger one's direction, in [0, pi). */
typedef struct axes {
  double small, large, angle;
} axes;

static axes axes_at(const grid *g, int i, int j)
{
  double xx = (double)g->xx[at(i, j)], xy = (double)g->xy[at(i, j)];
  double yy = (double)g->yy[at(i, j)];
  double radius = hypot(0.5 * (xx - yy), xy);
  double angle = 0.5 * atan2(2.0 * xy, xx - yy);
  return (axes){0.5 * (xx + yy) - radius, 0.5 * (xx + yy) + radius,
                angle < 0.0 ? angle + PI : angle};
}

static double constant_angle(int i, int j)
{
  (void)i, (void)j;
  return 0.8;
}

static double bent_angle(int i, int j)
{
  return 0.4 + 0.01 * i + 0.015 * j;
}

/* Directions spread evenly over the half circle within every few cells. */
static double incoherent_angle(int i, int j)
{
  return PI * ((i + 2 * j) % 5) / 5.0;
}

/* Reverses from row to row: the axis is the same, the arrow is not. */
static double alternating_angle(int i, int j)
{
  (void)i;
  return 1.1 + (j % 2 ? PI : 0.0);
}

static double left_and_right_angle(int i, int j)
{
  (void)j;
  return i < COLUMNS / 2 ? 0.3 : 1.2;
}

static void one_direction_stays(void **state)
{
  (void)state;
  double (*cases[])(int, int) = {constant_angle, alternating_angle};
  double wanted[] = {0.8, 1.1};
  for (int n = 0; n < 2; ++n) {
    grid *g = grid_of(cases[n]);
    smooth(g, false, 1.3);
    for (int j = 0; j < ROWS; ++j)
      for (int i = 0; i < COLUMNS; ++i) {
        axes a = axes_at(g, i, j);
        assert_true(fabs(a.small - ANISOTROPY) < 1e-5 && fabs(a.large - 1.0) < 1e-5);
        assert_true(fabs(a.angle - wanted[n]) < 1e-5);
      }
    free(g);
  }
}

static void slow_turns_are_followed(void **state)
{
  (void)state;
  grid *g = grid_of(bent_angle);
  smooth(g, false, 0.9);
  for (int j = 8; j < ROWS - 8; ++j)
    for (int i = 8; i < COLUMNS - 8; ++i) {
      axes a = axes_at(g, i, j);
      assert_true(fabs(a.angle - bent_angle(i, j)) < 1e-3);
      assert_true(fabs(a.small - ANISOTROPY) < 1e-5);
    }
  free(g);
}

static void directions_that_cancel_leave_no_preference(void **state)
{
  (void)state;
  grid *g = grid_of(incoherent_angle);
  smooth(g, false, 2.0);
  for (int j = 6; j < ROWS - 6; ++j)
    for (int i = 6; i < COLUMNS - 6; ++i) {
      axes a = axes_at(g, i, j);
      assert_true(a.small > 0.95 && a.large < 1.0 + 1e-5);
    }
  free(g);
}

static void tensors_stay_between_the_two_costs(void **state)
{
  (void)state;
  grid *g = grid_of(left_and_right_angle);
  smooth(g, false, 1.0);
  for (int j = 0; j < ROWS; ++j)
    for (int i = 0; i < COLUMNS; ++i) {
      axes a = axes_at(g, i, j);
      assert_true(a.small > ANISOTROPY - 1e-5 && a.large < 1.0 + 1e-5);
    }
  free(g);
}

static void a_mask_separates(void **state)
{
  (void)state;
  grid *g = grid_of(left_and_right_angle);
  for (int j = 0; j < ROWS; ++j) {
    /* a wall wider than the Gaussian reaches, with nonsense in it */
    for (int i = COLUMNS / 2 - 8; i < COLUMNS / 2 + 8; ++i) {
      set_angle(g, i, j, 0.75);
      g->active[at(i, j)] = 0;
    }
  }
  smooth(g, false, 2.0);
  for (int j = 0; j < ROWS; ++j)
    for (int i = 0; i < COLUMNS; ++i)
      if (g->active[at(i, j)])
        assert_true(fabs(axes_at(g, i, j).angle - left_and_right_angle(i, j)) < 1e-4);
  assert_true(g->xx[at(COLUMNS / 2, 3)] == 0.0F);
  free(g);
}

static void a_periodic_seam_is_no_boundary(void **state)
{
  (void)state;
  grid *open = grid_of(left_and_right_angle), *closed = grid_of(left_and_right_angle);
  smooth(open, false, 1.5);
  smooth(closed, true, 1.5);
  /* by symmetry the seam of the closed grid looks like its middle, where both sides meet
   */
  axes seam = axes_at(closed, 0, 12), middle = axes_at(closed, COLUMNS / 2 - 1, 12);
  assert_true(fabs(seam.angle - middle.angle) < 1e-4);
  assert_true(fabs(axes_at(open, 0, 12).angle - 0.3) < 1e-5);
  assert_true(fabs(seam.angle - 0.3) > 0.1);
  free(open);
  free(closed);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_direction_stays),
      cmocka_unit_test(slow_turns_are_followed),
      cmocka_unit_test(directions_that_cancel_leave_no_preference),
      cmocka_unit_test(tensors_stay_between_the_two_costs),
      cmocka_unit_test(a_mask_separates),
      cmocka_unit_test(a_periodic_seam_is_no_boundary),
  };
  return cmocka_run_group_tests_name("tensor/smooth", tests, NULL, NULL);
}
