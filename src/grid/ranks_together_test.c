#include "grid/together_test.h"

#include <string.h>

#include "base/mix.h"

/* However the terms are dealt out; they wrap round. */
static void sums_are_the_same_as_one_rank_alone_gives(void **state)
{
  (void)state;
  enum { TERMS = 5000 };
  uint64_t alone[2] = {0}, mine[2] = {0};
  for (uint64_t n = 0; n < TERMS; ++n) {
    alone[0] += fg__mix(n);
    alone[1] -= n;
    if (n * n % 11 % (uint64_t)us.ranks->count != (uint64_t)us.ranks->rank)
      continue;
    mine[0] += fg__mix(n);
    mine[1] -= n;
  }
  fg__ranks_add(us.ranks, mine, 2);
  expect(mine[0] == alone[0] && mine[1] == alone[1]);
  end_together();
}

static void words_are_combined_bit_by_bit(void **state)
{
  (void)state;
  uint32_t word[2] = {0x80000001U << us.ranks->rank, 0xffffffffU}, expected = 0;
  for (int rank = 0; rank < us.ranks->count; ++rank)
    expected ^= 0x80000001U << rank;
  fg__ranks_combine(us.ranks, word, 2);
  expect(word[0] == expected);
  expect(word[1] == (us.ranks->count % 2 ? 0xffffffffU : 0U));
  end_together();
}

static void the_greatest_is_found_wherever_it_is(void **state)
{
  (void)state;
  for (int at = 0; at < us.ranks->count; ++at) {
    double value[2] = {us.ranks->rank == at ? -0.5 : -0.75 - us.ranks->rank,
                       us.ranks->rank == at ? 1e300 : -1e300};
    fg__ranks_greatest(us.ranks, value, 2);
    expect(value[0] == -0.5 && value[1] == 1e300);
  }
  end_together();
}

/* One bit of one rank, the lowest and the highest too, is enough of a difference. */
static void a_number_is_alike_or_not(void **state)
{
  (void)state;
  const uint64_t number = UINT64_C(0x9e3779b97f4a7c15);
  expect(fg__ranks_alike(us.ranks, number));
  expect(fg__ranks_alike(us.ranks, 0) && fg__ranks_alike(us.ranks, ~UINT64_C(0)));
  for (int bit = 0; bit < 64; ++bit)
    for (int rank = 0; rank < us.ranks->count; ++rank) {
      uint64_t other = number ^ (uint64_t)(us.ranks->rank == rank) << bit;
      expect(fg__ranks_alike(us.ranks, other) == (us.ranks->count == 1));
    }
  end_together();
}

static void no_failure_is_none(void **state)
{
  (void)state;
  expect(fg__ranks_agree(us.ranks, us.context, FG_STATUS_OK) == FG_STATUS_OK);
  expect(strcmp(fg_context_message(us.context), "") == 0);
  end_together();
}

/* Every set of failing ranks; each says something of its own. */
static void all_end_with_the_lowest_rank_s_failure(void **state)
{
  (void)state;
  for (int failing = 1; failing < 1 << us.ranks->count; ++failing) {
    int lowest = 0;
    while (!(failing >> lowest & 1))
      ++lowest;
    fg_status status = FG_STATUS_OK;
    if (failing >> us.ranks->rank & 1) {
      status = us.ranks->rank % 2 ? FG_STATUS_FILE_ACCESS : FG_STATUS_FILE_FORMAT;
      fg__fail(us.context, status, "rank %d saw no file", us.ranks->rank);
      fg__hint(us.context, "Ask rank %d.", us.ranks->rank);
    }
    status = fg__ranks_agree(us.ranks, us.context, status);
    char message[64], hint[64];
    snprintf(message, sizeof message, "rank %d saw no file", lowest);
    snprintf(hint, sizeof hint, "Ask rank %d.", lowest);
    expect(status == (lowest % 2 ? FG_STATUS_FILE_ACCESS : FG_STATUS_FILE_FORMAT));
    expect(strcmp(fg_context_message(us.context), message) == 0);
    expect(strcmp(fg_context_hint(us.context), hint) == 0);
    fg_context_clear(us.context);
  }
  end_together();
}

/* Ctrl-C reaches some ranks; the last of the others has something better to say. */
static void a_stop_gives_way_to_a_failure(void **state)
{
  (void)state;
  bool last = us.ranks->rank == us.ranks->count - 1;
  fg_status status =
      last ? fg__fail(us.context, FG_STATUS_MEMORY, "no memory on the last rank")
           : fg__fail(us.context, FG_STATUS_STOPPED, "stopped on request");
  expect(fg__ranks_agree(us.ranks, us.context, status) == FG_STATUS_MEMORY);
  expect(strcmp(fg_context_message(us.context), "no memory on the last rank") == 0);
  fg_context_clear(us.context);
  status = last ? FG_STATUS_STOPPED : FG_STATUS_OK;
  expect(fg__ranks_agree(us.ranks, us.context, status) == FG_STATUS_STOPPED);
  end_together();
}

/* A rank's bytes as rank 0 should see them: its number, then a pattern. */
static unsigned char byte_of(int rank, size_t n)
{
  return (unsigned char)(n ? n * 31 % 251 + (size_t)rank : (size_t)rank);
}

/* What should come next. */
typedef struct expected {
  const size_t *counts;
  int rank;
  size_t at;
} expected;

