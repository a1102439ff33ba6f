#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "evolve/components.h"
#include "evolve/means.h"

/* Two rooms beside each other along z, the wall a layer of masked cells that is open
 * nowhere; the second room is L-shaped. */
enum { W = 7, H = 5, D = 9, N = W * H * D, CW = W - 1, CH = H - 1, CD = D - 1 };

typedef struct rooms {
  unsigned char active[CW * CH * CD];
  float mass[N], u[N];
  fg__components parts;
} rooms;

static int set_up(void **state)
{
  rooms *r = calloc(1, sizeof *r);
  for (int n = 0; n < CW * CH * CD; ++n) {
    int x = n % CW, z = n / (CW * CH);
    r->active[n] = z != 3 && !(z > 5 && x > 2);
  }
  srand(4);
  for (int n = 0; n < N; ++n) {
    r->u[n] = (float)(rand() % 2000 - 1100) / 1000.0F;
    for (int corner = 0; corner < 8; ++corner) {
      int x = n % W - corner % 2, y = n / W % H - corner / 2 % 2;
      int z = n / (W * H) - corner / 4;
      if (x >= 0 && y >= 0 && z >= 0 && x < CW && y < CH && z < CD &&
          r->active[(z * CH + y) * CW + x])
        r->mass[n] += 0.125F;
    }
  }
  fg__component_grid grid = {.nodes = {W, H, D}, .active = r->active};
  *state = r;
  return fg__components_find(&r->parts, NULL, &grid) != FG_STATUS_OK;
}

static int tear_down(void **state)
{
  rooms *r = *state;
  fg__components_clear(&r->parts);
  free(r);
  return 0;
}

static void test_parts_are_what_the_mask_separates(void **state)
{
  rooms *r = *state;
  assert_int_equal(r->parts.count, 2);
  assert_int_equal(r->parts.debris, 0);
  assert_true(r->parts.area[0] == 6 * 4 * 3);
  assert_true(r->parts.area[1] == 6 * 4 * 2 + 3 * 4 * 2);
  for (int n = 0; n < N; ++n) {
    int z = n / (W * H);
    int expected = z <= 3 ? 1 : r->mass[n] > 0.0F ? 2 : 0;
    assert_int_equal(r->parts.label[n], expected);
  }
}

static void add_all(fg__means *means, const rooms *r, bool backwards, bool weigh)
{
  for (int row = 0; row < N / W; ++row) {
    int first = (backwards ? N / W - 1 - row : row) * W;
    int half = row % W;
    fg__means_add_row(means, r->parts.label + first, r->mass + first, r->u + first, half,
                      weigh);
    fg__means_add_row(means, r->parts.label + first + half, r->mass + first + half,
                      r->u + first + half, W - half, weigh);
  }
}

static double mean_of_part(const rooms *r, int part)
{
  double sum = 0.0, mass = 0.0;
  for (int n = 0; n < N; ++n)
    if (r->parts.label[n] == part) {
      sum += (double)r->mass[n] * (double)r->u[n];
      mass += (double)r->mass[n];
    }
  return sum / mass;
}

static void test_each_part_gets_its_mean_back(void **state)
{
  rooms *r = *state;
  fg__means means;
  assert_int_equal(fg__means_create(&means, NULL, 2), FG_STATUS_OK);
  add_all(&means, r, false, true);
  fg__means_hold(&means);
  const double before[2] = {mean_of_part(r, 1), mean_of_part(r, 2)};
  float outside[N];
  for (int n = 0; n < N; ++n) {
    r->u[n] += r->parts.label[n] == 1 ? 0.07F : (float)(n % 3) * -0.05F;
    outside[n] = r->u[n];
  }
  fg__means_begin(&means);
  add_all(&means, r, true, false);
  fg__means_settle(&means);
  for (int row = 0; row < N; row += W)
    fg__means_shift_row(&means, r->parts.label + row, r->u + row, W);
  assert_true(fabs(mean_of_part(r, 1) - before[0]) < 1e-7);
  assert_true(fabs(mean_of_part(r, 2) - before[1]) < 1e-7);
  for (int n = 0; n < N; ++n)
    if (r->parts.label[n] == 0)
      assert_true(r->u[n] == outside[n]);
  fg__means_clear(&means);
}

static void test_sums_know_no_order(void **state)
{
  rooms *r = *state;
  fg__means one, other;
  assert_int_equal(fg__means_create(&one, NULL, 2), FG_STATUS_OK);
  assert_int_equal(fg__means_create(&other, NULL, 2), FG_STATUS_OK);
  add_all(&one, r, false, true);
  add_all(&other, r, true, true);
  for (int n = 0; n < 2; ++n) {
    assert_true(one.sum[n] == other.sum[n]);
    assert_true(one.mass[n] == other.mass[n]);
  }
  fg__means_clear(&one);
  fg__means_clear(&other);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_parts_are_what_the_mask_separates, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_each_part_gets_its_mean_back, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_sums_know_no_order, set_up, tear_down),
  };
  return cmocka_run_group_tests_name("evolve/means", tests, NULL, NULL);
}
