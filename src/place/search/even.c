#include "place/search/even.h"

#include "base/memory.h"
#include "place/search/peaks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LLOYD_STEPS = 12 };

/* Farther than so many lambda from the lines that are there all is the same. */
static const double FAR = 2.0;

typedef struct points {
  const fg__place_raster *raster;
  float (*place)[3]; /* a seed, in cells */
  double (*sum)[4];  /* a seed: of its cells' places by weight, and the weight */
  float *beside;     /* a cell: square of the distance to the lines that are there */
  float *square;     /* a cell: that to the nearest of these and of the seeds */
  int *owner;        /* a cell: that seed; -1: none */
  int count;
} points;

static void cell_place(const fg__place_raster *raster, size_t cell, float place[3])
{
  for (int k = 0; k < 3; ++k) {
    place[k] = (float)(cell % (size_t)raster->cells[k]);
    cell /= (size_t)raster->cells[k];
  }
}

/* The cells within `within` cells of a place: from low to below high. */
static void box_round(const points *all, const float at[3], float within, int low[3],
                      int high[3])
{
  for (int k = 0; k < 3; ++k) {
    float first = at[k] - within, last = at[k] + within;
    int cells = all->raster->cells[k];
    low[k] = first > 0.0F ? (int)first : 0;
    high[k] = last < (float)cells - 1.0F ? (int)last + 1 : cells;
  }
}

/* Lets a seed (-1: a line that is there) at a place own the cells of a box that it is
 * nearest to. */
static void claim(points *all, int seed, const float at[3], const int low[3],
                  const int high[3])
{
  const fg__place_raster *raster = all->raster;
  for (int z = low[2]; z < high[2]; ++z)
    for (int y = low[1]; y < high[1]; ++y) {
      size_t row =
          ((size_t)z * (size_t)raster->cells[1] + (size_t)y) * (size_t)raster->cells[0];
      float dy = (float)y - at[1], dz = (float)z - at[2];
      for (int x = low[0]; x < high[0]; ++x) {
        float dx = (float)x - at[0], square = dx * dx + dy * dy + dz * dz;
        size_t cell = row + (size_t)x;
        if (square < all->square[cell]) {
          all->square[cell] = square;
          all->owner[cell] = seed;
        }
      }
    }
}

static float far_away(const fg__place_raster *raster)
{
  float sum = 0.0F;
  for (int k = 0; k < 3; ++k)
    sum += (float)raster->cells[k] * (float)raster->cells[k];
  return 4.0F * sum;
}

/* Starts over without seeds. */
static void forget(points *all)
{
  memcpy(all->square, all->beside, all->raster->count * sizeof *all->square);
  for (size_t n = 0; n < all->raster->count; ++n)
    all->owner[n] = -1;
}

static void claim_beside_lines(points *all, const fg__place_search *search)
{
  const fg__place_raster *raster = all->raster;
  for (size_t n = 0; n < raster->count; ++n)
    all->square[n] = far_away(raster);
  for (int k = 0; k < search->count; ++k) {
    const fg__place_line *line = &search->icon[k]->line;
    for (int n = 0; n < line->count; ++n) {
      float at[3] = {0};
      int low[3], high[3];
      for (int m = 0; m < raster->dimension; ++m)
        at[m] = line->position[m][n] / raster->cell - 0.5F;
      box_round(all, at, (float)FAR / raster->cell, low, high);
      claim(all, -1, at, low, high);
    }
  }
  memcpy(all->beside, all->square, raster->count * sizeof *all->square);
}

/* Without lines the first seed is the cell that counts most, the first of such. */
static fg_status choose_farthest(points *all, fg_context *context)
{
  const fg__place_raster *raster = all->raster;
  fg__place_peaks peaks;
  forget(all);
  fg_status status =
      fg__place_peaks_create(&peaks, context, raster, all->square, raster->weight);
  for (int seed = 0; seed < all->count && status == FG_STATUS_OK; ++seed) {
    size_t best;
    int low[3], high[3];
    fg__place_peaks_top(&best, &peaks);
    cell_place(raster, best, all->place[seed]);
    box_round(all, all->place[seed], sqrtf(all->square[best]), low, high);
    claim(all, seed, all->place[seed], low, high);
    fg__place_peaks_renew(&peaks, low, high);
  }
  fg__place_peaks_clear(&peaks);
  return status;
}

