#include "solver/subdomain/subdomains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* A subdomain may be so large; all together what every rank may hold, and cost less than
 * cycles do: the sum of squares of their nodes is at most four times the mesh's nodes
 * (docs/design/evolution.md). Where that is not enough for all, smaller subdomains go
 * first. While a step has failed of late more of them are worth their cost. */
enum { MOST_OF_ONE = 512, MOST_SQUARES = 4 };
enum { MOST_OF_ONE_FAILED = 1024, MOST_SQUARES_FAILED = 64, MOST_OF_ALL = 16384 };

enum { MOST_ENTRIES = 27 }; /* of a row in 3D */

typedef struct place {
  uint64_t index; /* in the level's grid, x fastest */
  uint32_t subdomain;
} place;

typedef struct collection {
  fg__subdomains *out;
  const fg__multigrid *multigrid;
  const fg__mass_constraint *masses;
  const fg__level *block; /* of this rank */
  const int *first;       /* its first node in the level's grid */
  const int *nodes;       /* of the level's grid */
  const bool *periodic;
  uint64_t *size; /* [subdomains] nodes */
  place *place;   /* [out->nodes] sorted */
  int *position;  /* [out->nodes] where each of these is solved */
  int *at;        /* [out->nodes] which of them is solved where */
} collection;

static bool is_small(const collection *c, int subdomain)
{
  return c->size[subdomain] <= (uint64_t)c->out->largest;
}

/* By the number of subdomains of each size. */
static int choose_largest(const collection *c, int most_of_one, double most_squares)
{
  const int *nodes = c->nodes;
  double left = most_squares * nodes[0] * nodes[1] * nodes[2];
  int parts[MOST_OF_ONE_FAILED + 1] = {0}, largest = 0;
  double all = MOST_OF_ALL;
  for (int n = 0; n < c->masses->count; ++n)
    if (c->size[n] <= MOST_OF_ONE_FAILED)
      ++parts[c->size[n]];
  for (int n = 1; n <= most_of_one; ++n) {
    all -= (double)n * parts[n];
    left -= (double)n * n * parts[n];
    if (all < 0.0 || left < 0.0)
      break;
    largest = parts[n] > 0 ? n : largest;
  }
  return largest;
}

static void count_nodes(collection *c)
{
  const fg__mass_constraint *masses = c->masses;
  for (int n = 0; n < masses->run_count; ++n)
    c->size[masses->run[n].subdomain] += (uint64_t)masses->run[n].nodes;
  fg__ranks_add(c->multigrid->ranks, c->size, masses->count);
  c->out->small = choose_largest(c, MOST_OF_ONE, MOST_SQUARES);
  c->out->largest = choose_largest(c, MOST_OF_ONE_FAILED, MOST_SQUARES_FAILED);
  for (int n = 0; n < masses->count; ++n)
    if (is_small(c, n)) {
      c->out->nodes += (int)c->size[n];
      ++c->out->count;
    }
  for (int n = 0; n < masses->run_count; ++n)
    if (is_small(c, masses->run[n].subdomain))
      c->out->own_count += masses->run[n].nodes;
}

static fg_status take_arrays(fg__subdomains *out, fg_context *context)
{
  size_t nodes = (size_t)out->nodes, rows = nodes * (size_t)out->entries;
  size_t own = (size_t)out->own_count + 1;
  out->first = fg__allocate((size_t)out->count + 1, sizeof *out->first);
  out->target = fg__allocate(rows, sizeof *out->target);
  out->laplacian = fg__allocate(rows, sizeof *out->laplacian);
  out->energy = fg__allocate(rows, sizeof *out->energy);
  out->mass = fg__allocate(nodes, sizeof *out->mass);
  out->own = fg__allocate(own, sizeof *out->own);
  out->at = fg__allocate(own, sizeof *out->at);
  out->word = fg__allocate(FG__SUBDOMAIN_WORDS * nodes, sizeof *out->word);
  out->u = fg__allocate(nodes, sizeof *out->u);
  out->w = fg__allocate(nodes, sizeof *out->w);
  out->done = fg__allocate(nodes, sizeof *out->done);
  if (out->first && out->target && out->laplacian && out->energy && out->mass &&
      out->own && out->at && out->word && out->u && out->w && out->done)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "small parts of the domain",
                         rows * (sizeof(int) + 2 * sizeof(double)));
}

/* Which node of the block lies at a place of this rank's arrays. */
static void find_node(const collection *c, ptrdiff_t at, int node[3])
{
  const fg__layout *layout = &c->block->layout;
  ptrdiff_t left = at;
  node[2] = layout->plane > 0 ? (int)(left / layout->plane) : 0;
  left -= node[2] * layout->plane;
  node[1] = (int)(left / layout->stride);
  left -= node[1] * layout->stride;
  node[0] =
      (int)(left < layout->odd_offset ? 2 * left : 2 * (left - layout->odd_offset) + 1);
}

