/* A grid in boxes gives what the whole grid gives. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "component/components.h"

enum { MOST_BOXES = 24 };

typedef struct world {
  int nodes[3], cells[3];
  bool periodic[3];
  float *u;              /* NULL: 1 everywhere */
  unsigned char *active; /* NULL: no mask */
} world;

/* A box with arrays of its own, which reach one node further on each side. */
typedef struct part {
  int first[3], nodes[3];
  int pitch[3]; /* 1, row, plane */
  float *u;
  unsigned char *active;
  int *number;
  ptrdiff_t origin; /* of node (0, 0, 0) in the arrays */
  fg__component_box box;
  fg__components components;
  int before;
} part;

static size_t node_count(const world *w)
{
  return (size_t)w->nodes[0] * (size_t)w->nodes[1] * (size_t)w->nodes[2];
}

static world make_world(int dimension)
{
  world w = {.nodes = {5 + rand() % 14, 4 + rand() % 9, 1}};
  if (dimension == 3)
    w.nodes[2] = 3 + rand() % 7;
  size_t cells = 1;
  for (int k = 0; k < 3; ++k) {
    w.periodic[k] = k < dimension && rand() % 2 == 0;
    w.cells[k] = w.periodic[k] || k >= dimension ? w.nodes[k] : w.nodes[k] - 1;
    cells *= (size_t)w.cells[k];
  }
  w.u = rand() % 6 ? malloc(node_count(&w) * sizeof *w.u) : NULL;
  for (size_t n = 0; n < node_count(&w) && w.u; ++n)
    w.u[n] = (float)(rand() % 2000 - 1150) / 1000.0F;
  w.active = rand() % 2 ? calloc(cells + 1, 1) : NULL;
  for (size_t n = 0; n < cells && w.active; ++n)
    w.active[n] = rand() % 10 >= 3;
  return w;
}

/* Index of a node or a cell of the whole grid; -1 beyond its boundary. */
static ptrdiff_t index_in(const world *w, const int size[3], const int place[3])
{
  int at[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = place[k];
    if (w->periodic[k])
      at[k] = (at[k] + size[k]) % size[k];
    if (at[k] < 0 || at[k] >= size[k])
      return -1;
  }
  return ((ptrdiff_t)at[2] * size[1] + at[1]) * size[0] + at[0];
}

/* Fills a part's array, ring included, from one of the whole grid; what lies beyond the
 * boundary must not matter. */
static void fill_part(part *p, const world *w)
{
  for (int k = -1; k <= p->nodes[2]; ++k)
    for (int j = -1; j <= p->nodes[1]; ++j)
      for (int i = -1; i <= p->nodes[0]; ++i) {
        const int place[3] = {p->first[0] + i, p->first[1] + j, p->first[2] + k};
        ptrdiff_t here =
            p->origin + i + (ptrdiff_t)j * p->pitch[1] + (ptrdiff_t)k * p->pitch[2];
        ptrdiff_t node = index_in(w, w->nodes, place);
        ptrdiff_t cell = index_in(w, w->cells, place);
        p->u[here] = node < 0 || !w->u ? 1.0F : w->u[node];
        p->active[here] = cell < 0 || !w->active ? 1 : w->active[cell];
      }
}

static void make_part(part *p, const world *w)
{
  p->pitch[0] = 1;
  p->pitch[1] = p->nodes[0] + 2 + rand() % 3;
  p->pitch[2] = p->pitch[1] * (p->nodes[1] + 2);
  size_t size = (size_t)p->pitch[2] * (size_t)(p->nodes[2] + 2);
  p->origin = 1 + p->pitch[1] + p->pitch[2];
  p->u = malloc(size * sizeof *p->u);
  p->active = malloc(size);
  p->number = malloc(size * sizeof *p->number);
  fill_part(p, w);
  p->components = (fg__components){0};
  p->box = (fg__component_box){.u = w->u ? p->u + p->origin : NULL,
                               .row = p->pitch[1],
                               .plane = p->pitch[2],
                               .active = w->active ? p->active + p->origin : NULL,
                               .cell_row = p->pitch[1],
                               .cell_plane = p->pitch[2]};
  for (int k = 0; k < 3; ++k) {
    p->box.grid_nodes[k] = w->nodes[k];
    p->box.periodic[k] = w->periodic[k];
    p->box.first[k] = p->first[k];
    p->box.nodes[k] = p->nodes[k];
  }
}

