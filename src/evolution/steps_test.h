/* Steps of an evolution that ranks take together, for tests. */
#ifndef FG__STEPS_TEST_H
#define FG__STEPS_TEST_H

#include "grid/together_test.h"

#include <string.h>

#include "evolution/evolution.h"

static inline fg_step advance(fg_evolution *e, int steps)
{
  fg_step step = {0};
  for (int n = 0; n < steps; ++n)
    expect(fg_evolution_step(e, &step) == FG_STATUS_OK);
  return step;
}

static inline bool same_number(double a, double b)
{
  return memcmp(&a, &b, sizeof a) == 0;
}

static inline void expect_same(const fg_step *a, const fg_step *b)
{
  expect(a->step == b->step);
  expect(same_number(a->time, b->time));
  expect(same_number(a->tau, b->tau));
  expect(same_number(a->energy, b->energy));
  expect(same_number(a->mass, b->mass));
  expect(same_number(a->increment, b->increment));
  expect(same_number(a->area_fraction, b->area_fraction));
  expect(a->clusters == b->clusters);
  expect(a->cells == b->cells);
}

/* Steps that all have taken together are the same on all. */
static inline void expect_alike(const fg_step *step)
{
  const double numbers[] = {
      step->time, step->tau,           step->energy,          step->increment,
      step->mass, step->area_fraction, (double)step->clusters};
  for (size_t n = 0; n < sizeof numbers / sizeof *numbers; ++n) {
    uint64_t bits;
    memcpy(&bits, &numbers[n], sizeof bits);
    expect(fg__ranks_alike(us.ranks, bits));
  }
}

#endif
