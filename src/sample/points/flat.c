/* Points in space that all lie in one plane, or in two alike: a field in the plane's own
 * coordinates. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "base/memory.h"
#include "field/plane.h"
#include "sample/points/points.h"

/* Of the points' width: those so near to a plane are in it; and of their coordinates, for
 * these are text of six figures at least. */
static const double FLAT = 1e-5, FIGURES = 1e-6;

/* Of the largest component: vectors that differ by less are the same. */
static const double SAME_VECTOR = 1e-6;

/* A component of a normal that is smaller is rounding. */
static const double NO_COMPONENT = 1e-5;

static void point_of(double out[3], const fg__scatter *points, size_t i)
{
  for (int k = 0; k < 3; ++k)
    out[k] = points->position[k][i];
}

/* From point a to point b. */
static void way(double out[3], const fg__scatter *points, size_t a, size_t b)
{
  for (int k = 0; k < 3; ++k)
    out[k] = points->position[k][b] - points->position[k][a];
}

/* The point farthest from the first one, or from the line of two. */
static size_t farthest(const fg__scatter *points, const double *along, double *distance)
{
  size_t found = 0;
  *distance = 0.0;
  for (size_t i = 1; i < points->count; ++i) {
    double from[3], off[3];
    way(from, points, 0, i);
    memcpy(off, from, sizeof off);
    if (along)
      fg__cross(from, along, off);
    const double here = fg__dot(off, off);
    if (here > *distance) {
      *distance = here;
      found = i;
    }
  }
  *distance = sqrt(*distance);
  return found;
}

/* The plane through the first point, the farthest from it, and the farthest from their
 * line; false where others lie off it. */
static bool find_plane(fg__plane_basis *out, const fg__scatter *points)
{
  double along[3], aside[3], normal[3], width, height, off = 0.0, largest = 0.0;
  way(along, points, 0, farthest(points, NULL, &width));
  for (int k = 0; k < 3 && width > 0.0; ++k)
    along[k] /= width;
  way(aside, points, 0, farthest(points, along, &height));
  fg__cross(along, aside, normal);
  if (!(height > FLAT * width))
    return false; /* on one line */
  for (int k = 0; k < 3; ++k) {
    normal[k] /= height;
    normal[k] = fabs(normal[k]) < NO_COMPONENT ? 0.0 : normal[k];
  }
  for (size_t i = 0; i < points->count; ++i) {
    double from[3];
    way(from, points, 0, i);
    off = fmax(off, fabs(fg__dot(from, normal)));
    for (int k = 0; k < 3; ++k)
      largest = fmax(largest, fabs(points->position[k][i]));
  }
  return off <= FLAT * width + FIGURES * largest && fg__plane_basis_of(out, normal);
}

/* A point of two layers across an axis. */
typedef struct layered {
  double at[2]; /* in its layer */
  bool high;
  size_t point;
} layered;

static int by_place(const void *a, const void *b)
{
  const layered *p = a, *q = b;
  for (int k = 0; k < 2; ++k)
    if (p->at[k] != q->at[k])
      return p->at[k] > q->at[k] ? 1 : -1;
  return p->high - q->high;
}

static bool have_same_vector(const fg__scatter *points, size_t a, size_t b,
                             double rounding)
{
  for (int c = 0; c < 3; ++c) {
    const double x = (double)points->velocity[c][a], y = (double)points->velocity[c][b];
    if (!(fabs(x - y) <= rounding) && !(isnan(x) && isnan(y)))
      return false;
  }
  return true;
}

/* Whether the points are two layers across axis k, the ends of its coordinates, of which
 * each has a point and its vector where the other has. */
static bool are_alike(layered *list, const fg__scatter *points, int k,
                      const double ends[2], double rounding)
{
  const double same = FIGURES * fmax(fabs(ends[0]), fabs(ends[1]));
  for (size_t i = 0; i < points->count; ++i) {
    const double z = points->position[k][i];
    const bool high = fabs(z - ends[1]) <= same;
    if (!high && !(fabs(z - ends[0]) <= same))
      return false;
    list[i] = (layered){
        {points->position[(k + 1) % 3][i], points->position[(k + 2) % 3][i]}, high, i};
  }
  qsort(list, points->count, sizeof *list, by_place);
  for (size_t i = 0; i + 1 < points->count; i += 2)
    if (list[i].high || !list[i + 1].high || list[i].at[0] != list[i + 1].at[0] ||
        list[i].at[1] != list[i + 1].at[1] ||
        !have_same_vector(points, list[i].point, list[i + 1].point, rounding))
      return false;
  return points->count % 2 == 0 && ends[1] - ends[0] > 2.0 * same;
}

