#include "base/context_test.h"
#include "base/team.h"

enum { MEMBERS = 3, COUNT = 1001, ROUNDS = 200 };

typedef struct sums {
  int value[COUNT];
  long total[MEMBERS];
} sums;

/* Each member writes its part, then reads all of it: wrong without the barrier. */
static void fill_and_add(void *argument, const fg__share *share)
{
  sums *s = argument;
  int begin, end;
  fg__team_part(share, COUNT, 2, &begin, &end);
  for (int n = begin; n < end; ++n)
    ++s->value[n];
  fg__team_meet(share, 1);
  long total = 0;
  for (int n = 0; n < COUNT; ++n)
    total += s->value[n];
  s->total[share->member] += total;
  fg__team_barrier(share);
}

static void members_see_what_others_wrote(void **state)
{
  (void)state;
  fg__team *team;
  assert_int_equal(fg__team_create(&team, NULL, MEMBERS), FG_STATUS_OK);
  sums s = {{0}, {0}};
  for (int round = 0; round < ROUNDS; ++round)
    fg__team_run(team, fill_and_add, &s);
  fg__team_destroy(team);
  long expected = (long)COUNT * ROUNDS * (ROUNDS + 1) / 2;
  for (int n = 0; n < COUNT; ++n)
    assert_int_equal(s.value[n], ROUNDS);
  for (int m = 0; m < MEMBERS; ++m)
    assert_int_equal(s.total[m], expected);
}

static void one_member_needs_no_thread(void **state)
{
  (void)state;
  fg__team *team = (fg__team *)1;
  assert_int_equal(fg__team_create(&team, NULL, 1), FG_STATUS_OK);
  assert_null(team);
  sums s = {{0}, {0}};
  fg__team_run(team, fill_and_add, &s);
  assert_int_equal(s.total[0], COUNT);
  fg__team_destroy(team);
}

static void count_occasions(void *argument, unsigned occasion)
{
  unsigned *seen = argument;
  *seen = 10 * *seen + occasion;
}

/* Whom a member on its own meets hears of meetings, not of barriers; without anybody to
 * meet it goes on. */
static void one_member_meets_whom_its_share_says(void **state)
{
  (void)state;
  unsigned seen = 0;
  fg__share share = {.members = 1, .meet = count_occasions, .argument = &seen};
  fg__team_meet(&share, 3);
  fg__team_barrier(&share);
  fg__team_meet(&share, 5);
  assert_int_equal(seen, 35);
  fg__share alone = fg__alone();
  fg__team_meet(&alone, 3);
}

static void a_team_may_end_without_work(void **state)
{
  (void)state;
  fg__team *team;
  assert_int_equal(fg__team_create(&team, NULL, MEMBERS), FG_STATUS_OK);
  fg__team_destroy(team);
}

static void parts_cover_all_once(void **state)
{
  (void)state;
  for (int members = 1; members < 9; ++members)
    for (int count = 0; count < 40; ++count) {
      int next = 0;
      for (int member = 0; member < members; ++member) {
        fg__share share = {.member = member, .members = members};
        int begin, end;
        fg__team_part(&share, count, 2, &begin, &end);
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
      cmocka_unit_test(one_member_meets_whom_its_share_says),
      cmocka_unit_test(a_team_may_end_without_work),
      cmocka_unit_test(parts_cover_all_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
