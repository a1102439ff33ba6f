/* What an evolution says its ranks told each other. */
#include "grid/together_test.h"

#include <math.h>

#include "flowgrain/flowgrain.h"

/* Totals over ranks; ranks do not have equally many neighbours. */
typedef struct report {
  fg_communication mean[FG_PHASES], most[FG_PHASES];
} report;

static report report_of(const fg_evolution *evolution)
{
  report out = {0};
  fg_evolution_communication(evolution, out.mean, out.most);
  return out;
}

static fg_evolution *evolve(const char *name, int nodes)
{
  fg_field *field;
  fg_evolution *out;
  expect(fg_field_create_analytic(&field, us.context, name, 33) == FG_STATUS_OK);
  const fg_evolution_options options = {.nodes = nodes, .threads = 1};
  expect(fg_evolution_create(&out, us.context, field, &options) == FG_STATUS_OK);
  fg_field_destroy(field);
  return out;
}

/* Takes steps and returns how many cycles they needed. */
static int take_steps(fg_evolution *evolution, int count)
{
  int cycles = 0;
  fg_step step = {0};
  for (int n = 0; n < count; ++n) {
    expect(fg_evolution_step(evolution, &step) == FG_STATUS_OK);
    cycles += step.cycles;
  }
  return cycles;
}

static bool between(double low, double value, double high)
{
  return low < value && value <= high;
}

/* Means over ranks are quotients. */
static bool equal(double a, double b)
{
  return fabs(a - b) <= 1e-12 * fabs(a);
}

static void check_report(const char *name, int nodes)
{
  enum { FIRST = 3, SECOND = 5 };
  fg_evolution *evolution = evolve(name, nodes);
  report start = report_of(evolution);
  int few = take_steps(evolution, FIRST);
  report middle = report_of(evolution);
  int more = take_steps(evolution, SECOND);
  report end = report_of(evolution);
  const fg_communication *a = &start.mean[FG_PHASE_CYCLES];
  const fg_communication *b = &middle.mean[FG_PHASE_CYCLES];
  const fg_communication *c = &end.mean[FG_PHASE_CYCLES];
  if (us.ranks->count == 1) {
    for (int n = 0; n < FG_PHASES; ++n)
      expect(end.most[n].times == 0.0 && end.most[n].bytes == 0.0 &&
             end.most[n].messages == 0.0 && end.most[n].reductions == 0.0 &&
             end.most[n].gathers == 0.0);
  } else {
    expect(end.mean[FG_PHASE_STEPS].times - start.mean[FG_PHASE_STEPS].times ==
           FIRST + SECOND);
    expect(b->times - a->times == few && c->times - b->times == more);
    /* every cycle sends the same */
    expect(equal((b->messages - a->messages) * more, (c->messages - b->messages) * few));
    expect(equal((b->bytes - a->bytes) * more, (c->bytes - b->bytes) * few));
    expect(between(0.0, c->messages, end.most[FG_PHASE_CYCLES].messages));
    expect(between(0.0, c->bytes, end.most[FG_PHASE_CYCLES].bytes));
    expect(between(0.0, c->gathered, end.most[FG_PHASE_CYCLES].gathered));
    expect(end.mean[FG_PHASE_STEPS].reductions > 0.0);
    expect(end.mean[FG_PHASE_COUNTING].reductions > 0.0);
  }
  fg_evolution_destroy(evolution);
}

static void every_cycle_sends_the_same(void **state)
{
  (void)state;
  check_report("vortex3", 65);
  check_report("vortex3d", 33);
  end_together();
}

int main(void)
{
  start_together();
  const struct CMUnitTest tests[] = {
      TOGETHER(every_cycle_sends_the_same),
  };
  return cmocka_run_group_tests_name("evolution/communication", tests, NULL, NULL);
}
