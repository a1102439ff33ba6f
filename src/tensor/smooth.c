#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "tensor/eigenvalues.h"
#include "tensor/length.h"
#include "tensor/tensor.h"

/* Beyond three standard deviations a Gaussian holds 0.3 % of its weight. */
static const double reach = 3.0;

/* Coherence, the length of the mean of unit directions' double-angle vectors, above which
 * the full anisotropy is given back. Chosen by eye among 1, 2/3, 1/2 and 1/3 on global
 * winds: less leaves blobs where the wind turns within a cluster, more makes cusps. */
const double fg__full_coherence = 0.5;

/* A Gaussian cut at reach; weights[k] for offsets 0 ... radius. */
typedef struct gaussian {
  int radius;
  float *weights;
} gaussian;

int fg__smoothing_radius(const fg__cells *cells, int k, double width)
{
  double radius = ceil(reach * (width / cells->spacing[k]));
  int most = fg__domain_count(cells, k) / 2;
  return radius < most ? (int)radius : most;
}

static bool gaussian_create(gaussian *out, const fg__cells *cells, int k, double width)
{
  double width_in_cells = width / cells->spacing[k];
  out->radius = fg__smoothing_radius(cells, k, width);
  out->weights = fg__allocate((size_t)out->radius + 1, sizeof *out->weights);
  for (int n = 0; out->weights && n <= out->radius; ++n)
    out->weights[n] = (float)exp(-0.5 * n * n / (width_in_cells * width_in_cells));
  return out->weights != NULL;
}

/* Index of a cell beyond the grid: round a periodic axis, or none. */
static int neighbour(int index, int count, bool periodic)
{
  if (index >= 0 && index < count)
    return index;
  return periodic ? (index % count + count) % count : -1;
}

/* A tensor to be smoothed. Members take rows along x, then columns of all rows and
 * layers; a whole plane of scratch is shared out likewise. */
typedef struct smoothing {
  fg__tensor *tensor;
  double anisotropy;
  const fg__cells *cells;
  gaussian kernel[3];
  bool wraps[3];
  float *scratch; /* a plane */
  float *row;     /* one a thread */
} smoothing;

/* The axes of the separable sum, in place; in each the inner loop is contiguous. A cell's
 * terms are added in the order of their offsets whatever the box, so that boxes agree. */
static void sum_along_x(float *values, const smoothing *s, int first_row, int end_row,
                        float *scratch)
{
  const gaussian *kernel = &s->kernel[0];
  bool periodic = s->wraps[0];
  int columns = s->cells->count[0];
  if (!kernel->weights)
    return; /* an axis without a Gaussian stays as it is */
  for (int j = first_row; j < end_row; ++j) {
    float *out = values + (size_t)j * (size_t)columns;
    memcpy(scratch, out, (size_t)columns * sizeof *out);
    memset(out, 0, (size_t)columns * sizeof *out);
    for (int k = -kernel->radius; k <= kernel->radius; ++k) {
      float weight = kernel->weights[k < 0 ? -k : k];
      int first = k < 0 ? -k : 0, last = k > 0 ? columns - k : columns;
      for (int i = first; i < last; ++i)
        out[i] += weight * scratch[i + k];
      for (int i = 0; periodic && i < columns; ++i)
        if (i < first || i >= last)
          out[i] += weight * scratch[neighbour(i + k, columns, true)];
    }
  }
}

/* Over `rows` pieces of `columns` values that lie `stride` apart: along y or z. */
static void sum_rows(float *values, size_t columns, int rows, size_t stride,
                     const gaussian *kernel, bool periodic, float *scratch)
{
  if (!kernel->weights)
    return;
  for (size_t j = 0; j < (size_t)rows; ++j)
    memcpy(scratch + j * columns, values + j * stride, columns * sizeof *values);
  for (int j = 0; j < rows; ++j) {
    float *out = values + (size_t)j * stride;
    memset(out, 0, columns * sizeof *out);
    for (int k = -kernel->radius; k <= kernel->radius; ++k) {
      int source = neighbour(j + k, rows, periodic);
      if (source < 0)
        continue;
      float weight = kernel->weights[k < 0 ? -k : k];
      const float *row = scratch + (size_t)source * columns;
      for (size_t i = 0; i < columns; ++i)
        out[i] += weight * row[i];
    }
  }
}

