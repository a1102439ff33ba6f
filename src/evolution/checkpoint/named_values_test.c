/* Values survive being lines of a text to the last bit, and nothing else becomes one. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "evolution/checkpoint/named_values.h"

typedef struct sample {
  double real;
  int integer;
  int64_t number;
  uint64_t count, bits;
  bool flag;
} sample;

static const fg__named_value values[] = {
    {"real", FG__VALUE_REAL, offsetof(sample, real)},
    {"integer", FG__VALUE_INTEGER, offsetof(sample, integer)},
    {"long", FG__VALUE_INT64, offsetof(sample, number)},
    {"count", FG__VALUE_COUNT, offsetof(sample, count)},
    {"bits", FG__VALUE_BITS, offsetof(sample, bits)},
    {"flag", FG__VALUE_FLAG, offsetof(sample, flag)},
};
enum { VALUES = sizeof values / sizeof values[0] };

enum { TEXT_BYTES = 512 };

static void print(char text[TEXT_BYTES], const sample *s)
{
  FILE *stream = fmemopen(text, TEXT_BYTES, "w");
  assert_non_null(stream);
  fputs("other 7\n", stream);
  fg__values_print(stream, values, VALUES, s);
  assert_int_equal(fclose(stream), 0);
}

static void they_come_back(void **state)
{
  (void)state;
  const double reals[] = {0.0,        -0.0,    0.1,       -1.0 / 3.0,
                          DBL_MAX,    DBL_MIN, 0x1p-1074, (double)INFINITY,
                          (double)NAN};
  for (size_t n = 0; n < sizeof reals / sizeof reals[0]; ++n) {
    sample one = {.real = reals[n],
                  .integer = n % 2 ? INT_MIN : INT_MAX,
                  .number = n % 2 ? LONG_MAX : LONG_MIN,
                  .count = n % 2 ? UINT64_MAX : n,
                  .bits = n % 2 ? n : UINT64_MAX - n,
                  .flag = n % 2 == 0};
    sample other;
    memset(&other, 0x5a, sizeof other);
    other.flag = !one.flag;
    char text[TEXT_BYTES];
    print(text, &one);
    assert_int_equal(fg__values_scan(text, "PATH", NULL, values, VALUES, &other),
                     FG_STATUS_OK);
    assert_null(fg__values_difference(values, VALUES, &one, &other));
  }
}

static void the_first_difference_is_found(void **state)
{
  (void)state;
  const sample one = {.real = 0.0, .integer = 3, .count = 5};
  sample other = one;
  other.bits = 1;
  assert_ptr_equal(fg__values_difference(values, VALUES, &one, &other), &values[4]);
  other.integer = 4;
  assert_ptr_equal(fg__values_difference(values, VALUES, &one, &other), &values[1]);
  other.real = -0.0;
  assert_ptr_equal(fg__values_difference(values, VALUES, &one, &other), &values[0]);
}

static void people_can_read_them(void **state)
{
  (void)state;
  char text[FG__VALUE_TEXT_BYTES];
  sample s = {.real = 0.3, .count = 12};
  fg__value_describe(text, &values[0], &s);
  assert_string_equal(text, "0.3");
  s.real = nextafter(0.3, 1.0);
  fg__value_describe(text, &values[0], &s);
  assert_string_equal(text, "0.30000000000000004");
  fg__value_describe(text, &values[3], &s);
  assert_string_equal(text, "12");
}

static void is_refused(const char *line, const char *words)
{
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  sample s = {0};
  char text[TEXT_BYTES], all[2 * TEXT_BYTES];
  print(text, &s);
  char *start = strstr(text, "\nreal");
  assert_non_null(start);
  *start = '\0';
  snprintf(all, sizeof all, "%s\n%s\n%s", text, line, strchr(start + 1, '\n') + 1);
  assert_int_equal(fg__values_scan(all, "PATH", context, values, VALUES, &s),
                   FG_STATUS_FILE_FORMAT);
  const char *message = fg_context_message(context);
  if (strstr(message, "PATH") != message || !strstr(message, words))
    fail_msg("\"%s\" does not say \"%s\"", message, words);
  fg_context_destroy(context);
}

static void other_texts_are_refused(void **state)
{
  (void)state;
  is_refused("", "lacks the value of 'real'");
  is_refused("realer 3ff0000000000000", "lacks");
  is_refused("real", "lacks");
  is_refused("real 3ff000000000000", "'3ff000000000000' is no value of 'real'");
  is_refused("real 3ff00000000000000", "no value");
  is_refused("real  ff0000000000000", "no value");
  is_refused("real 3FF0000000000000", "no value");
  is_refused("real 1.5", "no value");
  const char *const lines[] = {"integer 2147483648", "integer x",
                               "integer 1 ",         "flag 2",
                               "count -1",           "count 18446744073709551616"};
  for (size_t n = 0; n < sizeof lines / sizeof lines[0]; ++n) {
    char line[128];
    snprintf(line, sizeof line, "real 3ff0000000000000\n%s", lines[n]);
    is_refused(line, "no value");
  }
}

static void lines_end_at_the_first_empty_one(void **state)
{
  (void)state;
  size_t length;
  const char *text = "a 1\nbb 22\n\nc 3\n";
  assert_ptr_equal(fg__value_find(text, "bb", &length), text + 7);
  assert_int_equal(length, 2);
  assert_null(fg__value_find(text, "b", &length));
  assert_null(fg__value_find(text, "c", &length));
  assert_null(fg__value_find("a 1", "a 1", &length));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(they_come_back),
      cmocka_unit_test(the_first_difference_is_found),
      cmocka_unit_test(people_can_read_them),
      cmocka_unit_test(other_texts_are_refused),
      cmocka_unit_test(lines_end_at_the_first_empty_one),
  };
  return cmocka_run_group_tests_name("evolution/checkpoint/named_values", tests, NULL,
                                     NULL);
}
