#include "grid/ranks.h"

#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/communicator.h"

#undef fg__ranks_agree /* for the analyzer also a macro */

static pthread_once_t once = PTHREAD_ONCE_INIT;
static int start_error;
static size_t missing; /* bytes, for want of which MPI was not started */
static fg__ranks all, alone;
const fg__ranks fg__single_rank = {.count = 1};
static fg__traffic_book book_of_all;
static MPI_Comm communicator_of_all = MPI_COMM_NULL;

static void finalise(void)
{
  int done = 0;
  MPI_Finalized(&done);
  if (done)
    return;
  MPI_Comm_free(&communicator_of_all);
  MPI_Finalize();
}

/* A launcher announces itself in the environment. */
static bool is_launched(void)
{
  return getenv("OMPI_COMM_WORLD_SIZE") || getenv("PMI_SIZE") || getenv("PMIX_RANK");
}

/* Whether all that were launched run on this machine. */
static bool is_local(void)
{
  const char *all_ranks = getenv("OMPI_COMM_WORLD_SIZE");
  const char *local = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  return all_ranks && local && strcmp(all_ranks, local) == 0;
}

/* On one machine no network is needed, and not to look for one saves Open MPI most of
 * MPI_Init: 0.3 s become 0.03 s for a process on its own; two under mpirun started in 0.2
 * s instead of 0.43 on a busy machine. TCP costs nothing, and serves where there is no
 * room for shared memory. What the user has set stays.
 *
 * Processes on their own share one session folder in TMPDIR, which each removes at its
 * end: of 160 short runs, 8 at a time, 6 failed in MPI_Init because another had just
 * removed it. A process on its own keeps nothing there, and gets none. */
static void settle_for_one_machine(void)
{
  if (is_launched() && !is_local())
    return;
  setenv("OMPI_MCA_btl", is_launched() ? "self,vader,tcp" : "self", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  if (!is_launched()) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
}

/* Open MPI 4.1 takes 171 MB of address space to start on 2 ranks, 180 MB on 4; with some
 * of it a rank hangs there, and the others with it. */
static size_t bytes_to_start(void)
{
  static const size_t own = (size_t)192 << 20, a_rank = (size_t)5 << 20;
  const char *ranks = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  int count = ranks ? atoi(ranks) : 1;
  return own + a_rank * (size_t)(count > 0 ? count : 1);
}

static bool can_have(size_t bytes)
{
  void *room = fg__allocate(bytes, 1); /* never touched */
  bool had = room != NULL;
  free(room);
  return had;
}

static void start(void)
{
  int running = 0;
  MPI_Initialized(&running);
  if (!running) {
    if (is_launched() && !can_have(bytes_to_start())) {
      missing = bytes_to_start();
      return;
    }
    settle_for_one_machine();
    int provided;
    start_error = MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
    if (start_error != MPI_SUCCESS)
      return;
    atexit(finalise);
  }
  start_error = MPI_Comm_dup(MPI_COMM_WORLD, &communicator_of_all);
  if (start_error != MPI_SUCCESS)
    return;
  MPI_Comm_set_errhandler(communicator_of_all, MPI_ERRORS_ARE_FATAL);
  MPI_Comm_rank(communicator_of_all, &all.rank);
  MPI_Comm_size(communicator_of_all, &all.count);
  if (all.count > 1)
    all.book = &book_of_all;
  alone.count = 1;
}

static fg_status started(fg_context *context)
{
  pthread_once(&once, start);
  if (missing)
    return fg__fail_memory(context, "the start of MPI", missing);
  if (start_error != MPI_SUCCESS)
    return fg__fail(context, FG_STATUS_MPI, "MPI_Init failed with error %d", start_error);
  return FG_STATUS_OK;
}

fg_status fg__ranks_all(const fg__ranks **out, fg_context *context)
{
  fg_status status = started(context);
  *out = status ? NULL : &all;
  return status;
}

fg_status fg__ranks_alone(const fg__ranks **out, fg_context *context)
{
  fg_status status = started(context);
  *out = status ? NULL : &alone;
  return status;
}

MPI_Comm fg__communicator(const fg__ranks *ranks)
{
  return ranks == &all ? communicator_of_all : MPI_COMM_SELF;
}

void fg__ranks_add(const fg__ranks *ranks, uint64_t *sum, int count)
{
  if (ranks->count == 1)
    return;
  fg__traffic_add_reduction(ranks->book, (size_t)count * sizeof *sum);
  /* unsigned: wraps round as the sums are meant to */
  MPI_Allreduce(MPI_IN_PLACE, sum, count, MPI_UINT64_T, MPI_SUM, fg__communicator(ranks));
}

void fg__ranks_combine(const fg__ranks *ranks, uint32_t *word, int count)
{
  if (ranks->count == 1)
    return;
  fg__traffic_add_reduction(ranks->book, (size_t)count * sizeof *word);
  MPI_Allreduce(MPI_IN_PLACE, word, count, MPI_UINT32_T, MPI_BXOR,
                fg__communicator(ranks));
}

void fg__ranks_greatest(const fg__ranks *ranks, double *value, int count)
{
  if (ranks->count == 1)
    return;
  fg__traffic_add_reduction(ranks->book, (size_t)count * sizeof *value);
  MPI_Allreduce(MPI_IN_PLACE, value, count, MPI_DOUBLE, MPI_MAX, fg__communicator(ranks));
}

bool fg__ranks_alike(const fg__ranks *ranks, uint64_t number)
{
  if (ranks->count == 1)
    return true;
  uint64_t ends[] = {number, ~number}; /* the greatest complement is the least's */
  fg__traffic_add_reduction(ranks->book, sizeof ends);
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_UINT64_T, MPI_MAX, fg__communicator(ranks));
  return ends[0] == ~ends[1];
}

