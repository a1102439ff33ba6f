/* Fields made from arrays, or refused. */
#ifndef FG__MADE_TEST_H
#define FG__MADE_TEST_H

#include <string.h>

#include "base/context_test.h"

static inline fg_field *field_made(fg_context *context, const fg_field_arrays *arrays)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, arrays), FG_STATUS_OK);
  assert_non_null(field);
  return field;
}

static inline void assert_field_refused(fg_context *context,
                                        const fg_field_arrays *arrays, fg_status expected,
                                        const char *part_of_message)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create(&field, context, arrays), expected);
  assert_null(field);
  if (!strstr(fg_context_message(context), part_of_message))
    fail_msg("\"%s\" lacks \"%s\"", fg_context_message(context), part_of_message);
  fg_context_clear(context);
}

#endif
