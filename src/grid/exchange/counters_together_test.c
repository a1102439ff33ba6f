/* What is sent is counted as it can be counted by hand. */
#include "grid/exchange/exchange.h"
#include "grid/exchange/gather.h"

#include "grid/grids_test.h"

/* What this rank has told the others between begin and now. */
typedef struct meter {
  fg_phase before;
  fg_communication start;
} meter;

static const fg_phase MEASURED = FG_PHASE_COUNTING; /* any will do */

static meter begin_count(void)
{
  meter out = {.before = FG_PHASE_OTHER};
  out.before = fg__phase_begin(us.ranks->counters, MEASURED);
  out.start =
      us.ranks->counters ? us.ranks->counters->of[MEASURED] : (fg_communication){0};
  return out;
}

static fg_communication end_count(const meter *m)
{
  fg_communication now =
      us.ranks->counters ? us.ranks->counters->of[MEASURED] : (fg_communication){0};
  fg__phase_return(us.ranks->counters, m->before);
  return (fg_communication){.exchanges = now.exchanges - m->start.exchanges,
                            .messages = now.messages - m->start.messages,
                            .bytes = now.bytes - m->start.bytes,
                            .gathers = now.gathers - m->start.gathers,
                            .gathered = now.gathered - m->start.gathered,
                            .reductions = now.reductions - m->start.reductions,
                            .reduced = now.reduced - m->start.reduced};
}

static fg__partition divided(const grid *g, const int blocks[3])
{
  fg__partition out;
  if (fg__partition_create(&out, us.context, us.ranks, g->dimension, g->cells,
                           g->periodic, blocks, 4) != FG_STATUS_OK)
    abort();
  return out;
}

typedef struct example {
  grid grid;
  int blocks[3];
  unsigned colours;
  int nodes[2]; /* that ranks 0 and 1 send to each other, counted by hand */
} example;

enum { EVEN_ROWS = 0x33, ODD_ROWS = 0xcc };

static const example EXAMPLES[] = {
    /* 17 x 9 nodes, cut before row 4: a row of 17 and its mirrored ends each way */
    {{2, {16, 8, 1}, {false, false, false}}, {1, 2, 1}, FG__ALL_COLOURS, {19, 19}},
    /* row 4 is even, what it needs of the other side odd */
    {{2, {16, 8, 1}, {false, false, false}}, {1, 2, 1}, EVEN_ROWS, {0, 19}},
    {{2, {16, 8, 1}, {false, false, false}}, {1, 2, 1}, ODD_ROWS, {19, 0}},
    /* of columns -1 to 17, which stand for 1, 0 ... 16, 15, the even and the odd */
    {{2, {16, 8, 1}, {false, false, false}}, {1, 2, 1}, 1U << 0, {0, 9}},
    {{2, {16, 8, 1}, {false, false, false}}, {1, 2, 1}, 1U << 1, {0, 10}},
    /* closed along y: neighbours on both sides */
    {{2, {8, 48, 1}, {false, true, false}}, {1, 2, 1}, FG__ALL_COLOURS, {22, 22}},
    /* a plane of 8 x 8 nodes that is closed both ways, with its ring */
    {{3, {8, 16, 8}, {true, false, true}}, {1, 2, 1}, FG__ALL_COLOURS, {100, 100}},
    /* two planes of 8 x 17 nodes, with their rings */
    {{3, {8, 16, 8}, {true, false, true}}, {1, 1, 2}, FG__ALL_COLOURS, {380, 380}},
};

static void check_example(const example *e, int arrays)
{
  enum { TIMES = 3 };
  fg__partition partition = divided(&e->grid, e->blocks);
  fg__exchange *exchange;
  expect(fg__exchange_create(&exchange, us.context, &partition, arrays) == FG_STATUS_OK);
  fields f = fields_of(&partition, arrays);
  meter m = begin_count();
  for (int time = 0; time < TIMES; ++time)
    fg__exchange_fill(exchange, arrays, f.array, e->colours);
  fg_communication sent = end_count(&m);
  int nodes = e->nodes[us.ranks->rank];
  expect(sent.exchanges == TIMES);
  expect(sent.messages == (nodes > 0 ? TIMES : 0));
  expect(sent.bytes == 4.0 * nodes * arrays * TIMES);
  expect(sent.gathers == 0.0 && sent.reductions == 0.0);
  fields_clear(&f);
  fg__exchange_destroy(exchange);
  fg__partition_clear(&partition);
}

static void ghosts_of_two_blocks_are_counted(void **state)
{
  (void)state;
  for (size_t n = 0; n < sizeof EXAMPLES / sizeof *EXAMPLES && us.ranks->count == 2; ++n)
    for (int arrays = 1; arrays <= 3; ++arrays)
      check_example(&EXAMPLES[n], arrays);
  end_together();
}

