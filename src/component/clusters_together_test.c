/* Any blocks of ranks and any threads find what is found in the plain grid at once. */
#include <string.h>

#include "component/clusters.h"
#include "grid/grids_test.h"

enum { TRIALS = 8, FEWER_TRIALS = 4, MOST_THREADS = 5 };

/* A grid that every rank has, and this rank's block of it. */
typedef struct world {
  const grid *g;
  fg__component_grid plain;
  float *u;
  unsigned char *active; /* NULL: no mask */
  fg__partition partition;
  fg__layout layout;
  float *array; /* node (0, 0, 0) of the block */
  unsigned char *ringed;
  fg__cluster_grid block;
} world;

static size_t product(const int count[3])
{
  return (size_t)count[0] * (size_t)count[1] * (size_t)count[2];
}

static int cells_along(const grid *g, int k)
{
  return k >= g->dimension ? 1 : g->cells[k];
}

/* Speckles of which a third to three quarters are positive: pieces meet at the sides of
 * every block and slab. */
static void make_plain(world *w, uint64_t *seed)
{
  int cells[3];
  w->plain = (fg__component_grid){0};
  for (int k = 0; k < 3; ++k) {
    w->plain.nodes[k] = nodes_along(w->g, k);
    w->plain.periodic[k] = w->g->periodic[k];
    cells[k] = cells_along(w->g, k);
  }
  size_t nodes = product(w->plain.nodes);
  w->u = allocate_or_end(nodes, sizeof *w->u);
  const int negative = 1250 - 375 * (int)random_below(seed, 3);
  for (size_t n = 0; n < nodes; ++n)
    w->u[n] = (float)((int)random_below(seed, 2000) - negative) / 1000.0F;
  w->active = random_below(seed, 2) ? allocate_or_end(product(cells), 1) : NULL;
  for (size_t n = 0; n < product(cells) && w->active; ++n)
    w->active[n] = random_below(seed, 10) >= 2;
  w->plain.u = w->u;
  w->plain.active = w->active;
}

/* A cell that may lie one beyond a side: its value in a periodic grid, else 0. */
static unsigned char cell_at(const world *w, int i, int j, int k)
{
  int at[3] = {i, j, k};
  size_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    int cells = cells_along(w->g, axis);
    if (w->g->periodic[axis])
      at[axis] = (at[axis] + cells) % cells;
    if (at[axis] < 0 || at[axis] >= cells)
      return 0;
    index = index * (size_t)cells + (size_t)at[axis];
  }
  return w->active[index];
}

static void make_block(world *w, uint64_t seed)
{
  w->partition = divide_at_random(w->g, seed, 1);
  const fg__box *own = fg__own_block(&w->partition);
  const int *all = w->plain.nodes;
  int solid = w->g->dimension == 3;
  w->layout = fg__layout_of(w->g->dimension, own->nodes);
  w->array =
      (float *)allocate_or_end(w->layout.array_size, sizeof(float)) + w->layout.first;
  w->block = (fg__cluster_grid){
      .partition = &w->partition, .layout = &w->layout, .cell_row = own->nodes[0] + 2};
  w->block.cell_plane = w->block.cell_row * (own->nodes[1] + 2);
  ptrdiff_t origin = 1 + w->block.cell_row + solid * w->block.cell_plane;
  if (w->active)
    w->ringed = allocate_or_end((size_t)(w->block.cell_plane * (own->nodes[2] + 2)), 1);
  for (int k = -solid; k < own->nodes[2] + solid; ++k)
    for (int j = -1; j <= own->nodes[1]; ++j)
      for (int i = -1; i <= own->nodes[0]; ++i) {
        const int of[3] = {own->first[0] + i, own->first[1] + j, own->first[2] + k};
        size_t node = 0;
        for (int axis = 2; axis >= 0; --axis)
          node = node * (size_t)all[axis] + (size_t)image_along(w->g, axis, of[axis]);
        w->array[fg__node_at(&w->layout, i, j, k)] = w->u[node];
        if (w->ringed)
          w->ringed[origin + i + j * w->block.cell_row + k * w->block.cell_plane] =
              cell_at(w, of[0], of[1], of[2]);
      }
  w->block.active = w->ringed ? w->ringed + origin : NULL;
}

static void clear_world(world *w)
{
  free(w->u);
  free(w->active);
  free(w->array - w->layout.first);
  free(w->ringed);
  fg__partition_clear(&w->partition);
  *w = (world){0};
}

