#include "texture/grain.h"

#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"

typedef struct filling {
  float *grain;
  const fg__raster *raster;
  uint64_t key;
  float *rows; /* three a thread */
} filling;

/* Beyond a boundary that is not periodic the noise simply goes on. */
static int place_of(const fg__raster *r, int k, int index)
{
  return r->periodic[k] ? fg__raster_wrap(r, k, index) : index;
}

/* In [-1/2, 1/2). */
static float white(uint64_t key, int i, int j)
{
  uint64_t bits = fg__mix(key ^ ((uint64_t)(uint32_t)j << 32 | (uint64_t)(uint32_t)i));
  return (float)(bits >> 40) * 0x1p-24F - 0.5F;
}

/* A row of noise smoothed along itself by 1/4, 1/2, 1/4. */
static void make_row(float *out, const filling *f, int j)
{
  const fg__raster *r = f->raster;
  const int row = place_of(r, 1, j);
  float before = white(f->key, place_of(r, 0, -r->margin - 1), row);
  float at = white(f->key, place_of(r, 0, -r->margin), row);
  for (int i = 0; i < r->stride; ++i) {
    float after = white(f->key, place_of(r, 0, i - r->margin + 1), row);
    out[i] = 0.25F * (before + after) + 0.5F * at;
    before = at;
    at = after;
  }
}

/* Each row is smoothed with those beside it as it comes: three are kept, in turn. */
static void fill_part(void *argument, const fg__thread *thread)
{
  const filling *f = argument;
  const fg__raster *r = f->raster;
  const size_t stride = (size_t)r->stride;
  float *const ring = f->rows + (size_t)thread->index * 3 * stride;
  int begin, end;
  fg__threads_range(thread, r->rows, 1, &begin, &end);
  for (int j = begin - 1; j <= end; ++j) {
    make_row(ring + (size_t)((j + 3) % 3) * stride, f, j - r->margin);
    if (j <= begin)
      continue;
    const float *below = ring + (size_t)((j + 1) % 3) * stride;
    const float *at = ring + (size_t)((j + 2) % 3) * stride;
    const float *above = ring + (size_t)(j % 3) * stride;
    float *out = f->grain + (size_t)(j - 1) * stride;
    for (size_t i = 0; i < stride; ++i)
      out[i] = 0.25F * (below[i] + above[i]) + 0.5F * at[i];
  }
}

fg_status fg__grain_fill(float *grain, fg_context *context, const fg__raster *raster,
                         uint64_t seed, fg__threads *threads)
{
  size_t count = (size_t)fg__threads_count(threads) * 3 * (size_t)raster->stride;
  filling f = {grain, raster, fg__mix(seed), fg__allocate(count, sizeof *f.rows)};
  if (!f.rows)
    return fg__fail_memory(context, "noise", count * sizeof *f.rows);
  fg__threads_run(threads, fill_part, &f);
  free(f.rows);
  return FG_STATUS_OK;
}
