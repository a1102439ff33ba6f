/* Runs of small fields, for tests. */
#ifndef FG__RUN_TEST_H
#define FG__RUN_TEST_H

#include "flowgrain/run.h"

#include "base/context_test.h"

#include <string.h>

static inline fg_field *field_of(fg_context *context, const char *name)
{
  fg_field *field = NULL;
  assert_int_equal(fg_field_create_analytic(&field, context, name, 33), FG_STATUS_OK);
  return field;
}

static inline fg_run *run_of(fg_context *context, const fg_field *field,
                             const fg_run_options *options)
{
  fg_run *run = NULL;
  assert_int_equal(fg_run_create(&run, context, field, options), FG_STATUS_OK);
  return run;
}

static inline void same_icons(const fg_icons *a, const fg_icons *b)
{
  assert_int_equal(fg_icons_count(a), fg_icons_count(b));
  for (int n = 0; n < fg_icons_count(a); ++n) {
    const fg_icon *one = fg_icons_at(a, n), *other = fg_icons_at(b, n);
    assert_int_equal(one->point_count, other->point_count);
    assert_memory_equal(one->points, other->points,
                        (size_t)one->point_count * sizeof *one->points);
    assert_int_equal(one->cluster, other->cluster);
  }
}

#endif
