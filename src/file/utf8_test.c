#include <string.h>

#include "base/context_test.h"
#include "file/utf8.h"

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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_character_is_known),
      cmocka_unit_test(texts_are_valid_as_a_whole),
  };
  return cmocka_run_group_tests_name("file/utf8", tests, NULL, NULL);
}
