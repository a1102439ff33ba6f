/* Ranks with a slab each find their neighbours and get what these send, and no more. */
#include "mesh/slabs.h"

#include "mesh/shares_test.h"

static int last_axis(const grid *g)
{
  return g->dimension - 1;
}

/* Slabs of two slices, and one of what is left; slab n, counted from below, belongs to
 * rank (turn + step n) modulo the ranks' number. */
static shares in_slabs(const grid *g, int turn, int step)
{
  int ranks = us.ranks->count, axis = last_axis(g);
  shares out = {.count = ranks};
  int first = 0;
  for (int n = 0; n < ranks; ++n) {
    for (int k = 0; k < 3; ++k)
      out.box[n].nodes[k] = nodes_along(g, k);
    out.box[n].first[axis] = first;
    if (n + 1 < ranks)
      out.box[n].nodes[axis] = 2;
    else
      out.box[n].nodes[axis] -= first;
    first += out.box[n].nodes[axis];
    out.owner[n] = (turn + step * n % ranks + ranks) % ranks;
  }
  return out;
}

/* The rank that has the slab `by` above this rank's. */
static int neighbour(const grid *g, const shares *s, int by)
{
  for (int n = 0; n < s->count; ++n) {
    int other = n + by;
    if (s->owner[n] != us.ranks->rank)
      continue;
    if (g->periodic[last_axis(g)])
      other = (other + s->count) % s->count;
    return other < 0 || other >= s->count ? FG__NOBODY : s->owner[other];
  }
  return FG__NOBODY;
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
  const fg_traffic *book = &us.ranks->book->of[us.ranks->book->now], before = *book;
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
  expect(book->exchanges - before.exchanges == 1.0);
  expect(book->messages - before.messages == messages);
  expect(book->bytes - before.bytes == bytes);
}

static void neighbours_get_what_is_sent_them(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT && us.ranks->count > 1; ++g)
    for (int turn = 0; turn < us.ranks->count; ++turn)
      for (int step = -1; step <= 1; step += 2) {
        shares s = in_slabs(&GRIDS[g], turn, step);
        fg__partition partition = partition_of(&GRIDS[g], &s);
        fg__slabs slabs;
        expect(fg__slabs_find(&slabs, &partition));
        expect(slabs.below == neighbour(&GRIDS[g], &s, -1));
        expect(slabs.above == neighbour(&GRIDS[g], &s, 1));
        check_exchange(&slabs);
        fg__partition_clear(&partition);
      }
  end_together();
}

/* One rank has no neighbour; pieces of slices and several boxes a rank are for
 * exchange.h. */
static void other_boxes_are_no_slabs(void **state)
{
  (void)state;
  for (int g = 0; g < GRID_COUNT; ++g) {
    shares s = in_slabs(&GRIDS[g], 0, 1);
    fg__box *cut = &s.box[s.count - 1];
    for (int kind = 0; kind < 2; ++kind) {
      shares other = s;
      if (us.ranks->count > 1) {
        int axis = kind == 0 ? 0 : last_axis(&GRIDS[g]);
        fg__box *above = &other.box[other.count];
        *above = *cut;
        other.box[s.count - 1].nodes[axis] = 1;
        above->first[axis] += 1;
        above->nodes[axis] -= 1;
        other.owner[other.count++] = other.owner[s.count - 1];
      }
      fg__partition partition = partition_of(&GRIDS[g], &other);
      expect(!fg__slabs_find(&(fg__slabs){0}, &partition));
      fg__partition_clear(&partition);
    }
  }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(neighbours_get_what_is_sent_them),
      TOGETHER(other_boxes_are_no_slabs),
  };
  return cmocka_run_group_tests_name("mesh/slabs", tests, NULL, NULL);
}
