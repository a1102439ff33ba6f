#include "mesh/refinement.h"

#include <math.h>
#include <string.h>

#include "mesh/carry.h"
#include "mesh/together_test.h"

typedef struct scene {
  fg__mesh_description description;
  double center[3]; /* of the sphere that is resolved, in cells of the finest level */
} scene;

static const scene SCENES[] = {
    {{.dimension = 2,
      .side = {1.0, 1.0},
      .nodes = 65,
      .patch_cells = 4,
      .refinements = 3},
     {20.0, 50.0, 0.0}},
    {{.dimension = 2,
      .side = {2.0, 1.0},
      .periodic = {true, false},
      .nodes = 120,
      .patch_cells = 8,
      .refinements = 2},
     {5.0, 30.0, 0.0}},
    {{.dimension = 3,
      .side = {1.0, 1.0, 1.0},
      .periodic = {false, true, false},
      .nodes = 33,
      .patch_cells = 4,
      .refinements = 2},
     {32.0, 3.0, 10.0}},
};
enum { SCENE_COUNT = sizeof SCENES / sizeof *SCENES, ROUNDS = 3 };

/* Fine where a sphere, growing round by round, passes through a leaf or near it. */
static signed char wanted_level(const scene *s, const fg__mesh *mesh,
                                const fg__leaf *leaf, int round)
{
  double square = 0.0, side = leaf->side * mesh->patch_cells;
  for (int k = 0; k < mesh->dimension; ++k) {
    double d = fabs(leaf->first[k] * mesh->patch_cells + 0.5 * side - s->center[k]);
    if (mesh->periodic[k])
      d = fmin(d, mesh->cells[k] - d);
    square += d * d;
  }
  double from_sphere = fabs(sqrt(square) - (4.0 + 8.0 * round));
  double level = (from_sphere - side) / 4.0;
  return (signed char)(level < 0.0                     ? 0
                       : level > mesh->level_count - 1 ? mesh->level_count - 1
                                                       : (int)level);
}

/* The mesh after some rounds, of all ranks or of this one alone. */
static fg__mesh mesh_after(const scene *s, int rounds, const fg__ranks *ranks)
{
  fg__mesh mesh;
  fg__mesh_description description = s->description;
  description.ranks = ranks;
  if (fg__mesh_create(&mesh, us.context, &description) != FG_STATUS_OK)
    abort();
  for (int round = 0; round < rounds; ++round) {
    signed char *wanted = allocate_or_end((size_t)mesh.leaf_count, 1);
    for (int n = 0; n < mesh.leaf_count; ++n)
      wanted[n] = wanted_level(s, &mesh, &mesh.leaf[n], round);
    fg__mesh adapted;
    if (fg__mesh_adapt(&adapted, us.context, &mesh, wanted) != FG_STATUS_OK)
      abort();
    free(wanted);
    fg__mesh_clear(&mesh);
    mesh = adapted;
  }
  return mesh;
}

static size_t count_nodes(const fg__partition *level)
{
  return (size_t)level->nodes[0] * (size_t)level->nodes[1] * (size_t)level->nodes[2];
}

static size_t place_of(const fg__partition *level, int i, int j, int k)
{
  return ((size_t)k * (size_t)level->nodes[1] + (size_t)j) * (size_t)level->nodes[0] +
         (size_t)i;
}

/* How many boxes own each node of a level. */
static unsigned char *owners_of(const fg__partition *level)
{
  unsigned char *owners = allocate_or_end(count_nodes(level), 1);
  for (int n = 0; n < level->count; ++n) {
    const fg__box *b = &level->box[n];
    for (int k = b->first[2]; k < b->first[2] + b->nodes[2]; ++k)
      for (int j = b->first[1]; j < b->first[1] + b->nodes[1]; ++j)
        for (int i = b->first[0]; i < b->first[0] + b->nodes[0]; ++i)
          ++owners[place_of(level, i, j, k)];
  }
  return owners;
}

