#include "base/context_test.h"
#include "picture/plain_text.h"

static void bytes_that_are_no_text_are_replaced(void **state)
{
  (void)state;
  static const char *const pairs[][2] = {
      {"wind", "wind"},
      {"30\xC2\xB0N", "30\xC2\xB0N"},
      {"a\tb\001c\002", "a b c "},
      {"\xFFx", "?x"},
      {"\xC2", "?"},                /* ends inside a character */
      {"\xC0\xAF", "??"},           /* overlong */
      {"\xED\xA0\x80", "???"},      /* surrogate */
      {"\xF4\x90\x80\x80", "????"}, /* past the last character */
      {"\xF0\x9F\x8C\x8A", "\xF0\x9F\x8C\x8A"},
  };
  for (size_t k = 0; k < sizeof pairs / sizeof *pairs; ++k) {
    char out[32];
    fg__text_clean(out, sizeof out, pairs[k][0]);
    assert_string_equal(out, pairs[k][1]);
  }
}

static void texts_are_cut_at_characters(void **state)
{
  (void)state;
  char out[6];
  fg__text_clean(out, sizeof out, "abcd\xC2\xB0");
  assert_string_equal(out, "abcd");
  fg__text_clean(out, sizeof out, "abc\xC2\xB0z");
  assert_string_equal(out, "abc\xC2\xB0");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bytes_that_are_no_text_are_replaced),
      cmocka_unit_test(texts_are_cut_at_characters),
  };
  return cmocka_run_group_tests_name("picture/plain_text", tests, NULL, NULL);
}
