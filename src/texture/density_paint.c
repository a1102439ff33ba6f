#include "texture/evolved.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

enum { TAPS = 4 };

/* Nodes whose values a pixel's row or column takes, and their weights: the cubic through
 * them with the slopes of their neighbours' differences (Catmull and Rom 1974). */
typedef struct taps {
  int node[TAPS];
  float weight[TAPS];
} taps;

typedef struct painting {
  float *value;
  const fg__raster *raster;
  const fg_density_arrays *density;
  taps *axis[2];
  float *row; /* a row of nodes a thread */
} painting;

static taps *find_taps(const fg_density_arrays *density, int k, int pixels)
{
  taps *out = fg__allocate((size_t)pixels, sizeof *out);
  const int nodes = density->nodes[k];
  const bool periodic = density->periodic[k];
  const int cells = periodic ? nodes : nodes - 1;
  for (int i = 0; out && i < pixels; ++i) {
    const double place = cells * ((i + 0.5) / pixels);
    const int cell = (int)fmin(floor(place), cells - 1);
    const float t = (float)(place - cell), square = t * t, cube = square * t;
    const float weight[TAPS] = {
        0.5F * (2.0F * square - cube - t), 0.5F * (3.0F * cube - 5.0F * square + 2.0F),
        0.5F * (4.0F * square - 3.0F * cube + t), 0.5F * (cube - square)};
    for (int n = 0; n < TAPS; ++n) {
      int node = cell + n - 1;
      if (periodic)
        node = (node % nodes + nodes) % nodes;
      else if (node < 0 || node >= nodes) /* the boundary's condition: no slope */
        node = node < 0 ? -node : 2 * (nodes - 1) - node;
      out[i].node[n] = node < nodes && node >= 0 ? node : 0;
      out[i].weight[n] = weight[n];
    }
  }
  return out;
}

static void paint_part(void *argument, const fg__thread *thread)
{
  const painting *p = argument;
  const fg_density_arrays *density = p->density;
  const size_t nodes = (size_t)density->nodes[0];
  float *row = p->row + (size_t)thread->index * nodes;
  int begin, end;
  fg__threads_range(thread, p->raster->size[1], 1, &begin, &end);
  for (int j = begin; j < end; ++j) {
    const taps *y = &p->axis[1][j];
    for (size_t i = 0; i < nodes; ++i) {
      float sum = 0.0F;
      for (int n = 0; n < TAPS; ++n)
        sum += y->weight[n] * density->u[(size_t)y->node[n] * nodes + i];
      row[i] = sum;
    }
    float *out = p->value + (size_t)j * (size_t)p->raster->size[0];
    for (int i = 0; i < p->raster->size[0]; ++i) {
      const taps *x = &p->axis[0][i];
      float u = 0.0F;
      for (int n = 0; n < TAPS; ++n)
        u += x->weight[n] * row[x->node[n]];
      out[i] = u;
    }
  }
}

fg_status fg__density_paint(float *value, fg_context *context, const fg__raster *raster,
                            const fg_density_arrays *density, fg__threads *threads)
{
  painting p = {.value = value, .raster = raster, .density = density};
  const size_t row = (size_t)density->nodes[0] * (size_t)fg__threads_count(threads);
  for (int k = 0; k < 2; ++k)
    p.axis[k] = find_taps(density, k, raster->size[k]);
  p.row = fg__allocate(row, sizeof *p.row);
  fg_status status = FG_STATUS_OK;
  if (p.axis[0] && p.axis[1] && p.row)
    fg__threads_run(threads, paint_part, &p);
  else
    status = fg__fail_memory(context, "a density's pixels", row * sizeof *p.row);
  free(p.axis[0]);
  free(p.axis[1]);
  free(p.row);
  return status;
}
