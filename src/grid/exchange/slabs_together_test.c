/* Ranks with a slab each find their neighbours and get what these send, and no more. */
#include "grid/exchange/slabs.h"

#include "grid/grids_test.h"

/* The last axis alone is divided. */
static fg__partition in_slabs(const grid *g)
{
  int blocks[3] = {1, 1, 1};
  blocks[g->dimension - 1] = us.ranks->count;
  fg__partition out;
  if (fg__partition_create(&out, us.context, us.ranks, g->dimension, g->cells,
                           g->periodic, blocks, 2) != FG_STATUS_OK)
    abort();
  return out;
}

/* The rank `by` above this one, as slabs follow each other. */
static int neighbour(const grid *g, int by)
{
  int count = us.ranks->count, other = us.ranks->rank + by;
  if (g->periodic[g->dimension - 1])
    return (other + count) % count;
  return other < 0 || other >= count ? FG__NOBODY : other;
}

/* What rank r sends in a run. */
static float sent_by(int rank, int run, size_t n)
{
  return (float)(1000 * rank + 100 * run + (int)n);
}

enum { RUNS = 3, MOST_FLOATS = 7 };

static void check_exchange(const fg__slabs *slabs)
{
  static const size_t floats[RUNS] = {5, 2, MOST_FLOATS};
  static const bool up[RUNS] = {true, false, true};
  float sent[RUNS][MOST_FLOATS], received[RUNS][MOST_FLOATS + 1];
  fg__run run[RUNS];
  for (int r = 0; r < RUNS; ++r) {
    for (size_t n = 0; n < MOST_FLOATS; ++n) {
      sent[r][n] = sent_by(us.ranks->rank, r, n);
      received[r][n] = UNTOUCHED;
    }
    received[r][MOST_FLOATS] = UNTOUCHED;
    run[r] = (fg__run){sent[r], received[r], floats[r], up[r]};
  }
  const fg_communication *counters = &us.ranks->counters->of[us.ranks->counters->now],
                         before = *counters;
  fg__slabs_exchange(slabs, run, RUNS);
  double messages = 0.0, bytes = 0.0;
  for (int r = 0; r < RUNS; ++r) {
    int from = up[r] ? slabs->below : slabs->above;
    int to = up[r] ? slabs->above : slabs->below;
    messages += to != FG__NOBODY;
    bytes += to != FG__NOBODY ? 4.0 * (double)floats[r] : 0.0;
    for (size_t n = 0; n <= MOST_FLOATS; ++n)
      expect(received[r][n] ==
             (from == FG__NOBODY || n >= floats[r] ? UNTOUCHED : sent_by(from, r, n)));
  }
  expect(counters->exchanges - before.exchanges == 1.0);
  expect(counters->messages - before.messages == messages);
  expect(counters->bytes - before.bytes == bytes);
}

static void neighbours_get_what_is_sent_them(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT && us.ranks->count > 1; ++g) {
    fg__partition partition = in_slabs(&GRIDS[g]);
    fg__slabs slabs;
    expect(fg__slabs_find(&slabs, &partition));
    expect(slabs.below == neighbour(&GRIDS[g], -1));
    expect(slabs.above == neighbour(&GRIDS[g], 1));
    check_exchange(&slabs);
    fg__partition_clear(&partition);
  }
  end_together();
}

/* One rank has no neighbour; pencils are for exchange.h. */
static void other_blocks_are_no_slabs(void **state)
{
  (void)state;
  const fg__ranks *alone = &fg__single_rank;
  for (int g = 0; g < GRID_COUNT; ++g) {
    const fg__ranks *ranks = GRIDS[g].dimension == 3 ? us.ranks : alone;
    const int blocks[3] = {1, ranks->count, 1};
    fg__partition partition;
    expect(fg__partition_create(&partition, us.context, ranks, GRIDS[g].dimension,
                                GRIDS[g].cells, GRIDS[g].periodic, blocks,
                                2) == FG_STATUS_OK);
    expect(!fg__slabs_find(&(fg__slabs){0}, &partition));
    fg__partition_clear(&partition);
  }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(neighbours_get_what_is_sent_them),
      TOGETHER(other_blocks_are_no_slabs),
  };
  return cmocka_run_group_tests_name("grid/exchange/slabs", tests, NULL, NULL);
}