/* Moves each seed to the centroid of its cells. */
static void move_to_centroids(points *all)
{
  const fg__place_raster *raster = all->raster;
  size_t cell = 0;
  memset(all->sum, 0, (size_t)all->count * sizeof *all->sum);
  for (int z = 0; z < raster->cells[2]; ++z)
    for (int y = 0; y < raster->cells[1]; ++y)
      for (int x = 0; x < raster->cells[0]; ++x, ++cell) {
        double weight = (double)raster->weight[cell];
        if (!(weight > 0.0) || all->owner[cell] < 0)
          continue;
        double *sum = all->sum[all->owner[cell]];
        sum[0] += weight * x;
        sum[1] += weight * y;
        sum[2] += weight * z;
        sum[3] += weight;
      }
  for (int n = 0; n < all->count; ++n)
    for (int k = 0; k < 3 && all->sum[n][3] > 0.0; ++k)
      all->place[n][k] = (float)(all->sum[n][k] / all->sum[n][3]);
}

static fg_status even_out(points *all, fg_context *context)
{
  float within = 0.0F;
  fg_status status = choose_farthest(all, context);
  for (size_t n = 0; n < all->raster->count; ++n)
    if (all->raster->weight[n] > 0.0F && all->square[n] > within)
      within = all->square[n];
  within = 2.0F * sqrtf(within) + 1.0F;
  for (int step = 0; step < LLOYD_STEPS && status == FG_STATUS_OK; ++step) {
    move_to_centroids(all);
    forget(all);
    for (int n = 0; n < all->count; ++n) {
      int low[3], high[3];
      box_round(all, all->place[n], within, low, high);
      claim(all, n, all->place[n], low, high);
    }
    status = fg__check_stop(context);
  }
  return status;
}

static fg_status add_icons(fg__place_search *search, const points *all)
{
  const fg__place_scale *scale = &search->scale;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < all->count && status == FG_STATUS_OK; ++n) {
    fg__place_seed seed = {{0}, {0}};
    bool added;
    for (int k = 0; k < scale->dimension; ++k)
      seed.position[k] =
          scale->origin[k] + ((double)all->place[n][k] + 0.5) * scale->cell;
    seed.way[0] = seed.way[1] = scale->first_way;
    status = fg__place_add(search, &added, &seed, search->next_identity);
    search->next_identity += added;
  }
  return status;
}

fg_status fg__place_fill_evenly(fg__place_search *search, int count)
{
  const fg__place_raster *raster = &search->raster;
  points all = {.raster = raster, .count = count - search->count};
  if (all.count <= 0)
    return FG_STATUS_OK;
  all.place = fg__allocate((size_t)all.count, sizeof *all.place);
  all.sum = fg__allocate((size_t)all.count, sizeof *all.sum);
  all.beside = fg__allocate(raster->count, 2 * sizeof *all.beside);
  all.owner = fg__allocate(raster->count, sizeof *all.owner);
  fg_status status = FG_STATUS_OK;
  if (!all.place || !all.sum || !all.beside || !all.owner)
    status =
        fg__fail_memory(search->context, "even seeds",
                        raster->count * (2 * sizeof *all.beside + sizeof *all.owner));
  if (status == FG_STATUS_OK) {
    all.square = all.beside + raster->count;
    claim_beside_lines(&all, search);
    status = even_out(&all, search->context);
  }
  if (status == FG_STATUS_OK)
    status = add_icons(search, &all);
  free(all.place);
  free(all.sum);
  free(all.beside);
  free(all.owner);
  return status;
}