typedef void check(const fg__mesh *mesh, const scene *s, int round);

static void for_all_meshes(check *holds)
{
  for (int n = 0; n < SCENE_COUNT; ++n)
    for (int round = 0; round <= ROUNDS; ++round) {
      fg__mesh mesh = mesh_after(&SCENES[n], round, NULL);
      holds(&mesh, &SCENES[n], round);
      fg__mesh_clear(&mesh);
    }
}

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

/* The index of the cell that cell `index` is or mirrors. */
static int cell_image(const fg__partition *level, int k, int index)
{
  int cells = level->cells[k];
  if (level->periodic[k])
    return (index + cells) % cells;
  return index < 0 ? -1 - index : index >= cells ? 2 * cells - 1 - index : index;
}

/* owners: of the lower corners of cells, mesh->cover. */
static bool has_cell(const fg__partition *level, const unsigned char *owners,
                     const int cell[3])
{
  int image[3];
  for (int k = 0; k < 3; ++k)
    image[k] = k < level->dimension ? cell_image(level, k, cell[k]) : 0;
  return owners[place_of(level, image[0], image[1], image[2])] > 0;
}

static bool is_on_border(const fg__partition *level, const unsigned char *owners,
                         const int node[3])
{
  for (int corner = 0; corner < 1 << level->dimension; ++corner) {
    int cell[3] = {node[0], node[1], node[2]};
    for (int k = 0; k < 3; ++k)
      cell[k] -= corner >> k & 1; /* in 2D corner has no bit 2 */
    if (!has_cell(level, owners, cell))
      return true;
  }
  return false;
}

/* Whether a node of the grid has a cell of the level beside it. */
static bool is_of_level(const fg__partition *level, const unsigned char *cover,
                        const int node[3])
{
  for (int corner = 0; corner < 1 << level->dimension; ++corner) {
    int cell[3] = {node[0], node[1], node[2]};
    for (int k = 0; k < 3; ++k)
      cell[k] -= corner >> k & 1;
    if (has_cell(level, cover, cell))
      return true;
  }
  return false;
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

/* Whole numbers, so that means of eight are exact. */
static float coarse_at(const fg__partition *level, int array, const int node[3])
{
  (void)level;
  int index = 0;
  for (int k = 0; k < 3; ++k)
    index = 37 * index + node[k];
  return (float)((index * 7919 + 101 * array) % 4093);
}

typedef struct values {
  float **node[2]; /* [array][own box] */
  float *const *array[2];
  fg__layout *layout;
  int boxes;
} values;

static values values_of(const fg__partition *level)
{
  values out;
  const fg__box *own = fg__own_boxes(level, &out.boxes);
  out.layout = allocate_or_end((size_t)out.boxes, sizeof *out.layout);
  for (int a = 0; a < 2; ++a) {
    out.array[a] = out.node[a] = allocate_or_end((size_t)out.boxes, sizeof(float *));
    for (int b = 0; b < out.boxes; ++b) {
      out.layout[b] = fg__layout_of(level->dimension, own[b].nodes);
      float *memory = allocate_or_end(out.layout[b].array_size, sizeof *memory);
      out.node[a][b] = memory + out.layout[b].first;
    }
  }
  return out;
}

static void values_clear(values *v)
{
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < v->boxes; ++b)
      free(v->node[a][b] - v->layout[b].first);
    free(v->node[a]);
  }
  free(v->layout);
}

typedef float value_of(const fg__partition *level, int array, const int node[3]);

static float nothing_at(const fg__partition *level, int array, const int node[3])
{
  (void)level;
  (void)node;
  return -1.0F - (float)array;
}

static void set_values(values *v, const fg__partition *level, value_of *value)
{
  int count;
  const fg__box *own = fg__own_boxes(level, &count);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < v->boxes; ++b)
      for (int k = 0; k < own[b].nodes[2]; ++k)
        for (int j = 0; j < own[b].nodes[1]; ++j)
          for (int i = 0; i < own[b].nodes[0]; ++i)
            v->node[a][b][fg__node_at(&v->layout[b], i, j, k)] = value(
                level, a,
                (int[3]){own[b].first[0] + i, own[b].first[1] + j, own[b].first[2] + k});
}

