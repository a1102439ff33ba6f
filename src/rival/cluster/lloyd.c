#include "rival/cluster/lloyd.h"

#include "base/memory.h"
#include "rival/cluster/seed_bins.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rounds end when no centre has moved by this, in fair-share lengths: less than a cell of
 * the raster; or after so many, when few move. */
static const double STILL = 5e-3;
enum { MOST_ROUNDS = 60 };

/* A cell with what it is sorted by. */
typedef struct sorted_cell {
  double key;
  int cluster, at; /* at: in the list of cells */
} sorted_cell;

typedef struct clustering {
  fg_context *context;
  const fg__domain *domain;
  int cells, clusters;
  double lambda, weight;
  int *cell;           /* [cells] of the raster */
  int *label;          /* [cells] */
  double *cost;        /* [cells] squared distance to the label's centre */
  sorted_cell *sorted; /* [cells] */
  fg__seed *center;    /* [clusters] */
  double (*sum)[6];    /* [clusters] */
  int *size;           /* [clusters] */
  fg__seed_bins bins;
} clustering;

static fg__seed seed_of(const clustering *work, int at)
{
  fg__seed seed = {0};
  fg__domain_center(work->domain, work->cell[at], seed.position);
  const double *direction = fg__domain_direction(work->domain, work->cell[at]);
  for (int k = 0; k < work->domain->dimension; k++)
    seed.direction[k] = direction[k];
  return seed;
}

static fg_status allocate(clustering *work, int wanted)
{
  const fg__domain *domain = work->domain;
  int raster = fg__domain_cell_count(domain);
  for (int i = 0; i < raster; i++)
    work->cells += fg__domain_cell_moves(domain, i);
  work->clusters = wanted < work->cells ? wanted : work->cells;
  size_t cells = (size_t)work->cells, clusters = (size_t)work->clusters;
  work->cell = fg__allocate(cells, sizeof *work->cell);
  work->label = fg__allocate(cells, sizeof *work->label);
  work->cost = fg__allocate(cells, sizeof *work->cost);
  work->sorted = fg__allocate(cells, sizeof *work->sorted);
  work->center = fg__allocate(clusters, sizeof *work->center);
  work->sum = fg__allocate(clusters, sizeof *work->sum);
  work->size = fg__allocate(clusters, sizeof *work->size);
  if (!work->cell || !work->label || !work->cost || !work->sorted || !work->center ||
      !work->sum || !work->size)
    return fg__fail_memory(work->context, "clusters", cells * sizeof *work->sorted);
  for (int i = 0, at = 0; i < raster; i++)
    if (fg__domain_cell_moves(domain, i))
      work->cell[at++] = i;
  return FG_STATUS_OK;
}

static void clear(clustering *work)
{
  free(work->cell);
  free(work->label);
  free(work->cost);
  free(work->sorted);
  free(work->center);
  free(work->sum);
  free(work->size);
  fg__seed_bins_clear(&work->bins);
}

static int compare(const void *first, const void *second)
{
  const sorted_cell *a = first, *b = second;
  if (a->cluster != b->cluster)
    return a->cluster < b->cluster ? -1 : 1;
  if (a->key != b->key)
    return a->key < b->key ? -1 : 1;
  return (a->at > b->at) - (a->at < b->at);
}

/* What a cell counts by: place, then direction; 2 * dimension numbers. */
static void features(const clustering *work, int at, double feature[6])
{
  const fg__seed seed = seed_of(work, at);
  int dimension = work->domain->dimension;
  for (int k = 0; k < dimension; k++) {
    feature[k] = (seed.position[k] - work->domain->origin[k]) / work->lambda;
    feature[dimension + k] = work->weight * seed.direction[k];
  }
}

/* The feature of largest variance; the first of equal ones. */
static int widest_feature(const clustering *work, const sorted_cell *cell, int count)
{
  double sum[6] = {0}, square[6] = {0}, feature[6] = {0}, largest = -1;
  int widest = 0, number = 2 * work->domain->dimension;
  for (int i = 0; i < count; i++) {
    features(work, cell[i].at, feature);
    for (int f = 0; f < number; f++) {
      sum[f] += feature[f];
      square[f] += feature[f] * feature[f];
    }
  }
  for (int f = 0; f < number; f++) {
    double variance = square[f] - sum[f] * sum[f] / count;
    if (variance > largest * (1 + 1e-9)) { /* what differs by rounding is equal */
      largest = variance;
      widest = f;
    }
  }
  return widest;
}

/* Gives the clusters from `first` on equal numbers of these cells: halves them, and the
 * halves again. */
static void halve(clustering *work, sorted_cell *cell, int count, int first, int clusters)
{
  if (clusters == 1) {
    for (int i = 0; i < count; i++)
      work->label[cell[i].at] = first;
    return;
  }
  int widest = widest_feature(work, cell, count);
  for (int i = 0; i < count; i++) {
    double feature[6] = {0};
    features(work, cell[i].at, feature);
    cell[i].key = feature[widest];
  }
  qsort(cell, (size_t)count, sizeof *cell, compare);
  int half = clusters / 2;
  int taken = (int)((double)count * half / clusters);
  halve(work, cell, taken, first, half);
  halve(work, cell + taken, count - taken, first + half, clusters - half);
}

/* Moves the centres to the means of their members; returns the largest move, squared, in
 * fair-share lengths. Differences are taken by the shortest way from the old centre. */
