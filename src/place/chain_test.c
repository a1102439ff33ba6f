#include "place/placed_test.h"

static const fg_icon *find_id(const fg_icons *icons, int id)
{
  for (int n = 0; n < fg_icons_count(icons); ++n)
    if (fg_icons_at(icons, n)->id == id)
      return fg_icons_at(icons, n);
  return NULL;
}

static void a_chain_keeps_its_arrows(void **state)
{
  static const struct {
    const sampling *box;
    velocity_of velocity;
    int count;
    fg_effort effort;
  } cases[] = {{&PLAIN, coast, 50, FG_EFFORT_NORMAL},
               {&STRIP, swirl, 50, FG_EFFORT_QUICK},
               {&ROUND, winds, 40, FG_EFFORT_NORMAL},
               {&SOLID, hall, 20, FG_EFFORT_QUICK}};
  for (int n = 0; n < 4; ++n) {
    const int count = cases[n].count, fewer = 9 * count / 10;
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_placement *placement = placement_of(*state, field, cases[n].effort);
    fg_icons *fine = place(*state, placement, count),
             *coarse = place(*state, placement, fewer);
    assert_int_equal(fg_icons_count(coarse), fewer);
    int kept = 0;
    fg_placement_find_parents(placement, fine);
    for (int k = 0; k < count; ++k) {
      const fg_icon *icon = fg_icons_at(fine, k);
      const fg_icon *parent = find_id(coarse, icon->parent);
      assert_non_null(parent);
      if (!find_id(coarse, icon->id))
        continue;
      assert_int_equal(icon->parent, icon->id);
      /* it stays only if it has moved by little */
      if (distance_between(icon->center, parent->center, 3) < lambda_of(placement))
        ++kept;
    }
    assert_true(10 * kept >= 9 * fewer);
    fg_icons_destroy(fine);
    fg_icons_destroy(coarse);
    fg_placement_destroy(placement);
    fg_field_destroy(field);
  }
}

/* The parent of an arrow that is gone is the one nearest to its seed. */
static void a_lost_arrow_goes_into_the_nearest(void **state)
{
  fg_field *field = field_of(*state, &PLAIN, coast);
  fg_placement *placement = placement_of(*state, field, FG_EFFORT_QUICK);
  fg_icons *fine = place(*state, placement, 40), *coarse = place(*state, placement, 12);
  fg_placement_find_parents(placement, fine);
  int gone = 0;
  for (int n = 0; n < 40; ++n) {
    const fg_icon *icon = fg_icons_at(fine, n);
    double least = HUGE_VAL, parents = HUGE_VAL;
    if (find_id(coarse, icon->id))
      continue;
    for (int m = 0; m < 12; ++m)
      for (int i = 0; i < fg_icons_at(coarse, m)->point_count; ++i) {
        const fg_icon *other = fg_icons_at(coarse, m);
        double distance = distance_between(icon->seed, other->points[i], 2);
        least = fmin(least, distance);
        if (other->id == icon->parent)
          parents = fmin(parents, distance);
      }
    assert_close(parents, least, 0.1 * lambda_of(placement));
    ++gone;
  }
  assert_true(gone >= 28);
  fg_icons_destroy(fine);
  fg_icons_destroy(coarse);
  fg_placement_destroy(placement);
  fg_field_destroy(field);
}

/* How many of these have one of the others where they are. */
static int count_near(const fg_icons *icons, const fg_icons *others, double reach)
{
  int near = 0;
  for (int n = 0; n < fg_icons_count(icons); ++n) {
    bool found = false;
    for (int m = 0; m < fg_icons_count(others) && !found; ++m)
      found = distance_between(fg_icons_at(icons, n)->center,
                               fg_icons_at(others, m)->center, 3) < reach;
    near += found;
  }
  return near;
}

/* Of a placement that starts from another's icons, as from an animation's frame before.
 */
static void most_arrows_stay_where_they_were(void **state)
{
  static const struct {
    const sampling *box;
    velocity_of velocity;
    int count;
  } cases[] = {{&PLAIN, swirl, 60}, {&ROUND, winds, 60}, {&PLAIN, coast, 60}};
  for (int n = 0; n < 3; ++n) {
    const int count = cases[n].count;
    fg_field *field = field_of(*state, cases[n].box, cases[n].velocity);
    fg_placement *placement = placement_of(*state, field, FG_EFFORT_NORMAL);
    fg_placement *later = placement_of(*state, field, FG_EFFORT_NORMAL);
    fg_icons *before = place(*state, placement, count), *after = NULL;
    assert_int_equal(fg_placement_place(later, count, before), FG_STATUS_OK);
    assert_int_equal(fg_placement_icons(&after, later), FG_STATUS_OK);
    assert_int_equal(fg_icons_count(after), count);
    const int stay = count_near(before, after, 0.15 * lambda_of(placement));
    assert_true(stay > 8 * count / 10);
    assert_true(error_of(*state, field, after) < 1.05 * error_of(*state, field, before));
    fg_icons_destroy(before);
    fg_icons_destroy(after);
    fg_placement_destroy(placement);
    fg_placement_destroy(later);
    fg_field_destroy(field);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(a_chain_keeps_its_arrows),
      CASE(most_arrows_stay_where_they_were),
      CASE(a_lost_arrow_goes_into_the_nearest),
  };
  return cmocka_run_group_tests_name("place/chain", tests, NULL, NULL);
}
