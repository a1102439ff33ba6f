/* Teams in a build without threads (FLOWGRAIN_THREADS=OFF): the caller alone. */
#include "base/team.h"

fg_status fg__team_create(fg__team **out, fg_context *context, int members)
{
  (void)context;
  (void)members;
  *out = NULL;
  return FG_STATUS_OK;
}

void fg__team_destroy(fg__team *team)
{
  (void)team;
}

int fg__team_members(const fg__team *team)
{
  (void)team;
  return 1;
}

void fg__team_run(fg__team *team, fg__team_work *work, void *argument)
{
  (void)team;
  fg__share alone = fg__alone();
  work(argument, &alone);
}

void fg__team_barrier(const fg__share *share)
{
  (void)share;
}
