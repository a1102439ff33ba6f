#include "launch.h"

#include <stdlib.h>

#include "program.h"

/* The number of processes according to the launcher's environment variables. */
static int launched(void)
{
  static const char *const names[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
  for (size_t n = 0; n < sizeof names / sizeof *names; ++n) {
    const char *count = getenv(names[n]);
    if (count)
      return atoi(count);
  }
  return 1;
}

/* Refuses several processes: without MPI each would write the same results. */
int launch_start(void)
{
  if (launched() <= 1)
    return EXIT_DONE;
  complain("one of %d processes: this build has no MPI (FLOWGRAIN_MPI=OFF)", launched());
  return EXIT_FAILED;
}

void launch_end(void)
{
}

fg_status launch_share(fg_context *context)
{
  (void)context;
  return FG_STATUS_OK;
}
