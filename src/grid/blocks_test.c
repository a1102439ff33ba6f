/* Blocks for many ranks, without starting so many. */
#include "grid/blocks.h"

#include <stdio.h>
#include <string.h>

#include "base/context_test.h"

static fg_status choose(fg__blocks *out, fg_context *context, int dimension,
                        const int cells[3], int rank_count)
{
  const fg__ranks ranks = {.count = rank_count};
  return fg__blocks_choose(out, context, &ranks, dimension, cells, false);
}

static const int FLAT[][3] = {{512, 512, 1}, {1024, 352, 1}, {48, 4096, 1}, {64, 40, 1}};
static const int SOLID[][3] = {
    {128, 128, 128}, {64, 256, 48}, {512, 512, 1024}, {32, 16, 64}};

enum { GRIDS = 4, MOST_RANKS = 200 };

/* As many blocks as ranks, of a whole unit at least; none across a row. */
static void each_rank_has_a_block(void **state)
{
  for (int dimension = 2; dimension <= 3; ++dimension)
    for (int n = 0; n < GRIDS; ++n)
      for (int ranks = 1; ranks <= MOST_RANKS; ++ranks) {
        const int *cells = dimension == 3 ? SOLID[n] : FLAT[n];
        fg__blocks b;
        if (choose(&b, *state, dimension, cells, ranks) != FG_STATUS_OK)
          continue;
        assert_int_equal(b.count[0], 1);
        assert_int_equal(b.count[1] * b.count[2], ranks);
        assert_true(dimension == 3 || b.count[2] == 1);
        assert_true(b.unit >= FG__LEAST_BLOCK_CELLS && (b.unit & (b.unit - 1)) == 0);
        for (int k = 1; k < dimension; ++k)
          assert_true(b.count[k] == 1 ||
                      (cells[k] % b.unit == 0 && cells[k] / b.unit >= b.count[k]));
      }
}

/* Exactly what divides the outer axes into blocks of four cells or more fits. */
static void too_many_ranks_are_refused(void **state)
{
  for (int dimension = 2; dimension <= 3; ++dimension)
    for (int n = 0; n < GRIDS; ++n)
      for (int ranks = 1, most = 0; ranks <= MOST_RANKS; ++ranks) {
        const int *cells = dimension == 3 ? SOLID[n] : FLAT[n];
        bool fits = false;
        for (int along_y = 1; along_y <= ranks; ++along_y)
          if (ranks % along_y == 0 && along_y <= cells[1] / 4)
            fits = fits || ranks / along_y <= (dimension == 3 ? cells[2] / 4 : 1);
        most = fits ? ranks : most;
        fg__blocks b;
        fg_status status = choose(&b, *state, dimension, cells, ranks);
        assert_int_equal(status, fits ? FG_STATUS_OK : FG_STATUS_ARGUMENT);
        char expected[64];
        snprintf(expected, sizeof expected, "; %d ranks fit", most);
        assert_true(fits || strstr(fg_context_message(*state), expected));
        fg_context_clear(*state);
        assert_int_equal(fg__blocks_choose(&b, *state, &(fg__ranks){.count = ranks},
                                           dimension, cells, true),
                         FG_STATUS_OK); /* as many as fit have a block */
        assert_int_equal(b.count[1] * b.count[2], most);
      }
}

static void expect_blocks(fg_context *context, const int cells[3], int ranks, int along_y,
                          int along_z)
{
  fg__blocks b;
  assert_int_equal(choose(&b, context, 3, cells, ranks), FG_STATUS_OK);
  assert_int_equal(b.count[1], along_y);
  assert_int_equal(b.count[2], along_z);
}

/* Slabs while they are not much thinner than the pencils would be; more pencils along z
 * than along y, where that fits. */
static void slabs_give_way_to_pencils_as_thick_as_can_be(void **state)
{
  expect_blocks(*state, SOLID[0], 2, 1, 2);
  expect_blocks(*state, SOLID[0], 3, 1, 3);
  expect_blocks(*state, SOLID[0], 4, 1, 4);
  expect_blocks(*state, SOLID[0], 6, 1, 6);
  expect_blocks(*state, (const int[3]){16, 16, 16}, 4, 2, 2);
  expect_blocks(*state, SOLID[0], 64, 8, 8);
  expect_blocks(*state, (const int[3]){64, 128, 16}, 9, 9, 1);
  expect_blocks(*state, (const int[3]){64, 16, 128}, 9, 1, 9);
  expect_blocks(*state, (const int[3]){64, 128, 8}, 4, 4, 1);
}

/* Units as thick as they can be where blocks come out even, thinner where not: every rank
 * computes what cannot be shared. */
static void thick_units_leave_small_whole_levels(void **state)
{
  fg__blocks b;
  assert_int_equal(choose(&b, *state, 2, FLAT[0], 4), FG_STATUS_OK);
  assert_true(b.unit >= 64);
  assert_int_equal(choose(&b, *state, 3, SOLID[0], 4), FG_STATUS_OK);
  assert_true(b.unit >= 16);
  assert_int_equal(choose(&b, *state, 3, SOLID[0], 3), FG_STATUS_OK);
  assert_true(b.unit <= 16);
}

int main(void)
{
#define CASE(name)                                                                       \
  cmocka_unit_test_setup_teardown(name, context_set_up, context_tear_down)
  const struct CMUnitTest tests[] = {
      CASE(each_rank_has_a_block),
      CASE(too_many_ranks_are_refused),
      CASE(slabs_give_way_to_pencils_as_thick_as_can_be),
      CASE(thick_units_leave_small_whole_levels),
  };
  return cmocka_run_group_tests_name("grid/blocks", tests, NULL, NULL);
}
