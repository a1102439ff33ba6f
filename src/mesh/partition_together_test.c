#include "mesh/partition.h"

#include "mesh/exchange.h"
#include "mesh/gather.h"
#include "mesh/shares_test.h"

enum { SEEDS = 12 };

/* Rank that owns a node, -1 for none, -2 for more than one. */
static int owner_in(const fg__partition *partition, const int node[3])
{
  int owner = -1;
  for (int rank = 0; rank < partition->ranks->count; ++rank)
    for (int n = partition->first_of_rank[rank]; n < partition->first_of_rank[rank + 1];
         ++n)
      if (has_node(&partition->box[n], node))
        owner = owner == -1 ? rank : -2;
  return owner;
}

typedef void on_node(const int node[3], void *data);

static void for_all_nodes(const int nodes[3], on_node *act, void *data)
{
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        act((int[3]){i, j, k}, data);
}

typedef struct pair {
  const shares *shares;
  const fg__partition *partition;
  int scale[3]; /* from the partition's indices to the shares' */
} pair;

static void has_its_owner(const int node[3], void *data)
{
  const pair *p = data;
  int fine[3] = {node[0] * p->scale[0], node[1] * p->scale[1], node[2] * p->scale[2]};
  expect(owner_in(p->partition, node) == owner_of(p->shares, fine));
}

static void every_rank_knows_every_owner(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      shares s = cut_at_random(&GRIDS[g], seed, 2);
      fg__partition partition = partition_of(&GRIDS[g], &s);
      pair p = {&s, &partition, {1, 1, 1}};
      for (int k = 0; k < 3; ++k)
        expect(partition.nodes[k] == nodes_along(&GRIDS[g], k));
      for_all_nodes(partition.nodes, has_its_owner, &p);
      fg__partition_clear(&partition);
    }
  end_together();
}

/* Node i of a coarser level is node 2 i, and stays where that is. */
static void coarse_nodes_stay_with_their_owners(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      shares s = cut_at_random(&GRIDS[g], seed, 1);
      fg__partition level = partition_of(&GRIDS[g], &s);
      pair p = {&s, &level, {1, 1, 1}};
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
      fg__partition_clear(&level);
    }
  end_together();
}

static void small_or_crooked_boxes_are_not_workable(void **state)
{
  (void)state;
  const grid *g = &GRIDS[4]; /* 17 x 9 x 25 nodes */
  const struct {
    fg__box box[2];
    int least;
    bool workable;
  } cases[] = {
      {{{{0, 0, 0}, {8, 9, 25}}, {{8, 0, 0}, {9, 9, 25}}}, 8, true},
      {{{{0, 0, 0}, {8, 9, 25}}, {{8, 0, 0}, {9, 9, 25}}}, 9, false},
      {{{{0, 0, 0}, {17, 9, 22}}, {{0, 0, 22}, {17, 9, 3}}}, 3, true},
      {{{{0, 0, 0}, {17, 9, 22}}, {{0, 0, 22}, {17, 9, 3}}}, 4, false},
      {{{{0, 0, 0}, {17, 5, 25}}, {{0, 5, 0}, {17, 4, 25}}}, 2, false},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    shares s = {.count = 2, .owner = {0, us.ranks->count - 1}};
    s.box[0] = cases[n].box[0];
    s.box[1] = cases[n].box[1];
    fg__partition partition = partition_of(g, &s);
    expect(fg__partition_is_workable(&partition, cases[n].least) == cases[n].workable);
    fg__partition_clear(&partition);
  }
  end_together();
}

/* Its last row would be no node of the next level. */
static void a_level_of_odd_cells_is_not_workable(void **state)
{
  (void)state;
  const grid g = {2, {12, 6, 1}, {false, false, false}};
  shares s = {.count = 1, .box = {{{0, 0, 0}, {13, 7, 1}}}};
  fg__partition partition = partition_of(&g, &s), coarse;
  expect(fg__partition_is_workable(&partition, 4));
  expect(fg__partition_coarsen(&coarse, us.context, &partition) == FG_STATUS_OK);
  expect(coarse.box[0].nodes[1] == 4 && !fg__partition_is_workable(&coarse, 4));
  fg__partition_clear(&coarse);
  fg__partition_clear(&partition);
  end_together();
}

