/* Removes triangles over regions without data: gaps, bays, the slivers of the hull. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/weighted.h"
#include "sample/points/delaunay.h"

/* Numbers that belong to each point, one after the other. */
typedef struct sheaf {
  size_t *first; /* [points + 1] */
  float *number;
} sheaf;

static void clear(sheaf *s)
{
  free(s->first);
  free(s->number);
}

/* Room for one number a corner; counts them by point. */
static fg_status create(sheaf *s, fg_context *context, const fg__triangles *triangles,
                        size_t points)
{
  *s = (sheaf){.first = fg__allocate(points + 1, sizeof *s->first),
               .number = fg__allocate(3 * triangles->count, sizeof *s->number)};
  if (!s->first || !s->number)
    return fg__fail_memory(context, "a local spacing", 3 * triangles->count * 4);
  for (size_t c = 0; c < 3 * triangles->count; ++c)
    ++s->first[triangles->corner[c] + 1];
  for (size_t p = 0; p < points; ++p)
    s->first[p + 1] += s->first[p];
  return FG_STATUS_OK;
}

static double distance(const double *position, int a, int b)
{
  const double *p = position + 3 * (size_t)a, *q = position + 3 * (size_t)b;
  return sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
              (p[2] - q[2]) * (p[2] - q[2]));
}

/* The larger of the two in the middle where there are two. */
static float median(float *number, size_t count)
{
  qsort(number, count, sizeof *number, fg__by_size_of_floats);
  return count > 0 ? number[count / 2] : 0.0f;
}

/* Each point's median of the numbers in its sheaf: the length of the edge that leaves it
 * in each triangle, or what `of` has at that edge's end. */
static void find_medians(float *out, sheaf *s, size_t *filled,
                         const fg__triangles *triangles, size_t points,
                         const double *position, const float *of)
{
  for (size_t p = 0; p < points; ++p)
    filled[p] = s->first[p];
  for (size_t c = 0; c < 3 * triangles->count; ++c) {
    const int from = triangles->corner[c];
    const int to = triangles->corner[c % 3 == 2 ? c - 2 : c + 1];
    s->number[filled[from]++] = of ? of[to] : (float)distance(position, from, to);
  }
  for (size_t p = 0; p < points; ++p)
    out[p] = median(s->number + s->first[p], s->first[p + 1] - s->first[p]);
}

/* Radius of the circle through a triangle's corners: a b c / (4 area), the area by
 * Heron's formula for any order of sides (Kahan). */
static double circle(const double *position, const int *corner)
{
  double a = distance(position, corner[0], corner[1]);
  double b = distance(position, corner[1], corner[2]);
  double c = distance(position, corner[2], corner[0]);
  const double most = fmax(a, fmax(b, c)), least = fmin(a, fmin(b, c));
  b = fmax(fmin(a, b), fmin(fmax(a, b), c));
  a = most;
  c = least;
  const double sides = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return sides > 0.0 ? a * b * c / sqrt(sides) : HUGE_VAL;
}

static double local_spacing(const int *corner, const float *spacing)
{
  return (double)fmaxf(spacing[corner[0]], fmaxf(spacing[corner[1]], spacing[corner[2]]));
}

/* Keeps the triangles whose circumradius is at most `most` times the greater of the local
 * spacing and the median circumradius: points along tracks are close to their neighbours
 * on the track alone. */
static size_t cut(fg__triangles *triangles, const float *radius, const float *spacing,
                  double most, double median_radius)
{
  const size_t all = triangles->count;
  size_t kept = 0;
  for (size_t t = 0; t < all; ++t) {
    const int *corner = triangles->corner + 3 * t;
    const double limit = most * fmax(local_spacing(corner, spacing), median_radius);
    if ((double)radius[t] <= limit)
      memmove(triangles->corner + 3 * kept++, corner, 3 * sizeof *corner);
  }
  triangles->count = kept;
  return all - kept;
}

fg_status fg__triangles_cut(fg__triangles *triangles, size_t *dropped,
                            fg_context *context, size_t points, const double *position,
                            double most)
{
  sheaf s;
  float *own = fg__allocate(points, sizeof *own);
  float *spacing = fg__allocate(points, sizeof *spacing);
  float *radius = fg__allocate(triangles->count, sizeof *radius);
  size_t *filled = fg__allocate(points, sizeof *filled);
  *dropped = 0;
  fg_status status = create(&s, context, triangles, points);
  if (status == FG_STATUS_OK && (!own || !spacing || !radius || !filled))
    status = fg__fail_memory(context, "a local spacing", points * sizeof *own);
  if (status == FG_STATUS_OK && triangles->count > 0) {
    find_medians(own, &s, filled, triangles, points, position, NULL);
    find_medians(spacing, &s, filled, triangles, points, position, own);
    for (size_t t = 0; t < triangles->count; ++t)
      s.number[t] = radius[t] = (float)circle(position, triangles->corner + 3 * t);
    const float median_radius = median(s.number, triangles->count);
    *dropped = cut(triangles, radius, spacing, most, (double)median_radius);
  }
  free(own);
  free(spacing);
  free(radius);
  free(filled);
  clear(&s);
  return status;
}