static uint64_t index_of(const collection *c, const int node[3])
{
  const int *nodes = c->nodes;
  return (uint64_t)node[0] +
         (uint64_t)nodes[0] *
             ((uint64_t)node[1] + (uint64_t)nodes[1] * (uint64_t)node[2]);
}

static int compare_places(const void *left, const void *right)
{
  const place *a = left, *b = right;
  if (a->subdomain != b->subdomain)
    return a->subdomain < b->subdomain ? -1 : 1;
  return (a->index > b->index) - (a->index < b->index);
}

static int find_place(const collection *c, uint32_t subdomain, uint64_t index)
{
  place key = {index, subdomain};
  const place *found =
      bsearch(&key, c->place, (size_t)c->out->nodes, sizeof key, compare_places);
  return found ? (int)(found - c->place) : -1;
}

/* The node that a neighbour, perhaps beyond the grid, is or stands for. */
static uint64_t neighbour_of(const collection *c, uint64_t index, int entry)
{
  const int *nodes = c->nodes;
  const bool *periodic = c->periodic;
  bool solid = c->out->entries == MOST_ENTRIES;
  uint64_t size[2] = {(uint64_t)nodes[0], (uint64_t)nodes[1]};
  int node[3] = {(int)(index % size[0]), (int)(index / size[0] % size[1]),
                 (int)(index / (size[0] * size[1]))};
  int d[3] = {entry % 3 - 1, entry / 3 % 3 - 1, solid ? entry / 9 - 1 : 0};
  for (int k = 0; k < 3; ++k) {
    node[k] += d[k];
    if (node[k] < 0)
      node[k] = periodic[k] ? nodes[k] - 1 : 1;
    else if (node[k] >= nodes[k])
      node[k] = periodic[k] ? 0 : nodes[k] - 2;
  }
  return index_of(c, node);
}

/* Visits a subdomain's nodes, [first, end) of the sorted ones, from one on, neighbours
 * first, and returns the last; `seen` is 0 for all of them. */
static int visit(const collection *c, int first, int end, int from, int *order,
                 char *seen)
{
  int entries = c->out->entries, count = 1;
  order[0] = from;
  seen[from] = 1;
  for (int n = 0; n < count; ++n)
    for (int k = 0; k < entries; ++k) {
      const place *here = &c->place[order[n]];
      int found = find_place(c, here->subdomain, neighbour_of(c, here->index, k));
      if (found < first || found >= end || seen[found])
        continue;
      seen[found] = 1;
      order[count++] = found;
    }
  memset(seen + first, 0, (size_t)(end - first));
  return order[count - 1];
}

/* Greatest distance of neighbours' positions. */
static int spread_of(const collection *c, int first, int end)
{
  int most = 0;
  for (int n = first; n < end; ++n)
    for (int k = 0; k < c->out->entries; ++k) {
      const place *here = &c->place[n];
      int found = find_place(c, here->subdomain, neighbour_of(c, here->index, k));
      int distance = found < 0 ? 0 : abs(c->position[found] - c->position[n]);
      most = distance > most ? distance : most;
    }
  return most;
}

/* The narrower band of two orders: as nodes are sorted, or along the subdomain from one
 * of its ends, as Cuthill and McKee do. */
static void order_nodes(collection *c, int first, int end, char *seen)
{
  for (int n = first; n < end; ++n)
    c->position[n] = n;
  int band = spread_of(c, first, end);
  int *order = c->at + first, start = visit(c, first, end, first, order, seen);
  visit(c, first, end, start, order, seen);
  for (int n = first; n < end; ++n)
    c->position[c->at[n]] = n;
  if (spread_of(c, first, end) < band)
    return;
  for (int n = first; n < end; ++n)
    c->position[n] = c->at[n] = n;
}

