/* Readers of the nearest tangents. */
#include "score/reader.h"

#include "base/clones.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* An icon's sample in units of cells, from the raster's corner. */
typedef struct site {
  double at[3], tangent[3];
} site;

/* Of a row of cells, a number a cell each; single precision places a sample within 1e-4
 * cells of a raster of some hundred. */
typedef struct row_work {
  float *place; /* x of the centre */
  float *near_x,
      *near_rest;         /* of the icon's nearest sample: x, squared distance across */
  float *near_tangent[3]; /* and tangent */
  float *best, *best_tangent[3]; /* squared distance of the nearest so far */
  float *sum[3];
  /* the envelope: samples, and from which x on each is the nearest */
  const site **hull;
  double *start;
  float *memory;
} row_work;

typedef struct work {
  const fg__domain_raster *raster;
  const fg__samples *samples;
  site *sites;    /* each icon's by x */
  double scale;   /* units of the field in one of ours */
  double epsilon; /* squared */
  row_work *rows; /* one a thread */
  size_t most;    /* samples of an icon */
  fg__nearest *out;
} work;

static int compare_sites(const void *a, const void *b)
{
  const site *p = a, *q = b;
  for (int k = 0; k < 3; ++k)
    if (p->at[k] != q->at[k])
      return p->at[k] < q->at[k] ? -1 : 1;
  return 0;
}

static fg_status sort_sites(work *w, fg_context *context)
{
  const fg__samples *samples = w->samples;
  w->sites = fg__allocate(samples->count, sizeof *w->sites);
  if (!w->sites)
    return fg__fail_memory(context, "samples of icons", samples->count * sizeof(site));
  for (size_t n = 0; n < samples->count; ++n)
    for (int k = 0; k < w->raster->dimension; ++k) {
      w->sites[n].at[k] = (samples->position[n][k] - w->raster->origin[k]) / w->scale;
      w->sites[n].tangent[k] = samples->tangent[n][k];
    }
  for (int n = 0; n < samples->icons; ++n) {
    const size_t count = samples->first[n + 1] - samples->first[n];
    qsort(w->sites + samples->first[n], count, sizeof *w->sites, compare_sites);
    w->most = count > w->most ? count : w->most;
  }
  return FG_STATUS_OK;
}

static bool row_create(row_work *row, const work *w)
{
  const size_t columns = (size_t)w->raster->size[0];
  float **const part[] = {&row->place,
                          &row->near_x,
                          &row->near_rest,
                          &row->near_tangent[0],
                          &row->near_tangent[1],
                          &row->near_tangent[2],
                          &row->best,
                          &row->best_tangent[0],
                          &row->best_tangent[1],
                          &row->best_tangent[2],
                          &row->sum[0],
                          &row->sum[1],
                          &row->sum[2]};
  const size_t parts = sizeof part / sizeof part[0];
  row->memory = fg__allocate(parts * columns, sizeof(float));
  row->hull = fg__allocate(w->most, sizeof(const site *));
  row->start = fg__allocate(w->most + 1, sizeof(double));
  for (size_t n = 0; row->memory && n < parts; ++n)
    *part[n] = row->memory + n * columns;
  for (size_t i = 0; row->memory && i < columns; ++i)
    row->place[i] = (float)(((double)i + 0.5) * w->raster->cell[0] / w->scale);
  return row->memory && row->hull && row->start;
}

static void row_clear(row_work *row)
{
  free(row->memory);
  free(row->hull);
  free(row->start);
}

/* Squared distance of a sample from the row's line. */
static double rest_of(const site *sample, const double centre[3])
{
  const double y = sample->at[1] - centre[1], z = sample->at[2] - centre[2];
  return y * y + z * z;
}

