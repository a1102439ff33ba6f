/* Tests that several ranks run together, by mpirun. A check that fails on one rank must
 * not end the case there, or the others wait for its messages: faults are counted, and
 * all ranks fail together at the end of a case. Rank 0 reports. */
#ifndef FG__TOGETHER_TEST_H
#define FG__TOGETHER_TEST_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/context_test.h"
#include "flowgrain/mpi.h"
#include "grid/ranks.h"

typedef struct together {
  fg_context *context, *every_case;
  const fg__ranks *ranks; /* of the context, between cases of every_case */
  int faults;
} together;

static together us;

#define expect(condition)                                                                \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      if (us.faults++ < 5)                                                               \
        fprintf(stderr, "%s:%d: rank %d of %d: not true: %s\n", __FILE__, __LINE__,      \
                us.ranks->rank, us.ranks->count, #condition);                            \
    }                                                                                    \
  } while (0)

/* Without a launcher there is one rank, which needs no MPI. */
static inline bool is_launched(void)
{
  return getenv("OMPI_COMM_WORLD_SIZE") || getenv("PMI_SIZE") || getenv("PMIX_RANK");
}

static inline int together_set_up(void **state)
{
  (void)state;
  us.faults = 0;
  if (fg_context_create(&us.context) != FG_STATUS_OK)
    return 1;
  if (is_launched() &&
      fg_context_set_communicator(us.context, MPI_COMM_WORLD) != FG_STATUS_OK)
    return 1;
  us.ranks = fg__ranks_of(us.context);
  return 0;
}

static inline int together_tear_down(void **state)
{
  (void)state;
  us.ranks = fg__ranks_of(us.every_case);
  fg_context_destroy(us.context);
  return 0;
}

/* The last statement of a case. */
static inline void end_together(void)
{
  uint64_t faults = (uint64_t)us.faults;
  fg__ranks_add(us.ranks, &faults, 1);
  assert_int_equal(faults, 0);
}

/* Without memory nothing can be said of the others. */
static inline void *allocate_or_end(size_t count, size_t size)
{
  void *memory = calloc(count ? count : 1, size);
  if (!memory)
    abort();
  return memory;
}

/* A name for a folder, the same on all ranks, that no other test has; where nothing has
 * to be brought to a disk, if there is such a place. */
static inline void name_folder(char *out, size_t room)
{
  uint64_t process = us.ranks->rank == 0 ? (uint64_t)getpid() : 0;
  fg__ranks_add(us.ranks, &process, 1);
  snprintf(out, room, "%s/flowgrain-together-%llu",
           access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp",
           (unsigned long long)process);
}

static void end_all(void)
{
  fg_context_destroy(us.every_case);
  if (is_launched())
    MPI_Finalize();
}

static inline void start_together(void)
{
  int provided;
  if (is_launched() && MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided))
    abort();
  if (together_set_up(NULL))
    abort();
  us.every_case = us.context;
  atexit(end_all);
  if (us.ranks->rank != 0 && !freopen("/dev/null", "w", stdout))
    abort();
}

#define TOGETHER(name)                                                                   \
  cmocka_unit_test_setup_teardown(name, together_set_up, together_tear_down)

#endif