/* The mean of the coarse nodes round a node. */
static float mean_at(const fg__partition *coarser, int array, const int node[3])
{
  float sum = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    int coarse[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      if (k < coarser->dimension)
        coarse[k] = (node[k] + (corner >> k & 1)) / 2;
      if (coarser->periodic[k])
        coarse[k] %= coarser->nodes[k];
    }
    sum += coarse_at(coarser, array, coarse);
  }
  return 0.125F * sum;
}

/* Border nodes of the colours have the mean of what lies round them on the coarser level,
 * all others what they had. */
static void check_values(const values *v, const fg__mesh *mesh, int n,
                         const unsigned char *cover, unsigned colours)
{
  int count;
  const fg__partition *level = &mesh->level[n];
  const fg__box *own = fg__own_boxes(level, &count);
  for (int b = 0; b < v->boxes; ++b)
    for (int k = 0; k < own[b].nodes[2]; ++k)
      for (int j = 0; j < own[b].nodes[1]; ++j)
        for (int i = 0; i < own[b].nodes[0]; ++i) {
          int node[3] = {own[b].first[0] + i, own[b].first[1] + j, own[b].first[2] + k};
          int colour = (node[0] & 1) + 2 * (node[1] & 1) + 4 * (node[2] & 1);
          bool set = is_on_border(level, cover, node) && (colours >> colour & 1U);
          for (int a = 0; a < 2; ++a)
            expect(v->node[a][b][fg__node_at(&v->layout[b], i, j, k)] ==
                   (set ? mean_at(&mesh->level[n + 1], a, node)
                        : nothing_at(level, a, node)));
        }
}

static void check_border(const fg__mesh *mesh, int n)
{
  const fg__partition *level = &mesh->level[n];
  fg__partition half;
  fg__exchange *exchange;
  fg__border *border;
  expect(fg__border_create(&border, us.context, mesh, n, 2) == FG_STATUS_OK);
  expect(fg__partition_coarsen(&half, us.context, level) == FG_STATUS_OK);
  expect(fg__exchange_create_between(&exchange, us.context, &mesh->level[n + 1], &half,
                                     FG__NODES_AND_GHOSTS, 2) == FG_STATUS_OK);
  values coarse = values_of(&mesh->level[n + 1]), halves = values_of(&half);
  values fine = values_of(level);
  unsigned char *cover = owners_of(&mesh->cover[n]);
  set_values(&coarse, &mesh->level[n + 1], coarse_at);
  fg__exchange_fill_between(exchange, 2, coarse.array, halves.array, FG__ALL_COLOURS);
  set_values(&fine, level, nothing_at);
  fg__border_interpolate(border, 2, halves.array, fine.array);
  check_values(&fine, mesh, n, cover, FG__ALL_COLOURS);
  static const unsigned COLOURS[] = {1U << 0, 1U << 1, 1U << 7, FG__ODD_ROWS, 0x5a};
  for (int c = 0; c < 5; ++c) {
    set_values(&fine, level, nothing_at);
    fg__border_restore(border, 2, fine.array, COLOURS[c]);
    check_values(&fine, mesh, n, cover, COLOURS[c]);
  }
  uint64_t nodes = (uint64_t)fg__border_count(border);
  fg__ranks_add(us.ranks, &nodes, 1);
  bool any = false;
  for (int k = 0; k < level->nodes[2]; ++k)
    for (int j = 0; j < level->nodes[1]; ++j)
      for (int i = 0; i < level->nodes[0]; ++i) {
        int node[3] = {i, j, k};
        any =
            any || (is_of_level(level, cover, node) && is_on_border(level, cover, node));
      }
  expect((nodes > 0) == any);
  free(cover);
  values_clear(&coarse);
  values_clear(&halves);
  values_clear(&fine);
  fg__exchange_destroy(exchange);
  fg__border_destroy(border);
  fg__partition_clear(&half);
}

