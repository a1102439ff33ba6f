/* How icons lie: to each other, to the field, and what they leave empty. */
#include "base/memory.h"
#include "score/measures.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Nearer to another icon, in lambda, is crowded. */
static const double CROWDED = 0.1;

enum { MOST_BUCKETS = 1 << 22 };

/* Samples in buckets at least as wide as the distance that matters. */
typedef struct buckets {
  const fg__samples *samples;
  int dimension, size[3];
  double low[3], width, reach;
  size_t *last, *next; /* of a bucket; of a sample: SIZE_MAX: none */
  int *icon;           /* a sample's */
} buckets;

static size_t bucket_of(const buckets *b, const double position[3], int at[3])
{
  size_t place = 0;
  at[2] = 0;
  for (int k = b->dimension - 1; k >= 0; --k) {
    const double number = floor((position[k] - b->low[k]) / b->width);
    at[k] = number < 0.0 ? 0 : number >= b->size[k] ? b->size[k] - 1 : (int)number;
    place = place * (size_t)b->size[k] + (size_t)at[k];
  }
  return place;
}

static fg_status buckets_create(buckets *out, fg_context *context,
                                const fg__domain_raster *raster,
                                const fg__samples *samples, double reach)
{
  *out = (buckets){.samples = samples,
                   .dimension = raster->dimension,
                   .size = {1, 1, 1},
                   .width = fmax(reach, raster->spacing),
                   .reach = reach};
  double count = MOST_BUCKETS + 1.0;
  for (; count > MOST_BUCKETS; out->width *= 2.0) {
    count = 1.0;
    for (int k = 0; k < raster->dimension; ++k)
      count *= 1.0 + floor(raster->size[k] * raster->cell[k] / out->width);
    if (count <= MOST_BUCKETS)
      break;
  }
  for (int k = 0; k < raster->dimension; ++k) {
    out->size[k] = 1 + (int)floor(raster->size[k] * raster->cell[k] / out->width);
    out->low[k] = raster->origin[k];
  }
  out->last = fg__allocate((size_t)count, sizeof *out->last);
  out->next = fg__allocate(samples->count, sizeof *out->next);
  out->icon = fg__allocate(samples->count, sizeof *out->icon);
  if (!out->last || !out->next || !out->icon)
    return fg__fail_memory(context, "samples of icons", (size_t)count * sizeof(size_t));
  for (size_t n = 0; n < (size_t)count; ++n)
    out->last[n] = SIZE_MAX;
  for (int icon = 0; icon < samples->icons; ++icon)
    for (size_t n = samples->first[icon]; n < samples->first[icon + 1]; ++n) {
      int ignored[3];
      size_t *last = &out->last[bucket_of(out, samples->position[n], ignored)];
      out->icon[n] = icon;
      out->next[n] = *last;
      *last = n;
    }
  return FG_STATUS_OK;
}

static void buckets_clear(buckets *b)
{
  free(b->last);
  free(b->next);
  free(b->icon);
}

static bool is_near(const double a[3], const double b[3], double reach)
{
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z < reach * reach;
}

static bool has_other(const buckets *b, size_t place, size_t sample)
{
  const fg__samples *samples = b->samples;
  for (size_t n = b->last[place]; n != SIZE_MAX; n = b->next[n])
    if (b->icon[n] != b->icon[sample] &&
        is_near(samples->position[n], samples->position[sample], b->reach))
      return true;
  return false;
}

static bool is_crowded(const buckets *b, size_t sample)
{
  int at[3] = {0}, from[3], to[3];
  bucket_of(b, b->samples->position[sample], at);
  for (int k = 0; k < 3; ++k) {
    from[k] = at[k] > 0 ? at[k] - 1 : 0;
    to[k] = at[k] + 1 < b->size[k] ? at[k] + 1 : b->size[k] - 1;
  }
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) {
        const size_t row = (size_t)k * (size_t)b->size[1] + (size_t)j;
        if (has_other(b, row * (size_t)b->size[0] + (size_t)i, sample))
          return true;
      }
  return false;
}

fg_status fg__score_clutter(double *share, fg_context *context,
                            const fg__domain_raster *raster, const fg__samples *samples,
                            double lambda)
{
  buckets b;
  size_t crowded = 0;
  fg_status status = buckets_create(&b, context, raster, samples, CROWDED * lambda);
  for (size_t n = 0; n < samples->count && status == FG_STATUS_OK; ++n)
    crowded += is_crowded(&b, n);
  buckets_clear(&b);
  *share = samples->count ? (double)crowded / (double)samples->count : 0.0;
  return status;
}

double fg__score_tangency(const fg__domain_raster *raster, const fg__samples *samples)
{
  double sum = 0.0;
  size_t count = 0;
  for (size_t n = 0; n < samples->count; ++n) {
    double tangent[3] = {0.0};
    if (!fg_field_tangent(raster->field, samples->position[n], tangent) ||
        (tangent[0] == 0.0 && tangent[1] == 0.0 && tangent[2] == 0.0))
      continue;
    sum += fg__angle(samples->tangent[n], tangent);
    ++count;
  }
  return sum / (double)count;
}

void fg__score_voids(double *mean, double *most, const fg__domain_raster *raster,
                     const float *distance, double lambda)
{
  double sum = 0.0, largest = 0.0;
  size_t count = 0;
  for (size_t n = 0; n < raster->cells; ++n)
    if (raster->inside[n]) {
      sum += (double)distance[n];
      largest = fmax(largest, (double)distance[n]);
      ++count;
    }
  *mean = sum / (double)count / lambda;
  *most = largest / lambda;
}