static void sum_along_axes(float *values, const smoothing *s, const fg__thread *thread)
{
  const fg__cells *cells = s->cells;
  int height = cells->count[1], layers = fg__layers(cells);
  size_t width = (size_t)cells->count[0], plane = width * (size_t)height;
  int begin, end;
  fg__threads_range(thread, cells->count[0], 1, &begin, &end);
  int tallest = height > layers ? height : layers;
  float *scratch = s->scratch + (size_t)begin * (size_t)tallest;
  size_t columns = (size_t)(end - begin);
  for (int k = 0; k < layers; ++k)
    sum_rows(values + (size_t)k * plane + begin, columns, height, width, &s->kernel[1],
             s->wraps[1], scratch);
  for (int j = 0; j < height && cells->dimension == 3; ++j)
    sum_rows(values + (size_t)j * width + begin, columns, layers, plane, &s->kernel[2],
             s->wraps[2], scratch);
}

/* The double-angle vector (xx - yy, 2 xy) takes the place of xx and xy, the cell's weight
 * that of yy. */
static void take_apart_2d(fg__tensor *tensor, size_t n)
{
  float active = tensor->active[n] ? 1.0F : 0.0F;
  tensor->xx[n] = active > 0.0F ? tensor->xx[n] - tensor->yy[n] : 0.0F;
  tensor->xy[n] = active > 0.0F ? 2.0F * tensor->xy[n] : 0.0F;
  tensor->yy[n] = active;
}

/* The tensor whose double-angle vector is the mean one, brought back to full length where
 * it is coherent; its smaller eigenvalue is that of the cross direction. */
static void rebuild_2d(fg__tensor *tensor, size_t n, double anisotropy)
{
  double x = (double)(tensor->xx[n] / tensor->yy[n]);
  double y = (double)(tensor->xy[n] / tensor->yy[n]);
  double length = fg__length(x, y, 0.0) / (1.0 - anisotropy);
  double share = fmin(length / fg__full_coherence, 1.0);
  double contrast = (1.0 - anisotropy) * share;
  double cosine = length > 0.0 ? x / fg__length(x, y, 0.0) : 0.0;
  double sine = length > 0.0 ? y / fg__length(x, y, 0.0) : 0.0;
  tensor->xx[n] = (float)(1.0 - 0.5 * contrast * (1.0 - cosine));
  tensor->yy[n] = (float)(1.0 - 0.5 * contrast * (1.0 + cosine));
  tensor->xy[n] = (float)(0.5 * contrast * sine);
}

/* The part of A without trace, (1 - a)(e e^T - I / 3), and the cell's weight in place of
 * zz. */
static void take_apart_3d(fg__tensor *tensor, size_t n)
{
  float active = tensor->active[n] ? 1.0F : 0.0F;
  float mean = active * (tensor->xx[n] + tensor->yy[n] + tensor->zz[n]) / 3.0F;
  tensor->xx[n] = active * tensor->xx[n] - mean;
  tensor->yy[n] = active * tensor->yy[n] - mean;
  tensor->xy[n] *= active;
  tensor->xz[n] *= active;
  tensor->yz[n] *= active;
  tensor->zz[n] = active;
}

/* With M the mean of e e^T, p its largest eigenvalue and P = p I - M: each eigenvalue q
 * of P becomes 1 - (1 - a) min(q / fg__full_coherence, 1), and its direction stays. In a
 * plane, where q is 0 and the coherence, that is the rule of 2D. The minimum is written
 * as the quadratic linear P + square P^2 through its three values, the first of them 0 at
 * the main direction: no eigenvectors, nothing to choose where eigenvalues meet. */
