#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "tensor/tensor.h"

/* Beyond three standard deviations a Gaussian holds 0.3 % of its weight. */
static const double reach = 3.0;

/* Coherence, the length of the mean of unit directions' double-angle vectors, above which
 * the full anisotropy is given back. Chosen by eye among 1, 2/3, 1/2 and 1/3 on global
 * winds: less leaves blobs where the wind turns within a cluster, more makes cusps. */
static const double full_coherence = 0.5;

/* A Gaussian cut at reach; weights[k] for offsets 0 ... radius. */
typedef struct gaussian {
  int radius;
  float *weights;
} gaussian;

static bool gaussian_create(gaussian *out, double width_in_cells, int most)
{
  double radius = ceil(reach * width_in_cells);
  out->radius = radius < most ? (int)radius : most;
  out->weights = fg__allocate((size_t)out->radius + 1, sizeof *out->weights);
  for (int k = 0; out->weights && k <= out->radius; ++k)
    out->weights[k] = (float)exp(-0.5 * k * k / (width_in_cells * width_in_cells));
  return out->weights != NULL;
}

/* Index of a cell beyond the grid: round a periodic axis, or none. */
static int neighbour(int index, int count, bool periodic)
{
  if (index >= 0 && index < count)
    return index;
  return periodic ? (index % count + count) % count : -1;
}

/* The two axes of the separable sum; in both the inner loop is contiguous. */
static void sum_rows(const float *from, float *to, const int count[2],
                     const gaussian *kernel, bool periodic)
{
  size_t columns = (size_t)count[0];
  memset(to, 0, columns * (size_t)count[1] * sizeof *to);
  for (int j = 0; j < count[1]; ++j)
    for (int k = -kernel->radius; k <= kernel->radius; ++k) {
      int source = neighbour(j + k, count[1], periodic);
      if (source < 0)
        continue;
      float weight = kernel->weights[k < 0 ? -k : k];
      const float *row = from + (size_t)source * columns;
      float *out = to + (size_t)j * columns;
      for (size_t i = 0; i < columns; ++i)
        out[i] += weight * row[i];
    }
}

static void sum_columns(const float *from, float *to, const int count[2],
                        const gaussian *kernel, bool periodic)
{
  size_t columns = (size_t)count[0];
  memset(to, 0, columns * (size_t)count[1] * sizeof *to);
  for (int j = 0; j < count[1]; ++j) {
    const float *row = from + (size_t)j * columns;
    float *out = to + (size_t)j * columns;
    for (int k = -kernel->radius; k <= kernel->radius; ++k) {
      float weight = kernel->weights[k < 0 ? -k : k];
      int first = k < 0 ? -k : 0, last = k > 0 ? count[0] - k : count[0];
      for (int i = first; i < last; ++i)
        out[i] += weight * row[i + k];
      for (int i = 0; periodic && i < count[0]; ++i)
        if (i < first || i >= last)
          out[i] += weight * row[neighbour(i + k, count[0], true)];
    }
  }
}

/* The tensor whose double-angle vector (xx - yy, 2 xy) is the mean one, brought back to
 * full length where it is coherent; its smaller eigenvalue is that of the cross
 * direction. */
static void rebuild(fg__tensor *tensor, size_t cell, double anisotropy, double x,
                    double y)
{
  double length = hypot(x, y) / (1.0 - anisotropy);
  double share = fmin(length / full_coherence, 1.0);
  double contrast = (1.0 - anisotropy) * share;
  double cosine = length > 0.0 ? x / hypot(x, y) : 0.0;
  double sine = length > 0.0 ? y / hypot(x, y) : 0.0;
  tensor->xx[cell] = (float)(1.0 - 0.5 * contrast * (1.0 - cosine));
  tensor->yy[cell] = (float)(1.0 - 0.5 * contrast * (1.0 + cosine));
  tensor->xy[cell] = (float)(0.5 * contrast * sine);
}

fg_status fg__tensor_smooth(fg__tensor *tensor, fg_context *context, double anisotropy,
                            const fg__cells *cells, const bool periodic[2], double width)
{
  if (!(anisotropy < 1.0))
    return FG_STATUS_OK; /* nothing is preferred */
  size_t count = (size_t)cells->count[0] * (size_t)cells->count[1];
  float *memory = fg__allocate(4 * count, sizeof *memory);
  gaussian kernel[2] = {{0}};
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < 2; ++k)
    if (!gaussian_create(&kernel[k], width / cells->spacing[k], cells->count[k] / 2))
      status = FG_STATUS_MEMORY;
  if (status || !memory) {
    status = fg__fail_memory(context, "the smoothed tensor", 4 * count * sizeof *memory);
    goto cleanup;
  }
  float *sums[3] = {memory, memory + count, memory + 2 * count};
  float *scratch = memory + 3 * count;
  for (size_t n = 0; n < count; ++n)
    if (tensor->active[n]) {
      sums[0][n] = tensor->xx[n] - tensor->yy[n];
      sums[1][n] = 2.0F * tensor->xy[n];
      sums[2][n] = 1.0F;
    }
  for (int n = 0; n < 3; ++n) {
    sum_columns(sums[n], scratch, cells->count, &kernel[0], periodic[0]);
    sum_rows(scratch, sums[n], cells->count, &kernel[1], periodic[1]);
  }
  for (size_t n = 0; n < count; ++n)
    if (tensor->active[n])
      rebuild(tensor, n, anisotropy, (double)(sums[0][n] / sums[2][n]),
              (double)(sums[1][n] / sums[2][n]));
cleanup:
  free(memory);
  free(kernel[0].weights);
  free(kernel[1].weights);
  return status;
}
