/* What sharing a mesh costs: ghosts filled and messages sent on the ranks it is started
 * with (mpirun -n R bench_mesh), boxes and neighbours of 1000 ranks by counting. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/memory.h"
#include "mesh/exchange_plan.h"
#include "mesh/mesh.h"

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
static void time_exchange(int dimension, int nodes)
{
  fg__mesh mesh;
  check(fg__mesh_create(&mesh, NULL,
                        &(fg__mesh_description){.dimension = dimension,
                                                .side = {1.0, 1.0, 1.0},
                                                .nodes = nodes}));
  fg__exchange *exchange;
  check(fg__exchange_create(&exchange, NULL, &mesh.partition, 2));
  int count;
  const fg__box *own = fg__own_boxes(&mesh.partition, &count);
  float **node[2] = {take((size_t)count, sizeof(float *)),
                     take((size_t)count, sizeof(float *))};
  for (int b = 0; b < count; ++b)
    for (int a = 0; a < 2; ++a) {
      fg__layout layout = fg__layout_of(dimension, own[b].nodes);
      node[a][b] = (float *)take(layout.array_size, sizeof(float)) + layout.first;
    }
  float *const *arrays[2] = {node[0], node[1]};
  enum { TIMES = 200 };
  fg__exchange_fill(exchange, 2, arrays, FG__ALL_COLOURS);
  fg__traffic_book *book = mesh.ranks->book;
  fg_traffic first = book ? book->of[book->now] : (fg_traffic){0};
  double start = now();
  for (int n = 0; n < TIMES; ++n)
    fg__exchange_fill(exchange, 2, arrays, FG__ALL_COLOURS);
  double seconds = (now() - start) / TIMES;
  fg_traffic sent = book ? book->of[book->now] : (fg_traffic){0};
  double most[4] = {seconds * 1e6, (sent.messages - first.messages) / TIMES,
                    (sent.bytes - first.bytes) / TIMES, count};
  fg__ranks_greatest(mesh.ranks, most, 4);
  if (mesh.ranks->rank == 0)
    printf("%d ranks, %d nodes a side in %dD: an exchange of u and w takes %.0f us; at "
           "most %.0f boxes a rank, %.0f messages, %.0f kB\n",
           mesh.ranks->count, nodes, dimension, most[0], most[3], most[1], most[2] / 1e3);
  fg__exchange_destroy(exchange);
  fg__mesh_clear(&mesh);
}

/* Patch n of the Morton curve. */
static fg__box patch_at(long n, int dimension, int cells, int patch)
{
  fg__box out = {{0, 0, 0}, {1, 1, 1}};
  for (int bit = 0; n >> (bit * dimension); ++bit)
    for (int k = 0; k < dimension; ++k)
      out.first[k] |= (int)(n >> (bit * dimension + k) & 1) << bit;
  for (int k = 0; k < dimension; ++k) {
    out.first[k] *= patch;
    out.nodes[k] = patch + (out.first[k] + patch == cells);
  }
  return out;
}

/* The shares that ranks would have of a square (cube) of 2^n patches a side: equal pieces
 * of the curve. */
static fg__partition share_out(int dimension, int cells, int patch,
                               const fg__ranks *ranks)
{
  fg__partition out = {
      .dimension = dimension, .cells = {1, 1, 1}, .nodes = {1, 1, 1}, .ranks = ranks};
  long patches = 1;
  for (int k = 0; k < dimension; ++k) {
    out.cells[k] = cells;
    out.nodes[k] = cells + 1;
    patches *= cells / patch;
  }
  out.box = take((size_t)patches, sizeof *out.box);
  out.first_of_rank = take((size_t)ranks->count + 1, sizeof(int));
  for (int r = 0; r < ranks->count; ++r) {
    long first = patches * r / ranks->count, end = patches * (r + 1) / ranks->count;
    fg__box *box = out.box + out.count;
    for (long n = first; n < end; ++n)
      box[n - first] = patch_at(n, dimension, cells, patch);
    out.first_of_rank[r] = out.count;
    out.count += fg__boxes_merge(box, (int)(end - first));
  }
  out.first_of_rank[ranks->count] = out.count;
  return out;
}

static void count_neighbours(int dimension, int nodes, int patch, int rank_count)
{
  double boxes = 0.0, neighbours = 0.0, most_neighbours = 0.0, most_bytes = 0.0,
         plan_seconds = 0.0, asked = 0.0;
  fg__ranks ranks = {.count = rank_count};
  fg__partition level = share_out(dimension, nodes - 1, patch, &ranks);
  int workable = 0;
  fg__partition coarse = level;
  while (fg__partition_is_workable(&coarse, 4)) {
    fg__partition next;
    check(fg__partition_coarsen(&next, NULL, &coarse));
    if (workable++)
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
    boxes += level.first_of_rank[r + 1] - level.first_of_rank[r];
    neighbours += exchange->senders.count;
    most_neighbours = fmax(most_neighbours, exchange->senders.count);
    most_bytes = fmax(most_bytes, bytes);
    fg__exchange_destroy(exchange);
  }
  printf("%d ranks, %d nodes a side in %dD, patches of %d: %.1f boxes and %.1f "
         "neighbours a rank (%.0f at most), %.0f kB an exchange of u and w; list of %d "
         "boxes, plan in %.1f ms; %d shared levels, then %d x %d x %d nodes whole\n",
         rank_count, nodes, dimension, patch, boxes / asked, neighbours / asked,
         most_neighbours, most_bytes / 1e3, level.count, plan_seconds / asked * 1e3,
         workable, coarse.nodes[0], coarse.nodes[1], coarse.nodes[2]);
  fg__partition_clear(&coarse);
  fg__partition_clear(&level);
}

int main(void)
{
  const fg__ranks *all;
  check(fg__ranks_all(&all, NULL));
  time_exchange(2, 1025);
  time_exchange(3, 129);
  if (all->count > 1)
    return 0;
  count_neighbours(2, 8193, 16, 1000);
  count_neighbours(2, 8193, 64, 1000);
  count_neighbours(3, 1025, 16, 1000);
  count_neighbours(3, 1025, 32, 1000);
  return 0;
}
