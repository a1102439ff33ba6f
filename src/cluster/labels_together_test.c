#include "cluster/patches.h"
#include "cluster/window.h"

#include <string.h>

#include "cluster/divided_density_test.h"
#include "cluster/unwrap.h"

typedef struct tally {
  int clusters, unwrapped, closed;
} tally;

/* First and last node of a cluster along each axis on the plain grid, and its first node.
 */
static void bounds_of(const fg__density_block *block, int cluster, int bounds[6],
                      int *first)
{
  const int *nodes = block->partition.nodes;
  *first = -1;
  for (int n = 0; n < nodes[0] * nodes[1]; ++n) {
    const int place[3] = {n % nodes[0], n / nodes[0], 0};
    if (block->label[n] != cluster)
      continue;
    for (int k = 0; k < 3; ++k) {
      if (*first < 0 || place[k] < bounds[2 * k])
        bounds[2 * k] = place[k];
      if (*first < 0 || place[k] > bounds[2 * k + 1])
        bounds[2 * k + 1] = place[k];
    }
    *first = *first < 0 ? n : *first;
  }
}

/* Compares with bounds that are found by following each cluster over the plain grid. */
static void compare_labels(const fg__labels *got, const subject *s, const shape *about,
                           tally *sum)
{
  const fg_density_arrays *arrays = fg_density_contents(s->whole);
  const fg__density_block *block = fg__density_block_of(s->whole);
  const fg__component_grid grid = {
      .nodes = {arrays->nodes[0], arrays->nodes[1], 1},
      .periodic = {arrays->periodic[0], arrays->periodic[1], false},
      .u = arrays->u,
      .active = arrays->active};
  fg__unwrap unwrap;
  expect(fg__unwrap_create(&unwrap, us.context, &grid, block->label) == FG_STATUS_OK);
  expect(got->count == block->count && got->debris == block->debris);
  for (int n = 0; n < block->count && got->count == block->count; ++n) {
    int bounds[6], first;
    bool closed[3] = {false, false, false}, both = false;
    bounds_of(block, n + 1, bounds, &first);
    for (int k = 0; k < 2; ++k)
      both = both || (grid.periodic[k] && bounds[2 * k] == 0 &&
                      bounds[2 * k + 1] == grid.nodes[k] - 1);
    if (both)
      fg__unwrap_bounds(&unwrap, first, bounds, closed);
    bool same = memcmp(got->bounds[n], bounds, sizeof bounds) == 0 &&
                memcmp(got->closed[n], closed, sizeof closed) == 0;
    expect(got->area[n] == block->area[n] * (arrays->spacing[0] * arrays->spacing[1]));
    expect(same);
    if (!same)
      fprintf(stderr, "%s: cluster %d: x %d to %d, y %d to %d\n", about->name, n + 1,
              got->bounds[n][0], got->bounds[n][1], got->bounds[n][2], got->bounds[n][3]);
    sum->clusters++;
    sum->unwrapped += bounds[1] >= COLUMNS || bounds[3] >= ROWS;
    sum->closed += closed[0] || closed[1];
  }
  fg__unwrap_clear(&unwrap);
}

/* What a rank that has patches sees of each cluster, compared with the whole's window. */
static void compare_windows(const fg__labels *labels, const subject *s)
{
  const fg_density_arrays *grid = fg_density_contents(s->shared);
  size_t count = (size_t)labels->count;
  fg__wanted_patch *wanted = allocate_or_end(count, sizeof *wanted);
  for (int n = 0; n < labels->count; ++n)
    fg__patch_place(&wanted[n].patch, grid, labels->bounds[n], labels->closed[n]);
  expect(fg__patches_fill(us.context, s->shared, wanted, labels->count) == FG_STATUS_OK);
  fg__labels want = {0};
  if (s->whole)
    expect(fg__labels_create(&want, us.context, s->whole) == FG_STATUS_OK);
  for (int n = 0; n < labels->count && s->whole; ++n) {
    fg__window one, other;
    expect(fg__window_cut(&one, us.context, grid, labels, &wanted[n].patch, n + 1) ==
           FG_STATUS_OK);
    expect(fg__window_create(&other, us.context, fg_density_contents(s->whole), &want,
                             n + 1) == FG_STATUS_OK);
    size_t nodes = (size_t)other.nodes[0] * (size_t)other.nodes[1];
    size_t cells = (size_t)(other.nodes[0] - 1) * (size_t)(other.nodes[1] - 1);
    expect(one.nodes[0] == other.nodes[0] && one.nodes[1] == other.nodes[1]);
    expect(one.origin[0] == other.origin[0] && one.origin[1] == other.origin[1]);
    expect(memcmp(one.at_boundary, other.at_boundary, sizeof one.at_boundary) == 0);
    expect(memcmp(one.level, other.level, nodes * sizeof *one.level) == 0);
    expect(memcmp(one.active, other.active, cells) == 0);
    fg__window_clear(&one);
    fg__window_clear(&other);
  }
  for (int n = 0; n < labels->count; ++n)
    fg__patch_clear(&wanted[n].patch);
  fg__labels_clear(&want);
  free(wanted);
}

static void blocks_show_what_the_plain_grid_shows(void **state)
{
  (void)state;
  tally sum = {0};
  for (int n = 0; n < SHAPE_COUNT; ++n)
    for (int way = 0; way < 4; ++way) {
      if (!is_taken(n, way))
        continue;
      bool periodic[2];
      set_periods(periodic, way);
      subject s = subject_of(&SHAPES[n], periodic, (n + way) % 3 == 0);
      fg__labels labels;
      expect(fg__labels_create(&labels, us.context, s.shared) == FG_STATUS_OK);
      if (s.whole)
        compare_labels(&labels, &s, &SHAPES[n], &sum);
      compare_windows(&labels, &s);
      fg__labels_clear(&labels);
      subject_clear(&s);
    }
  /* the shapes are what they are meant to be */
  if (us.ranks->rank == 0)
    expect(sum.clusters > 75 && sum.unwrapped > 10 && sum.closed > 5);
  end_together();
}

static void a_density_in_one_piece_is_not_gathered(void **state)
{
  (void)state;
  const float u[] = {1.0F, -1.0F, 1.0F, 0.5F};
  fg_density_arrays arrays = {
      .dimension = 2, .nodes = {2, 2}, .spacing = {1.0, 1.0}, .u = u};
  fg_density *density, *out;
  expect(fg_density_create_from_arrays(&density, us.context, &arrays) == FG_STATUS_OK);
  expect(!fg_density_is_distributed(density));
  const int *label = fg_density_labels(density);
  expect(label && label[0] == 1 && label[1] == 0 && label[2] == 1 && label[3] == 1);
  expect(fg_density_gather(&out, us.context, density) == FG_STATUS_ARGUMENT);
  fg_density_destroy(density);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(blocks_show_what_the_plain_grid_shows),
      TOGETHER(a_density_in_one_piece_is_not_gathered),
  };
  return cmocka_run_group_tests_name("cluster/labels", tests, NULL, NULL);
}
