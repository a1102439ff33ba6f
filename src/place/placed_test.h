/* Placements, and what their icons come to. */
#ifndef FG__PLACED_TEST_H
#define FG__PLACED_TEST_H

#include "icon/icons.h"
#include "place/fields_test.h"
#include "place/placement.h"

static inline fg_placement *placement_of(fg_context *context, const fg_field *field,
                                         fg_effort effort)
{
  const fg_placement_options options = {.effort = effort};
  fg_placement *placement = NULL;
  assert_int_equal(fg_placement_create(&placement, context, field, &options),
                   FG_STATUS_OK);
  return placement;
}

static inline fg_icons *place(fg_context *context, fg_placement *placement, int count)
{
  fg_icons *icons = NULL;
  if (fg_placement_place(placement, count, NULL) != FG_STATUS_OK)
    fail_msg("%s", fg_context_message(context));
  assert_int_equal(fg_placement_icons(&icons, placement), FG_STATUS_OK);
  return icons;
}

static inline double lambda_of(const fg_placement *placement)
{
  return fg__placement_search(placement)->scale.lambda;
}

static inline double length_of(const fg_icon *icon)
{
  double sum = 0.0;
  for (int i = 1; i < icon->point_count; ++i)
    sum += distance_between(icon->points[i - 1], icon->points[i], 3);
  return sum;
}

static inline double error_of(fg_context *context, const fg_field *field,
                              const fg_icons *icons)
{
  const fg_score_options options = {.lengths = FG_SCORE_FREE, .readers_only = true};
  return score_of(context, field, icons, &options).mean;
}

static inline void assert_same_icons(const fg_icons *a, const fg_icons *b)
{
  assert_int_equal(fg_icons_count(a), fg_icons_count(b));
  assert_int_equal(fg__icons_next_id(a), fg__icons_next_id(b));
  for (int n = 0; n < fg_icons_count(a); ++n) {
    const fg_icon *one = fg_icons_at(a, n), *other = fg_icons_at(b, n);
    assert_int_equal(one->id, other->id);
    assert_int_equal(one->point_count, other->point_count);
    assert_memory_equal(one->points, other->points,
                        (size_t)one->point_count * sizeof *one->points);
    assert_memory_equal(one->seed, other->seed, sizeof one->seed);
    assert_memory_equal(one->way, other->way, sizeof one->way);
    assert_true(one->area == other->area && one->speed == other->speed);
    assert_true(one->width == other->width && one->kind == other->kind);
  }
}

#endif
