#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/palette.h"

static double contrast_on(fg__color mark, double page)
{
  double luminance = fg__color_luminance(mark);
  return (fmax(luminance, page) + 0.05) / (fmin(luminance, page) + 0.05);
}

static void every_map_is_monotone_and_stands_out_from_white(void **state)
{
  (void)state;
  int count = 0;
  for (const char *const *name = fg_picture_palettes(); *name; ++name, ++count) {
    fg__palette palette;
    assert_int_equal(fg__palette_create(&palette, NULL, *name), FG_STATUS_OK);
    assert_false(palette.uniform);
    double first = fg__color_lightness(fg__palette_color(&palette, 0.0));
    double last = fg__color_lightness(fg__palette_color(&palette, 1.0));
    double sign = last > first ? 1.0 : -1.0;
    assert_true(fabs(last - first) > 0.3);
    double before = first;
    for (int k = 0; k <= 500; ++k) {
      fg__color color = fg__palette_color(&palette, k / 500.0);
      double lightness = fg__color_lightness(color);
      assert_true(contrast_on(color, 1.0) > 2.99);
      if (k > 0) {
        double step = sign * (lightness - before) * 500.0 / fabs(last - first);
        assert_true(step > 0.0);
        /* The published maps are even in another measure (CAM02-UCS), which gives black
         * less room; ours are even in this one. */
        if (count < 4)
          assert_true(fabs(step - 1.0) < 0.1);
      }
      before = lightness;
    }
  }
  assert_true(count >= 4);
}

static void shares_outside_are_clamped(void **state)
{
  (void)state;
  fg__palette palette;
  assert_int_equal(fg__palette_create(&palette, NULL, NULL), FG_STATUS_OK);
  fg__color low = fg__palette_color(&palette, -7.0);
  fg__color none = fg__palette_color(&palette, (double)NAN);
  fg__color high = fg__palette_color(&palette, 1e300);
  assert_memory_equal(&low, &palette.sample[0], sizeof low);
  assert_memory_equal(&none, &palette.sample[0], sizeof none);
  assert_memory_equal(&high, &palette.sample[FG__PALETTE_SAMPLES - 1], sizeof high);
}

static void one_colour_is_a_map_too(void **state)
{
  (void)state;
  fg__palette palette;
  assert_int_equal(fg__palette_create(&palette, NULL, "#0fA037"), FG_STATUS_OK);
  assert_true(palette.uniform);
  fg__color color = fg__palette_color(&palette, 0.37);
  assert_int_equal(lround(255.0 * color.red), 0x0f);
  assert_int_equal(lround(255.0 * color.green), 0xa0);
  assert_int_equal(lround(255.0 * color.blue), 0x37);
}

static void unknown_names_are_refused(void **state)
{
  (void)state;
  static const char *const bad[] = {"", "jet", "#12345", "#12345g", "viridis ", "Gale"};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
    fg_context *context;
    assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
    fg__palette palette;
    assert_int_equal(fg__palette_create(&palette, context, bad[k]), FG_STATUS_ARGUMENT);
    assert_non_null(strstr(fg_context_message(context), bad[k]));
    for (const char *const *name = fg_picture_palettes(); *name; ++name)
      assert_non_null(strstr(fg_context_hint(context), *name));
    fg_context_destroy(context);
  }
}

/* Luminance and lightness of sRGB's corners as their definitions publish them. */
static void colours_have_their_published_values(void **state)
{
  (void)state;
  fg__color white, red, blue;
  assert_true(fg__color_read(&white, "#ffffff"));
  assert_true(fg__color_read(&red, "#ff0000"));
  assert_true(fg__color_read(&blue, "#0000ff"));
  assert_true(fabs(fg__color_lightness(white) - 1.0) < 1e-4);
  assert_true(fabs(fg__color_lightness(red) - 0.62796) < 1e-4);
  assert_true(fabs(fg__color_lightness(blue) - 0.45201) < 1e-4);
  assert_true(fabs(contrast_on(red, 1.0) - 4.0) < 0.01); /* WCAG: 3.998 */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_map_is_monotone_and_stands_out_from_white),
      cmocka_unit_test(shares_outside_are_clamped),
      cmocka_unit_test(one_colour_is_a_map_too),
      cmocka_unit_test(unknown_names_are_refused),
      cmocka_unit_test(colours_have_their_published_values),
  };
  return cmocka_run_group_tests_name("picture/palette", tests, NULL, NULL);
}
