#include <math.h>
#include <stdlib.h>

#include "base/context_test.h"
#include "picture/light.h"

/* Levels of an arrow's pixel as a picture has them, 0 to 255, without a glint. */
static void levels_of(double out[3], fg__color color, double depth)
{
  const fg__lit lit = {.normal = {0.0, -0.6, 0.8},
                       .to_viewer = {0.0, -0.6, 0.8},
                       .lamp = {0.0, 0.8, 0.6},
                       .sky_seen = 1.0,
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
    assert_true(kept[0][k] > 0.6 && kept[0][k] < 0.95);
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
      fg__light_numbers(3 * pixel, 7 * pixel + 1, n, 1, number);
      for (int k = 0; k < 2; ++k)
        assert_true(number[k] >= 0.0 && number[k] < 1.0);
      ++quarter[2 * (number[0] < 0.5) + (number[1] < 0.5)];
    }
    for (int n = 0; n < 4; ++n)
      assert_true(quarter[n] >= 2 && quarter[n] <= 7);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(far_colors_keep_apart_alike),
      cmocka_unit_test(samples_of_a_pixel_are_evenly_spread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
