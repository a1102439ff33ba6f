#include <stdio.h>
#include <string.h>

#include "base/context_test.h"
#include "base/names.h"

static void a_dozen_are_shown_and_the_rest_counted(void **state)
{
  static const struct {
    int count;
    const char *between, *text;
  } rows[] = {{0, ", ", ""},
              {1, ", ", "n0"},
              {3, "; ", "n0; n1; n2"},
              {12, ", ", "n0, n1, n2, n3, n4, n5, n6, n7, n8, n9, n10, n11"},
              {13, ", ", "n0, n1, n2, n3, n4, n5, n6, n7, n8, n9, n10, n11 and 1 more"},
              {5000, " | ",
               "n0 | n1 | n2 | n3 | n4 | n5 | n6 | n7 | n8 | n9 | n10 | n11 and 4988 "
               "more"}};
  (void)state;
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    fg__names names = {0};
    for (int n = 0; n < rows[k].count; ++n)
      fg__names_add(&names, rows[k].between, "n%d", n);
    assert_string_equal(names.text, rows[k].text);
    assert_int_equal(names.count, rows[k].count);
  }
}

/* None is cut, and none after it shown: the list would look as if it were whole. */
static void names_that_do_not_fit_are_counted(void **state)
{
  char large[2 * FG__NAMES_BYTES], half[FG__NAMES_BYTES / 2];
  (void)state;
  memset(large, 'x', sizeof large - 1);
  memset(half, 'y', sizeof half - 1);
  large[sizeof large - 1] = half[sizeof half - 1] = '\0';
  fg__names names = {0};
  fg__names_add(&names, ", ", "%s", large);
  fg__names_add(&names, ", ", "u");
  assert_string_equal(names.text, "2 more");
  names = (fg__names){0};
  for (int n = 0; n < 3; ++n)
    fg__names_add(&names, ", ", "%s", half);
  assert_int_equal(names.shown, 1);
  assert_string_equal(names.text + sizeof half - 1, " and 2 more");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_dozen_are_shown_and_the_rest_counted),
      cmocka_unit_test(names_that_do_not_fit_are_counted),
  };
  return cmocka_run_group_tests_name("base/names", tests, NULL, NULL);
}
