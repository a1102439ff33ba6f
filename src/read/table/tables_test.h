/* Tables in memory, read for the tests of this folder. */
#ifndef FG__TABLES_TEST_H
#define FG__TABLES_TEST_H

#include <string.h>

#include "base/context_test.h"
#include "read/format.h"

static inline fg__source source_of(const char *text)
{
  return (fg__source){
      .path = "table.txt", .bytes = (const unsigned char *)text, .size = strlen(text)};
}

static inline fg_field *read_with(fg_context *context, const char *text,
                                  const fg_read_options *options)
{
  const fg__source source = source_of(text);
  fg_field *field = NULL;
  assert_true(fg__format_table.is_mine(source.bytes, source.size));
  if (fg__dataset_read(&field, context, &fg__format_table, &source, options,
                       (fg__slab_index){0, 1}))
    fail_msg("%s\nof\n%s", fg_context_message(context), text);
  return field;
}

static inline fg_field *read_text(fg_context *context, const char *text)
{
  static const fg_read_options options = {0};
  return read_with(context, text, &options);
}

/* A grid of 3 x 2: x 1.5 2.5 3.5, y 10 20; u = x + y, v = -0.25 but where it is missing.
 */
static inline void check_small(fg_field *field, int missing)
{
  const fg_field_arrays *f = fg_field_contents(field);
  assert_int_equal(f->size[0], 3);
  assert_int_equal(f->size[1], 2);
  for (int n = 0; n < 6; ++n) {
    const double x = f->axis[0][n % 3], y = f->axis[1][n / 3];
    assert_true(x == 1.5 + n % 3 && y == 10.0 + 10.0 * (double)(n / 3));
    assert_int_equal(f->valid == NULL || f->valid[n] != 0, n != missing);
    if (n != missing) {
      assert_true((double)f->velocity[0][n] == x + y);
      assert_true(f->velocity[1][n] == -0.25f);
    }
  }
  fg_field_destroy(field);
}

#endif
