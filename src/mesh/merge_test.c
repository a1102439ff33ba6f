/* Few ranks get slabs, many do not, without starting so many. */
#include "mesh/merge.h"

#include "base/context_test.h"

static int unit_for(int dimension, const int cells[3], int rank_count)
{
  fg__ranks ranks = {.count = rank_count};
  fg__mesh mesh = {.dimension = dimension, .cells = {1, 1, 1}, .ranks = &ranks};
  for (int k = 0; k < dimension; ++k)
    mesh.cells[k] = cells[k];
  return fg__mesh_slab_unit(&mesh);
}

/* Each rank has a unit, and the one with most no more than boxes would cost it. */
static void slabs_are_whole_units_for_all(void **state)
{
  (void)state;
  static const int CELLS[][3] = {{512, 512, 1}, {1024, 352, 1}, {48, 4096, 1}};
  static const int SOLID[][3] = {{128, 128, 128}, {64, 256, 48}, {512, 512, 1024}};
  for (int dimension = 2; dimension <= 3; ++dimension)
    for (int n = 0; n < 3; ++n)
      for (int ranks = 2; ranks <= 200; ++ranks) {
        const int *cells = dimension == 3 ? SOLID[n] : CELLS[n];
        int unit = unit_for(dimension, cells, ranks), units;
        if (unit == 0)
          continue;
        units = cells[dimension - 1] / unit;
        assert_true(unit >= 8 && (unit & (unit - 1)) == 0);
        assert_int_equal(units * unit, cells[dimension - 1]);
        assert_true(units >= ranks);
        assert_true((units + ranks - 1) / ranks * ranks <= 1.7 * units);
      }
}

static void few_ranks_have_slabs(void **state)
{
  (void)state;
  for (int ranks = 2; ranks <= 4; ++ranks) {
    assert_true(unit_for(2, (const int[3]){96, 64}, ranks) > 0);
    assert_true(unit_for(2, (const int[3]){1024, 1024}, ranks) > 0);
    assert_true(unit_for(3, (const int[3]){64, 64, 64}, ranks) > 0);
  }
  assert_true(unit_for(2, (const int[3]){1024, 1024}, 32) > 0);
  assert_true(unit_for(3, (const int[3]){256, 256, 256}, 16) > 0);
}

static void one_rank_and_many_have_none(void **state)
{
  (void)state;
  assert_int_equal(unit_for(2, (const int[3]){512, 512}, 1), 0);
  assert_int_equal(unit_for(2, (const int[3]){8192, 8192}, 1000), 0);
  assert_int_equal(unit_for(3, (const int[3]){1024, 1024, 1024}, 1000), 0);
  assert_int_equal(unit_for(3, (const int[3]){64, 64, 64}, 7), 0);
  assert_int_equal(unit_for(2, (const int[3]){64, 16}, 4), 0);
}

/* Units as thick as they can be where slabs come out even, thinner where not: every rank
 * computes what cannot be shared. */
static void thick_units_leave_small_whole_levels(void **state)
{
  (void)state;
  assert_true(unit_for(2, (const int[3]){512, 512}, 4) >= 64);
  int unit = unit_for(3, (const int[3]){128, 128, 128}, 3);
  assert_true(unit > 0 && unit <= 16);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slabs_are_whole_units_for_all),
      cmocka_unit_test(few_ranks_have_slabs),
      cmocka_unit_test(one_rank_and_many_have_none),
      cmocka_unit_test(thick_units_leave_small_whole_levels),
  };
  return cmocka_run_group_tests_name("mesh/merge", tests, NULL, NULL);
}
