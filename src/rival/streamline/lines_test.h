/* Points of the lines that seeding methods place. */
#ifndef FG__RIVAL_LINES_TEST_H
#define FG__RIVAL_LINES_TEST_H

#include "base/context_test.h"
#include "rival/streamline/evenly.h"

#include <math.h>
#include <stdlib.h>

/* Points of line n, `spacing` apart; *points is allocated. */
static inline int sample_line(double (**points)[3], fg_context *context,
                              const fg__domain *domain, const fg__lines *lines, int n,
                              double spacing)
{
  const fg__lines_part *part = &lines->part[n];
  fg__line line = {0};
  assert_int_equal(fg__lines_trace(&line, context, domain, lines, part->seed,
                                   fmax(-part->from, part->to)),
                   FG_STATUS_OK);
  int pieces = (int)ceil((part->to - part->from) / spacing);
  *points = calloc((size_t)pieces + 1, sizeof **points);
  assert_non_null(*points);
  for (int i = 0; i <= pieces; i++) {
    double tangent[3];
    fg__line_at(&line, line.start + part->from + (part->to - part->from) * i / pieces,
                NULL, (*points)[i], tangent);
  }
  fg__line_clear(&line);
  return pieces + 1;
}

#endif