/* Cuts the grid in two, one of the two in two, and so on, at random. */
static int cut_world(part *list, const world *w, int dimension)
{
  int count = 1;
  list[0] = (part){.nodes = {w->nodes[0], w->nodes[1], w->nodes[2]}};
  for (int tries = 0; tries < MOST_BOXES - 1; ++tries) {
    part *p = &list[rand() % count];
    int axis = rand() % dimension;
    if (p->nodes[axis] < 2)
      continue;
    int low = 1 + rand() % (p->nodes[axis] - 1);
    part *q = &list[count++];
    *q = *p;
    q->first[axis] += low;
    q->nodes[axis] -= low;
    p->nodes[axis] = low;
  }
  for (int n = 0; n < count; ++n)
    make_part(&list[n], w);
  return count;
}

static void gather(const part *p, const world *w, int *of_grid, bool scatter)
{
  for (int k = scatter ? -1 : 0; k < p->nodes[2] + scatter; ++k)
    for (int j = scatter ? -1 : 0; j < p->nodes[1] + scatter; ++j)
      for (int i = scatter ? -1 : 0; i < p->nodes[0] + scatter; ++i) {
        const int place[3] = {p->first[0] + i, p->first[1] + j, p->first[2] + k};
        ptrdiff_t node = index_in(w, w->nodes, place);
        int *here = p->number + p->origin + i + (ptrdiff_t)j * p->pitch[1] +
                    (ptrdiff_t)k * p->pitch[2];
        bool ghost = i < 0 || j < 0 || k < 0 || i >= p->nodes[0] || j >= p->nodes[1] ||
                     k >= p->nodes[2];
        if (!scatter)
          of_grid[node] = *here;
        else if (ghost)
          *here = node < 0 ? 12345 : of_grid[node];
      }
}

/* Steps 1 to 5 of components.h. */
static void merge_parts(part *list, int count, const world *w, double debris_area,
                        bool all, fg__components *merged)
{
  /* a piece takes a node at least, and a node meets at most 18 others */
  fg__component_piece *piece = calloc(node_count(w), sizeof *piece);
  fg__component_pair *pair = calloc(18 * node_count(w), sizeof *pair);
  size_t pairs = 0;
  int pieces = 0;
  int *numbers = calloc(node_count(w), sizeof *numbers);
  for (int n = 0; n < count; ++n) {
    part *p = &list[n];
    fg__components *c = &p->components;
    p->before = pieces;
    assert_int_equal(fg__components_cut(c, NULL, &p->box), FG_STATUS_OK);
    fg__components_number(c, &p->box, p->before, all, p->number + p->origin);
    if (c->piece_count > 0)
      memcpy(piece + pieces, c->piece, (size_t)c->piece_count * sizeof *piece);
    pieces += c->piece_count;
    gather(p, w, numbers, false);
  }
  for (int n = count - 1; n >= 0; --n) { /* pairs in any order */
    part *p = &list[n];
    fg__components *c = &p->components;
    gather(p, w, numbers, true);
    assert_int_equal(fg__components_pairs(c, NULL, &p->box, p->number + p->origin),
                     FG_STATUS_OK);
    if (c->pair_count > 0)
      memcpy(pair + pairs, c->pair, c->pair_count * sizeof *pair);
    pairs += c->pair_count;
  }
  assert_int_equal(
      fg__components_merge(merged, NULL, piece, pieces, pair, pairs, debris_area),
      FG_STATUS_OK);
  for (int n = 0; n < count; ++n)
    fg__components_label(&list[n].components, &list[n].box, merged->piece_label,
                         list[n].before, list[n].number + list[n].origin);
  free(piece);
  free(pair);
  free(numbers);
}

