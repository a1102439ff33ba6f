#include "mesh/exchange.h"

#include "mesh/shares_test.h"

static int colour_of(const int node[3])
{
  return (node[0] & 1) + 2 * (node[1] & 1) + 4 * (node[2] & 1);
}

/* What a ghost of own box `box` should hold, and whether it is covered at all. */
typedef struct ghost {
  int at[3], node[3];
  int owner;
} ghost;

typedef void on_ghost(const ghost *g, int box, const fg__layout *layout, void *data);

static void for_all_ghosts(const grid *g, const shares *s, on_ghost *act, void *data)
{
  fg__box own[MOST_SHARES];
  int count = own_shares(s, own), depth = g->dimension == 3;
  for (int b = 0; b < count; ++b) {
    fg__layout layout = fg__layout_of(g->dimension, own[b].nodes);
    for (int k = -depth; k < own[b].nodes[2] + depth; ++k)
      for (int j = -1; j <= own[b].nodes[1]; ++j)
        for (int i = -1; i <= own[b].nodes[0]; ++i) {
          ghost here = {.at = {i, j, k}};
          bool inside = true;
          for (int axis = 0; axis < 3; ++axis) {
            here.node[axis] = image_along(g, axis, own[b].first[axis] + here.at[axis]);
            inside = inside && here.at[axis] >= 0 && here.at[axis] < own[b].nodes[axis];
          }
          here.owner = owner_of(s, here.node);
          if (!inside)
            act(&here, b, &layout, data);
        }
  }
}

typedef struct check {
  const fields *fields;
  unsigned colours;
  const fg__uncovered *uncovered;
  int uncovered_count;
} check;

static void holds_its_source(const ghost *g, int box, const fg__layout *layout,
                             void *data)
{
  const check *c = data;
  ptrdiff_t at = fg__node_at(layout, g->at[0], g->at[1], g->at[2]);
  bool filled = g->owner >= 0 && (c->colours >> colour_of(g->node) & 1U);
  for (int a = 0; a < c->fields->count; ++a)
    expect(c->fields->node[a][box][at] == (filled ? value_at(a, g->node) : UNTOUCHED));
}

static void is_listed_when_uncovered(const ghost *g, int box, const fg__layout *layout,
                                     void *data)
{
  const check *c = data;
  (void)layout;
  int times = 0;
  for (int n = 0; n < c->uncovered_count; ++n)
    times += c->uncovered[n].box == box && has_node(&c->uncovered[n].nodes, g->at);
  expect(times == (g->owner < 0));
}

static const unsigned COLOURS[] = {FG__ALL_COLOURS, 1U << 0,         1U << 3, 1U << 6,
                                   FG__EVEN_ROWS,   FG__ODD_COLUMNS, 0x81,    0};
enum { COLOUR_SETS = sizeof COLOURS / sizeof *COLOURS, SEEDS = 12 };

static void check_exchange(const grid *g, const shares *s, unsigned colours)
{
  fg__partition partition = partition_of(g, s);
  fg__exchange *exchange;
  expect(fg__exchange_create(&exchange, us.context, &partition, 3) == FG_STATUS_OK);
  for (int arrays = 1; arrays <= 3; ++arrays) {
    fields f = fields_of(&partition, arrays);
    fg__exchange_fill(exchange, arrays, arrays_of(&f), colours);
    check c = {.fields = &f, .colours = colours};
    for_all_ghosts(g, s, holds_its_source, &c);
    fields_clear(&f);
  }
  fg__exchange_destroy(exchange);
  fg__partition_clear(&partition);
}

static void ghosts_hold_what_they_stand_for(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      shares s = cut_at_random(&GRIDS[g], seed, 2, seed % 3 == 2);
      check_exchange(&GRIDS[g], &s, COLOURS[seed % COLOUR_SETS]);
    }
  end_together();
}

/* Coarse levels that are shared only to be gathered begin anywhere. */
static void boxes_may_begin_at_odd_indices(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 100; seed < 100 + SEEDS; ++seed) {
      shares s = cut_at_random(&GRIDS[g], seed, 1, false);
      check_exchange(&GRIDS[g], &s, COLOURS[seed % COLOUR_SETS]);
    }
  end_together();
}

static void ghosts_without_an_owner_are_listed(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 200; seed < 200 + SEEDS; ++seed) {
      shares s = cut_at_random(&GRIDS[g], seed, 2, seed % 4 != 0);
      fg__partition partition = partition_of(&GRIDS[g], &s);
      fg__exchange *exchange;
      expect(fg__exchange_create(&exchange, us.context, &partition, 1) == FG_STATUS_OK);
      check c = {0};
      c.uncovered = fg__exchange_uncovered(exchange, &c.uncovered_count);
      for_all_ghosts(&GRIDS[g], &s, is_listed_when_uncovered, &c);
      expect(seed % 4 != 0 || c.uncovered_count == 0);
      fg__exchange_destroy(exchange);
      fg__partition_clear(&partition);
    }
  end_together();
}

