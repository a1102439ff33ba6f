#include "place/domain/distance.h"

#include "score/picture_test.h"

/* By every cell and every other, a ring of outer ones round the raster included. */
static double distance_of(const int *inside, const int cells[3], int dimension, int x,
                          int y, int z)
{
  double least = HUGE_VAL;
  int flat = dimension == 2;
  for (int c = flat ? 0 : -1; c <= (flat ? 0 : cells[2]); ++c)
    for (int b = -1; b <= cells[1]; ++b)
      for (int a = -1; a <= cells[0]; ++a) {
        bool beyond =
            a < 0 || b < 0 || c < 0 || a >= cells[0] || b >= cells[1] || c >= cells[2];
        if (beyond || !inside[(c * cells[1] + b) * cells[0] + a])
          least = fmin(least, hypot(hypot(a - x, b - y), c - z));
      }
  return least - 0.5;
}

static void check(fg_context *context, const int cells[3], int dimension, double share,
                  unsigned seed)
{
  enum { MOST = 600 };
  int inside[MOST], count = cells[0] * cells[1] * cells[2];
  float found[MOST];
  const double spacing = 0.37;
  for (int n = 0; n < count; ++n)
    inside[n] = next_random(&seed) < share ? 3 : 0;
  assert_int_equal(fg__place_distance(found, context, inside, cells, dimension, spacing),
                   FG_STATUS_OK);
  for (int z = 0, n = 0; z < cells[2]; ++z)
    for (int y = 0; y < cells[1]; ++y)
      for (int x = 0; x < cells[0]; ++x, ++n) {
        double wanted =
            inside[n] ? spacing * distance_of(inside, cells, dimension, x, y, z) : 0.0;
        assert_close((double)found[n], wanted, 1e-6);
      }
}

static void distances_are_those_to_the_nearest_outer_cell(void **state)
{
  static const double shares[] = {0.3, 0.8, 0.97, 1.0};
  for (unsigned n = 0; n < 4; ++n) {
    check(*state, (const int[3]){29, 17, 1}, 2, shares[n], 11 + n);
    check(*state, (const int[3]){5, 41, 1}, 2, shares[n], 21 + n);
    check(*state, (const int[3]){11, 7, 6}, 3, shares[n], 31 + n);
  }
}

static void a_single_cell_is_half_a_cell_from_the_frame(void **state)
{
  check(*state, (const int[3]){1, 1, 1}, 2, 1.0, 1);
  check(*state, (const int[3]){7, 1, 1}, 2, 1.0, 1);
  check(*state, (const int[3]){1, 1, 9}, 3, 1.0, 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(distances_are_those_to_the_nearest_outer_cell),
      CASE(a_single_cell_is_half_a_cell_from_the_frame),
  };
  return cmocka_run_group_tests_name("place/domain/distance", tests, NULL, NULL);
}
