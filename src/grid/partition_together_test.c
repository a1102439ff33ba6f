#include "grid/partition.h"

#include "grid/exchange/exchange.h"
#include "grid/exchange/gather.h"
#include "grid/grids_test.h"

enum { SEEDS = 12 };

typedef void on_node(const int node[3], void *data);

static void for_all_nodes(const int nodes[3], on_node *act, void *data)
{
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        act((int[3]){i, j, k}, data);
}

typedef struct pair {
  const fg__partition *fine, *level;
  int scale[3]; /* from the level's indices to the fine one's */
} pair;

static void has_its_owner(const int node[3], void *data)
{
  const pair *p = data;
  int fine[3] = {node[0] * p->scale[0], node[1] * p->scale[1], node[2] * p->scale[2]};
  int owner = owner_of(p->level, node);
  expect(owner != FG__NOBODY && owner == owner_of(p->fine, fine));
}

/* Blocks of whole rows, each but the last of whole units, as even as units allow. */
static void check_blocks(const grid *g, const int blocks[3], int unit)
{
  fg__partition partition;
  expect(fg__partition_create(&partition, us.context, us.ranks, g->dimension, g->cells,
                              g->periodic, blocks, unit) == FG_STATUS_OK);
  pair p = {&partition, &partition, {1, 1, 1}};
  for (int k = 0; k < 3; ++k)
    expect(partition.nodes[k] == nodes_along(g, k));
  for_all_nodes(partition.nodes, has_its_owner, &p);
  for (int rank = 0; rank < us.ranks->count; ++rank) {
    const fg__box *block = &partition.block[rank];
    expect(block->first[0] == 0 && block->nodes[0] == nodes_along(g, 0));
    for (int k = 1; k < 3 && k < g->dimension; ++k) {
      double mean = (double)g->cells[k] / blocks[k];
      fg__box cells = fg__block_cells(&partition, block);
      expect(block->first[k] % unit == 0 && cells.nodes[k] % unit == 0);
      expect(cells.nodes[k] > mean - unit && cells.nodes[k] < mean + unit);
    }
  }
  fg__partition_clear(&partition);
}

static void every_node_has_one_owner(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (int unit = 1; unit <= 2; unit *= 2)
      for (int along_y = 1; along_y <= us.ranks->count; ++along_y) {
        const int blocks[3] = {1, along_y, us.ranks->count / along_y};
        if (blocks[1] * blocks[2] == us.ranks->count &&
            (GRIDS[g].dimension == 3 || blocks[2] == 1))
          check_blocks(&GRIDS[g], blocks, unit);
      }
  end_together();
}

/* Blocks touch their neighbours' sides, across periodic boundaries too. */
static void neighbours_lie_side_by_side(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      fg__partition p = divide_at_random(&GRIDS[g], seed, 1);
      const fg__box *own = fg__own_block(&p);
      for (int axis = 0; axis < GRIDS[g].dimension; ++axis)
        for (int up = 0; up < 2; ++up) {
          int steps[3] = {0, 0, 0},
              node[3] = {own->first[0], own->first[1], own->first[2]};
          steps[axis] = up ? 1 : -1;
          node[axis] = up ? own->first[axis] + own->nodes[axis] : own->first[axis] - 1;
          if (GRIDS[g].periodic[axis])
            node[axis] = image_along(&GRIDS[g], axis, node[axis]);
          expect(fg__block_neighbour(&p, us.ranks->rank, steps) == owner_of(&p, node));
        }
      fg__partition_clear(&p);
    }
  end_together();
}

/* Node i of a coarser level is node 2 i, and stays where that is. */
static void coarse_nodes_stay_with_their_owners(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      fg__partition finest = divide_at_random(&GRIDS[g], seed, 1), level;
      expect(fg__partition_copy(&level, us.context, &finest) == FG_STATUS_OK);
      pair p = {&finest, &level, {1, 1, 1}};
      for (int depth = 0; depth < 3; ++depth) {
        fg__partition coarse;
        expect(fg__partition_coarsen(&coarse, us.context, &level) == FG_STATUS_OK);
        for (int k = 0; k < GRIDS[g].dimension; ++k) {
          p.scale[k] *= 2;
          expect(coarse.cells[k] * 2 == level.cells[k]);
          expect(coarse.nodes[k] == coarse.cells[k] + !GRIDS[g].periodic[k]);
        }
        fg__partition_clear(&level);
        level = coarse;
        for_all_nodes(level.nodes, has_its_owner, &p);
      }
      fg__partition_clear(&finest);
      fg__partition_clear(&level);
    }
  end_together();
}

