#include "grid/exchange/exchange.h"

#include "grid/grids_test.h"

static int colour_of(const int node[3])
{
  return (node[0] & 1) + 2 * (node[1] & 1) + 4 * (node[2] & 1);
}

/* A ghost of the own block, and the node whose value it should hold. */
typedef struct ghost {
  int at[3], node[3];
} ghost;

typedef void on_ghost(const ghost *g, void *data);

static void for_all_ghosts(const grid *g, const fg__partition *partition, on_ghost *act,
                           void *data)
{
  int depth = g->dimension == 3;
  const fg__box *own = fg__own_block(partition);
  for (int k = -depth; k < own->nodes[2] + depth; ++k)
    for (int j = -1; j <= own->nodes[1]; ++j)
      for (int i = -1; i <= own->nodes[0]; ++i) {
        ghost here = {.at = {i, j, k}};
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
          here.node[axis] = image_along(g, axis, own->first[axis] + here.at[axis]);
          inside = inside && here.at[axis] >= 0 && here.at[axis] < own->nodes[axis];
        }
        if (!inside)
          act(&here, data);
      }
}

typedef struct check {
  const fields *fields;
  unsigned colours;
} check;

static void holds_its_source(const ghost *g, void *data)
{
  const check *c = data;
  ptrdiff_t at = fg__node_at(&c->fields->layout, g->at[0], g->at[1], g->at[2]);
  bool filled = (c->colours >> colour_of(g->node) & 1U) != 0;
  for (int a = 0; a < c->fields->count; ++a)
    expect(c->fields->array[a][at] == (filled ? value_at(a, g->node) : UNTOUCHED));
}

enum { EVEN_ROWS = 0x33, ODD_COLUMNS = 0xaa };

static const unsigned COLOURS[] = {FG__ALL_COLOURS, 1U << 0,     1U << 3, 1U << 6,
                                   EVEN_ROWS,       ODD_COLUMNS, 0x81,    0};
enum { COLOUR_SETS = sizeof COLOURS / sizeof *COLOURS, SEEDS = 12 };

static void check_exchange(const grid *g, uint64_t seed, int alignment)
{
  unsigned colours = COLOURS[seed % COLOUR_SETS];
  fg__partition partition = divide_at_random(g, seed, alignment);
  fg__exchange *exchange;
  expect(fg__exchange_create(&exchange, us.context, &partition, 3) == FG_STATUS_OK);
  for (int arrays = 1; arrays <= 3; ++arrays) {
    fields f = fields_of(&partition, arrays);
    fg__exchange_fill(exchange, arrays, f.array, colours);
    check c = {.fields = &f, .colours = colours};
    for_all_ghosts(g, &partition, holds_its_source, &c);
    fields_clear(&f);
  }
  fg__exchange_destroy(exchange);
  fg__partition_clear(&partition);
}

static void ghosts_hold_what_they_stand_for(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 0; seed < SEEDS; ++seed)
      check_exchange(&GRIDS[g], seed, 2);
  end_together();
}

/* Coarse levels that are shared only to be gathered begin anywhere. */
static void blocks_may_begin_at_odd_indices(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g)
    for (uint64_t seed = 100; seed < 100 + SEEDS; ++seed)
      check_exchange(&GRIDS[g], seed, 1);
  end_together();
}

/* Nodes of the other colours may change meanwhile, and a second plan be under way. */
static void work_goes_on_between_begin_and_finish(void **state)
{
  (void)state;
  const grid *g = &GRIDS[5];
  fg__partition one = divide_at_random(g, 17, 2), two = divide_at_random(g, 18, 2);
  fg__exchange *first, *second;
  expect(fg__exchange_create(&first, us.context, &one, 2) == FG_STATUS_OK);
  expect(fg__exchange_create(&second, us.context, &two, 1) == FG_STATUS_OK);
  fields f = fields_of(&one, 2), h = fields_of(&two, 1);
  fg__exchange_begin(first, 2, f.array, EVEN_ROWS);
  fg__exchange_begin(second, 1, h.array, FG__ALL_COLOURS);
  for (int i = 0; i < f.layout.nodes[0]; ++i)
    f.array[0][fg__node_at(&f.layout, i, 1, 0)] = 1e9F;
  fg__exchange_finish(first);
  fg__exchange_finish(second);
  check c = {.fields = &f, .colours = EVEN_ROWS};
  for_all_ghosts(g, &one, holds_its_source, &c);
  c = (check){.fields = &h, .colours = FG__ALL_COLOURS};
  for_all_ghosts(g, &two, holds_its_source, &c);
  fields_clear(&f);
  fields_clear(&h);
  fg__exchange_destroy(first);
  fg__exchange_destroy(second);
  fg__partition_clear(&one);
  fg__partition_clear(&two);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(ghosts_hold_what_they_stand_for),
      TOGETHER(blocks_may_begin_at_odd_indices),
      TOGETHER(work_goes_on_between_begin_and_finish),
  };
  return cmocka_run_group_tests_name("grid/exchange/exchange", tests, NULL, NULL);
}