static void check_ring(const grid *g, const fg__partition *partition, const fields *f)
{
  int count, depth = g->dimension == 3;
  const fg__box *own = fg__own_boxes(partition, &count);
  for (int b = 0; b < count; ++b)
    for (int k = -depth; k < own[b].nodes[2] + depth; ++k)
      for (int j = -1; j <= own[b].nodes[1]; ++j)
        for (int i = -1; i <= own[b].nodes[0]; ++i) {
          int node[3] = {own[b].first[0] + i, own[b].first[1] + j, own[b].first[2] + k};
          for (int axis = 0; axis < 3; ++axis)
            node[axis] = image_along(g, axis, node[axis]);
          for (int a = 0; a < f->count; ++a)
            expect(f->node[a][b][fg__node_at(&f->layout[b], i, j, k)] ==
                   value_at(a, node));
        }
}

/* To the whole grid on each rank and back, ghosts included. */
static void replicated_levels_hold_all_and_give_it_back(void **state)
{
  (void)state;
  const fg__ranks *alone;
  expect(fg__ranks_alone(&alone, us.context) == FG_STATUS_OK);
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      fg__box all_nodes = {{0, 0, 0}, {1, 1, 1}};
      for (int k = 0; k < 3; ++k)
        all_nodes.nodes[k] = nodes_along(&GRIDS[g], k);
      shares s = cut_at_random(&GRIDS[g], seed, 1);
      fg__partition partition = partition_of(&GRIDS[g], &s), whole;
      expect(fg__partition_create(&whole, us.context, alone, GRIDS[g].dimension,
                                  GRIDS[g].cells, GRIDS[g].periodic, &all_nodes,
                                  1) == FG_STATUS_OK);
      fg__gather *gather;
      fg__exchange *mirror;
      expect(fg__gather_create(&gather, us.context, &partition, 3) == FG_STATUS_OK);
      expect(fg__exchange_create(&mirror, us.context, &whole, 3) == FG_STATUS_OK);
      fields shared = fields_of(&partition, 3), all = fields_of(&whole, 3);
      for (int a = 0; a < 3; ++a)
        for (size_t n = 0; n < all.layout[0].array_size; ++n)
          (all.node[a][0] - all.layout[0].first)[n] = UNTOUCHED;
      float *target[3] = {all.node[0][0], all.node[1][0], all.node[2][0]};
      int arrays = 1 + (int)seed % 3;
      fg__gather_fill(gather, arrays, arrays_of(&shared), target);
      fg__exchange_fill(mirror, 3, arrays_of(&all), FG__ALL_COLOURS);
      all.count = shared.count = arrays;
      check_ring(&GRIDS[g], &whole, &all);
      for (int b = 0; b < shared.boxes; ++b)
        for (int a = 0; a < arrays; ++a)
          for (size_t n = 0; n < shared.layout[b].array_size; ++n)
            (shared.node[a][b] - shared.layout[b].first)[n] = UNTOUCHED;
      fg__gather_return(gather, arrays, target, arrays_of(&shared));
      check_ring(&GRIDS[g], &partition, &shared);
      all.count = shared.count = 3;
      fields_clear(&shared);
      fields_clear(&all);
      fg__gather_destroy(gather);
      fg__exchange_destroy(mirror);
      fg__partition_clear(&partition);
      fg__partition_clear(&whole);
    }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(every_rank_knows_every_owner),
      TOGETHER(coarse_nodes_stay_with_their_owners),
      TOGETHER(small_or_crooked_boxes_are_not_workable),
      TOGETHER(a_level_of_odd_cells_is_not_workable),
      TOGETHER(replicated_levels_hold_all_and_give_it_back),
  };
  return cmocka_run_group_tests_name("mesh/partition", tests, NULL, NULL);
}
