/* Any team finds what is found in the whole grid at once. */
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "component/team_clusters.h"

enum { MOST_TEAM = 7, TRIALS = 60 };

typedef struct world {
  fg__layout layout;
  bool periodic[3];
  float *plain, *array; /* the same values; NULL before */
  unsigned char *active;
} world;

static size_t product(const int count[3])
{
  return (size_t)count[0] * (size_t)count[1] * (size_t)count[2];
}

/* Speckles of which a third to three quarters are positive: pieces meet at every border
 * of a slab. */
static world make_world(int dimension)
{
  int nodes[3] = {5 + rand() % 14, 9 + rand() % 25, 1}, cells[3] = {1, 1, 1};
  if (dimension == 3)
    nodes[2] = 5 + rand() % 20;
  world w = {.layout = fg__layout_of(dimension, nodes)};
  for (int k = 0; k < dimension; ++k) {
    w.periodic[k] = rand() % 2 == 0;
    cells[k] = nodes[k] - !w.periodic[k];
  }
  float *memory = calloc(w.layout.array_size, sizeof *memory);
  w.plain = malloc(product(nodes) * sizeof *w.plain);
  w.active = rand() % 3 == 0 ? malloc(product(cells)) : NULL;
  if (!memory || !w.plain)
    abort();
  w.array = memory + w.layout.first;
  size_t n = 0;
  const int negative = 1250 - 375 * (rand() % 3);
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i, ++n)
        w.array[fg__node_at(&w.layout, i, j, k)] = w.plain[n] =
            (float)(rand() % 2000 - negative) / 1000.0F;
  for (n = 0; n < product(cells) && w.active; ++n)
    w.active[n] = rand() % 10 >= 2;
  return w;
}

static void clear_world(world *w)
{
  free(w->array - w->layout.first);
  free(w->plain);
  free(w->active);
}

/* In 2D without a mask large areas may be known by a lower bound alone; returns how many
 * were. */
static int compare_areas(const world *w, const fg__components *found,
                         const fg__components *whole, double debris_area)
{
  bool bounds = debris_area > 0.0 && w->layout.dimension == 2 && !w->active;
  int bounded = 0;
  for (int n = 0; n < whole->count; ++n) {
    bool same = memcmp(&found->area[n], &whole->area[n], sizeof *whole->area) == 0;
    assert_true(same || bounds);
    assert_true(found->area[n] >= debris_area);
    assert_true(found->area[n] <= whole->area[n] * (1.0 + 1e-6));
    bounded += !same;
  }
  return bounded;
}

static int compare(const world *w, fg__team *team, double debris_area)
{
  fg__component_grid grid = {
      .u = w->plain, .active = w->active, .debris_area = debris_area};
  for (int k = 0; k < 3; ++k) {
    grid.nodes[k] = w->layout.nodes[k];
    grid.periodic[k] = w->periodic[k];
  }
  fg__components whole = {0};
  fg__team_clusters found = {0};
  assert_int_equal(fg__components_count(&whole, NULL, &grid), FG_STATUS_OK);
  for (int counting = 0; counting < 2; ++counting) {
    assert_int_equal(fg__team_clusters_find(&found, NULL, team, &w->layout, w->periodic,
                                            w->array, w->active, debris_area,
                                            counting == 1),
                     FG_STATUS_OK);
    assert_memory_equal(&found.covered, &whole.covered, sizeof whole.covered);
  }
  assert_int_equal(found.whole.count, whole.count);
  assert_int_equal(found.whole.debris, whole.debris);
  int bounded = compare_areas(w, &found.whole, &whole, debris_area);
  fg__team_clusters_clear(&found);
  fg__components_clear(&whole);
  return bounded;
}

static void any_team_finds_the_same(void **state)
{
  (void)state;
  srand(11);
  int bounded = 0;
  for (int members = 1; members <= MOST_TEAM; members += 2) {
    fg__team *team;
    assert_int_equal(fg__team_create(&team, NULL, members), FG_STATUS_OK);
    for (int trial = 0; trial < TRIALS; ++trial) {
      world w = make_world(2 + trial % 2);
      bounded += compare(&w, team, trial % 4 == 0 ? 0.0 : 1.5);
      clear_world(&w);
    }
    fg__team_destroy(team);
  }
  assert_int_not_equal(bounded, 0);
}

/* The same memory serves density after density. */
static void memory_is_used_again(void **state)
{
  (void)state;
  srand(12);
  fg__team *team;
  assert_int_equal(fg__team_create(&team, NULL, 3), FG_STATUS_OK);
  world w = make_world(3);
  fg__team_clusters found = {0};
  int first = 0, again = 0;
  float *values = w.array - w.layout.first;
  for (int time = 0; time < 3; ++time) {
    assert_int_equal(fg__team_clusters_find(&found, NULL, team, &w.layout, w.periodic,
                                            w.array, NULL, 0.0, true),
                     FG_STATUS_OK);
    if (time == 0)
      first = found.whole.count;
    again = found.whole.count;
    for (size_t n = 0; n < w.layout.array_size; ++n)
      values[n] = -values[n];
  }
  assert_int_not_equal(first, 0);
  assert_int_equal(again, first);
  fg__team_clusters_clear(&found);
  clear_world(&w);
  fg__team_destroy(team);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_team_finds_the_same),
      cmocka_unit_test(memory_is_used_again),
  };
  return cmocka_run_group_tests_name("component/team_clusters", tests, NULL, NULL);
}
