#include "base/team.h"

void fg__team_meet(const fg__share *share, unsigned occasion)
{
  if (!share->team && share->meet)
    share->meet(share->argument, occasion);
  else
    fg__team_barrier(share);
}

void fg__team_part(const fg__share *share, int count, int multiple, int *begin, int *end)
{
  int64_t units = ((int64_t)count + multiple - 1) / multiple;
  *begin = (int)(units * share->member / share->members) * multiple;
  *end = (int)(units * (share->member + 1) / share->members) * multiple;
  if (*end > count)
    *end = count;
}
