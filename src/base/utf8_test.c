#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "base/utf8.h"

/* Every code point in its shortest form, by the definition of RFC 3629, section 3. */
static size_t encode(char out[5], unsigned long point)
{
  size_t bytes = point < 0x80 ? 1 : point < 0x800 ? 2 : point < 0x10000 ? 3 : 4;
  static const unsigned long mark[5] = {0, 0, 0xC0, 0xE0, 0xF0};
  for (size_t k = bytes; k-- > 1; point >>= 6)
    out[k] = (char)(0x80 | (point & 0x3F));
  out[0] = (char)(mark[bytes] | point);
  out[bytes] = '\0';
  return bytes;
}

static void every_character_is_known(void **state)
{
  (void)state;
  for (unsigned long point = 1; point < 0x120000; ++point) {
    char text[5];
    size_t bytes = encode(text, point);
    bool is_character = point < 0xD800 || (point > 0xDFFF && point < 0x110000);
    assert_int_equal(fg__utf8_bytes((const unsigned char *)text),
                     is_character ? bytes : 0);
    assert_int_equal(fg__utf8_is_valid(text), is_character);
    if (!is_character || bytes == 1)
      continue;
    text[bytes - 1] = '\0'; /* ends too early */
    assert_false(fg__utf8_is_valid(text));
  }
}

static void texts_are_valid_as_a_whole(void **state)
{
  (void)state;
  assert_true(fg__utf8_is_valid(""));
  assert_true(fg__utf8_is_valid("30\xC2\xB0N \xF0\x9F\x8C\x8A"));
  assert_false(fg__utf8_is_valid("30\xB0N"));
  assert_false(fg__utf8_is_valid("ends in\xC2"));
  assert_false(fg__utf8_is_valid("\xC0\xAF is overlong"));
  assert_false(fg__utf8_is_valid("\xE0\x9F\xBF is overlong"));
}

static void texts_of_files_become_utf8(void **state)
{
  static const struct {
    const char *text;
    size_t count, size;
    const char *expected;
  } rows[] = {
      {"m s-1", 5, 16, "m s-1"},
      {"30\xC2\xB0N", 5, 16, "30\xC2\xB0N"},
      {"\xB0"
       "C",
       2, 16,
       "\xC2\xB0"
       "C"},                                           /* Latin-1 */
      {"m/s at 5\xB0", 9, 16, "m/s at 5\xC2\xB0"},     /* to its last byte */
      {"\xFFng\xC2\xB0", 5, 16, "\xC3\xBFng\xC2\xB0"}, /* beside a character */
      {"unit\0old", 8, 16, "unit"},
      {"cut here", 3, 16, "cut"},
      {"cut", 3, 3, "cu"},
      {"\xC2\xB0 \xC2\xB0", 5, 5, "\xC2\xB0 "}, /* between two characters */
      {"\xB0 \xB0", 3, 5, "\xC2\xB0 "},
      {"\xC2\xB0 \xE2\x82", 5, 16, "\xC2\xB0 "}, /* cut before */
      {"\xC2\xB0 \xE2\x82 ", 6, 16, "\xC2\xB0 \xC3\xA2\xC2\x82 "},
      {"", 0, 1, ""},
  };
  (void)state;
  for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
    char out[16];
    memset(out, 'x', sizeof out);
    fg__utf8_take(out, rows[k].size, rows[k].text, rows[k].count);
    if (strcmp(out, rows[k].expected) != 0 || !fg__utf8_is_valid(out))
      fail_msg("row %zu: \"%s\"", k, out);
  }
}

static void whole_texts_are_copied(void **state)
{
  (void)state;
  char *copy = fg__utf8_copy("\xB5m and \xB5m"), *none = fg__utf8_copy("");
  assert_string_equal(copy, "\xC2\xB5m and \xC2\xB5m");
  assert_string_equal(none, "");
  assert_null(fg__utf8_copy(NULL));
  free(copy);
  free(none);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_character_is_known),
      cmocka_unit_test(texts_are_valid_as_a_whole),
      cmocka_unit_test(texts_of_files_become_utf8),
      cmocka_unit_test(whole_texts_are_copied),
  };
  return cmocka_run_group_tests_name("base/utf8", tests, NULL, NULL);
}