/* Tells all ranks of each node; then all sort alike. */
static void exchange_places(collection *c, uint64_t *before, char *seen)
{
  fg__subdomains *out = c->out;
  const fg__ranks *ranks = c->multigrid->ranks;
  before[ranks->rank] = (uint64_t)out->own_count;
  fg__ranks_add(ranks, before, ranks->count);
  size_t slot = 0;
  for (int n = 0; n < ranks->rank; ++n)
    slot += before[n];
  memset(out->word, 0, FG__SUBDOMAIN_WORDS * (size_t)out->nodes * sizeof *out->word);
  for (int n = 0, own = 0; n < c->masses->run_count; ++n) {
    const fg__subdomain_run *run = &c->masses->run[n];
    for (int m = 0; m < run->nodes && is_small(c, run->subdomain); ++m, ++own) {
      int node[3];
      find_node(c, run->at + m, node);
      for (int k = 0; k < 3; ++k)
        node[k] += c->first[k];
      uint64_t index = index_of(c, node);
      uint32_t *word = out->word + FG__SUBDOMAIN_WORDS * (slot + (size_t)own);
      word[0] = (uint32_t)index;
      word[1] = (uint32_t)(index >> 32);
      word[2] = (uint32_t)run->subdomain;
      out->at[own] = run->at + m;
    }
  }
  fg__ranks_combine(ranks, out->word, FG__SUBDOMAIN_WORDS * out->nodes);
  for (int n = 0; n < out->nodes; ++n) {
    const uint32_t *word = out->word + FG__SUBDOMAIN_WORDS * n;
    c->place[n] = (place){(uint64_t)word[1] << 32 | word[0], word[2]};
  }
  qsort(c->place, (size_t)out->nodes, sizeof *c->place, compare_places);
  for (int n = 0; n < out->own_count; ++n) {
    const uint32_t *word = out->word + FG__SUBDOMAIN_WORDS * (slot + (size_t)n);
    out->own[n] = find_place(c, word[2], (uint64_t)word[1] << 32 | word[0]);
  }
  int subdomain = 0;
  for (int n = 0; n < out->nodes; ++n)
    if (n == 0 || c->place[n].subdomain != c->place[n - 1].subdomain)
      out->first[subdomain++] = n;
  out->first[subdomain] = out->nodes;
  for (int n = 0; n < out->count; ++n)
    order_nodes(c, out->first[n], out->first[n + 1], seen);
  for (int n = 0; n < out->own_count; ++n)
    out->own[n] = c->position[out->own[n]];
}

/* A node's couplings to its neighbours, x fastest. */
static void read_row(const fg__level *block, const fg__stencil *stencil,
                     const int node[3], float *row)
{
  const fg__layout *at = &block->layout;
  int middle = at->dimension == 3 ? 13 : 4;
  row[middle] = 0.0F;
  for (int n = 0; n < fg__coupling_count(at->dimension); ++n) {
    int d[3] = {n == 0 ? 1 : (n - 1) % 3 - 1, 0, 0};
    if (n > 0)
      fg__upper_row((n - 1) / 3, &d[1], &d[2]);
    int step = d[0] + 3 * d[1] + 9 * d[2];
    row[middle + step] = stencil->to[n][fg__node_at(at, node[0], node[1], node[2])];
    row[middle - step] =
        stencil->to[n][fg__node_at(at, node[0] - d[0], node[1] - d[1], node[2] - d[2])];
  }
}

/* Rows over the mass; a constant has neither flux nor energy, to the last bit. */
static void fill_row(const collection *c, int first, int node, const float *laplacian,
                     const float *energy, double mass)
{
  const fg__subdomains *out = c->out;
  const place *here = &c->place[c->at[node]];
  int entries = out->entries, middle = entries / 2;
  double *l = out->laplacian + node * entries, *k = out->energy + node * entries;
  int *target = out->target + node * entries;
  l[middle] = k[middle] = 0.0;
  for (int n = 0; n < entries; ++n) {
    int found = find_place(c, here->subdomain, neighbour_of(c, here->index, n));
    target[n] = found < 0 ? -1 : c->position[found] - first;
    if (n == middle || found < 0)
      continue;
    l[n] = (double)laplacian[n] / mass;
    k[n] = (double)energy[n] / mass;
    l[middle] -= l[n];
    k[middle] -= k[n];
  }
}

/* Sends each own node's rows and masses to all. */
static void exchange_rows(const collection *c, uint32_t *word)
{
  fg__subdomains *out = c->out;
  int entries = out->entries, width = 2 * entries + 2;
  for (int n = 0, own = 0; n < c->masses->run_count; ++n) {
    const fg__subdomain_run *run = &c->masses->run[n];
    for (int m = 0; m < run->nodes && is_small(c, run->subdomain); ++m, ++own) {
      float row[2 * MOST_ENTRIES] = {0.0F};
      int node[3];
      find_node(c, run->at + m, node);
      read_row(c->block, &c->block->laplacian, node, row);
      read_row(c->block, &c->block->energy, node, row + entries);
      uint32_t *to = word + (size_t)width * (size_t)out->own[own];
      for (int k = 0; k < 2 * entries; ++k)
        to[k] = fg__bits_of(row[k]);
      to[2 * entries] = fg__bits_of(run->mass[m]);
      to[2 * entries + 1] =
          fg__bits_of(run->row_mass * run->column_mass[m] * run->mass[m]);
    }
  }
  fg__ranks_combine(c->multigrid->ranks, word, width * out->nodes);
  for (int p = 0; p < out->count; ++p)
    for (int n = out->first[p]; n < out->first[p + 1]; ++n, word += width) {
      float row[2 * MOST_ENTRIES] = {0.0F};
      for (int k = 0; k < 2 * entries; ++k)
        row[k] = (float)fg__float_of(word[k]);
      fill_row(c, out->first[p], n, row, row + entries, fg__float_of(word[2 * entries]));
      out->mass[n] = fg__float_of(word[2 * entries + 1]);
      int middle = n * entries + entries / 2;
      out->stiffness = fmax(out->stiffness, out->laplacian[middle] * out->energy[middle]);
    }
}