enum { PIECE_BYTES = 1 << 16 };

static void take_pieces(const unsigned char *bytes, size_t count, fg__taker *take,
                        void *closure)
{
  for (size_t at = 0; at < count; at += PIECE_BYTES)
    take(closure, bytes + at, count - at < PIECE_BYTES ? count - at : PIECE_BYTES);
}

void fg__ranks_pass(const fg__ranks *ranks, const void *bytes, size_t count,
                    fg__taker *take, void *closure)
{
  enum { TAG = 1 };
  unsigned char piece[PIECE_BYTES];
  const unsigned char *own = bytes ? bytes : piece;
  if (ranks->rank > 0) {
    for (size_t at = 0; at <= count; at += PIECE_BYTES) { /* a short one ends them */
      size_t bytes_now = count - at < PIECE_BYTES ? count - at : PIECE_BYTES;
      fg__traffic_add_message(ranks->book, bytes_now);
      MPI_Ssend(own + at, (int)bytes_now, MPI_BYTE, 0, TAG, fg__communicator(ranks));
    }
    return;
  }
  take_pieces(own, count, take, closure);
  for (int r = 1; r < ranks->count; ++r)
    for (int received = PIECE_BYTES; received == PIECE_BYTES;) {
      MPI_Status about;
      MPI_Recv(piece, PIECE_BYTES, MPI_BYTE, r, TAG, fg__communicator(ranks), &about);
      MPI_Get_count(&about, MPI_BYTE, &received);
      if (received > 0)
        take(closure, piece, (size_t)received);
    }
}

/* Replaces what the context holds by what it holds on rank `from`. */
static void spread_message(const fg__ranks *ranks, fg_context *context, fg_status status,
                           int from)
{
  enum { TEXT_BYTES = 2048 };
  char text[2][TEXT_BYTES] = {{0}};
  if (ranks->rank == from) {
    snprintf(text[0], TEXT_BYTES, "%s", fg_context_message(context));
    snprintf(text[1], TEXT_BYTES, "%s", fg_context_hint(context));
  }
  MPI_Bcast(text, sizeof text, MPI_CHAR, from, fg__communicator(ranks));
  fg_context_clear(context);
  fg__fail(context, status, "%s", text[0]);
  if (text[1][0])
    fg__hint(context, "%s", text[1]);
}

fg_status fg__ranks_agree(const fg__ranks *ranks, fg_context *context, fg_status status)
{
  if (ranks->count == 1)
    return status;
  int order = status == FG_STATUS_OK        ? INT_MAX
              : status == FG_STATUS_STOPPED ? ranks->count + ranks->rank
                                            : ranks->rank;
  int first[2] = {order, (int)status}; /* MPI_2INT: the least order and its status */
  fg__traffic_add_reduction(ranks->book, sizeof first);
  MPI_Allreduce(MPI_IN_PLACE, first, 1, MPI_2INT, MPI_MINLOC, fg__communicator(ranks));
  if (first[0] == INT_MAX)
    return FG_STATUS_OK;
  spread_message(ranks, context, (fg_status)first[1], first[0] % ranks->count);
  return (fg_status)first[1];
}

/* Whether there can be more than this rank. MPI may have been started by the program. */
static bool may_have_company(void)
{
  int running = 0;
  MPI_Initialized(&running);
  return running || is_launched();
}

fg_status fg_ranks(fg_context *context, int *rank, int *count)
{
  *rank = 0;
  *count = 1;
  if (!may_have_company())
    return FG_STATUS_OK;
  const fg__ranks *ranks;
  fg_status status = fg__ranks_all(&ranks, context);
  if (!status) {
    *rank = ranks->rank;
    *count = ranks->count;
  }
  return status;
}

fg_status fg_ranks_agree(fg_context *context, fg_status status, const char *message,
                         const char *hint)
{
  if (status && message) {
    fg_context_clear(context);
    fg__fail(context, status, "%s", message);
    if (hint)
      fg__hint(context, "%s", hint);
  }
  if (!may_have_company())
    return status;
  const fg__ranks *ranks;
  fg_status started_status = fg__ranks_all(&ranks, context);
  return started_status ? started_status : fg__ranks_agree(ranks, context, status);
}