/* The samples of an icon that are the nearest anywhere on the line, in the order of x. */
static int find_envelope(row_work *row, const site *first, size_t count,
                         const double centre[3])
{
  int used = 0;
  for (const site *sample = first; sample < first + count; ++sample) {
    const double rest = rest_of(sample, centre);
    double start = -HUGE_VAL;
    bool nowhere = false;
    while (used > 0 && !nowhere) {
      const site *last = row->hull[used - 1];
      const double last_rest = rest_of(last, centre);
      const double apart = sample->at[0] - last->at[0];
      start = -HUGE_VAL;
      if (apart > 0.0)
        start = 0.5 * ((rest - last_rest) / apart + sample->at[0] + last->at[0]);
      else
        nowhere = rest >= last_rest;
      if (nowhere || start > row->start[used - 1])
        break;
      --used;
    }
    if (nowhere)
      continue;
    row->start[used] = used ? start : -HUGE_VAL;
    row->hull[used++] = sample;
  }
  return used;
}

/* Writes the nearest sample's numbers to every cell of the row. */
static void spell_out(row_work *row, int used, int columns, int dimension,
                      const double centre[3])
{
  int i = 0;
  for (int n = 0; n < used && i < columns; ++n) {
    const site *sample = row->hull[n];
    const double rest = rest_of(sample, centre);
    const double end = n + 1 < used ? row->start[n + 1] : HUGE_VAL;
    const int begin = i;
    while (i < columns && (double)row->place[i] < end)
      ++i;
    for (int c = begin; c < i; ++c) {
      row->near_x[c] = (float)sample->at[0];
      row->near_rest[c] = (float)rest;
      row->near_tangent[0][c] = (float)sample->tangent[0];
      row->near_tangent[1][c] = (float)sample->tangent[1];
    }
    for (int c = begin; dimension == 3 && c < i; ++c)
      row->near_tangent[2][c] = (float)sample->tangent[2];
  }
}

/* Adds the icon whose nearest samples were spelled out. */
FG__CLONES static void add_2d(const row_work *row, int columns, float epsilon)
{
  const float *restrict place = row->place, *restrict near_x = row->near_x,
                        *restrict rest = row->near_rest,
                        *restrict tangent_x = row->near_tangent[0],
                        *restrict tangent_y = row->near_tangent[1];
  float *restrict best = row->best, *restrict best_x = row->best_tangent[0],
                  *restrict best_y = row->best_tangent[1], *restrict sum_x = row->sum[0],
                  *restrict sum_y = row->sum[1];
  for (int i = 0; i < columns; ++i) {
    const float along = place[i] - near_x[i];
    const float square = along * along + rest[i], rounded = square + epsilon;
    const float weight = 1.0F / (rounded * sqrtf(rounded));
    const bool nearer = square < best[i];
    sum_x[i] += weight * tangent_x[i];
    sum_y[i] += weight * tangent_y[i];
    best[i] = nearer ? square : best[i];
    best_x[i] = nearer ? tangent_x[i] : best_x[i];
    best_y[i] = nearer ? tangent_y[i] : best_y[i];
  }
}

FG__CLONES static void add_3d(const row_work *row, int columns, float epsilon)
{
  const float *restrict place = row->place, *restrict near_x = row->near_x,
                        *restrict rest = row->near_rest;
  float *restrict best = row->best;
  for (int i = 0; i < columns; ++i) {
    const float along = place[i] - near_x[i];
    const float square = along * along + rest[i], rounded = square + epsilon;
    const float weight = 1.0F / (rounded * rounded);
    const bool nearer = square < best[i];
    best[i] = nearer ? square : best[i];
    for (int k = 0; k < 3; ++k) {
      const float tangent = row->near_tangent[k][i];
      row->sum[k][i] += weight * tangent;
      row->best_tangent[k][i] = nearer ? tangent : row->best_tangent[k][i];
    }
  }
}

static void write_row(const work *w, const row_work *row, size_t first)
{
  const fg__domain_raster *raster = w->raster;
  for (int i = 0; i < raster->size[0]; ++i) {
    const size_t place = first + (size_t)i;
    double field[3] = {0}, near[3] = {0}, weighted[3] = {0};
    if (!raster->inside[place])
      continue;
    w->out->distance[place] = (float)(sqrt((double)row->best[i]) * w->scale);
    if (!raster->counts[place])
      continue;
    for (int k = 0; k < raster->dimension; ++k) {
      field[k] = (double)raster->direction[k][place];
      near[k] = (double)row->best_tangent[k][i];
      weighted[k] = (double)row->sum[k][i];
    }
    w->out->angle[place] = (float)fg__angle(near, field);
    w->out->weighted_angle[place] = (float)fg__angle(weighted, field);
  }
}

