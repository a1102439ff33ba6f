#include <stdlib.h>

#include "base/context_test.h"
#include "picture/render/bands.h"

/* Each triangle is in each band that it touches, once, and in its order. */
static void bands_have_what_touches_them(void **state)
{
  (void)state;
  enum { COUNT = 500, HEIGHT = 61 };
  fg__band_rows rows[COUNT];
  fg__bands bands;
  for (int n = 0; n < COUNT; ++n) {
    double low = n * 37 % 97 - 20.0;
    rows[n] = fg__rows_between(low, low + n % 19, HEIGHT);
    assert_true(rows[n].first > rows[n].last ||
                (rows[n].first >= 0 && rows[n].last < HEIGHT));
  }
  assert_int_equal(fg__bands_make(&bands, NULL, rows, COUNT, HEIGHT), FG_STATUS_OK);
  assert_int_equal(bands.count, 8);
  size_t all = 0;
  for (int b = 0; b < bands.count; ++b) {
    size_t at = bands.first[b];
    for (int n = 0; n < COUNT; ++n) {
      bool touches = rows[n].first <= rows[n].last &&
                     rows[n].first < (b + 1) * FG__BAND && rows[n].last >= b * FG__BAND;
      all += touches;
      if (touches) {
        assert_true(at < bands.first[b + 1]);
        assert_int_equal(bands.member[at++], n);
      }
    }
    assert_int_equal(at, bands.first[b + 1]);
  }
  assert_true(all > COUNT);
  fg__bands_clear(&bands);
}

static void rows_are_cut_to_the_picture(void **state)
{
  (void)state;
  assert_true(fg__rows_between(-5.0, -0.5, 10).first >
              fg__rows_between(-5.0, -0.5, 10).last);
  assert_true(fg__rows_between(10.0, 12.0, 10).first >
              fg__rows_between(10.0, 12.0, 10).last);
  assert_int_equal(fg__rows_between(-3.0, 4.7, 10).first, 0);
  assert_int_equal(fg__rows_between(-3.0, 4.7, 10).last, 4);
  assert_int_equal(fg__rows_between(2.9, 1e300, 10).first, 2);
  assert_int_equal(fg__rows_between(2.9, 1e300, 10).last, 9);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bands_have_what_touches_them),
      cmocka_unit_test(rows_are_cut_to_the_picture),
  };
  return cmocka_run_group_tests_name("picture/render/bands", tests, NULL, NULL);
}
