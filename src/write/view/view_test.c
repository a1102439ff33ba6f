/* Parts of the page for browsers; the page itself is tested by tests/cli/page_test.sh and
 * viewer/test/page.test.mjs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "write/view/parts.h"

/* By the definition of IEEE 754. */
static float value_of(uint16_t half)
{
  int exponent = half >> 10 & 31;
  float part = (float)(half & 1023);
  float size = exponent ? ldexpf(1024.0F + part, exponent - 25) : ldexpf(part, -24);
  return half & 0x8000 ? -size : size;
}

static void every_half_is_itself_and_what_lies_between_goes_to_the_nearest(void **state)
{
  (void)state;
  for (unsigned h = 0; h < 0x7c00U; ++h) {
    const float low = value_of((uint16_t)h);
    assert_int_equal(fg__view_half(low), h);
    assert_int_equal(fg__view_half(-low), h | 0x8000U);
    if (h + 1 == 0x7c00U)
      continue;
    const float high = value_of((uint16_t)(h + 1)), middle = 0.5F * (low + high);
    assert_int_equal(fg__view_half(nextafterf(middle, 0.0F)), h);
    assert_int_equal(fg__view_half(nextafterf(middle, high)), h + 1);
    assert_int_equal(fg__view_half(middle), h + (h & 1U));
  }
  assert_int_equal(fg__view_half(nanf("")) & 0x7c00, 0x7c00);
  assert_int_not_equal(fg__view_half(nanf("")) & 0x3ff, 0);
  assert_int_equal(fg__view_half(1e9F), 0x7c00);
}

static fg_field *make_field(int width, int height, double period, double hole)
{
  double *axis[2] = {malloc((size_t)width * sizeof(double)),
                     malloc((size_t)height * sizeof(double))};
  const size_t count = (size_t)width * (size_t)height;
  float *u = malloc(count * sizeof *u), *v = malloc(count * sizeof *v);
  assert_true(axis[0] && axis[1] && u && v);
  for (int i = 0; i < width; ++i)
    axis[0][i] = 2.0 * i;
  for (int j = 0; j < height; ++j)
    axis[1][j] = 5.0 + j;
  for (size_t n = 0; n < count; ++n) {
    u[n] = axis[0][n % (size_t)width] < hole ? nanf("") : 3.0F;
    v[n] = (float)(0.01 * axis[1][n / (size_t)width]);
  }
  fg_field *field = NULL;
  const fg_field_arrays arrays = {.dimension = 2,
                                  .size = {width, height},
                                  .axis = {axis[0], axis[1]},
                                  .period = {period, 0.0},
                                  .velocity = {u, v}};
  assert_int_equal(fg_field_create(&field, NULL, &arrays), FG_STATUS_OK);
  free(axis[0]);
  free(axis[1]);
  free(u);
  free(v);
  return field;
}

static void of_many_samples_means_are_kept_from_end_to_end(void **state)
{
  (void)state;
  fg_field *field = make_field(300, 100, 0.0, 60.0);
  fg__view_samples few;
  assert_int_equal(fg__view_samples_create(&few, NULL, field, 3000), FG_STATUS_OK);
  const int *size = few.size;
  assert_in_range(size[0] * size[1], 2700, 3000);
  assert_true(few.axis[0][0] < 0.5 && few.axis[0][size[0] - 1] > 597.5);
  assert_true(few.axis[1][0] < 5.5 && few.axis[1][size[1] - 1] > 103.5);
  for (int n = 0; n < size[0] * size[1]; ++n) {
    const bool is_there = few.axis[0][n % size[0]] >= 60.0;
    assert_int_equal((few.velocity[0][n] & 0x7c00) == 0x7c00, !is_there);
    if (!is_there)
      continue;
    assert_true(fabs((double)value_of(few.velocity[0][n]) * few.unit - 3.0) < 2e-3);
    const double y = few.axis[1][n / size[0]];
    assert_true(fabs((double)value_of(few.velocity[1][n]) * few.unit - 0.01 * y) < 0.02);
  }
  fg__view_samples_clear(&few);
  fg_field_destroy(field);

  field = make_field(300, 100, 600.0, -1.0); /* its last sample lies before the first's
                                                repetition, in the page as well */
  assert_int_equal(fg__view_samples_create(&few, NULL, field, 3000), FG_STATUS_OK);
  const double step = few.axis[0][1] - few.axis[0][0];
  assert_true(fabs(600.0 - few.axis[0][few.size[0] - 1] - step) <= 2.0);
  fg__view_samples_clear(&few);
  fg_field_destroy(field);
}

static void no_text_ends_the_script(void **state)
{
  (void)state;
  char text[256] = "";
  FILE *stream = fmemopen(text, sizeof text, "w");
  assert_non_null(stream);
  fg__view_text(stream, "</script>\n\"\\ & \xc3\xa9");
  fg__view_text(stream, NULL);
  fclose(stream);
  assert_string_equal(
      text, "\"\\u003c/script\\u003e\\u000a\\u0022\\u005c \\u0026 \xc3\xa9\"null");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_half_is_itself_and_what_lies_between_goes_to_the_nearest),
      cmocka_unit_test(of_many_samples_means_are_kept_from_end_to_end),
      cmocka_unit_test(no_text_ends_the_script)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
