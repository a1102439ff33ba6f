/* Points in space that all lie in one plane: a field in the plane's own coordinates. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/decimal.h"
#include "field/plane.h"
#include "sample/points/points.h"

/* Of the points' width: those so near to a plane are in it; and of their coordinates, for
 * these are text of six figures at least. */
static const double FLAT = 1e-5, FIGURES = 1e-6;

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

/* What is called "z = 4" where all points have one z. */
static void name_level(fg__flat_words *words, const fg__scatter *points, int across)
{
  static const char *const letters[] = {"x", "y", "z"};
  char number[FG__NUMBER_BYTES];
  const char *name = words->all.axis_name[across], *units = words->all.axis_units[across];
  if (words->all.level)
    return;
  fg__number_write(number, points->position[across][0]);
  snprintf(words->level, sizeof words->level, "%.60s = %s%s%.40s",
           name && name[0] ? name : letters[across], number, units && units[0] ? " " : "",
           units ? units : "");
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
  if (points->dimension < 3 || points->count < 3 || !find_plane(&basis, points))
    return;
  const bool along_axes = fg__plane_is_axis(&basis, 0) && fg__plane_is_axis(&basis, 1);
  if (along_axes) {
    name_level(words, points, basis.across);
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