fg__subdomain fg__subdomain_of(const fg__subdomains *p, int n)
{
  int first = p->first[n];
  return (fg__subdomain){.nodes = p->first[n + 1] - first,
                         .entries = p->entries,
                         .target = p->target + first * p->entries,
                         .laplacian = p->laplacian + first * p->entries,
                         .energy = p->energy + first * p->entries,
                         .mass = p->mass + first};
}

/* Four vectors and the largest that a step takes. */
static fg_status take_space(fg__subdomains *out, fg_context *context)
{
  int most = 0;
  for (int n = 0; n < out->count; ++n) {
    fg__subdomain subdomain = fg__subdomain_of(out, n);
    int space = fg__subdomain_space(&subdomain);
    most = space > most ? space : most;
  }
  size_t count = (size_t)most + 4 * (size_t)out->largest;
  out->space = fg__allocate(count, sizeof *out->space);
  if (out->space)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "small parts of the domain", count * sizeof(double));
}

static fg_status collect(collection *c, fg_context *context)
{
  fg__subdomains *out = c->out;
  const fg__ranks *ranks = c->multigrid->ranks;
  uint64_t *before = fg__allocate((size_t)ranks->count, sizeof *before);
  size_t words = (2 * (size_t)out->entries + 2) * (size_t)out->nodes;
  uint32_t *word = fg__allocate(words, sizeof *word);
  char *seen = fg__allocate((size_t)out->nodes, 1);
  c->place = fg__allocate((size_t)out->nodes, sizeof *c->place);
  c->position = fg__allocate((size_t)out->nodes, sizeof *c->position);
  c->at = fg__allocate((size_t)out->nodes, sizeof *c->at);
  fg_status status = take_arrays(out, context);
  if (!status && !(before && word && seen && c->place && c->position && c->at))
    status = fg__fail_memory(context, "small parts of the domain", words * sizeof *word);
  status = fg__ranks_agree(ranks, context, status);
  if (!status) {
    exchange_places(c, before, seen);
    exchange_rows(c, word);
    status = fg__ranks_agree(ranks, context, take_space(out, context));
  }
  free(before);
  free(word);
  free(seen);
  free(c->place);
  free(c->position);
  free(c->at);
  return status;
}

fg_status fg__subdomains_create(fg__subdomains *out, fg_context *context,
                                const fg__multigrid *multigrid,
                                const fg__mass_constraint *masses)
{
  *out = (fg__subdomains){0};
  if (masses->count <= 1)
    return FG_STATUS_OK;
  const fg__level *block = fg__multigrid_finest(multigrid);
  const fg__partition *partition = &multigrid->partition;
  collection c = {.out = out,
                  .multigrid = multigrid,
                  .masses = masses,
                  .block = block,
                  .first = fg__own_block(partition)->first,
                  .nodes = partition->nodes,
                  .periodic = block->periodic};
  out->entries = block->layout.dimension == 3 ? MOST_ENTRIES : 9;
  c.size = fg__allocate((size_t)masses->count, sizeof *c.size);
  fg_status status = FG_STATUS_OK;
  if (!c.size)
    status = fg__fail_memory(context, "small parts of the domain",
                             (size_t)masses->count * sizeof *c.size);
  status = fg__ranks_agree(multigrid->ranks, context, status);
  if (!status)
    count_nodes(&c);
  if (!status && out->count > 0)
    status = collect(&c, context);
  free(c.size);
  if (status)
    fg__subdomains_clear(out);
  return status;
}

void fg__subdomains_clear(fg__subdomains *subdomains)
{
  free(subdomains->first);
  free(subdomains->target);
  free(subdomains->laplacian);
  free(subdomains->energy);
  free(subdomains->mass);
  free(subdomains->own);
  free(subdomains->at);
  free(subdomains->word);
  free(subdomains->u);
  free(subdomains->w);
  free(subdomains->done);
  free(subdomains->space);
  *subdomains = (fg__subdomains){0};
}
