/* What sharing a mesh costs: ghosts filled and messages sent on the ranks it is started
 * with (mpirun -n R bench_mesh), blocks and neighbours of many ranks by counting. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/memory.h"
#include "flowgrain/mpi.h"
#include "grid/blocks.h"
#include "grid/exchange/plan.h"
#include "grid/mesh.h"

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *take(size_t count, size_t size)
{
  void *memory = fg__allocate_aligned(count, size);
  if (!memory)
    abort();
  return memory;
}

static void check(fg_status status)
{
  if (status)
    abort();
}

/* Two arrays, all nodes; seconds an exchange, and what this rank sent. */
static void time_exchange(const fg__ranks *ranks, int dimension, int nodes)
{
  fg__mesh mesh;
  check(fg__mesh_create(&mesh, NULL,
                        &(fg__mesh_description){.dimension = dimension,
                                                .ranks = ranks,
                                                .side = {1.0, 1.0, 1.0},
                                                .nodes = nodes}));
  fg__exchange *exchange;
  check(fg__exchange_create(&exchange, NULL, &mesh.partition, 2));
  fg__layout layout = fg__layout_of(dimension, fg__own_block(&mesh.partition)->nodes);
  float *const arrays[2] = {
      (float *)take(layout.array_size, sizeof(float)) + layout.first,
      (float *)take(layout.array_size, sizeof(float)) + layout.first};
  enum { TIMES = 200 };
  fg__exchange_fill(exchange, 2, arrays, FG__ALL_COLOURS);
  fg__counters *counters = mesh.ranks->counters;
  fg_communication first = counters ? counters->of[counters->now] : (fg_communication){0};
  double start = now();
  for (int n = 0; n < TIMES; ++n)
    fg__exchange_fill(exchange, 2, arrays, FG__ALL_COLOURS);
  double seconds = (now() - start) / TIMES;
  fg_communication sent = counters ? counters->of[counters->now] : (fg_communication){0};
  double most[3] = {seconds * 1e6, (sent.messages - first.messages) / TIMES,
                    (sent.bytes - first.bytes) / TIMES};
  fg__ranks_greatest(mesh.ranks, most, 3);
  if (mesh.ranks->rank == 0)
    printf("%d ranks, %d nodes a side in %dD: an exchange of u and w takes %.0f us; at "
           "most %.0f messages, %.0f kB\n",
           mesh.ranks->count, nodes, dimension, most[0], most[1], most[2] / 1e3);
  fg__exchange_destroy(exchange);
  fg__mesh_clear(&mesh);
}

static void count_neighbours(int dimension, int nodes, int rank_count)
{
  double neighbours = 0.0, most_bytes = 0.0, plan_seconds = 0.0, asked = 0.0;
  fg__ranks ranks = {.count = rank_count};
  const int cells[3] = {nodes - 1, nodes - 1, dimension == 3 ? nodes - 1 : 1};
  const bool periodic[3] = {false, false, false};
  fg__blocks blocks;
  fg__partition level, coarse;
  check(fg__blocks_choose(&blocks, NULL, &ranks, dimension, cells, false));
  check(fg__partition_create(&level, NULL, &ranks, dimension, cells, periodic,
                             blocks.count, blocks.unit));
  check(fg__partition_copy(&coarse, NULL, &level));
  int workable = 0;
  for (; fg__partition_is_workable(&coarse, FG__LEAST_BLOCK_NODES); ++workable) {
    fg__partition next;
    check(fg__partition_coarsen(&next, NULL, &coarse));
    fg__partition_clear(&coarse);
    coarse = next;
  }
  for (int r = 0; r < rank_count; r += 37, ++asked) {
    ranks.rank = r;
    fg__exchange *exchange;
    double start = now(), bytes = 0.0;
    check(fg__exchange_create(&exchange, NULL, &level, 2));
    plan_seconds += now() - start;
    for (int n = 0; n < exchange->senders.count; ++n)
      bytes += 8.0 * (double)fg__neighbour_nodes(&exchange->senders.neighbour[n],
                                                 FG__ALL_COLOURS);
    neighbours += exchange->senders.count;
    most_bytes = fmax(most_bytes, bytes);
    fg__exchange_destroy(exchange);
  }
  printf("%d x %d ranks, %d nodes a side in %dD, units of %d: %.1f neighbours a rank, "
         "%.0f kB an exchange of u and w; plan in %.1f ms; %d shared levels, then "
         "%d x %d x %d nodes whole\n",
         blocks.count[1], blocks.count[2], nodes, dimension, blocks.unit,
         neighbours / asked, most_bytes / 1e3, plan_seconds / asked * 1e3, workable,
         coarse.nodes[0], coarse.nodes[1], coarse.nodes[2]);
  fg__partition_clear(&coarse);
  fg__partition_clear(&level);
}

int main(void)
{
  fg_context *context;
  MPI_Init(NULL, NULL);
  check(fg_context_create(&context));
  check(fg_context_set_communicator(context, MPI_COMM_WORLD));
  const fg__ranks *all = fg__ranks_of(context);
  time_exchange(all, 2, 1025);
  time_exchange(all, 3, 129);
  if (all->count == 1) {
    count_neighbours(2, 8193, 64);
    count_neighbours(2, 8193, 256);
    count_neighbours(2, 8193, 1000);
    count_neighbours(3, 1025, 64);
    count_neighbours(3, 1025, 1000);
    count_neighbours(3, 2049, 1024);
  }
  fg_context_destroy(context);
  MPI_Finalize();
  return 0;
}
