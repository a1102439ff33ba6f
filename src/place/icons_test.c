#include "place/placement.h"

#include "icon/icons.h"

#include "place/placed_test.h"

/* Icons of a placement, of which number 4 has the line through `seed`, that far. */
static fg_icons *icons_with(fg_context *context, fg_placement *placement,
                            const double seed[2], const double way[2])
{
  enum { COUNT = 12 };
  fg_icons *icons = place(context, placement, COUNT), *made;
  fg_icon *icon = fg__icons_change(icons, 4);
  for (int k = 0; k < 2; ++k) {
    icon->seed[k] = seed[k];
    icon->way[k] = way[k];
  }
  assert_int_equal(fg_placement_resume(placement, icons), FG_STATUS_OK);
  assert_int_equal(fg_placement_icons(&made, placement), FG_STATUS_OK);
  assert_int_equal(fg_icons_count(made), COUNT);
  fg_icons_destroy(icons);
  return made;
}

/* The kind of the icon through a point at `radius` from the eye, all round as far as a
 * line may turn, or a quarter of that. */
static fg_icon_kind kind_at(fg_context *context, velocity_of velocity, double radius,
                            double share)
{
  fg_field *field = field_of(context, &PLAIN, velocity);
  fg_placement *placement = placement_of(context, field, FG_EFFORT_QUICK);
  const double seed[2] = {EYE[0] + 0.6 * radius, EYE[1] - 0.8 * radius};
  const double way = share * 164.0 * DEGREE * radius;
  fg_icons *made = icons_with(context, placement, seed, (double[2]){way, way});
  fg_icon_kind kind = fg_icons_at(made, 4)->kind;
  fg_icons_destroy(made);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
  return kind;
}

/* Where the flow turns by 70 degrees from one sample to the next. */
static const sampling CLOSE = {
    .dimension = 2, .nodes = {241, 161}, .low = {-7, 3}, .high = {5, 11}};

static void corner(const double position[3], double v[3])
{
  const double angle = position[0] < EYE[0] ? 0.0 : 70.0 * DEGREE;
  v[0] = cos(angle);
  v[1] = sin(angle);
}

/* By how many degrees the line turns over that length before its end, at most. */
static double turn_before_end(const fg_icon *icon, double length)
{
  double most = 0.0, end[3] = {0}, piece[3] = {0};
  for (int n = icon->point_count - 1; n > 0 && length > 0.0; --n) {
    for (int k = 0; k < 2; ++k)
      piece[k] = icon->points[n][k] - icon->points[n - 1][k];
    if (n == icon->point_count - 1)
      memcpy(end, piece, sizeof end);
    most = fmax(most, degrees_between(piece, end, 2));
    length -= distance_between(icon->points[n], icon->points[n - 1], 2);
  }
  return most;
}

static void a_head_lies_on_a_calm_piece(void **state)
{
  fg_field *field = field_of(*state, &CLOSE, corner);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *first = place(*state, placement, 12);
  const double lambda = lambda_of(placement);
  const double seed[2] = {EYE[0] - 0.5 * lambda, EYE[1]};
  fg_icons_destroy(first);
  /* the search looks at 0.15 lambda, the head of the fastest flow has 0.2 */
  static const double beyond[] = {0.16, 0.18, 0.2, 0.22, 0.3, 0.5};
  for (size_t n = 0; n < sizeof beyond / sizeof *beyond; ++n) {
    const double way[2] = {0.5 * lambda, (0.5 + beyond[n]) * lambda};
    fg_icons *made = icons_with(*state, placement, seed, way);
    const fg_icon *icon = fg_icons_at(made, 4);
    assert_true(icon->head_length > 0.19 * lambda);
    assert_true(turn_before_end(icon, icon->head_length) < 60.5);
    /* no more is taken off than that needs, and a sample of the search */
    const double longest = (1.0 + (beyond[n] > 0.35 ? beyond[n] : 0.0)) * lambda;
    assert_true(fabs(length_of(icon) - longest) < 0.11 * lambda);
    fg_icons_destroy(made);
  }
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void orbits_are_rings_and_swirls_spirals(void **state)
{
  for (double radius = 0.5; radius < 1.0; radius += 0.15) {
    assert_int_equal(kind_at(*state, vortex, radius, 1.0), FG_ICON_RING);
    assert_int_equal(kind_at(*state, drain, radius, 1.0), FG_ICON_SPIRAL);
    assert_int_equal(kind_at(*state, slant, radius, 1.0), FG_ICON_ARROW);
    assert_int_equal(kind_at(*state, vortex, radius, 0.5), FG_ICON_ARROW);
  }
}

static void count_kinds(int kinds[3], fg_context *context, velocity_of velocity,
                        fg_effort effort, int count)
{
  fg_field *field = field_of(context, &PLAIN, velocity);
  fg_placement *placement = placement_of(context, field, effort);
  fg_icons *icons = place(context, placement, count);
  kinds[0] = kinds[1] = kinds[2] = 0;
  for (int n = 0; n < count; ++n)
    ++kinds[fg_icons_at(icons, n)->kind];
  fg_icons_destroy(icons);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

static void no_field_gets_a_kind_that_it_has_not(void **state)
{
  static const int counts[] = {9, 14, 30};
  int kinds[3];
  for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
    const fg_effort effort = n < 2 ? FG_EFFORT_NORMAL : FG_EFFORT_QUICK;
    count_kinds(kinds, *state, vortex, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_SPIRAL], 0);
    count_kinds(kinds, *state, drain, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_RING], 0);
    count_kinds(kinds, *state, slant, effort, counts[n]);
    assert_int_equal(kinds[FG_ICON_ARROW], counts[n]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(orbits_are_rings_and_swirls_spirals),
      CASE(a_head_lies_on_a_calm_piece),
      CASE(no_field_gets_a_kind_that_it_has_not),
  };
  return cmocka_run_group_tests_name("place/icons", tests, NULL, NULL);
}