static void rebuild_3d(fg__tensor *tensor, size_t n, double anisotropy)
{
  double scale = 1.0 / ((1.0 - anisotropy) * (double)tensor->zz[n]);
  double m[6] = {scale * (double)tensor->xx[n], scale * (double)tensor->xy[n],
                 scale * (double)tensor->yy[n], 0.0,
                 scale * (double)tensor->xz[n], scale * (double)tensor->yz[n]};
  m[3] = -m[0] - m[2];
  double e[3];
  fg__eigenvalues(e, m);
  double near = e[0] - e[1], far = e[0] - e[2];
  double linear = 1.0 / fg__full_coherence, square = 0.0;
  if (near >= fg__full_coherence) {
    linear = (near + far) / (near * far);
    square = -1.0 / (near * far);
  } else if (far > fg__full_coherence) {
    square = -(far / fg__full_coherence - 1.0) / (far * (far - near));
    linear -= square * near;
  }
  linear *= 1.0 - anisotropy;
  square *= 1.0 - anisotropy;
  double xx = e[0] - m[0], yy = e[0] - m[2], zz = e[0] - m[3];
  double xy = -m[1], xz = -m[4], yz = -m[5];
  tensor->xx[n] = (float)(1.0 - linear * xx - square * (xx * xx + xy * xy + xz * xz));
  tensor->yy[n] = (float)(1.0 - linear * yy - square * (xy * xy + yy * yy + yz * yz));
  tensor->zz[n] = (float)(1.0 - linear * zz - square * (xz * xz + yz * yz + zz * zz));
  tensor->xy[n] = (float)(-linear * xy - square * (xx * xy + xy * yy + xz * yz));
  tensor->xz[n] = (float)(-linear * xz - square * (xx * xz + xy * yz + xz * zz));
  tensor->yz[n] = (float)(-linear * yz - square * (xy * xz + yy * yz + yz * zz));
}

static void rebuild(fg__tensor *tensor, size_t n, double anisotropy, int dimension)
{
  if (!tensor->active[n]) {
    tensor->xx[n] = tensor->xy[n] = tensor->yy[n] = 0.0F;
    if (dimension == 3)
      tensor->zz[n] = tensor->xz[n] = tensor->yz[n] = 0.0F;
  } else if (dimension == 3) {
    rebuild_3d(tensor, n, anisotropy);
  } else {
    rebuild_2d(tensor, n, anisotropy);
  }
}

static void smooth_part(void *argument, const fg__thread *thread)
{
  const smoothing *s = argument;
  const fg__cells *cells = s->cells;
  fg__tensor *t = s->tensor;
  float *parts[6] = {t->xx, t->xy, t->yy, t->zz, t->xz, t->yz};
  int count = cells->dimension == 3 ? 6 : 3, begin, end;
  fg__threads_range(thread, cells->count[1] * fg__layers(cells), 1, &begin, &end);
  size_t width = (size_t)cells->count[0];
  size_t first = (size_t)begin * width, last = (size_t)end * width;
  for (size_t n = first; n < last; ++n)
    if (cells->dimension == 3)
      take_apart_3d(t, n);
    else
      take_apart_2d(t, n);
  for (int part = 0; part < count; ++part)
    sum_along_x(parts[part], s, begin, end, s->row + (size_t)thread->index * width);
  fg__threads_barrier(thread);
  for (int part = 0; part < count; ++part)
    sum_along_axes(parts[part], s, thread);
  fg__threads_barrier(thread);
  for (size_t n = first; n < last; ++n)
    rebuild(t, n, s->anisotropy, cells->dimension);
}

fg_status fg__tensor_smooth(fg__tensor *tensor, fg_context *context, double anisotropy,
                            const fg__cells *cells, const bool periodic[3], double width,
                            fg__threads *threads)
{
  if (!(anisotropy < 1.0))
    return FG_STATUS_OK; /* nothing is preferred */
  int layers = fg__layers(cells);
  size_t rows = (size_t)(cells->count[1] > layers ? cells->count[1] : layers);
  size_t thread_count = (size_t)fg__threads_count(threads);
  size_t scratch = (size_t)cells->count[0] * (rows + thread_count);
  smoothing s = {.tensor = tensor, .anisotropy = anisotropy, .cells = cells};
  s.scratch = fg__allocate(scratch, sizeof *s.scratch);
  fg_status status = FG_STATUS_OK;
  for (int k = 0; k < cells->dimension; ++k) {
    s.wraps[k] = periodic[k] && cells->count[k] == fg__domain_count(cells, k);
    if (!gaussian_create(&s.kernel[k], cells, k, width))
      status = FG_STATUS_MEMORY;
  }
  if (status || !s.scratch) {
    status = fg__fail_memory(context, "the smoothed tensor", scratch * sizeof(float));
  } else {
    s.row = s.scratch + (size_t)cells->count[0] * rows;
    fg__threads_run(threads, smooth_part, &s);
  }
  free(s.scratch);
  for (int k = 0; k < 3; ++k)
    free(s.kernel[k].weights);
  return status;
}