/* 17 x 9 x 25 nodes, cut along z. */
static void thin_or_crooked_blocks_are_not_workable(void **state)
{
  (void)state;
  const grid *g = &GRIDS[4];
  const struct {
    int cut, least;
    bool workable;
  } cases[] = {{8, 8, true}, {8, 9, false}, {22, 3, true}, {22, 4, false}, {5, 2, false}};
  const int blocks[3] = {1, 1, us.ranks->count};
  for (size_t n = 0; n < sizeof cases / sizeof *cases && us.ranks->count == 2; ++n) {
    fg__partition p;
    expect(fg__partition_create(&p, us.context, us.ranks, g->dimension, g->cells,
                                g->periodic, blocks, 1) == FG_STATUS_OK);
    p.block[0].nodes[2] = p.block[1].first[2] = cases[n].cut;
    p.block[1].nodes[2] = p.nodes[2] - cases[n].cut;
    expect(fg__partition_is_workable(&p, cases[n].least) == cases[n].workable);
    fg__partition_clear(&p);
  }
  end_together();
}

/* Its last row would be no node of the next level. */
static void a_level_of_odd_cells_is_not_workable(void **state)
{
  (void)state;
  const grid g = {2, {12, 6, 1}, {false, false, false}};
  const fg__ranks *alone = &fg__single_rank;
  fg__partition partition, coarse;
  expect(fg__partition_create(&partition, us.context, alone, 2, g.cells, g.periodic,
                              (const int[3]){1, 1, 1}, 8) == FG_STATUS_OK);
  expect(fg__partition_is_workable(&partition, 4));
  expect(fg__partition_coarsen(&coarse, us.context, &partition) == FG_STATUS_OK);
  expect(coarse.block[0].nodes[1] == 4 && !fg__partition_is_workable(&coarse, 4));
  fg__partition_clear(&coarse);
  fg__partition_clear(&partition);
  end_together();
}

static void check_ring(const grid *g, const fg__partition *partition, const fields *f)
{
  int depth = g->dimension == 3;
  const fg__box *own = fg__own_block(partition);
  for (int k = -depth; k < own->nodes[2] + depth; ++k)
    for (int j = -1; j <= own->nodes[1]; ++j)
      for (int i = -1; i <= own->nodes[0]; ++i) {
        int node[3] = {own->first[0] + i, own->first[1] + j, own->first[2] + k};
        for (int axis = 0; axis < 3; ++axis)
          node[axis] = image_along(g, axis, node[axis]);
        for (int a = 0; a < f->count; ++a)
          expect(f->array[a][fg__node_at(&f->layout, i, j, k)] == value_at(a, node));
      }
}

static void check_gather(const grid *g, uint64_t seed, const fg__ranks *alone)
{
  int arrays = 1 + (int)seed % 3;
  fg__partition partition = divide_at_random(g, seed, 1), whole;
  expect(fg__partition_create(&whole, us.context, alone, g->dimension, g->cells,
                              g->periodic, (const int[3]){1, 1, 1}, 8) == FG_STATUS_OK);
  fg__gather *gather;
  fg__exchange *mirror;
  expect(fg__gather_create(&gather, us.context, &partition, 3) == FG_STATUS_OK);
  expect(fg__exchange_create(&mirror, us.context, &whole, 3) == FG_STATUS_OK);
  fields shared = fields_of(&partition, arrays), all = fields_of(&whole, arrays);
  fields_forget(&all);
  fg__gather_fill(gather, arrays, shared.array, all.array);
  fg__exchange_fill(mirror, arrays, all.array, FG__ALL_COLOURS);
  check_ring(g, &whole, &all);
  fields_forget(&shared);
  fg__gather_return(gather, arrays, all.array, shared.array);
  check_ring(g, &partition, &shared);
  fields_clear(&shared);
  fields_clear(&all);
  fg__gather_destroy(gather);
  fg__exchange_destroy(mirror);
  fg__partition_clear(&partition);
  fg__partition_clear(&whole);
}

/* To the whole grid on each rank and back, ghosts included. */
static void replicated_levels_hold_all_and_give_it_back(void **state)
{
  (void)state;
  const fg__ranks *alone = &fg__single_rank;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed)
      check_gather(&GRIDS[g], seed, alone);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(every_node_has_one_owner),
      TOGETHER(neighbours_lie_side_by_side),
      TOGETHER(coarse_nodes_stay_with_their_owners),
      TOGETHER(thin_or_crooked_blocks_are_not_workable),
      TOGETHER(a_level_of_odd_cells_is_not_workable),
      TOGETHER(replicated_levels_hold_all_and_give_it_back),
  };
  return cmocka_run_group_tests_name("grid/partition", tests, NULL, NULL);
}