static void interpolates_its_border(const fg__mesh *mesh, const scene *s, int round)
{
  (void)s;
  (void)round;
  for (int n = 0; n + 1 < mesh->level_count; ++n)
    check_border(mesh, n);
}

static void borders_are_interpolated_and_restored(void **state)
{
  (void)state;
  for_all_meshes(interpolates_its_border);
  end_together();
}

/* What carrying should give a node: what the old level has there, else the mean round it
 * on the coarser level. */
static float carried_at(const fg__mesh *from, unsigned char *const cover[], int n,
                        int array, const int node[3])
{
  const fg__partition *level = &from->level[n];
  if (is_of_level(level, cover[n], node))
    return coarse_at(level, array, node);
  float sum = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    int coarse[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      if (k < level->dimension)
        coarse[k] = (node[k] + (corner >> k & 1)) / 2;
      if (level->periodic[k])
        coarse[k] %= level->nodes[k] / 2;
    }
    sum += carried_at(from, cover, n + 1, array, coarse);
  }
  return 0.125F * sum;
}

static void check_carried(const values *v, const fg__mesh *from, const fg__mesh *to,
                          unsigned char *const cover[], int n)
{
  int count;
  const fg__box *own = fg__own_boxes(&to->level[n], &count);
  for (int b = 0; b < v->boxes; ++b)
    for (int k = 0; k < own[b].nodes[2]; ++k)
      for (int j = 0; j < own[b].nodes[1]; ++j)
        for (int i = 0; i < own[b].nodes[0]; ++i)
          for (int a = 0; a < 2; ++a) {
            int node[3] = {own[b].first[0] + i, own[b].first[1] + j, own[b].first[2] + k};
            expect(v->node[a][b][fg__node_at(&v->layout[b], i, j, k)] ==
                   carried_at(from, cover, n, a, node));
          }
}

static void check_carrying(const fg__mesh *from, const fg__mesh *to)
{
  enum { MOST = FG__MOST_REFINEMENTS + 1 };
  values old[MOST], carried[MOST];
  float *const *const *source[MOST];
  float *const *const *target[MOST];
  unsigned char *cover[MOST];
  for (int n = 0; n < from->level_count; ++n) {
    old[n] = values_of(&from->level[n]);
    carried[n] = values_of(&to->level[n]);
    cover[n] = owners_of(&from->cover[n]);
    set_values(&old[n], &from->level[n], coarse_at);
    source[n] = old[n].array;
    target[n] = carried[n].array;
  }
  expect(fg__mesh_carry(us.context, from, to, 2, source, target) == FG_STATUS_OK);
  for (int n = 0; n < from->level_count; ++n)
    check_carried(&carried[n], from, to, cover, n);
  for (int n = 0; n < from->level_count; ++n) {
    values_clear(&old[n]);
    values_clear(&carried[n]);
    free(cover[n]);
  }
}

/* Forwards and back again: refinement here, coarsening there. */
static void values_are_carried_to_another_mesh(void **state)
{
  (void)state;
  for (int n = 0; n < SCENE_COUNT; ++n)
    for (int round = 0; round < ROUNDS; ++round) {
      fg__mesh one = mesh_after(&SCENES[n], round, NULL);
      fg__mesh two = mesh_after(&SCENES[n], round + 1, NULL);
      check_carrying(&one, &two);
      check_carrying(&two, &one);
      fg__mesh_clear(&one);
      fg__mesh_clear(&two);
    }
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
      TOGETHER(borders_are_interpolated_and_restored),
      TOGETHER(values_are_carried_to_another_mesh),
      TOGETHER(cells_are_outside_or_leaves_or_refined),
      TOGETHER(impossible_patches_are_refused),
  };
  return cmocka_run_group_tests_name("mesh/refinement", tests, NULL, NULL);
}
