/* Icons by hand. */
#ifndef FG__SCORE_PICTURE_TEST_H
#define FG__SCORE_PICTURE_TEST_H

#include "critical/field_test.h"
#include "icon/icons.h"

static inline fg_icons *no_icons(fg_context *context)
{
  fg_icons *icons = NULL;
  assert_int_equal(fg__icons_create_empty(&icons, context), FG_STATUS_OK);
  return icons;
}

static inline void add_line(fg_icons *icons, fg_context *context,
                            const double (*points)[3], int count)
{
  const fg_icon icon = {.cluster = 1, .point_count = count, .points = points};
  assert_int_equal(fg__icons_add(icons, context, &icon), FG_STATUS_OK);
}

static inline void add_straight(fg_icons *icons, fg_context *context, double x, double y,
                                double to_x, double to_y)
{
  const double points[2][3] = {{x, y, 0}, {to_x, to_y, 0}};
  add_line(icons, context, points, 2);
}

static inline fg_score score_of(fg_context *context, const fg_field *field,
                                const fg_icons *icons, const fg_score_options *options)
{
  fg_score score;
  if (fg_icons_score(&score, context, field, icons, options) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  return score;
}

/* Crooked lines anywhere in the box and a little beyond. */
static inline void add_scribbles(fg_icons *icons, fg_context *context,
                                 const sampling *box, int count, double step)
{
  unsigned state = 7;
  for (int n = 0; n < count; ++n) {
    double points[9][3] = {{0}};
    for (int k = 0; k < box->dimension; ++k)
      points[0][k] =
          box->low[k] + (box->high[k] - box->low[k]) * (1.1 * next_random(&state) - 0.05);
    for (int i = 1; i < 9; ++i)
      for (int k = 0; k < box->dimension; ++k)
        points[i][k] = points[i - 1][k] + step * (next_random(&state) - 0.3);
    add_line(icons, context, (const double(*)[3])points, 9 - n % 4);
  }
}

#endif