/* Ghosts of the own block whose source another rank owns. */
static uint64_t count_remote(const grid *g, const fg__partition *partition)
{
  int depth = g->dimension == 3;
  const fg__box *own = fg__own_block(partition);
  uint64_t remote = 0;
  for (int k = -depth; k < own->nodes[2] + depth; ++k)
    for (int j = -1; j <= own->nodes[1]; ++j)
      for (int i = -1; i <= own->nodes[0]; ++i) {
        int at[3] = {i, j, k}, node[3];
        for (int axis = 0; axis < 3; ++axis)
          node[axis] = image_along(g, axis, own->first[axis] + at[axis]);
        remote += owner_of(partition, node) != us.ranks->rank;
      }
  return remote;
}

/* Every remote ghost is sent once, and a neighbour gets one message a time. */
static void every_remote_ghost_is_sent_once(void **state)
{
  (void)state;
  enum { TIMES = 3, ARRAYS = 2 };
  for (int g = 0; g < GRID_COUNT; ++g) {
    fg__partition partition = divide_at_random(&GRIDS[g], 31, 2);
    fg__exchange *exchange;
    expect(fg__exchange_create(&exchange, us.context, &partition, ARRAYS) ==
           FG_STATUS_OK);
    fields f = fields_of(&partition, ARRAYS);
    meter m = begin_count();
    for (int time = 0; time < TIMES; ++time)
      fg__exchange_fill(exchange, ARRAYS, f.array, FG__ALL_COLOURS);
    fg_communication sent = end_count(&m);
    uint64_t sums[2] = {(uint64_t)sent.bytes, count_remote(&GRIDS[g], &partition)};
    fg__ranks_add(us.ranks, sums, 2);
    expect(sums[0] == sums[1] * ARRAYS * sizeof(float) * TIMES);
    expect(sent.messages <= TIMES * (us.ranks->count - 1));
    fields_clear(&f);
    fg__exchange_destroy(exchange);
    fg__partition_clear(&partition);
  }
  end_together();
}

/* 17 x 9 nodes: 17 x 4 on rank 0, 17 x 5 on rank 1; two arrays. */
static void what_a_gather_brings_is_counted(void **state)
{
  (void)state;
  if (us.ranks->count == 2) {
    fg__partition partition = divided(&EXAMPLES[0].grid, EXAMPLES[0].blocks);
    fg__gather *gather;
    expect(fg__gather_create(&gather, us.context, &partition, 2) == FG_STATUS_OK);
    fg__layout layout = fg__layout_of(2, partition.nodes);
    float *memory = allocate_or_end(2 * layout.array_size, sizeof *memory);
    float *const whole[] = {memory + layout.first,
                            memory + layout.array_size + layout.first};
    fields f = fields_of(&partition, 2);
    meter m = begin_count();
    fg__gather_fill(gather, 2, f.array, whole);
    fg_communication sent = end_count(&m);
    int own = us.ranks->rank == 0 ? 68 : 85;
    expect(sent.gathers == 1.0);
    expect(sent.gathered == 4.0 * 2 * (153 - own));
    expect(sent.messages == 0.0 && sent.exchanges == 0.0 && sent.reductions == 0.0);
    fields_clear(&f);
    free(memory);
    fg__gather_destroy(gather);
    fg__partition_clear(&partition);
  }
  end_together();
}

static void reductions_are_counted(void **state)
{
  (void)state;
  meter m = begin_count();
  uint64_t sums[3] = {1, 2, 3};
  double greatest[2] = {0.5, -1.0};
  fg__ranks_add(us.ranks, sums, 3);
  fg__ranks_greatest(us.ranks, greatest, 2);
  expect(fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK) == FG_STATUS_OK);
  fg_communication sent = end_count(&m);
  bool several = us.ranks->count > 1;
  expect(sent.reductions == (several ? 3 : 0));
  expect(sent.reduced == (several ? 24 + 16 + 8 : 0));
  expect(sent.messages == 0.0 && sent.exchanges == 0.0 && sent.gathers == 0.0);
  end_together();
}

/* Inner phases do not count for the outer ones. */
static void phases_are_told_apart(void **state)
{
  (void)state;
  fg__counters counters = {.now = FG_PHASE_OTHER};
  fg_phase outer = fg__phase_begin(&counters, FG_PHASE_STEPS);
  fg__count_message(&counters, 5);
  fg_phase inner = fg__phase_begin(&counters, FG_PHASE_CYCLES);
  fg__count_message(&counters, 7);
  fg__phase_return(&counters, inner);
  fg__count_message(&counters, 11);
  fg__phase_return(&counters, outer);
  fg__count_message(&counters, 13);
  expect(counters.of[FG_PHASE_STEPS].times == 1 &&
         counters.of[FG_PHASE_STEPS].messages == 2 &&
         counters.of[FG_PHASE_STEPS].bytes == 16);
  expect(counters.of[FG_PHASE_CYCLES].bytes == 7);
  expect(counters.of[FG_PHASE_OTHER].times == 0 &&
         counters.of[FG_PHASE_OTHER].bytes == 13);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(ghosts_of_two_blocks_are_counted),
      TOGETHER(every_remote_ghost_is_sent_once),
      TOGETHER(what_a_gather_brings_is_counted),
      TOGETHER(reductions_are_counted),
      TOGETHER(phases_are_told_apart),
  };
  return cmocka_run_group_tests_name("grid/exchange/counters", tests, NULL, NULL);
}
