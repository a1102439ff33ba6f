#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "picture/render/light.h"

/* Levels of an arrow's pixel as a picture has them, 0 to 255, without a glint. */
static void levels_of(double out[3], fg__color color, double depth)
{
  const fg__lit lit = {.normal = {0.0, -0.6, 0.8},
                       .to_viewer = {0.0, -0.6, 0.8},
                       .lamp = {0.0, 0.8, 0.6},
                       .depth = depth};
  const uint32_t pixel = fg__light_pixel(fg__light_arrow(color, &lit), false);
  for (int k = 0; k < 3; ++k)
    out[k] = pixel >> (16 - 8 * k) & 255;
}

/* What is far has less contrast, but no more is lost among dark colours than among light
 * ones: a dark one does not look like another of the key. */
static void far_colors_keep_apart_alike(void **state)
{
  (void)state;
  const fg__color dark[2] = {{0.05, 0.08, 0.03}, {0.36, 0.42, 0.31}},
                  light[2] = {{0.58, 0.62, 0.66}, {0.93, 0.98, 1.00}};
  double kept[2][3];
  for (int pair = 0; pair < 2; ++pair) {
    const fg__color *color = pair ? light : dark;
    double one[2][3], other[2][3];
    for (int far = 0; far < 2; ++far) {
      levels_of(one[far], color[0], far);
      levels_of(other[far], color[1], far);
    }
    for (int k = 0; k < 3; ++k)
      kept[pair][k] = (other[1][k] - one[1][k]) / (other[0][k] - one[0][k]);
  }
  for (int k = 0; k < 3; ++k) {
    assert_true(kept[0][k] > 0.5 && kept[0][k] < 0.75);
    assert_true(fabs(kept[0][k] - kept[1][k]) < 0.06); /* bytes: 1 of 50 and more */
  }
}

static void samples_of_a_pixel_are_evenly_spread(void **state)
{
  (void)state;
  for (int pixel = 0; pixel < 50; ++pixel) {
    int quarter[4] = {0};
    for (int n = 0; n < 16; ++n) {
      double number[2];
      fg__light_numbers(16 * fg__light_order(3 * pixel, 7 * pixel + 1) + (unsigned)n, 1,
                        number);
      for (int k = 0; k < 2; ++k)
        assert_true(number[k] >= 0.0 && number[k] < 1.0);
      ++quarter[2 * (number[0] < 0.5) + (number[1] < 0.5)];
    }
    for (int n = 0; n < 4; ++n)
      assert_true(quarter[n] >= 2 && quarter[n] <= 7);
  }
}

/* Squares whose side and corner are multiples of a power of two are each one stretch of
 * the curve, from neighbour to neighbour. */
static void the_order_of_pixels_is_a_hilbert_curve(void **state)
{
  (void)state;
  enum { SIDE = 16 };
  const int corner[2] = {5 * SIDE, 83 * SIDE};
  int place[SIDE * SIDE][2];
  bool met[SIDE * SIDE] = {false};
  uint64_t first = fg__light_order(corner[0], corner[1]) / (SIDE * SIDE) * (SIDE * SIDE);
  for (int n = 0; n < SIDE * SIDE; ++n) {
    int x = corner[0] + n % SIDE, y = corner[1] + n / SIDE;
    uint64_t at = fg__light_order(x, y) - first;
    assert_true(at < SIDE * SIDE && !met[at]);
    met[at] = true;
    place[at][0] = x;
    place[at][1] = y;
  }
  for (int n = 1; n < SIDE * SIDE; ++n)
    assert_int_equal(
        abs(place[n][0] - place[n - 1][0]) + abs(place[n][1] - place[n - 1][1]), 1);
}

/* A disc's share of the square, by the numbers of one pixel and of 4 x 4 together: what
 * one has too much others have too little. */
static void pixels_make_up_for_each_other(void **state)
{
  (void)state;
  const double share = 3.141592653589793 * 0.09;
  double single = 0.0, together = 0.0;
  for (int block = 0; block < 64; ++block) {
    int seen = 0;
    for (int n = 0; n < 16; ++n) {
      int x = 4 * block + n % 4, y = 4 * (block % 7) + n / 4, own = 0;
      for (int m = 0; m < 16; ++m) {
        double number[2];
        fg__light_numbers(16 * fg__light_order(x, y) + (unsigned)m, 1, number);
        own += hypot(number[0] - 0.45, number[1] - 0.52) < 0.3;
      }
      seen += own;
      single += pow(own / 16.0 - share, 2.0) / (64 * 16);
    }
    together += pow(seen / 256.0 - share, 2.0) / 64;
  }
  assert_true(single > 0.0);
  /* independent sets would leave a quarter, and 16 numbers by chance 0.11 */
  assert_true(sqrt(together) < 0.2 * sqrt(single));
  assert_true(sqrt(single) < 0.07);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(far_colors_keep_apart_alike),
      cmocka_unit_test(samples_of_a_pixel_are_evenly_spread),
      cmocka_unit_test(the_order_of_pixels_is_a_hilbert_curve),
      cmocka_unit_test(pixels_make_up_for_each_other),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
