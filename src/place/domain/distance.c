#include "place/domain/distance.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* What a line of cells is transformed with; each array holds a line and two cells. */
typedef struct workspace {
  double *value, *result, *edge;
  int *vertex;
} workspace;

static bool allocate(workspace *work, int longest)
{
  size_t length = (size_t)longest + 3;
  work->value = fg__allocate(length, sizeof *work->value);
  work->result = fg__allocate(length, sizeof *work->result);
  work->edge = fg__allocate(length, sizeof *work->edge);
  work->vertex = fg__allocate(length, sizeof *work->vertex);
  return work->value && work->result && work->edge && work->vertex;
}

static void release(workspace *work)
{
  free(work->value);
  free(work->result);
  free(work->edge);
  free(work->vertex);
}

/* Replaces count values f by min over j of f(j) + (i - j)^2. */
static void transform_line(workspace *work, int count)
{
  const double *f = work->value;
  int *vertex = work->vertex, last = 0;
  double *edge = work->edge;
  vertex[0] = 0;
  edge[0] = -HUGE_VAL;
  edge[1] = HUGE_VAL;
  for (int i = 1; i < count; ++i) {
    double meet;
    for (;; --last) { /* edge[0] lies at -infinity */
      int j = vertex[last];
      meet = ((f[i] + (double)i * i) - (f[j] + (double)j * j)) / (2.0 * (i - j));
      if (meet > edge[last])
        break;
    }
    ++last;
    vertex[last] = i;
    edge[last] = meet;
    edge[last + 1] = HUGE_VAL;
  }
  for (int i = 0, k = 0; i < count; ++i) {
    while (edge[k + 1] < i)
      ++k;
    double way = i - vertex[k];
    work->result[i] = way * way + f[vertex[k]];
  }
}

/* One pass along axis k; a cell beyond either end counts as outside. */
static void transform_axis(float *out, workspace *work, const int cells[3], int k)
{
  size_t stride = 1;
  for (int j = 0; j < k; ++j)
    stride *= (size_t)cells[j];
  size_t all = (size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2];
  size_t block = stride * (size_t)cells[k];
  for (size_t outer = 0; outer < all; outer += block)
    for (size_t inner = 0; inner < stride; ++inner) {
      float *line = out + outer + inner;
      work->value[0] = work->value[cells[k] + 1] = 0.0;
      for (int i = 0; i < cells[k]; ++i)
        work->value[i + 1] = (double)line[(size_t)i * stride];
      transform_line(work, cells[k] + 2);
      for (int i = 0; i < cells[k]; ++i)
        line[(size_t)i * stride] = (float)work->result[i + 1];
    }
}

fg_status fg__place_distance(float *out, fg_context *context, const int *inside,
                             const int cells[3], int dimension, double spacing)
{
  size_t count = (size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2];
  int longest = 1;
  for (int k = 0; k < dimension; ++k)
    longest = cells[k] > longest ? cells[k] : longest;
  workspace work = {0};
  if (!allocate(&work, longest)) {
    release(&work);
    return fg__fail_memory(context, "a line of distances", (size_t)longest * 28);
  }
  double far = 3.0 * ((double)longest + 2.0) * ((double)longest + 2.0);
  for (size_t n = 0; n < count; ++n)
    out[n] = inside[n] ? (float)far : 0.0F;
  for (int k = 0; k < dimension; ++k)
    transform_axis(out, &work, cells, k);
  /* from centre to centre; the face lies half a cell nearer */
  for (size_t n = 0; n < count; ++n)
    out[n] = inside[n] ? (float)(spacing * (sqrt((double)out[n]) - 0.5)) : 0.0F;
  release(&work);
  return FG_STATUS_OK;
}
