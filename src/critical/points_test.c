#include "critical/field_test.h"
#include "critical/points.h"

static const double LOW[2] = {-1, 2}, HIGH[2] = {9, 8};

static fg__points points_of(fg_context *context, double reach, const double (*list)[3],
                            int count)
{
  fg__points out;
  assert_int_equal(fg__points_create(&out, context, LOW, HIGH, reach), FG_STATUS_OK);
  for (int n = 0; n < count; ++n) {
    const fg__point point = {.at = {list[n][0], list[n][1]}, .index = (int)list[n][2]};
    assert_int_equal(fg__points_add(&out, context, &point), FG_STATUS_OK);
  }
  return out;
}

static void opposite_points_cancel_closest_first(void **state)
{
  /* the middle one is nearer to the right one: the left stays */
  const double list[][3] = {{0, 3, 1}, {0.9, 3, -1}, {1.5, 3, 1}, {8, 7, -1}};
  fg__points points = points_of(*state, 1, list, 4);
  assert_int_equal(fg__points_merge(&points, *state), FG_STATUS_OK);
  assert_int_equal(fg__points_left(&points), 2);
  assert_false(points.point[0].gone);
  assert_true(points.point[1].gone && points.point[2].gone);
  fg__points_clear(&points);
}

static void like_points_become_one_that_goes_on(void **state)
{
  /* at 2.25 the first two meet; only from there the third is within reach */
  const double list[][3] = {{2, 5, -1}, {2.5, 5, -1}, {1.3, 5, -1}, {5, 5, 1}};
  fg__points points = points_of(*state, 1, list, 4);
  assert_int_equal(fg__points_merge(&points, *state), FG_STATUS_OK);
  assert_int_equal(fg__points_left(&points), 2);
  const fg__point *last = &points.point[points.count - 1];
  assert_false(last->gone);
  assert_close(last->at[0], (2.25 + 1.3) / 2, 1e-12);
  assert_int_equal(last->index, -1);
  fg__points_clear(&points);
}

/* Against the same done by looking at all pairs each time. */
static void many_points_merge_as_if_all_pairs_were_looked_at(void **state)
{
  enum { COUNT = 150 };
  double list[COUNT][3], at[2 * COUNT][3];
  unsigned seed = 3;
  for (int n = 0; n < COUNT; ++n) {
    list[n][0] = LOW[0] + (HIGH[0] - LOW[0]) * next_random(&seed);
    list[n][1] = LOW[1] + (HIGH[1] - LOW[1]) * next_random(&seed);
    list[n][2] = next_random(&seed) < 0.6 ? 1 : -1;
  }
  fg__points points = points_of(*state, 0.7, (const double(*)[3])list, COUNT);
  assert_int_equal(fg__points_merge(&points, *state), FG_STATUS_OK);
  memcpy(at, list, sizeof list);
  size_t left = COUNT;
  for (;;) {
    double best = 0.7;
    size_t a = 0, b = 0;
    for (size_t i = 0; i < left; ++i)
      for (size_t j = 0; j < i; ++j)
        if (hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]) < best) {
          best = hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]);
          a = i;
          b = j;
        }
    if (best >= 0.7)
      break;
    const double merged[3] = {(at[a][0] + at[b][0]) / 2, (at[a][1] + at[b][1]) / 2,
                              at[a][2]};
    const bool alike = at[a][2] * at[b][2] > 0;
    memmove(at[a], at[a + 1], (left - a - 1) * sizeof at[0]);
    memmove(at[b], at[b + 1], (left - b - 2) * sizeof at[0]);
    left -= 2;
    if (alike)
      memcpy(at[left++], merged, sizeof merged);
  }
  assert_true(left > 5 && left < COUNT - 20);
  assert_int_equal(fg__points_left(&points), left);
  fg__points_clear(&points);
}

static void points_match_within_reach_and_of_like_index_once(void **state)
{
  const double a[][3] = {{0, 3, 1}, {1, 3, 1}, {5, 5, 1}, {8, 3, -1}};
  const double b[][3] = {{0.6, 3, 1}, {5, 5.1, -1}, {8, 3.9, -1}, {8.4, 3, -1}};
  fg__points of_a = points_of(*state, 1, a, 4), of_b = points_of(*state, 1, b, 4);
  size_t matched = 0;
  assert_int_equal(fg__points_match(&matched, *state, &of_a, &of_b), FG_STATUS_OK);
  assert_int_equal(matched, 2); /* one with the first of b, one of two beside the last */
  fg__points_clear(&of_a);
  fg__points_clear(&of_b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      CASE(opposite_points_cancel_closest_first),
      CASE(like_points_become_one_that_goes_on),
      CASE(many_points_merge_as_if_all_pairs_were_looked_at),
      CASE(points_match_within_reach_and_of_like_index_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
