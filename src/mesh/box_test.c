#include <string.h>

#include "base/context_test.h"
#include "mesh/box.h"

/* Small enough to mark every node. */
enum { SIDE_X = 7, SIDE_Y = 6, SIDE_Z = 5, MOST = SIDE_X * SIDE_Y * SIDE_Z };

typedef struct marks {
  int times[SIDE_Z][SIDE_Y][SIDE_X];
} marks;

static void mark(marks *m, const fg__box *box)
{
  for (int k = 0; k < box->nodes[2]; ++k)
    for (int j = 0; j < box->nodes[1]; ++j)
      for (int i = 0; i < box->nodes[0]; ++i)
        ++m->times[box->first[2] + k][box->first[1] + j][box->first[0] + i];
}

static unsigned random_below(uint64_t *seed, unsigned end)
{
  *seed = *seed * 6364136223846793005U + 1442695040888963407U;
  return (unsigned)(*seed >> 33) % end;
}

static fg__box random_box(uint64_t *seed)
{
  const unsigned side[3] = {SIDE_X, SIDE_Y, SIDE_Z};
  fg__box box;
  for (int k = 0; k < 3; ++k) {
    box.first[k] = (int)random_below(seed, side[k]);
    box.nodes[k] = 1 + (int)random_below(seed, side[k] - (unsigned)box.first[k]);
  }
  return box;
}

static void the_intersection_is_what_both_have(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int trial = 0; trial < 500; ++trial) {
    fg__box a = random_box(&seed), b = random_box(&seed);
    fg__box common = fg__box_intersection(&a, &b);
    marks both = {0}, found = {0};
    mark(&both, &a);
    mark(&both, &b);
    if (!fg__box_is_empty(&common))
      mark(&found, &common);
    for (int n = 0; n < MOST; ++n)
      assert_int_equal(((int *)found.times)[n], ((int *)both.times)[n] == 2);
  }
}

/* Unit boxes at random nodes; the same in another order. */
static int scatter(fg__box box[MOST], uint64_t *seed, unsigned share)
{
  int count = 0;
  for (int n = 0; n < MOST; ++n)
    if (random_below(seed, 10) < share)
      box[count++] =
          (fg__box){{n % SIDE_X, n / SIDE_X % SIDE_Y, n / SIDE_X / SIDE_Y}, {1, 1, 1}};
  for (int n = count - 1; n > 0; --n) {
    int other = (int)random_below(seed, (unsigned)n + 1);
    fg__box kept = box[n];
    box[n] = box[other];
    box[other] = kept;
  }
  return count;
}

static void merging_covers_the_same_nodes(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (unsigned share = 0; share <= 10; ++share)
    for (int trial = 0; trial < 20; ++trial) {
      fg__box box[MOST];
      int count = scatter(box, &seed, share);
      marks before = {0}, after = {0};
      for (int n = 0; n < count; ++n)
        mark(&before, &box[n]);
      int merged = fg__boxes_merge(box, count);
      for (int n = 0; n < merged; ++n)
        mark(&after, &box[n]);
      assert_memory_equal(&before, &after, sizeof before);
      if (share == 10)
        assert_int_equal(merged, 1);
    }
}

/* No two of the boxes that come out could still be made one. */
static void nothing_is_left_to_merge(void **state)
{
  (void)state;
  uint64_t seed = 6;
  for (unsigned share = 3; share <= 9; ++share) {
    fg__box box[MOST];
    int count = fg__boxes_merge(box, scatter(box, &seed, share));
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b)
        for (int axis = 0; axis < 3; ++axis) {
          bool one = box[a].first[axis] + box[a].nodes[axis] == box[b].first[axis];
          for (int k = 0; k < 3; ++k)
            one = one && (k == axis || (box[a].first[k] == box[b].first[k] &&
                                        box[a].nodes[k] == box[b].nodes[k]));
          assert_false(one);
        }
  }
}

static void merging_does_not_depend_on_the_order(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int trial = 0; trial < 50; ++trial) {
    fg__box box[MOST], other[MOST];
    int count = scatter(box, &seed, 7);
    for (int n = 0; n < count; ++n)
      other[n] = box[count - 1 - n];
    int merged = fg__boxes_merge(box, count);
    assert_int_equal(fg__boxes_merge(other, count), merged);
    assert_memory_equal(box, other, (size_t)merged * sizeof *box);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_intersection_is_what_both_have),
      cmocka_unit_test(merging_covers_the_same_nodes),
      cmocka_unit_test(nothing_is_left_to_merge),
      cmocka_unit_test(merging_does_not_depend_on_the_order),
  };
  return cmocka_run_group_tests_name("mesh/box", tests, NULL, NULL);
}