static void take_expected(void *closure, const unsigned char *bytes, size_t count)
{
  expected *e = closure;
  for (size_t n = 0; n < count; ++n) {
    while (e->rank < us.ranks->count && e->at == e->counts[e->rank]) {
      ++e->rank;
      e->at = 0;
    }
    expect(e->rank < us.ranks->count && bytes[n] == byte_of(e->rank, e->at));
    ++e->at;
  }
}

/* Lengths round those of the pieces, and none. */
static void bytes_come_in_the_order_of_ranks(void **state)
{
  (void)state;
  static const size_t lengths[] = {0, 5, 65535, 65536, 65537, 200000, 131072};
  for (int shift = 0; shift < 7; ++shift) {
    size_t counts[64] = {0};
    for (int r = 0; r < us.ranks->count; ++r)
      counts[r] = lengths[(r * 2 + shift) % 7];
    size_t count = counts[us.ranks->rank];
    unsigned char *own = allocate_or_end(count, 1);
    for (size_t n = 0; n < count; ++n)
      own[n] = byte_of(us.ranks->rank, n);
    expected e = {.counts = counts};
    fg__ranks_pass(us.ranks, own, count, take_expected, &e);
    while (e.rank < us.ranks->count && e.at == counts[e.rank]) {
      ++e.rank;
      e.at = 0;
    }
    expect(us.ranks->rank > 0 || e.rank == us.ranks->count);
    free(own);
  }
  end_together();
}

static void a_rank_alone_asks_nobody(void **state)
{
  (void)state;
  const fg__ranks *alone = &fg__single_rank;
  expect(alone->rank == 0 && alone->count == 1);
  if (us.ranks->rank == 0) { /* would hang if it waited for the others */
    uint64_t sum = 3;
    fg__ranks_add(alone, &sum, 1);
    expect(sum == 3);
    expect(fg__ranks_agree(alone, us.context, FG_STATUS_MPI) == FG_STATUS_MPI);
  }
  end_together();
}

static void a_context_without_a_communicator_is_alone(void **state)
{
  (void)state;
  fg_context *context;
  int rank = 7, count = 7;
  fg_ranks(NULL, &rank, &count);
  expect(rank == 0 && count == 1);
  expect(fg_context_create(&context) == FG_STATUS_OK);
  rank = count = 7;
  fg_ranks(context, &rank, &count);
  expect(rank == 0 && count == 1);
  fg_context_destroy(context);
  fg_ranks(us.context, &rank, &count);
  expect(rank == us.ranks->rank && count == us.ranks->count);
  end_together();
}

static void no_communicator_and_a_second_one_are_refused(void **state)
{
  (void)state;
  fg_context *context;
  expect(fg_context_set_communicator(NULL, MPI_COMM_WORLD) == FG_STATUS_ARGUMENT);
  expect(fg_context_create(&context) == FG_STATUS_OK);
  expect(fg_context_set_communicator(context, MPI_COMM_NULL) == FG_STATUS_ARGUMENT);
  fg_context_destroy(context);
  fg_context_clear(us.context);
  if (us.ranks->count > 1 || !is_launched())
    expect(fg_context_set_communicator(us.context, MPI_COMM_WORLD) == FG_STATUS_ARGUMENT);
  expect(strstr(fg_context_message(us.context), "ranks: ") != NULL ||
         us.ranks->count == 1);
  end_together();
}

/* The first rank by itself, the others together: what they exchange stays among them. */
static void a_communicator_may_be_a_part_of_all(void **state)
{
  (void)state;
  if (is_launched()) {
    MPI_Comm part;
    fg_context *context;
    int rank, count, first = us.ranks->rank == 0;
    MPI_Comm_split(MPI_COMM_WORLD, first, 0, &part);
    expect(fg_context_create(&context) == FG_STATUS_OK);
    expect(fg_context_set_communicator(context, part) == FG_STATUS_OK);
    MPI_Comm_free(&part); /* the context has its own */
    fg_ranks(context, &rank, &count);
    expect(count == (first ? 1 : us.ranks->count - 1));
    expect(rank == (first ? 0 : us.ranks->rank - 1));
    uint64_t sum = (uint64_t)us.ranks->rank + 1, whole = 1;
    fg__ranks_add(fg__ranks_of(context), &sum, 1);
    for (int r = 1; r < us.ranks->count && !first; ++r)
      whole = r == 1 ? 2 : whole + (uint64_t)r + 1;
    expect(sum == whole);
    fg_context_destroy(context);
  }
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(sums_are_the_same_as_one_rank_alone_gives),
      TOGETHER(words_are_combined_bit_by_bit),
      TOGETHER(the_greatest_is_found_wherever_it_is),
      TOGETHER(a_number_is_alike_or_not),
      TOGETHER(no_failure_is_none),
      TOGETHER(all_end_with_the_lowest_rank_s_failure),
      TOGETHER(a_stop_gives_way_to_a_failure),
      TOGETHER(bytes_come_in_the_order_of_ranks),
      TOGETHER(a_rank_alone_asks_nobody),
      TOGETHER(a_context_without_a_communicator_is_alone),
      TOGETHER(no_communicator_and_a_second_one_are_refused),
      TOGETHER(a_communicator_may_be_a_part_of_all),
  };
  return cmocka_run_group_tests_name("grid/ranks", tests, NULL, NULL);
}
