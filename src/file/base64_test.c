#include <string.h>

#include "base/context_test.h"
#include "file/base64.h"

/* RFC 4648, section 10 */
static const char *const CLEAR[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
static const char *const CODED[] = {"",         "Zg==",     "Zm8=",    "Zm9v",
                                    "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};

static fg__base64 reader(const char *text)
{
  return (fg__base64){.text = (const unsigned char *)text, .size = strlen(text)};
}

static void the_standard_examples_hold_both_ways(void **state)
{
  (void)state;
  for (size_t i = 0; i < 7; ++i) {
    size_t length = strlen(CLEAR[i]);
    char coded[16] = "";
    assert_int_equal(fg__base64_length(length), strlen(CODED[i]));
    fg__base64_encode(coded, (const unsigned char *)CLEAR[i], length);
    assert_string_equal(coded, CODED[i]);

    unsigned char clear[16] = "";
    fg__base64 base64 = reader(CODED[i]);
    assert_true(fg__base64_available(&base64) >= length);
    assert_true(fg__base64_read(&base64, clear, length));
    assert_memory_equal(clear, CLEAR[i], length);
    assert_true(fg__base64_ended(&base64));
    assert_false(fg__base64_read(&base64, clear, 1));
  }
}

static void every_byte_survives(void **state)
{
  (void)state;
  unsigned char bytes[257], back[257];
  for (size_t i = 0; i < sizeof bytes; ++i)
    bytes[i] = (unsigned char)(i * 37 + 11);
  char text[512];
  size_t length = fg__base64_length(sizeof bytes);
  fg__base64_encode(text, bytes, sizeof bytes);
  fg__base64 base64 = {.text = (const unsigned char *)text, .size = length};
  size_t at = 0;
  for (size_t step = 1; at < sizeof bytes; ++step) { /* in portions of every size */
    size_t take = step < sizeof bytes - at ? step : sizeof bytes - at;
    assert_true(fg__base64_read(&base64, back + at, take));
    at += take;
  }
  assert_memory_equal(bytes, back, sizeof bytes);
}

static void parts_encoded_by_themselves_follow_each_other(void **state)
{
  (void)state;
  unsigned char clear[16] = "";
  fg__base64 base64 = reader(" Zm8=\n Zg==\tZm\r9 v ");
  assert_true(fg__base64_read(&base64, NULL, 1));
  assert_true(fg__base64_read(&base64, clear, 5));
  assert_memory_equal(clear, "offoo", 5);
  assert_true(fg__base64_ended(&base64));
}

static void wrong_text_is_refused(void **state)
{
  (void)state;
  static const char *const wrong[] = {"Z",    "Zm9",  "Z===", "====",   "Z=9v",
                                      "Zm=v", "Zm9<", "Zm-v", "Zm9\x80"};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
    unsigned char clear[4];
    fg__base64 base64 = reader(wrong[i]);
    assert_false(fg__base64_read(&base64, clear, 1));
  }
  assert_int_equal(fg__base64_length(SIZE_MAX), 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_standard_examples_hold_both_ways),
      cmocka_unit_test(every_byte_survives),
      cmocka_unit_test(parts_encoded_by_themselves_follow_each_other),
      cmocka_unit_test(wrong_text_is_refused),
  };
  return cmocka_run_group_tests_name("file/base64", tests, NULL, NULL);
}
