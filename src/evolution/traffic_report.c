#include <stdint.h>
#include <string.h>

#include "evolution/evolution.h"

enum { NUMBERS = sizeof(fg_traffic) / sizeof(double), ALL = FG_ACTIVITIES * NUMBERS };

void fg_evolution_traffic(const fg_evolution *evolution, fg_traffic mean[],
                          fg_traffic greatest[])
{
  const fg__ranks *ranks = evolution->ranks;
  double most[ALL] = {0.0}, number[ALL] = {0.0};
  uint64_t sum[ALL];
  /* a copy: the calls below are counted too */
  if (ranks->book)
    memcpy(most, ranks->book->of, sizeof most);
  for (int n = 0; n < ALL; ++n)
    sum[n] = (uint64_t)most[n];
  fg__ranks_add(ranks, sum, ALL);
  fg__ranks_greatest(ranks, most, ALL);
  for (int n = 0; n < ALL; ++n)
    number[n] = (double)sum[n] / ranks->count;
  memcpy(mean, number, sizeof number);
  memcpy(greatest, most, sizeof most);
}
