#include "mesh/refined_test.h"

static void fill_the_domain(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  uint64_t covered = 0;
  for (int n = 0; n < mesh->leaf_count; ++n) {
    uint64_t volume = 1;
    for (int k = 0; k < mesh->dimension; ++k)
      volume *= (uint64_t)(mesh->leaf[n].side * mesh->patch_cells);
    covered += volume;
  }
  fg__ranks_add(us.ranks, &covered, 1);
  expect(covered ==
         (uint64_t)mesh->cells[0] * (uint64_t)mesh->cells[1] * (uint64_t)mesh->cells[2]);
  /* the scenes are such that there is something to test */
  uint64_t largest = 0;
  for (int n = 0; n < mesh->leaf_count; ++n)
    largest += mesh->leaf[n].side > 1;
  fg__ranks_add(us.ranks, &largest, 1);
  expect(round == 0 ? largest == 0 : largest > 0);
  const fg__partition *last = &mesh->cover[mesh->level_count - 1];
  unsigned char *owners = owners_of(last);
  for (size_t n = 0; n < count_nodes(last); ++n)
    expect(owners[n] == 1);
  free(owners);
}

static void leaves_fill_the_domain(void **state)
{
  (void)state;
  for_all_meshes(fill_the_domain);
  end_together();
}

static void lie_in_own_boxes(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  (void)round;
  for (int n = 0; n < mesh->leaf_count; ++n) {
    const fg__leaf *leaf = &mesh->leaf[n];
    fg__leaf_place place = fg__mesh_place(mesh, leaf);
    int count;
    const fg__box *own = fg__own_boxes(&mesh->level[place.level], &count);
    expect(1 << place.level == leaf->side && place.box < count);
    for (int k = 0; place.box < count && k < mesh->dimension; ++k) {
      expect(place.first[k] >= 0 &&
             place.first[k] + mesh->patch_cells <= own[place.box].nodes[k]);
      expect((own[place.box].first[k] + place.first[k]) << place.level ==
             leaf->first[k] * mesh->patch_cells);
      expect(own[place.box].first[k] % mesh->patch_cells == 0);
    }
  }
}

static void leaves_lie_in_own_boxes(void **state)
{
  (void)state;
  for_all_meshes(lie_in_own_boxes);
  end_together();
}

/* Which cells there are on a level does not depend on the number of ranks. */
static void are_those_of_one_rank(const fg__mesh *mesh, const scene *s, int round)
{
  const fg__ranks *alone;
  expect(fg__ranks_alone(&alone, us.context) == FG_STATUS_OK);
  fg__mesh own = mesh_after(s, round, alone);
  expect(own.level_count == mesh->level_count);
  for (int n = 0; n < mesh->level_count && n < own.level_count; ++n) {
    unsigned char *shared = owners_of(&mesh->cover[n]);
    unsigned char *single = owners_of(&own.cover[n]);
    expect(memcmp(shared, single, count_nodes(&mesh->level[n])) == 0);
    free(shared);
    free(single);
  }
  fg__mesh_clear(&own);
}

static void meshes_do_not_depend_on_the_number_of_ranks(void **state)
{
  (void)state;
  for_all_meshes(are_those_of_one_rank);
  end_together();
}

static void surrounds_the_finer(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  (void)round;
  for (int n = 0; n + 1 < mesh->level_count; ++n) {
    fg__partition half;
    fg__exchange *exchange;
    int uncovered;
    expect(fg__partition_coarsen(&half, us.context, &mesh->level[n]) == FG_STATUS_OK);
    expect(fg__exchange_create_between(&exchange, us.context, &mesh->level[n + 1], &half,
                                       FG__NODES_AND_GHOSTS, 1) == FG_STATUS_OK);
    fg__exchange_uncovered(exchange, &uncovered);
    expect(uncovered == 0);
    fg__exchange_destroy(exchange);
    fg__partition_clear(&half);
  }
}

static void each_level_covers_the_finer_and_a_ring(void **state)
{
  (void)state;
  for_all_meshes(surrounds_the_finer);
  end_together();
}

static void leaves_become_as_fine_as_wanted(void **state)
{
  (void)state;
  for (int n = 0; n < SCENE_COUNT; ++n) {
    const scene *s = &SCENES[n];
    fg__mesh mesh = mesh_after(s, 3, NULL), adapted;
    signed char *wanted = allocate_or_end((size_t)mesh.leaf_count, 1);
    for (int l = 0; l < mesh.leaf_count; ++l)
      wanted[l] = wanted_level(s, &mesh, &mesh.leaf[l], 4);
    expect(fg__mesh_adapt(&adapted, us.context, &mesh, wanted) == FG_STATUS_OK);
    for (int l = 0; l < mesh.leaf_count; ++l) {
      const fg__partition *level = &adapted.level[wanted[l]];
      if (mesh.leaf[l].side < 1 << wanted[l])
        continue; /* coarser, if its sisters agree */
      unsigned char *owners = owners_of(level);
      int first[3] = {0, 0, 0};
      for (int k = 0; k < mesh.dimension; ++k)
        first[k] = (mesh.leaf[l].first[k] >> wanted[l]) * mesh.patch_cells;
      expect(owners[place_of(level, first[0], first[1], first[2])] == 1);
      free(owners);
    }
    free(wanted);
    fg__mesh_clear(&mesh);
    fg__mesh_clear(&adapted);
  }
  end_together();
}

