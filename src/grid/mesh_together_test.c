#include "grid/mesh.h"

#include <string.h>

#include "grid/exchange/slabs.h"
#include "grid/grids_test.h"

static fg__mesh mesh_of(int dimension, const double side[3], int nodes, int boundaries)
{
  fg__mesh_description description = {.dimension = dimension, .nodes = nodes};
  for (int k = 0; k < dimension; ++k) {
    description.side[k] = side[k];
    description.periodic[k] = (boundaries >> k & 1) != 0;
  }
  fg__mesh mesh;
  if (fg__mesh_create(&mesh, us.context, &description) != FG_STATUS_OK)
    abort();
  return mesh;
}

typedef void check(const fg__mesh *mesh);

static void for_all_meshes(check *holds)
{
  static const double SIDES[][3] = {
      {1.0, 1.0, 1.0}, {1.0, 2.0, 0.7}, {0.3, 1.0, 0.31}, {1.0, 1.0, 0.25}};
  static const int NODES[] = {9, 49, 100, 129};
  for (int s = 0; s < 4; ++s)
    for (int n = 0; n < 4; ++n)
      for (int dimension = 2; dimension <= 3; ++dimension) {
        fg__mesh mesh = mesh_of(dimension, SIDES[s], NODES[n], s + n);
        holds(&mesh);
        fg__mesh_clear(&mesh);
      }
}

/* Every node in one block: as many as there are, and no two blocks meet. */
static void shares_out_its_nodes(const fg__mesh *mesh)
{
  const fg__partition *p = &mesh->partition;
  int64_t sum = 0;
  for (int n = 0; n < us.ranks->count; ++n) {
    const fg__box *block = &p->block[n];
    sum += fg__box_count(block);
    for (int k = 0; k < 3; ++k)
      expect(block->first[k] >= 0 && block->nodes[k] > 0 &&
             block->first[k] + block->nodes[k] <= p->nodes[k]);
    expect(block->nodes[0] == p->nodes[0]);
    for (int other = 0; other < n; ++other) {
      fg__box common = fg__box_intersection(block, &p->block[other]);
      expect(fg__box_is_empty(&common));
    }
  }
  expect(sum == (long)p->nodes[0] * p->nodes[1] * p->nodes[2]);
}

static void every_node_has_one_block(void **state)
{
  (void)state;
  for_all_meshes(shares_out_its_nodes);
  end_together();
}

/* The finest level can be worked on as it is shared. */
static void is_workable(const fg__mesh *mesh)
{
  expect(fg__partition_is_workable(&mesh->partition, FG__LEAST_BLOCK_NODES));
}

static void blocks_are_thick_enough(void **state)
{
  (void)state;
  for_all_meshes(is_workable);
  end_together();
}

/* This rank's nodes in units of the mean. */
static double share_of(const fg__mesh *mesh)
{
  double nodes = (double)fg__box_count(fg__own_block(&mesh->partition));
  double all = (double)mesh->cells[0] * mesh->cells[1] * mesh->cells[2];
  return nodes * us.ranks->count / all;
}

/* Eight units may go to three ranks: an eighth too many. Of a small mesh four may, a half
 * too many: that costs less than coarser levels that every rank has. */
static void blocks_are_nearly_even(void **state)
{
  (void)state;
  static const double SQUARE[3] = {1.0, 1.0, 1.0}, LONG[3] = {1.0, 0.5, 0.5};
  const struct {
    int dimension;
    const double *side;
    int nodes;
  } cases[] = {
      {2, SQUARE, 257}, {2, LONG, 513}, {3, SQUARE, 65}, {3, LONG, 129}, {3, SQUARE, 17}};
  for (int n = 0; n < 5; ++n) {
    fg__mesh mesh = mesh_of(cases[n].dimension, cases[n].side, cases[n].nodes, 7);
    expect(share_of(&mesh) <= (cases[n].nodes == 17 ? 1.5 : 1.125));
    fg__slabs slabs;
    bool pencils = cases[n].nodes == 17 && us.ranks->count == 4;
    expect(fg__slabs_find(&slabs, &mesh.partition) == (us.ranks->count > 1 && !pencils));
    if (pencils)
      expect(mesh.partition.blocks[1] == 2 && mesh.partition.blocks[2] == 2);
    fg__mesh_clear(&mesh);
  }
  end_together();
}

/* 8 rows of cells are too few for three ranks. */
static void too_many_ranks_are_refused(void **state)
{
  (void)state;
  fg__mesh_description description = {.dimension = 2, .side = {4.0, 1.0}, .nodes = 33};
  fg__mesh mesh;
  fg_status status = fg__mesh_create(&mesh, us.context, &description);
  expect(status == (us.ranks->count > 2 ? FG_STATUS_ARGUMENT : FG_STATUS_OK));
  if (status)
    expect(strstr(fg_context_message(us.context), "; 2 ranks fit"));
  fg__mesh_clear(&mesh);
  end_together();
}

static void a_rank_can_have_a_mesh_of_its_own(void **state)
{
  (void)state;
  const fg__ranks *alone = &fg__single_rank;
  fg__mesh_description description = {
      .dimension = 2, .side = {1.0, 0.5}, .nodes = 65, .ranks = alone};
  fg__mesh mesh;
  expect(fg__mesh_create(&mesh, us.context, &description) == FG_STATUS_OK);
  expect(mesh.partition.block[0].nodes[0] == 65 &&
         mesh.partition.block[0].nodes[1] == 33);
  fg__mesh_clear(&mesh);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(every_node_has_one_block),
      TOGETHER(blocks_are_thick_enough),
      TOGETHER(blocks_are_nearly_even),
      TOGETHER(too_many_ranks_are_refused),
      TOGETHER(a_rank_can_have_a_mesh_of_its_own),
  };
  return cmocka_run_group_tests_name("grid/mesh on several ranks", tests, NULL, NULL);
}