static bool is_empty(const fg__domain_raster *raster, size_t first)
{
  for (int i = 0; i < raster->size[0]; ++i)
    if (raster->inside[first + (size_t)i])
      return false;
  return true;
}

static void read_row(const work *w, row_work *row, int number)
{
  const fg__domain_raster *raster = w->raster;
  const fg__samples *samples = w->samples;
  const int columns = raster->size[0], dimension = raster->dimension == 3 ? 3 : 2;
  const size_t first = (size_t)number * (size_t)columns;
  const int at[2] = {number % raster->size[1], number / raster->size[1]};
  double centre[3] = {0.0};
  if (is_empty(raster, first))
    return;
  for (int k = 1; k < dimension; ++k)
    centre[k] = (at[k - 1] + 0.5) * raster->cell[k] / w->scale;
  for (int i = 0; i < columns; ++i) {
    row->best[i] = HUGE_VALF;
    for (int k = 0; k < 3; ++k)
      row->sum[k][i] = row->best_tangent[k][i] = 0.0F;
  }
  for (int n = 0; n < samples->icons; ++n) {
    const size_t begin = samples->first[n], end = samples->first[n + 1];
    if (begin == end)
      continue;
    const int used = find_envelope(row, w->sites + begin, end - begin, centre);
    spell_out(row, used, columns, dimension, centre);
    (dimension == 3 ? add_3d : add_2d)(row, columns, (float)w->epsilon);
  }
  write_row(w, row, first);
}

static void read_rows(void *argument, const fg__thread *thread)
{
  const work *w = argument;
  int row, end;
  fg__threads_range(thread, (int)fg__domain_raster_rows(w->raster), 1, &row, &end);
  for (; row < end; ++row)
    read_row(w, &w->rows[thread->index], row);
}

static fg_status allocate(fg__nearest *out, fg_context *context, size_t cells)
{
  out->angle = fg__allocate(cells, sizeof(float));
  out->weighted_angle = fg__allocate(cells, sizeof(float));
  out->distance = fg__allocate(cells, sizeof(float));
  if (out->angle && out->weighted_angle && out->distance)
    return FG_STATUS_OK;
  return fg__fail_memory(context, "angles", 3 * cells * sizeof(float));
}

fg_status fg__nearest_create(fg__nearest *out, fg_context *context,
                             const fg__domain_raster *raster, const fg__samples *samples,
                             double lambda, fg__threads *threads)
{
  const double rounding = 0.05 * lambda / raster->spacing;
  const int thread_count = fg__threads_count(threads);
  work w = {.raster = raster,
            .samples = samples,
            .scale = raster->spacing,
            .epsilon = rounding * rounding,
            .out = out};
  *out = (fg__nearest){0};
  fg_status status = allocate(out, context, raster->cells);
  if (status == FG_STATUS_OK)
    status = sort_sites(&w, context);
  w.rows = fg__allocate((size_t)thread_count, sizeof *w.rows);
  bool rows = w.rows != NULL;
  for (int n = 0; n < thread_count && rows && status == FG_STATUS_OK; ++n)
    rows = row_create(&w.rows[n], &w);
  if (!rows && status == FG_STATUS_OK)
    status = fg__fail_memory(context, "rows of a score", 0);
  if (status == FG_STATUS_OK)
    fg__threads_run(threads, read_rows, &w);
  for (int n = 0; w.rows && n < thread_count; ++n)
    row_clear(&w.rows[n]);
  free(w.rows);
  free(w.sites);
  return status != FG_STATUS_OK ? status : fg__check_stop(context);
}

void fg__nearest_clear(fg__nearest *nearest)
{
  free(nearest->angle);
  free(nearest->weighted_angle);
  free(nearest->distance);
  *nearest = (fg__nearest){0};
}
