#include <string.h>

#include "base/context_test.h"
#include "grid/box.h"

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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_intersection_is_what_both_have),
  };
  return cmocka_run_group_tests_name("grid/box", tests, NULL, NULL);
}