static void compare_labels(const world *w, const fg__clusters *found,
                           const fg__components *want)
{
  const fg__box *own = fg__own_block(&w->partition);
  const int *all = w->plain.nodes;
  int *label = allocate_or_end((size_t)fg__box_count(own), sizeof *label), *at = label;
  fg__clusters_label(found, label);
  int differ = 0;
  for (int k = 0; k < own->nodes[2]; ++k)
    for (int j = 0; j < own->nodes[1]; ++j)
      for (int i = 0; i < own->nodes[0]; ++i)
        differ += *at++ != want->label[((size_t)(own->first[2] + k) * (size_t)all[1] +
                                        (size_t)(own->first[1] + j)) *
                                           (size_t)all[0] +
                                       (size_t)(own->first[0] + i)];
  expect(differ == 0);
  free(label);
}

/* In 2D without a mask large areas may be known by a lower bound alone; returns how many
 * were. */
static int compare_areas(const world *w, const fg__components *found,
                         const fg__components *want, const fg__cluster_request *request)
{
  bool bounds = request->exact_below > 0.0 && w->g->dimension == 2 && !w->active;
  int bounded = 0;
  for (int n = 0; n < want->count && found->count == want->count; ++n) {
    bool same = memcmp(&found->area[n], &want->area[n], sizeof *want->area) == 0;
    expect(same || bounds);
    expect(found->area[n] >= request->debris_area);
    expect(found->area[n] <= want->area[n] * (1.0 + 1e-6));
    bounded += !same;
  }
  return bounded;
}

static int compare(world *w, double debris_area)
{
  fg__components want = {0};
  w->plain.debris_area = debris_area;
  expect(fg__components_find(&want, us.context, &w->plain) == FG_STATUS_OK);
  fg__cluster_request request = {.debris_area = debris_area};
  fg__clusters found = {0};
  int bounded = 0;
  for (int way = 0; way < 3; ++way) { /* covered alone, bounds of areas, areas */
    request.counting = way > 0;
    request.exact_below = way == 1 ? debris_area : 0.0;
    expect(fg__clusters_find(&found, us.context, &w->block, w->array, &request) ==
           FG_STATUS_OK);
    expect(memcmp(&found.covered, &want.covered, sizeof want.covered) == 0);
    if (way == 0)
      continue;
    expect(found.found.count == want.count && found.found.debris == want.debris);
    bounded += compare_areas(w, &found.found, &want, &request);
    compare_labels(w, &found, &want);
  }
  fg__clusters_clear(&found);
  fg__components_clear(&want);
  return bounded;
}

static void any_blocks_and_threads_find_the_same(void **state)
{
  (void)state;
  uint64_t seed = 11;
  int bounded = 0;
  for (int thread_count = 1; thread_count <= MOST_THREADS; thread_count += 2) {
    fg__threads *threads;
    expect(fg__threads_create(&threads, us.context, thread_count) == FG_STATUS_OK);
    const int trials = thread_count == 1 ? TRIALS : FEWER_TRIALS;
    for (int trial = 0; trial < trials * GRID_COUNT; ++trial) {
      world w = {.g = &GRIDS[trial % GRID_COUNT]};
      make_plain(&w, &seed);
      make_block(&w, seed);
      w.block.threads = threads;
      bounded += compare(&w, trial / GRID_COUNT % 4 == 0 ? 0.0 : 1.5);
      clear_world(&w);
    }
    fg__threads_destroy(threads);
  }
  expect(bounded > 0);
  end_together();
}

/* The same memory serves density after density. */
static void memory_is_used_again(void **state)
{
  (void)state;
  uint64_t seed = 12;
  world w = {.g = &GRIDS[GRID_COUNT - 1]};
  make_plain(&w, &seed);
  free(w.active);
  w.active = NULL;
  make_block(&w, seed);
  expect(fg__threads_create(&w.block.threads, us.context, 3) == FG_STATUS_OK);
  const fg__cluster_request request = {.counting = true};
  fg__clusters found = {0};
  int count[3] = {0};
  for (int time = 0; time < 3; ++time) {
    expect(fg__clusters_find(&found, us.context, &w.block, w.array, &request) ==
           FG_STATUS_OK);
    count[time] = found.found.count;
    for (size_t n = 0; n < w.layout.array_size; ++n)
      (w.array - w.layout.first)[n] *= -1.0F;
  }
  expect(count[0] > 0 && count[1] != count[0] && count[2] == count[0]);
  fg__clusters_clear(&found);
  fg__threads_destroy(w.block.threads);
  clear_world(&w);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(any_blocks_and_threads_find_the_same),
      TOGETHER(memory_is_used_again),
  };
  return cmocka_run_group_tests_name("component/clusters", tests, NULL, NULL);
}