static void keep_low(fg__scatter *points, int k, const double ends[2])
{
  size_t kept = 0;
  for (size_t i = 0; i < points->count; ++i) {
    if (points->position[k][i] > 0.5 * (ends[0] + ends[1]))
      continue;
    for (int c = 0; c < 3; ++c) {
      points->position[c][kept] = points->position[c][i];
      points->velocity[c][kept] = points->velocity[c][i];
    }
    if (points->record)
      points->record[kept] = points->record[i];
    ++kept;
  }
  points->count = kept;
}

/* Leaves one of two layers that are alike, as the front and the back of a plane's mesh;
 * *other: where the other one is. */
static bool drop_layer(fg__scatter *points, double *other)
{
  double largest = 0.0;
  bool found = false;
  layered *list =
      points->count > 2 * 3 ? fg__allocate(points->count, sizeof *list) : NULL;
  for (size_t i = 0; i < points->count; ++i)
    for (int c = 0; c < 3; ++c)
      if (isfinite(points->velocity[c][i]))
        largest = fmax(largest, fabs((double)points->velocity[c][i]));
  for (int k = 0; k < 3 && list && !found; ++k) {
    double ends[2] = {HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < points->count; ++i) {
      ends[0] = fmin(ends[0], points->position[k][i]);
      ends[1] = fmax(ends[1], points->position[k][i]);
    }
    found = are_alike(list, points, k, ends, SAME_VECTOR * largest);
    if (found)
      keep_low(points, k, ends);
    *other = ends[1];
  }
  free(list);
  return found;
}

/* Axis k of space becomes the first or second, exactly. */
static void take_axis(fg__scatter *points, int to, int k)
{
  double *position = points->position[to];
  float *velocity = points->velocity[to];
  points->position[to] = points->position[k];
  points->velocity[to] = points->velocity[k];
  points->position[k] = position;
  points->velocity[k] = velocity;
}

static void turn(const fg__scatter *points, const fg__plane_basis *basis)
{
  for (size_t i = 0; i < points->count; ++i) {
    double at[3], velocity[3];
    point_of(at, points, i);
    for (int k = 0; k < 3; ++k)
      velocity[k] = (double)points->velocity[k][i];
    for (int k = 0; k < 2; ++k) {
      points->position[k][i] = fg__dot(at, basis->direction[k]);
      points->velocity[k][i] = (float)fg__dot(velocity, basis->direction[k]);
    }
  }
}

/* What is called "z = 4" where all points have one z; `other`: that of a layer like it,
 * or NULL. */
static void name_level(fg__flat_words *words, const fg__scatter *points, int across,
                       const double *other)
{
  static const char *const letters[] = {"x", "y", "z"};
  char number[FG__NUMBER_BYTES], second[FG__NUMBER_BYTES] = "";
  const char *name = words->all.axis_name[across], *units = words->all.axis_units[across];
  if (words->all.level)
    return;
  fg__number_write(number, points->position[across][0]);
  if (other)
    fg__number_write(second, *other);
  snprintf(words->level, sizeof words->level, "%.60s = %s%s%s%s%.40s",
           name && name[0] ? name : letters[across], number, other ? " and " : "", second,
           units && units[0] ? " " : "", units ? units : "");
  words->all.level = words->level;
}

static void name_axes(fg__flat_words *words, const fg__plane_basis *basis)
{
  static const char *const turned[] = {"x'", "y'", "z'"};
  const fg_field_arrays before = words->all;
  for (int k = 0; k < 2; ++k) {
    const int along = basis->axis[k];
    const bool is_axis = fg__plane_is_axis(basis, k);
    words->all.axis_name[k] = is_axis ? before.axis_name[along] : turned[along];
    words->all.axis_units[k] = before.axis_units[along];
    words->all.velocity_name[k] = is_axis ? before.velocity_name[along] : NULL;
  }
  words->all.axis_name[2] = words->all.axis_units[2] = NULL;
  words->all.velocity_name[2] = NULL;
}

void fg__scatter_flatten(fg__scatter *points, fg__flat_words *words)
{
  fg__plane_basis basis;
  double other = 0.0;
  if (points->dimension < 3 || points->count < 3)
    return;
  const bool layers = drop_layer(points, &other);
  if (!find_plane(&basis, points))
    return;
  const bool along_axes = fg__plane_is_axis(&basis, 0) && fg__plane_is_axis(&basis, 1);
  if (along_axes) {
    name_level(words, points, basis.across, layers ? &other : NULL);
    for (int k = 0; k < 2; ++k)
      if (basis.axis[k] != k)
        take_axis(points, k, basis.axis[k]);
  } else {
    turn(points, &basis);
  }
  name_axes(words, &basis);
  if (!along_axes || basis.across != 2) {
    words->all.scale = FG_SCALE_PLAIN;
    words->all.projection = NULL;
  }
  points->dimension = 2;
}
