/* Ghosts of plain arrays hold what the nodes hold that they stand for. */
#include "grid/exchange/halo.h"

#include "grid/grids_test.h"

static int *node_of(const fg__halo *halo, int *array, int i, int j, int k)
{
  bool solid = halo->partition->dimension == 3;
  return array + halo->first + i + (solid ? j : 0) * halo->row +
         (solid ? k : j) * halo->slice;
}

static int number_of(const int node[3])
{
  return 1 + node[0] + 100 * (node[1] + 100 * node[2]);
}

static void compare(const grid *g, const fg__partition *partition)
{
  const fg__box *own = fg__own_block(partition);
  fg__halo halo;
  expect(fg__halo_create(&halo, us.context, partition) == FG_STATUS_OK);
  int *array = allocate_or_end(halo.size, sizeof *array);
  int ghosts[3] = {0, g->dimension == 2 ? 1 : halo.ghost_rows, g->dimension == 3};
  for (int k = 0; k < own->nodes[2]; ++k)
    for (int j = 0; j < own->nodes[1]; ++j)
      for (int i = 0; i < own->nodes[0]; ++i)
        *node_of(&halo, array, i, j, k) =
            number_of((int[3]){own->first[0] + i, own->first[1] + j, own->first[2] + k});
  fg__halo_fill(&halo, array);
  int wrong = 0, filled = 0;
  for (int k = -ghosts[2]; k < own->nodes[2] + ghosts[2]; ++k)
    for (int j = -ghosts[1]; j < own->nodes[1] + ghosts[1]; ++j)
      for (int i = 0; i < own->nodes[0]; ++i) {
        int node[3] = {own->first[0] + i, own->first[1] + j, own->first[2] + k};
        bool beyond = false;
        for (int axis = 0; axis < 3; ++axis) {
          int nodes = nodes_along(g, axis);
          if (g->periodic[axis])
            node[axis] = (node[axis] + nodes) % nodes;
          beyond = beyond || node[axis] < 0 || node[axis] >= nodes;
        }
        int want = beyond ? 0 : number_of(node);
        wrong += *node_of(&halo, array, i, j, k) != want;
        filled += want != 0;
      }
  expect(wrong == 0);
  expect(us.ranks->count == 1 || filled > (int)fg__box_count(own));
  free(array);
  fg__halo_clear(&halo);
}

static void ghosts_hold_their_nodes(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 6; ++seed)
    for (int n = 0; n < GRID_COUNT; ++n) {
      fg__partition partition = divide_at_random(&GRIDS[n], seed, 1);
      compare(&GRIDS[n], &partition);
      fg__partition_clear(&partition);
    }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {TOGETHER(ghosts_hold_their_nodes)};
  return cmocka_run_group_tests_name("grid/halo", tests, NULL, NULL);
}