/* Nodes of the other colours may change meanwhile, and a second plan be under way. */
static void work_goes_on_between_begin_and_finish(void **state)
{
  (void)state;
  const grid *g = &GRIDS[5];
  shares s = cut_at_random(g, 17, 2, false), t = cut_at_random(g, 18, 2, false);
  fg__partition one = partition_of(g, &s), two = partition_of(g, &t);
  fg__exchange *first, *second;
  expect(fg__exchange_create(&first, us.context, &one, 2) == FG_STATUS_OK);
  expect(fg__exchange_create(&second, us.context, &two, 1) == FG_STATUS_OK);
  fields f = fields_of(&one, 2), h = fields_of(&two, 1);
  fg__exchange_begin(first, 2, arrays_of(&f), FG__EVEN_ROWS);
  fg__exchange_begin(second, 1, arrays_of(&h), FG__ALL_COLOURS);
  for (int b = 0; b < f.boxes; ++b)
    for (int i = 0; i < f.layout[b].nodes[0]; ++i)
      f.node[0][b][fg__node_at(&f.layout[b], i, 1, 0)] = 1e9F;
  fg__exchange_finish(first);
  fg__exchange_finish(second);
  check c = {.fields = &f, .colours = FG__EVEN_ROWS};
  for_all_ghosts(g, &s, holds_its_source, &c);
  c = (check){.fields = &h, .colours = FG__ALL_COLOURS};
  for_all_ghosts(g, &t, holds_its_source, &c);
  fields_clear(&f);
  fields_clear(&h);
  fg__exchange_destroy(first);
  fg__exchange_destroy(second);
  fg__partition_clear(&one);
  fg__partition_clear(&two);
  end_together();
}

typedef struct filling {
  const grid *grid;
  const shares *from, *to;
  const fields *filled;
  const fg__exchange *exchange;
  fg__part part;
} filling;

/* A node or ghost `at` of own box `b`. */
static void check_filled(const filling *c, const fg__box *box, int b, const int at[3])
{
  fg__box inner = {{0, 0, 0}, {box->nodes[0], box->nodes[1], box->nodes[2]}};
  int node[3], uncovered_count, times = 0;
  for (int axis = 0; axis < 3; ++axis)
    node[axis] = image_along(c->grid, axis, box->first[axis] + at[axis]);
  bool asked = (c->part & (has_node(&inner, at) ? FG__NODES : FG__GHOSTS)) != 0;
  bool there = owner_of(c->from, node) >= 0;
  ptrdiff_t offset = fg__node_at(&c->filled->layout[b], at[0], at[1], at[2]);
  for (int a = 0; a < c->filled->count; ++a)
    expect(c->filled->node[a][b][offset] ==
           (asked && there ? value_at(a, node) : UNTOUCHED));
  const fg__uncovered *uncovered = fg__exchange_uncovered(c->exchange, &uncovered_count);
  for (int n = 0; n < uncovered_count; ++n)
    times += uncovered[n].box == b && has_node(&uncovered[n].nodes, at);
  expect(times == (asked && !there));
}

static void check_filling(const filling *c)
{
  fg__box own[MOST_SHARES];
  int count = own_shares(c->to, own), depth = c->grid->dimension == 3;
  for (int b = 0; b < count; ++b)
    for (int k = -depth; k < own[b].nodes[2] + depth; ++k)
      for (int j = -1; j <= own[b].nodes[1]; ++j)
        for (int i = -1; i <= own[b].nodes[0]; ++i)
          check_filled(c, &own[b], b, (int[3]){i, j, k});
}

/* From one partition into another: nodes, ghosts or both, where the first has them. */
static void any_partition_can_be_filled_from_another(void **state)
{
  (void)state;
  static const fg__part PARTS[] = {FG__GHOSTS, FG__NODES, FG__NODES_AND_GHOSTS};
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
      const grid *of = &GRIDS[g];
      fg__part part = PARTS[seed % 3];
      shares s = cut_at_random(of, seed, 1, seed % 2 == 1);
      shares t = cut_at_random(of, seed + 50, 1, seed % 5 == 4);
      fg__partition from = partition_of(of, &s), to = partition_of(of, &t);
      fg__exchange *exchange;
      expect(fg__exchange_create_between(&exchange, us.context, &from, &to, part, 2) ==
             FG_STATUS_OK);
      fields f = fields_of(&from, 2), h = fields_of(&to, 2);
      for (int b = 0; b < h.boxes; ++b)
        for (int a = 0; a < 2; ++a)
          for (size_t n = 0; n < h.layout[b].array_size; ++n)
            (h.node[a][b] - h.layout[b].first)[n] = UNTOUCHED;
      fg__exchange_fill_between(exchange, 2, arrays_of(&f), arrays_of(&h),
                                FG__ALL_COLOURS);
      filling c = {of, &s, &t, &h, exchange, part};
      check_filling(&c);
      fields_clear(&f);
      fields_clear(&h);
      fg__exchange_destroy(exchange);
      fg__partition_clear(&from);
      fg__partition_clear(&to);
    }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(ghosts_hold_what_they_stand_for),
      TOGETHER(boxes_may_begin_at_odd_indices),
      TOGETHER(ghosts_without_an_owner_are_listed),
      TOGETHER(work_goes_on_between_begin_and_finish),
      TOGETHER(any_partition_can_be_filled_from_another),
  };
  return cmocka_run_group_tests_name("mesh/exchange", tests, NULL, NULL);
}