static double move_centers(clustering *work)
{
  int dimension = work->domain->dimension;
  memset(work->sum, 0, (size_t)work->clusters * sizeof *work->sum);
  memset(work->size, 0, (size_t)work->clusters * sizeof *work->size);
  for (int i = 0; i < work->cells; i++) {
    const fg__seed *center = &work->center[work->label[i]], seed = seed_of(work, i);
    double *sum = work->sum[work->label[i]], way[3] = {0};
    for (int k = 0; k < dimension; k++)
      way[k] = seed.position[k] - center->position[k];
    fg__domain_shortest(work->domain, way);
    for (int k = 0; k < dimension; k++) {
      sum[k] += way[k];
      sum[3 + k] += seed.direction[k];
    }
    work->size[work->label[i]]++;
  }
  double largest = 0;
  for (int n = 0; n < work->clusters; n++) {
    double move = 0;
    if (work->size[n] == 0)
      continue;
    for (int k = 0; k < dimension; k++) {
      double way = work->sum[n][k] / work->size[n];
      work->center[n].position[k] += way;
      work->center[n].direction[k] = work->sum[n][3 + k] / work->size[n];
      move += way * way;
    }
    fg__domain_wrap(work->domain, work->center[n].position);
    largest = fmax(largest, move / (work->lambda * work->lambda));
  }
  return largest;
}

/* A centre that has lost all its members gets the cell that is farthest from its own. */
static void fill_empty(clustering *work)
{
  for (int n = 0; n < work->clusters; n++) {
    if (work->size[n] > 0)
      continue;
    int farthest = -1;
    for (int i = 0; i < work->cells; i++)
      if (work->size[work->label[i]] > 1 &&
          (farthest < 0 || work->cost[i] > work->cost[farthest]))
        farthest = i;
    work->size[work->label[farthest]]--;
    work->size[n] = 1;
    work->label[farthest] = n;
    work->cost[farthest] = 0;
    work->center[n] = seed_of(work, farthest);
  }
}

static fg_status assign(clustering *work)
{
  fg_status status = fg__seed_bins_fill(&work->bins, work->context, work->domain,
                                        work->center, work->clusters, work->lambda);
  memset(work->size, 0, (size_t)work->clusters * sizeof *work->size);
  for (int i = 0; i < work->cells && status == FG_STATUS_OK; i++) {
    const fg__seed seed = seed_of(work, i);
    work->label[i] = fg__seed_bins_nearest(&work->bins, &seed, work->weight,
                                           work->label[i], &work->cost[i]);
    work->size[work->label[i]]++;
  }
  if (status == FG_STATUS_OK)
    fill_empty(work);
  return status;
}

static fg_status settle(clustering *work)
{
  for (int i = 0; i < work->cells; i++)
    work->sorted[i] = (sorted_cell){.at = i};
  halve(work, work->sorted, work->cells, 0, work->clusters);
  /* differences of places are from the first member */
  for (int i = work->cells - 1; i >= 0; i--)
    work->center[work->label[i]] = seed_of(work, i);
  move_centers(work);
  fg_status status = assign(work);
  for (int round = 0; round < MOST_ROUNDS && status == FG_STATUS_OK; round++) {
    double move = move_centers(work);
    status = assign(work);
    if (move <= STILL * STILL)
      break;
    if (status == FG_STATUS_OK)
      status = fg__check_stop(work->context);
  }
  return status;
}

static fg_status fill_result(fg__lloyd *out, clustering *work)
{
  size_t clusters = (size_t)work->clusters, cells = (size_t)work->cells;
  out->center = fg__allocate(clusters, sizeof *out->center);
  out->first = fg__allocate(clusters + 1, sizeof *out->first);
  out->member = fg__allocate(cells, sizeof *out->member);
  if (!out->center || !out->first || !out->member) {
    fg__lloyd_clear(out);
    return fg__fail_memory(work->context, "clusters", cells * sizeof *out->member);
  }
  for (int i = 0; i < work->cells; i++)
    work->sorted[i] =
        (sorted_cell){.key = work->cost[i], .cluster = work->label[i], .at = i};
  qsort(work->sorted, cells, sizeof *work->sorted, compare);
  for (int i = 0; i < work->cells; i++) {
    out->member[i] = work->cell[work->sorted[i].at];
    out->first[work->sorted[i].cluster + 1] = i + 1;
  }
  for (int n = 0; n < work->clusters; n++)
    memcpy(out->center[n], work->center[n].position, sizeof out->center[n]);
  out->count = work->clusters;
  return FG_STATUS_OK;
}

fg_status fg__lloyd_create(fg__lloyd *out, fg_context *context, const fg__domain *domain,
                           int count, double weight)
{
  *out = (fg__lloyd){0};
  clustering work = {.context = context,
                     .domain = domain,
                     .lambda = fg__domain_fair_share(domain, count),
                     .weight = weight};
  fg_status status = allocate(&work, count);
  if (status == FG_STATUS_OK && work.clusters > 0)
    status = settle(&work);
  if (status == FG_STATUS_OK)
    status = fill_result(out, &work);
  clear(&work);
  return status;
}

void fg__lloyd_clear(fg__lloyd *lloyd)
{
  free(lloyd->center);
  free(lloyd->first);
  free(lloyd->member);
  *lloyd = (fg__lloyd){0};
}
