/* Quadrilaterals between neighbouring points of a curvilinear grid, which may close
 * around the globe and across a tripolar fold. */
#include "base/memory.h"
#include "base/vector.h"
#include "sample/curvilinear/points.h"
#include "sample/gaps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points nearer than this fraction of a step coincide. */
static const double SAME_PLACE = 0.1;

/* Largest distance of neighbours across the seam, in steps. */
static const double NEXT_PLACE = 1.6;

enum { MOST_REPEATED = 3, COMPARED = 60 };

static double distance(const fg__positions *at, size_t a, size_t b)
{
  double one[3], other[3];
  fg__unit_vector(one, at, a);
  fg__unit_vector(other, at, b);
  return fg__distance(one, other);
}

/* The mean distance, over rows, of the first column's points from those of another, in
 * steps along i. */
static double seam(const fg__positions *at, const size_t size[2], size_t column)
{
  double sum = 0.0;
  size_t count = 0;
  for (size_t j = 0; j < size[1]; j += size[1] / COMPARED + 1) {
    const size_t row = j * size[0];
    const double step = distance(at, row, row + 1);
    const double off = distance(at, row, row + column);
    if (!(step > 0.0) || !isfinite(off))
      continue;
    sum += off / step;
    ++count;
  }
  return count > 0 ? sum / (double)count : HUGE_VAL;
}

void fg__rows_closure(size_t *repeated, bool *closed, const fg__positions *at,
                      const size_t size[2])
{
  *repeated = 0;
  *closed = false;
  for (size_t r = 1; r <= MOST_REPEATED && size[0] > 2 * r + 2; ++r)
    if (seam(at, size, size[0] - r) < SAME_PLACE) {
      *repeated = r;
      *closed = true;
      return;
    }
  *closed = size[0] > 3 && seam(at, size, size[0] - 1) < NEXT_PLACE;
}

/* Whether the last row is folded: column i is beside column n - 1 - i. */
static bool is_folded(const fg__positions *at, const size_t size[2], size_t columns)
{
  double across = 0.0, steps = 0.0;
  const size_t last = (size[1] - 1) * size[0];
  for (size_t i = 0; i < columns; i += columns / COMPARED + 1) {
    const double off = distance(at, last + i, last + columns - 1 - i);
    const double step = distance(at, last + i, last + i - size[0]);
    if (!isfinite(off) || !isfinite(step))
      continue;
    across += off;
    steps += step;
  }
  return steps > 0.0 && across < NEXT_PLACE * steps && across > SAME_PLACE * steps;
}

static void put(int *corner, size_t n, size_t a, size_t b, size_t c, size_t d)
{
  corner[4 * n] = (int)a;
  corner[4 * n + 1] = (int)b;
  corner[4 * n + 2] = (int)c;
  corner[4 * n + 3] = (int)d;
}

/* Marks cells that lie over gaps along one direction: `along` i (0) or j (1). */
static void mark_gaps(bool *over, const fg__positions *at, const size_t size[2],
                      size_t columns, int along, double *length, bool *gap)
{
  const size_t n = along == 0 ? columns : size[1], lines = along == 0 ? size[1] : columns;
  const size_t step = along == 0 ? 1 : size[0], across = along == 0 ? size[0] : 1;
  for (size_t line = 0; line < lines; ++line) {
    for (size_t i = 0; i + 1 < n; ++i)
      length[i] = distance(at, line * across + i * step, line * across + (i + 1) * step);
    if (fg__gaps_find(gap, length, n - 1) == 0)
      continue;
    for (size_t i = 0; i + 1 < n; ++i) {
      const size_t cell = line * across + i * step;
      over[cell] = over[cell] || gap[i];
      if (line > 0)
        over[cell - across] = over[cell - across] || gap[i];
    }
  }
}

/* Takes out the cells over gaps; *left_out: how many. */
static fg_status leave_out_gaps(int *corner, size_t *count, size_t *left_out,
                                const fg__dataset *data, const fg__positions *at,
                                const size_t size[2], size_t columns)
{
  const size_t longest = size[0] > size[1] ? size[0] : size[1];
  bool *over = fg__allocate(size[0] * size[1], sizeof *over);
  bool *gap = fg__allocate(longest, sizeof *gap);
  double *length = fg__allocate(longest, sizeof *length);
  fg_status status = FG_STATUS_OK;
  if (!over || !gap || !length)
    status = fg__fail_memory(data->context, "gaps", size[0] * size[1]);
  for (int along = 0; along < 2 && status == FG_STATUS_OK; ++along)
    mark_gaps(over, at, size, columns, along, length, gap);
  size_t kept = 0;
  for (size_t n = 0; n < *count && status == FG_STATUS_OK; ++n)
    if (!over[corner[4 * n]])
      memmove(corner + 4 * kept++, corner + 4 * n, 4 * sizeof *corner);
  *left_out = *count - kept;
  if (status == FG_STATUS_OK)
    *count = kept;
  free(over);
  free(gap);
  free(length);
  return status;
}

fg_status fg__cells_make(int **corner, size_t *count, size_t *left_out,
                         const fg__dataset *data, const fg__positions *at,
                         const size_t size[2], size_t repeated, bool closed)
{
  const size_t columns = size[0] - repeated, across = closed ? columns : columns - 1;
  const bool folded = is_folded(at, size, columns);
  const size_t most = across * size[1];
  size_t n = 0;
  *corner = fg__allocate(most, 4 * sizeof **corner);
  if (!*corner)
    return fg__fail_memory(data->context, "cells", most * 4 * sizeof **corner);
  for (size_t j = 0; j + 1 < size[1]; ++j)
    for (size_t i = 0; i < across; ++i) {
      const size_t a = j * size[0] + i, b = j * size[0] + (i + 1) % columns;
      put(*corner, n++, a, b, b + size[0], a + size[0]);
    }
  const size_t last = (size[1] - 1) * size[0];
  for (size_t i = 0; i + 1 < columns / 2 && folded; ++i)
    put(*corner, n++, last + i, last + i + 1, last + columns - 2 - i,
        last + columns - 1 - i);
  *count = n;
  return leave_out_gaps(*corner, count, left_out, data, at, size, columns);
}
