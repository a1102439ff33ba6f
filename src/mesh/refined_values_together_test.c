/* What nodes of refined meshes hold: on borders, and after they are carried. */
#include "mesh/carry.h"
#include "mesh/refined_test.h"

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
 * on the coarser level; the last has all nodes. */
static float carried_at(const fg__mesh *from, unsigned char *const cover[], int n,
                        int array, const int node[3])
{
  const fg__partition *level = &from->level[n];
  if (n == from->level_count - 1 || is_of_level(level, cover[n], node))
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
  const int levels = from->level_count;
  values old[MOST], carried[MOST];
  float *const *const *source[MOST] = {NULL};
  float *const *const *target[MOST] = {NULL};
  unsigned char *cover[MOST];
  for (int n = 0; n < levels; ++n) {
    old[n] = values_of(&from->level[n]);
    carried[n] = values_of(&to->level[n]);
    cover[n] = owners_of(&from->cover[n]);
    set_values(&old[n], &from->level[n], coarse_at);
    source[n] = old[n].array;
    target[n] = carried[n].array;
  }
  expect(fg__mesh_carry(us.context, from, to, 2, source, target) == FG_STATUS_OK);
  for (int n = 0; n < levels; ++n)
    check_carried(&carried[n], from, to, cover, n);
  for (int n = 0; n < levels; ++n) {
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

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(borders_are_interpolated_and_restored),
      TOGETHER(values_are_carried_to_another_mesh),
  };
  return cmocka_run_group_tests_name("mesh/refined_values", tests, NULL, NULL);
}