static fg__mesh adapted_to(const fg__mesh *mesh, int level)
{
  signed char *wanted = allocate_or_end((size_t)mesh->leaf_count, 1);
  memset(wanted, level, (size_t)mesh->leaf_count);
  fg__mesh adapted;
  if (fg__mesh_adapt(&adapted, us.context, mesh, wanted) != FG_STATUS_OK)
    abort();
  free(wanted);
  return adapted;
}

static void all_coarse_and_all_fine_are_reached(void **state)
{
  (void)state;
  for (int n = 0; n < SCENE_COUNT; ++n) {
    fg__mesh mesh = mesh_after(&SCENES[n], 2, NULL);
    int last = mesh.level_count - 1;
    for (int round = 0; round < last; ++round) {
      fg__mesh coarser = adapted_to(&mesh, last);
      fg__mesh_clear(&mesh);
      mesh = coarser;
    }
    for (int l = 0; l < mesh.leaf_count; ++l)
      expect(mesh.leaf[l].side == 1 << last);
    for (int level = 0; level < last; ++level)
      expect(mesh.level[level].count == 0);
    fg__mesh fine = adapted_to(&mesh, 0); /* at once */
    for (int l = 0; l < fine.leaf_count; ++l)
      expect(fine.leaf[l].side == 1);
    fg__mesh_clear(&mesh);
    fg__mesh_clear(&fine);
  }
  end_together();
}

/* Once where the cell at the upper corner is covered, else perhaps more often. */
static void owns_the_nodes_of_its_cells(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  (void)round;
  for (int n = 0; n < mesh->level_count; ++n) {
    const fg__partition *level = &mesh->level[n];
    unsigned char *owners = owners_of(level), *cover = owners_of(&mesh->cover[n]);
    for (int k = 0; k < level->nodes[2]; ++k)
      for (int j = 0; j < level->nodes[1]; ++j)
        for (int i = 0; i < level->nodes[0]; ++i) {
          int times = owners[place_of(level, i, j, k)];
          bool here = is_of_level(level, cover, (int[3]){i, j, k});
          expect((times > 0) == here);
          expect(times <= 1 || cover[place_of(level, i, j, k)] == 0);
        }
    expect(fg__partition_is_workable(level, 1));
    free(owners);
    free(cover);
  }
}

static void nodes_of_a_level_s_cells_have_owners(void **state)
{
  (void)state;
  for_all_meshes(owns_the_nodes_of_its_cells);
  end_together();
}

static void knows_its_cells(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  (void)round;
  for (int n = 0; n < mesh->level_count; ++n) {
    const fg__partition *level = &mesh->level[n];
    unsigned char *owners = owners_of(&mesh->cover[n]);
    unsigned char *finer = n > 0 ? owners_of(&mesh->cover[n - 1]) : NULL;
    for (int b = 0; b < level->count; ++b) {
      const fg__box *box = &level->box[b];
      int size[3] = {1, 1, 1}, first[3] = {0};
      for (int k = 0; k < 3; ++k) {
        size[k] = k < mesh->dimension ? box->nodes[k] + 1 : 1;
        first[k] = box->first[k] - (k < mesh->dimension);
      }
      size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
      unsigned char *kind = allocate_or_end(count, 1);
      fg__cell_kinds(kind, mesh, n, box);
      for (size_t c = 0; c < count; ++c) {
        int x = (int)(c % (size_t)size[0]), y = (int)(c / (size_t)size[0]) % size[1];
        int z = (int)(c / (size_t)size[0]) / size[1];
        int cell[3] = {first[0] + x, first[1] + y, first[2] + z}, fine[3] = {0};
        for (int k = 0; k < 3; ++k)
          fine[k] = k < mesh->dimension ? 2 * cell_image(level, k, cell[k]) : 0;
        bool refined = finer && has_cell(&mesh->cover[n - 1], finer, fine);
        fg__cell_kind expected = !has_cell(level, owners, cell) ? FG__CELL_OUTSIDE
                                 : refined                      ? FG__CELL_REFINED
                                                                : FG__CELL_LEAF;
        expect(kind[c] == expected);
      }
      free(kind);
    }
    free(owners);
    free(finer);
  }
}

static void cells_are_outside_or_leaves_or_refined(void **state)
{
  (void)state;
  for_all_meshes(knows_its_cells);
  end_together();
}

static void impossible_patches_are_refused(void **state)
{
  (void)state;
  static const int CASES[][2] = {{3, 1}, {2, 1}, {-4, 1}, {8, -1}, {8, 13}, {4096, 5}};
  for (int n = 0; n < 6; ++n) {
    fg__mesh_description description = {.dimension = 2,
                                        .side = {1.0, 1.0},
                                        .nodes = 65,
                                        .patch_cells = CASES[n][0],
                                        .refinements = CASES[n][1]};
    fg__mesh mesh;
    expect(fg__mesh_create(&mesh, us.context, &description) == FG_STATUS_ARGUMENT);
    fg_context_clear(us.context);
  }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(leaves_fill_the_domain),
      TOGETHER(leaves_lie_in_own_boxes),
      TOGETHER(meshes_do_not_depend_on_the_number_of_ranks),
      TOGETHER(each_level_covers_the_finer_and_a_ring),
      TOGETHER(leaves_become_as_fine_as_wanted),
      TOGETHER(all_coarse_and_all_fine_are_reached),
      TOGETHER(nodes_of_a_level_s_cells_have_owners),
      TOGETHER(cells_are_outside_or_leaves_or_refined),
      TOGETHER(impossible_patches_are_refused),
  };
  return cmocka_run_group_tests_name("mesh/refinement", tests, NULL, NULL);
}
