#include "launch.h"

#include <stdlib.h>
#include <string.h>

#include "flowgrain/mpi.h"
#include "program.h"

static bool started;

/* Launchers set environment variables. */
static bool is_launched(void)
{
  return getenv("OMPI_COMM_WORLD_SIZE") || getenv("PMI_SIZE") || getenv("PMIX_RANK");
}

/* Whether all ranks are on this machine. */
static bool is_local(void)
{
  const char *all_ranks = getenv("OMPI_COMM_WORLD_SIZE");
  const char *local = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  return all_ranks && local && strcmp(all_ranks, local) == 0;
}

/* Selects Open MPI's transports for a single machine, unless the user has set them.
 * Without the search for networks two ranks start in 0.2 s instead of 0.43 on a busy
 * machine. TCP costs nothing, and is used where shared memory is too small. */
static void settle_for_one_machine(void)
{
  if (!is_local())
    return;
  setenv("OMPI_MCA_btl", "self,vader,tcp", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
}

/* Open MPI 4.1 takes 171 MB of address space to start on 2 ranks, 180 MB on 4. With less
 * a rank hangs there, and so do the others. */
static size_t bytes_to_start(void)
{
  static const size_t own = (size_t)192 << 20, a_rank = (size_t)5 << 20;
  const char *ranks = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  int count = ranks ? atoi(ranks) : 1;
  return own + a_rank * (size_t)(count > 0 ? count : 1);
}

static bool can_have(size_t bytes)
{
  void *block = calloc(bytes, 1); /* memory is not touched */
  bool had = block != NULL;
  free(block);
  return had;
}

int launch_start(void)
{
  if (!is_launched())
    return EXIT_DONE;
  if (!can_have(bytes_to_start())) {
    complain("out of memory: %zu bytes for the start of MPI", bytes_to_start());
    return EXIT_FAILED;
  }
  settle_for_one_machine();
  int provided, error = MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
  if (error != MPI_SUCCESS) {
    complain("MPI_Init failed with error %d", error);
    return EXIT_FAILED;
  }
  started = true;
  return EXIT_DONE;
}

void launch_end(void)
{
  if (started)
    MPI_Finalize();
  started = false;
}

fg_status launch_share(fg_context *context)
{
  return started ? fg_context_set_communicator(context, MPI_COMM_WORLD) : FG_STATUS_OK;
}
