#include "skeleton/polyline.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

bool fg__polyline_add(fg__polyline *line, const double point[3])
{
  if (line->count == INT_MAX || !fg__grow((void **)&line->point, &line->capacity,
                                          (size_t)line->count + 1, sizeof *line->point))
    return false;
  memcpy(line->point[line->count++], point, sizeof *line->point);
  return true;
}

void fg__polyline_reverse(fg__polyline *line)
{
  for (int k = 0; k < line->count / 2; ++k) {
    double *a = line->point[k], *b = line->point[line->count - 1 - k], kept[3];
    memcpy(kept, a, sizeof kept);
    memcpy(a, b, sizeof kept);
    memcpy(b, kept, sizeof kept);
  }
}

static int segment_count(const fg__polyline *line)
{
  return line->closed ? line->count : line->count - 1;
}

static double segment_length(const fg__polyline *line, int segment)
{
  const double *a = line->point[segment];
  const double *b = line->point[(segment + 1) % line->count];
  return hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
}

double fg__polyline_length(const fg__polyline *line)
{
  double length = 0.0;
  for (int k = 0; k < segment_count(line); ++k)
    length += segment_length(line, k);
  return length;
}

bool fg__polyline_resample(fg__polyline *line, double step)
{
  double length = fg__polyline_length(line);
  if (line->count < 2 || !(length > 0.0))
    return true;
  double wanted = fmin(fmax(round(length / step), line->closed ? 3.0 : 1.0), INT_MAX / 2);
  int pieces = (int)wanted;
  fg__polyline even = {.closed = line->closed};
  int segment = 0;
  double before = 0.0; /* length up to the segment */
  double here = segment_length(line, 0);
  for (int k = 0; k < (line->closed ? pieces : pieces + 1); ++k) {
    double at = length * k / pieces;
    while (before + here < at && segment + 1 < segment_count(line)) {
      before += here;
      here = segment_length(line, ++segment);
    }
    double share = here > 0.0 ? fmin((at - before) / here, 1.0) : 0.0;
    const double *a = line->point[segment];
    const double *b = line->point[(segment + 1) % line->count];
    const double point[3] = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]),
                             a[2] + share * (b[2] - a[2])};
    if (!fg__polyline_add(&even, point)) {
      fg__polyline_clear(&even);
      return false;
    }
  }
  fg__polyline_clear(line);
  *line = even;
  return true;
}

void fg__polyline_clear(fg__polyline *line)
{
  free(line->point);
  *line = (fg__polyline){0};
}
