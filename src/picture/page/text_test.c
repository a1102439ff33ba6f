#include <math.h>
#include <string.h>

#include "base/context_test.h"
#include "picture/page/text.h"

static void shortened_texts_fit(void **state)
{
  (void)state;
  cairo_t *ruler = fg__text_ruler();
  static const char title[] = "Sea surface wind 30\xC2\xB0N, monthly means of January";
  double whole = fg__text_width(ruler, title, 9.0, true);
  for (double share = 1.1; share > 0.0; share -= 0.03) {
    char text[64];
    memcpy(text, title, sizeof title);
    fg__text_shorten(ruler, text, sizeof text, 9.0, true, share * whole);
    assert_true(fg__text_width(ruler, text, 9.0, true) <= share * whole);
    if (share >= 1.0)
      assert_string_equal(text, title);
    char clean[64];
    fg__text_clean(clean, sizeof clean, text);
    assert_string_equal(clean, text);
  }
  assert_int_equal(cairo_status(ruler), CAIRO_STATUS_SUCCESS);
  cairo_destroy(ruler);
}

static void widths_scale_and_exponents_are_small(void **state)
{
  (void)state;
  cairo_t *ruler = fg__text_ruler();
  double one = fg__text_width(ruler, "mean speed", 7.0, false);
  double three = fg__text_width(ruler, "mean speed", 21.0, false);
  assert_true(one > 0.0 && fabs(three / one - 3.0) < 0.01);
  double plain = fg__text_width(ruler, "s1", 9.0, false);
  double raised =
      fg__text_width(ruler, "s" FG__TEXT_RAISE "1" FG__TEXT_LOWER, 9.0, false);
  assert_true(raised < plain && raised > 0.6 * plain);
  cairo_destroy(ruler);
}

/* The ink stays inside the box that layouts reserve for a text. */
static void ink_stays_in_the_box(void **state)
{
  (void)state;
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 400, 100);
  cairo_t *cairo = cairo_create(surface);
  const double size = 40.0, x = 20.0, y = 60.0;
  static const char text[] = "Qgj m s" FG__TEXT_RAISE "\xE2\x88\x92"
                             "18" FG__TEXT_LOWER "|";
  cairo_move_to(cairo, x, y);
  fg__text_draw(cairo, text, size, false, false);
  double end = x + fg__text_width(cairo, text, size, false);
  cairo_surface_flush(surface);
  const unsigned char *pixels = cairo_image_surface_get_data(surface);
  int stride = cairo_image_surface_get_stride(surface), inked = 0;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 400; ++column) {
      if (pixels[row * stride + column] < 128)
        continue;
      ++inked;
      assert_true(row >= y - FG__TEXT_ASCENT * size - 1.0);
      assert_true(row <= y + FG__TEXT_DESCENT * size + 1.0);
      assert_true(column >= x - 2.0 && column <= end + 2.0);
    }
  }
  assert_true(inked > 500);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shortened_texts_fit),
      cmocka_unit_test(widths_scale_and_exponents_are_small),
      cmocka_unit_test(ink_stays_in_the_box),
  };
  return cmocka_run_group_tests_name("picture/page/text", tests, NULL, NULL);
}
