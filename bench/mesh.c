/* What sharing a mesh costs: ghosts filled and messages sent on the ranks it is started
 * with (mpirun -n R bench_mesh), boxes and neighbours of 1000 ranks by counting, and how
 * adaptive levels fall into boxes. */
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
  check(fg__exchange_create(&exchange, NULL, &mesh.level[0], 2));
  int count;
  const fg__box *own = fg__own_boxes(&mesh.level[0], &count);
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

/* The shares that `count` ranks would have: equal pieces of the Morton curve. */
static fg__partition share_out(const fg__mesh *mesh, const fg__ranks *ranks)
{
  const fg__partition *whole = &mesh->level[0];
  fg__partition out = *whole;
  out.ranks = ranks;
  out.count = 0;
  out.box = take((size_t)mesh->leaf_count, sizeof *out.box);
  out.first_of_rank = take((size_t)ranks->count + 1, sizeof(int));
  for (int r = 0; r < ranks->count; ++r) {
    int first = (int)((long)mesh->leaf_count * r / ranks->count);
    int end = (int)((long)mesh->leaf_count * (r + 1) / ranks->count), found = 0;
    fg__box *box = out.box + out.count;
    for (int n = first; n < end; ++n, ++found) {
      box[found] = (fg__box){{0, 0, 0}, {1, 1, 1}};
      for (int k = 0; k < mesh->dimension; ++k) {
        box[found].first[k] = mesh->leaf[n].first[k] * mesh->patch_cells;
        box[found].nodes[k] = mesh->patch_cells +
                              (box[found].first[k] + mesh->patch_cells == mesh->cells[k]);
      }
    }
    out.first_of_rank[r] = out.count;
    out.count += fg__boxes_merge(box, found);
  }
  out.first_of_rank[ranks->count] = out.count;
  return out;
}

static void count_neighbours(int dimension, int nodes, int patch, int rank_count)
{
  const fg__ranks *alone;
  fg__mesh mesh;
  check(fg__ranks_alone(&alone, NULL));
  int refinements = 0;
  while (patch << refinements < nodes - 1)
    ++refinements;
  check(fg__mesh_create(&mesh, NULL,
                        &(fg__mesh_description){.dimension = dimension,
                                                .side = {1.0, 1.0, 1.0},
                                                .nodes = nodes,
                                                .patch_cells = patch,
                                                .refinements = refinements,
                                                .ranks = alone}));
  double boxes = 0.0, neighbours = 0.0, most_neighbours = 0.0, most_bytes = 0.0,
         plan_seconds = 0.0, asked = 0.0;
  fg__ranks ranks = {.count = rank_count};
  fg__partition level = share_out(&mesh, &ranks);
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
  fg__mesh_clear(&mesh);
}

/* Twelve discs (balls) that cover a third of the domain, as late in a run. */
static double from_interface(int dimension, const double place[3])
{
  double least = 1.0;
  for (int n = 0; n < 12; ++n) {
    double square = 0.0, radius = dimension == 2 ? 0.09 : 0.18;
    const double center[3] = {(n % 4 + 0.5 + 0.1 * (n / 4)) / 4.4, (n / 4 + 0.5) / 3.0,
                              0.2 + 0.6 * (n * 5 % 12) / 12.0};
    for (int k = 0; k < dimension; ++k)
      square += (place[k] - center[k]) * (place[k] - center[k]);
    least = fmin(least, fabs(sqrt(square) - radius));
  }
  return least;
}

/* The coarsest level whose patch here keeps six cells from any interface. */
static signed char wanted_level(const fg__mesh *mesh, const fg__leaf *leaf)
{
  int level = 0;
  for (; level + 1 < mesh->level_count; ++level) {
    double place[3] = {0.0}, side = 2 << level;
    for (int k = 0; k < mesh->dimension; ++k)
      place[k] = (floor(leaf->first[k] / side) + 0.5) * side * mesh->patch_cells /
                 mesh->cells[k];
    double reach = 0.5 * side * mesh->patch_cells * sqrt(mesh->dimension) + 6.0;
    if (from_interface(mesh->dimension, place) < reach / mesh->cells[0])
      break;
  }
  return (signed char)level;
}

static void count_adaptive(int dimension, int nodes, int patch, int refinements)
{
  fg__mesh mesh;
  check(fg__mesh_create(&mesh, NULL,
                        &(fg__mesh_description){.dimension = dimension,
                                                .side = {1.0, 1.0, 1.0},
                                                .nodes = nodes,
                                                .patch_cells = patch,
                                                .refinements = refinements}));
  double seconds = 0.0;
  for (int round = 0; round <= refinements; ++round) {
    signed char *wanted = take((size_t)mesh.leaf_count, 1);
    for (int n = 0; n < mesh.leaf_count; ++n)
      wanted[n] = wanted_level(&mesh, &mesh.leaf[n]);
    fg__mesh adapted;
    double start = now();
    check(fg__mesh_adapt(&adapted, NULL, &mesh, wanted));
    seconds = now() - start;
    free(wanted);
    fg__mesh_clear(&mesh);
    mesh = adapted;
  }
  double nodes_all = 0.0, stored = 0.0, lanes = 0.0, boxes = 0.0;
  for (int l = 0; l < mesh.level_count; ++l)
    for (int b = 0; b < mesh.level[l].count; ++b) {
      const fg__box *box = &mesh.level[l].box[b];
      fg__layout layout = fg__layout_of(dimension, box->nodes);
      int half = (box->nodes[0] / 2 + FG__LANES - 1) / FG__LANES * FG__LANES;
      ++boxes;
      nodes_all += (double)fg__box_count(box);
      stored += (double)layout.array_size;
      lanes += 2.0 * half * box->nodes[1] * box->nodes[2];
    }
  printf("%d nodes a side in %dD, patches of %d, %d refinements: %.3f of the uniform "
         "nodes (%.3f with ghosts and pads, %.3f in whole vectors) in %.0f boxes on %d "
         "levels; adapted in %.1f ms\n",
         nodes, dimension, patch, refinements, nodes_all / pow(nodes, dimension),
         stored / pow(nodes, dimension), lanes / pow(nodes, dimension), boxes,
         mesh.level_count, seconds * 1e3);
  fg__mesh_clear(&mesh);
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
  for (int patch = 8; patch <= 32; patch *= 2)
    count_adaptive(2, 1025, patch, 3);
  for (int patch = 4; patch <= 16; patch *= 2)
    count_adaptive(3, 129, patch, 2);
  return 0;
}