static void same_as_whole(int dimension, double debris_area, bool all)
{
  world w = make_world(dimension);
  fg__component_grid grid = {.nodes = {w.nodes[0], w.nodes[1], w.nodes[2]},
                             .periodic = {w.periodic[0], w.periodic[1], w.periodic[2]},
                             .u = w.u,
                             .active = w.active,
                             .debris_area = debris_area};
  fg__components whole = {0}, merged = {0};
  assert_int_equal(fg__components_find(&whole, NULL, &grid), FG_STATUS_OK);
  part list[MOST_BOXES];
  int count = cut_world(list, &w, dimension);
  merge_parts(list, count, &w, debris_area, all, &merged);
  assert_int_equal(merged.count, whole.count);
  assert_int_equal(merged.debris, whole.debris);
  for (int n = 0; n < whole.count; ++n)
    assert_true(merged.area[n] == whole.area[n]);
  int *label = calloc(node_count(&w), sizeof *label);
  double covered = 0.0, covered_alone = 0.0;
  for (int n = 0; n < count; ++n) {
    gather(&list[n], &w, label, false);
    covered += list[n].components.covered;
    assert_int_equal(fg__components_cover(&list[n].components, NULL, &list[n].box),
                     FG_STATUS_OK);
    covered_alone += list[n].components.covered;
    fg__components_clear(&list[n].components);
    free(list[n].u);
    free(list[n].active);
    free(list[n].number);
  }
  assert_memory_equal(label, whole.label, node_count(&w) * sizeof *label);
  assert_true(covered == whole.covered && covered_alone == whole.covered);
  free(label);
  free(w.u);
  free(w.active);
  fg__components_clear(&whole);
  fg__components_clear(&merged);
}

static void test_boxes_in_2d(void **state)
{
  (void)state;
  srand(1);
  for (int round = 0; round < 400; ++round)
    same_as_whole(2, round % 3 == 0 ? 2.0 : 0.0, round % 2);
}

static void test_boxes_in_3d(void **state)
{
  (void)state;
  srand(2);
  for (int round = 0; round < 400; ++round)
    same_as_whole(3, round % 3 == 0 ? 2.0 : 0.0, round % 2);
}

/* Each positive node stands for the active cells round it, a quarter or an eighth each.
 */
static void test_covers_the_cells_round_positive_nodes(void **state)
{
  (void)state;
  srand(3);
  for (int round = 0; round < 40; ++round) {
    int dimension = 2 + round % 2;
    world w = make_world(dimension);
    double expected = 0.0;
    for (int n = 0; n < (int)node_count(&w); ++n) {
      const int node[3] = {n % w.nodes[0], n / w.nodes[0] % w.nodes[1],
                           n / (w.nodes[0] * w.nodes[1])};
      for (int corner = 0; corner < 1 << dimension; ++corner) {
        int place[3];
        for (int k = 0; k < 3; ++k)
          place[k] = node[k] - (corner >> k & 1);
        ptrdiff_t cell = index_in(&w, w.cells, place);
        if (cell >= 0 && (!w.active || w.active[cell]) && (!w.u || w.u[n] > 0.0F))
          expected += dimension == 3 ? 0.125 : 0.25;
      }
    }
    fg__component_grid grid = {.nodes = {w.nodes[0], w.nodes[1], w.nodes[2]},
                               .periodic = {w.periodic[0], w.periodic[1], w.periodic[2]},
                               .u = w.u,
                               .active = w.active};
    fg__components components = {0};
    assert_int_equal(fg__components_count(&components, NULL, &grid), FG_STATUS_OK);
    assert_true(components.covered == expected);
    fg__components_clear(&components);
    free(w.u);
    free(w.active);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_boxes_in_2d),
      cmocka_unit_test(test_boxes_in_3d),
      cmocka_unit_test(test_covers_the_cells_round_positive_nodes),
  };
  return cmocka_run_group_tests_name("component/boxes", tests, NULL, NULL);
}
