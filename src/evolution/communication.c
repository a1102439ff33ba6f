#include <stdint.h>
#include <string.h>

#include "evolution/evolution.h"

enum { NUMBERS = sizeof(fg_communication) / sizeof(double), ALL = FG_PHASES * NUMBERS };

void fg_evolution_communication(const fg_evolution *evolution,
                                fg_communication mean[FG_PHASES],
                                fg_communication greatest[FG_PHASES])
{
  const fg__ranks *ranks = evolution->ranks;
  double most[ALL] = {0.0}, number[ALL] = {0.0};
  uint64_t sum[ALL];
  /* a copy: the calls below are counted too */
  if (ranks->counters)
    memcpy(most, ranks->counters->of, sizeof most);
  for (int n = 0; n < ALL; ++n)
    sum[n] = (uint64_t)most[n];
  fg__ranks_add(ranks, sum, ALL);
  fg__ranks_greatest(ranks, most, ALL);
  for (int n = 0; n < ALL; ++n)
    number[n] = (double)sum[n] / ranks->count;
  memcpy(mean, number, sizeof number);
  memcpy(greatest, most, sizeof most);
}
