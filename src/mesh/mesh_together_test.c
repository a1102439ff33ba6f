#include "mesh/mesh.h"

#include <math.h>

#include "mesh/shares_test.h"
#include "mesh/slabs.h"

static fg__mesh mesh_of(int dimension, const double side[3], int nodes, int borders,
                        bool by_leaves)
{
  fg__mesh_description description = {.dimension = dimension, .nodes = nodes};
  expect((by_leaves ? setenv("FLOWGRAIN_SHARES", "leaves", 1)
                    : unsetenv("FLOWGRAIN_SHARES")) == 0);
  for (int k = 0; k < dimension; ++k) {
    description.side[k] = side[k];
    description.periodic[k] = (borders >> k & 1) != 0;
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
      {1.0, 1.0, 1.0}, {2.0, 1.0, 0.7}, {0.3, 1.0, 0.31}, {1.0, 1.0, 0.25}};
  static const int NODES[] = {9, 49, 100, 129};
  for (int s = 0; s < 4; ++s)
    for (int n = 0; n < 4; ++n)
      for (int kind = 0; kind < 4; ++kind) {
        fg__mesh mesh = mesh_of(2 + kind / 2, SIDES[s], NODES[n], s + n, kind % 2 == 0);
        holds(&mesh);
        fg__mesh_clear(&mesh);
      }
}

/* Every node in one box: as many as there are, and no two boxes meet. */
static void shares_out_its_nodes(const fg__mesh *mesh)
{
  const fg__partition *p = &mesh->partition;
  long sum = 0;
  for (int n = 0; n < p->count; ++n) {
    const fg__box *box = &p->box[n];
    sum += fg__box_count(box);
    for (int k = 0; k < 3; ++k)
      expect(box->first[k] >= 0 && box->nodes[k] > 0 &&
             box->first[k] + box->nodes[k] <= p->nodes[k]);
    for (int other = 0; other < n; ++other) {
      fg__box common = fg__box_intersection(box, &p->box[other]);
      expect(fg__box_is_empty(&common));
    }
  }
  expect(sum == (long)p->nodes[0] * p->nodes[1] * p->nodes[2]);
}

static void every_node_has_one_box(void **state)
{
  (void)state;
  for_all_meshes(shares_out_its_nodes);
  end_together();
}

static void begins_at_patches(const fg__mesh *mesh)
{
  for (int n = 0; n < mesh->partition.count; ++n)
    for (int k = 0; k < mesh->dimension; ++k)
      expect(mesh->partition.box[n].first[k] % mesh->patch_cells == 0);
  expect(mesh->patch_cells >= 8);
}

/* So three levels at least begin at even nodes. */
static void boxes_begin_at_whole_patches(void **state)
{
  (void)state;
  for_all_meshes(begins_at_patches);
  end_together();
}

static void has_each_cell_in_one_tile(const fg__mesh *mesh)
{
  int count;
  const fg__box *own = fg__own_boxes(&mesh->partition, &count);
  uint64_t cells = 0;
  expect(count == mesh->tile_count);
  for (int n = 0; n < count && n < mesh->tile_count; ++n) {
    const fg__tile *tile = &mesh->tile[n];
    cells +=
        (uint64_t)tile->cells[0] * (uint64_t)tile->cells[1] * (uint64_t)tile->cells[2];
    for (int k = 0; k < 3; ++k)
      expect(tile->first[k] == own[n].first[k] && tile->cells[k] <= own[n].nodes[k] &&
             tile->first[k] + tile->cells[k] <= mesh->cells[k]);
  }
  fg__ranks_add(us.ranks, &cells, 1);
  expect(cells ==
         (uint64_t)mesh->cells[0] * (uint64_t)mesh->cells[1] * (uint64_t)mesh->cells[2]);
}

static void every_cell_has_one_tile(void **state)
{
  (void)state;
  for_all_meshes(has_each_cell_in_one_tile);
  end_together();
}

/* This rank's nodes in units of the mean. */
static double share_of(const fg__mesh *mesh, int most_boxes)
{
  int count;
  const fg__box *own = fg__own_boxes(&mesh->partition, &count);
  double nodes = 0.0;
  for (int b = 0; b < count; ++b)
    nodes += (double)fg__box_count(&own[b]);
  expect(count <= most_boxes);
  double all = (double)mesh->cells[0] * mesh->cells[1] * mesh->cells[2];
  return nodes * us.ranks->count / all;
}

/* Leaves are dealt to 5 %: two or four ranks have one box each, three at most a
 * staircase. Of slabs eight units may go to three ranks: an eighth too many. */
static void shares_are_nearly_even(void **state)
{
  (void)state;
  static const double SQUARE[3] = {1.0, 1.0, 1.0}, LONG[3] = {1.0, 0.5, 0.5};
  const struct {
    int dimension;
    const double *side;
    int nodes;
  } cases[] = {{2, SQUARE, 257}, {2, LONG, 513}, {3, SQUARE, 65}, {3, LONG, 129}};
  for (int n = 0; n < 4; ++n) {
    fg__mesh mesh = mesh_of(cases[n].dimension, cases[n].side, cases[n].nodes, 7, true);
    expect(share_of(&mesh, us.ranks->count == 3 ? 6 : 1) <= 1.05);
    fg__mesh_clear(&mesh);
    mesh = mesh_of(cases[n].dimension, cases[n].side, cases[n].nodes, 7, false);
    expect(share_of(&mesh, 1) <= 1.125);
    fg__slabs slabs;
    expect(fg__slabs_find(&slabs, &mesh.partition) == (us.ranks->count > 1));
    fg__mesh_clear(&mesh);
  }
  end_together();
}

static void a_rank_can_have_a_mesh_of_its_own(void **state)
{
  (void)state;
  const fg__ranks *alone;
  expect(fg__ranks_alone(&alone, us.context) == FG_STATUS_OK);
  fg__mesh_description description = {
      .dimension = 2, .side = {1.0, 0.5}, .nodes = 65, .ranks = alone};
  fg__mesh mesh;
  expect(fg__mesh_create(&mesh, us.context, &description) == FG_STATUS_OK);
  expect(mesh.partition.count == 1 && mesh.tile_count == 1);
  expect(mesh.partition.box[0].nodes[0] == 65 && mesh.partition.box[0].nodes[1] == 33);
  fg__mesh_clear(&mesh);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(every_node_has_one_box),
      TOGETHER(boxes_begin_at_whole_patches),
      TOGETHER(every_cell_has_one_tile),
      TOGETHER(shares_are_nearly_even),
      TOGETHER(a_rank_can_have_a_mesh_of_its_own),
  };
  return cmocka_run_group_tests_name("mesh/mesh on several ranks", tests, NULL, NULL);
}
