#include "base/context_test.h"
#include "base/threads.h"

enum { MEMBERS = 3, COUNT = 1001, ROUNDS = 200 };

typedef struct sums {
  int value[COUNT];
  long total[MEMBERS];
} sums;

/* Each thread writes its part, then reads all of it: wrong without the barrier. */
static void fill_and_add(void *argument, const fg__thread *thread)
{
  sums *s = argument;
  int begin, end;
  fg__threads_range(thread, COUNT, 2, &begin, &end);
  for (int n = begin; n < end; ++n)
    ++s->value[n];
  fg__threads_exchange(thread, 1);
  long total = 0;
  for (int n = 0; n < COUNT; ++n)
    total += s->value[n];
  s->total[thread->index] += total;
  fg__threads_barrier(thread);
}

static void members_see_what_others_wrote(void **state)
{
  (void)state;
  fg__threads *threads;
  assert_int_equal(fg__threads_create(&threads, NULL, MEMBERS), FG_STATUS_OK);
  sums s = {{0}, {0}};
  for (int round = 0; round < ROUNDS; ++round)
    fg__threads_run(threads, fill_and_add, &s);
  fg__threads_destroy(threads);
  long expected = (long)COUNT * ROUNDS * (ROUNDS + 1) / 2;
  for (int n = 0; n < COUNT; ++n)
    assert_int_equal(s.value[n], ROUNDS);
  for (int m = 0; m < MEMBERS; ++m)
    assert_int_equal(s.total[m], expected);
}

static void one_member_needs_no_thread(void **state)
{
  (void)state;
  fg__threads *threads = (fg__threads *)1;
  assert_int_equal(fg__threads_create(&threads, NULL, 1), FG_STATUS_OK);
  assert_null(threads);
  sums s = {{0}, {0}};
  fg__threads_run(threads, fill_and_add, &s);
  assert_int_equal(s.total[0], COUNT);
  fg__threads_destroy(threads);
}

static void count_occasions(void *argument, unsigned occasion)
{
  unsigned *seen = argument;
  *seen = 10 * *seen + occasion;
}

/* A single thread calls its exchange, and not at barriers; without anybody to
 * meet it goes on. */
static void a_single_thread_calls_its_exchange(void **state)
{
  (void)state;
  unsigned seen = 0;
  fg__thread thread = {.count = 1, .exchange = count_occasions, .argument = &seen};
  fg__threads_exchange(&thread, 3);
  fg__threads_barrier(&thread);
  fg__threads_exchange(&thread, 5);
  assert_int_equal(seen, 35);
  fg__thread alone = fg__single_thread();
  fg__threads_exchange(&alone, 3);
}

static void threads_may_end_without_work(void **state)
{
  (void)state;
  fg__threads *threads;
  assert_int_equal(fg__threads_create(&threads, NULL, MEMBERS), FG_STATUS_OK);
  fg__threads_destroy(threads);
}

static void parts_cover_all_once(void **state)
{
  (void)state;
  for (int thread_count = 1; thread_count < 9; ++thread_count)
    for (int count = 0; count < 40; ++count) {
      int next = 0;
      for (int index = 0; index < thread_count; ++index) {
        fg__thread thread = {.index = index, .count = thread_count};
        int begin, end;
        fg__threads_range(&thread, count, 2, &begin, &end);
        if (begin < end) {
          assert_int_equal(begin, next);
          assert_int_equal(begin % 2, 0);
          next = end;
        }
      }
      assert_int_equal(next, count);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(members_see_what_others_wrote),
      cmocka_unit_test(one_member_needs_no_thread),
      cmocka_unit_test(a_single_thread_calls_its_exchange),
      cmocka_unit_test(threads_may_end_without_work),
      cmocka_unit_test(parts_cover_all_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
