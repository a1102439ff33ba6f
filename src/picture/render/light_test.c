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
  static fg__tones tones;
  fg__tones_make(&tones);
  const uint32_t pixel =
      fg__light_pixel(&tones, fg__light_arrow(&tones, color, &lit), false);
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

/* The tables against the formulas of IEC 61966-2-1, between their entries. */
static void tables_are_exact_to_a_hundredth_of_a_level(void **state)
{
  (void)state;
  static fg__tones tones;
  fg__tones_make(&tones);
  for (int n = 0; n < 3000; ++n) {
    double light = pow((n + 0.37) / 3000.0, 2.0);
    double level =
        light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
    for (int shown = 0; shown < 2; ++shown) {
      const fg__light white = {light, light, light, 1.0};
      const uint32_t pixel = fg__light_pixel(&tones, white, shown);
      double nearest = floor(255.0 * level + 0.5), rest = fabs(255.0 * level - nearest);
      if (rest < 0.49) /* else the neighbour is as near */
        assert_int_equal(pixel & 255U, (int)nearest);
      assert_int_equal(pixel >> 24, 255);
    }
  }
}

/* The disc overhead: each ring and each half has its share of the places. */
static void places_fill_the_disc(void **state)
{
  (void)state;
  enum { COUNT = 64 };
  int inner = 0, half[2] = {0}, quarter[4] = {0};
  for (int n = 0; n < COUNT; ++n) {
    double slope[2], place[2];
    fg__overhead_place(n, COUNT, slope, place);
    double radius = hypot(slope[0], slope[1]) / fg__overhead_size;
    assert_true(radius < 1.0);
    inner += radius < sqrt(0.5);
    for (int k = 0; k < 2; ++k) {
      assert_true(place[k] >= 0.0 && place[k] < 1.0);
      half[k] += slope[k] > 0.0;
    }
    ++quarter[2 * (place[0] < 0.5) + (place[1] < 0.5)];
  }
  assert_int_equal(inner, COUNT / 2);
  for (int k = 0; k < 2; ++k)
    assert_true(abs(half[k] - COUNT / 2) <= 2);
  for (int n = 0; n < 4; ++n)
    assert_true(abs(quarter[n] - COUNT / 4) <= 3);
}

/* Shadows of many arrows would else be read as arrows. */
static void shadows_are_faint(void **state)
{
  (void)state;
  const double bright = fg__light_wall(2, 1.0).red, dark = fg__light_wall(2, 0.0).red;
  assert_true(dark > 0.8 * bright && dark < 0.9 * bright);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(far_colors_keep_apart_alike),
      cmocka_unit_test(tables_are_exact_to_a_hundredth_of_a_level),
      cmocka_unit_test(places_fill_the_disc),
      cmocka_unit_test(shadows_are_faint),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
