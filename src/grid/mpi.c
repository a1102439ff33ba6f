#include "flowgrain/mpi.h"

#include <stdlib.h>

#include "base/memory.h"
#include "grid/transport.h"

enum { TAG = 1 };

typedef struct mpi_group {
  MPI_Comm communicator; /* a copy, whose messages are the library's alone */
  fg__ranks ranks;
  fg__counters counters;
} mpi_group;

static MPI_Comm communicator_of(const void *group)
{
  return ((const mpi_group *)group)->communicator;
}

static void add(void *group, uint64_t *sum, int count)
{
  MPI_Allreduce(MPI_IN_PLACE, sum, count, MPI_UINT64_T, MPI_SUM, communicator_of(group));
}

static void combine(void *group, uint32_t *word, int count)
{
  MPI_Allreduce(MPI_IN_PLACE, word, count, MPI_UINT32_T, MPI_BXOR,
                communicator_of(group));
}

static void greatest(void *group, double *value, int count)
{
  MPI_Allreduce(MPI_IN_PLACE, value, count, MPI_DOUBLE, MPI_MAX, communicator_of(group));
}

static void greatest_word(void *group, uint64_t *word, int count)
{
  MPI_Allreduce(MPI_IN_PLACE, word, count, MPI_UINT64_T, MPI_MAX, communicator_of(group));
}

static void first(void *group, int pair[2])
{
  MPI_Allreduce(MPI_IN_PLACE, pair, 1, MPI_2INT, MPI_MINLOC, communicator_of(group));
}

static void broadcast(void *group, void *bytes, int count, int from)
{
  MPI_Bcast(bytes, count, MPI_BYTE, from, communicator_of(group));
}

static void send_bytes(void *group, const void *bytes, int count, int to)
{
  MPI_Ssend(bytes, count, MPI_BYTE, to, TAG, communicator_of(group));
}

static int receive_bytes(void *group, void *bytes, int most, int from)
{
  int count = 0;
  MPI_Status about;
  MPI_Recv(bytes, most, MPI_BYTE, from, TAG, communicator_of(group), &about);
  MPI_Get_count(&about, MPI_BYTE, &count);
  return count;
}

static int rank_or_null(int rank)
{
  return rank < 0 ? MPI_PROC_NULL : rank;
}

static void swap(void *group, int tag, int count, const float *sent, int to,
                 float *received, int from)
{
  MPI_Sendrecv(sent, count, MPI_FLOAT, rank_or_null(to), tag, received, count, MPI_FLOAT,
               rank_or_null(from), tag, communicator_of(group), MPI_STATUS_IGNORE);
}

static void gather(void *group, const float *sent, int sent_count, float *received,
                   const int counts[], const int offsets[])
{
  MPI_Allgatherv(sent, sent_count, MPI_FLOAT, received, counts, offsets, MPI_FLOAT,
                 communicator_of(group));
}

static void deal(void *group, size_t size, const void *sent, const int sent_counts[],
                 const int sent_offsets[], void *received, const int counts[],
                 const int offsets[])
{
  MPI_Datatype type;
  MPI_Type_contiguous((int)size, MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(sent, sent_counts, sent_offsets, type, received, counts, offsets, type,
                communicator_of(group));
  MPI_Type_free(&type);
}

static void begin_send(void *group, void *requests, int n, const float *sent, int count,
                       int to)
{
  MPI_Request *request = (MPI_Request *)requests + n;
  *request = MPI_REQUEST_NULL;
  if (count > 0)
    MPI_Isend(sent, count, MPI_FLOAT, to, TAG, communicator_of(group), request);
}

static void begin_receive(void *group, void *requests, int n, float *received, int count,
                          int from)
{
  MPI_Request *request = (MPI_Request *)requests + n;
  *request = MPI_REQUEST_NULL;
  if (count > 0)
    MPI_Irecv(received, count, MPI_FLOAT, from, TAG, communicator_of(group), request);
}

static void wait_for(void *requests, int count)
{
  MPI_Waitall(count, requests, MPI_STATUSES_IGNORE);
}

static void end_group(void *group)
{
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized)
    MPI_Comm_free(&((mpi_group *)group)->communicator);
  free(group);
}

static const fg__transport by_mpi = {.add = add,
                                     .combine = combine,
                                     .greatest = greatest,
                                     .greatest_word = greatest_word,
                                     .first = first,
                                     .broadcast = broadcast,
                                     .send = send_bytes,
                                     .receive = receive_bytes,
                                     .swap = swap,
                                     .gather = gather,
                                     .deal = deal,
                                     .request_size = sizeof(MPI_Request),
                                     .begin_send = begin_send,
                                     .begin_receive = begin_receive,
                                     .wait = wait_for,
                                     .end = end_group};

static bool is_running(void)
{
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized && !finalized;
}

static const char *what_is_wrong(const fg_context *context, MPI_Comm communicator)
{
  if (!context)
    return "no context";
  if (fg__context_shared(context))
    return "the context has a communicator already";
  if (!is_running())
    return "MPI is not initialised";
  return communicator == MPI_COMM_NULL ? "a null communicator" : NULL;
}

fg_status fg_context_set_communicator(fg_context *context, MPI_Comm communicator)
{
  const char *wrong = what_is_wrong(context, communicator);
  if (wrong)
    return fg__fail(context, FG_STATUS_ARGUMENT, "ranks: %s", wrong);
  int rank, count, lacking;
  MPI_Comm_size(communicator, &count);
  MPI_Comm_rank(communicator, &rank);
  if (count == 1)
    return FG_STATUS_OK;
  mpi_group *group = fg__allocate(1, sizeof *group);
  lacking = group == NULL; /* on any rank, so that all do the same */
  MPI_Allreduce(MPI_IN_PLACE, &lacking, 1, MPI_INT, MPI_MAX, communicator);
  if (!group || lacking) {
    free(group);
    return fg__fail_memory(context, "ranks", sizeof *group);
  }
  int error = MPI_Comm_dup(communicator, &group->communicator);
  if (error != MPI_SUCCESS) {
    free(group);
    return fg__fail(context, FG_STATUS_MPI, "MPI_Comm_dup failed with error %d", error);
  }
  MPI_Comm_set_errhandler(group->communicator, MPI_ERRORS_ARE_FATAL);
  group->ranks = (fg__ranks){.rank = rank,
                             .count = count,
                             .counters = &group->counters,
                             .transport = &by_mpi,
                             .group = group};
  fg__ranks_share(context, &group->ranks);
  return FG_STATUS_OK;
}
