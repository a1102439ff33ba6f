/* Fields that placements are tested on, beside those of the scorer's tests. */
#ifndef FG__PLACE_FIELDS_TEST_H
#define FG__PLACE_FIELDS_TEST_H

#include "place/domain/domain.h"
#include "score/picture_test.h"

static const double DEGREE = 3.14159265358979324 / 180.0;

/* Around this point flows go, and sampled fields that are linear are exact. */
static const double EYE[3] = {-0.8, 6.7, 2.0};

static inline void vortex(const double position[3], double v[3])
{
  v[0] = -2.0 * (position[1] - EYE[1]);
  v[1] = 2.0 * (position[0] - EYE[0]);
}

/* It goes round and in: by about a third of the radius in a turn. */
static inline void drain(const double position[3], double v[3])
{
  v[0] = -(position[1] - EYE[1]) - 0.06 * (position[0] - EYE[0]);
  v[1] = position[0] - EYE[0] - 0.06 * (position[1] - EYE[1]);
}

/* A narrow box. */
static const sampling STRIP = {
    .dimension = 2, .nodes = {83, 9}, .low = {2, -1}, .high = {21, 0.7}};

static const sampling ROUND = {
    .dimension = 2, .nodes = {36, 19}, .low = {0, -70}, .high = {350, 75}, .round = true};

static inline void winds(const double position[3], double v[3])
{
  double x = position[0] * DEGREE, y = position[1] * DEGREE;
  v[0] = 1 + cos(2 * x + 0.3) * cos(y);
  v[1] = sin(3 * x) + 0.4 * cos(5 * y);
}

static const sampling SOLID = {
    .dimension = 3, .nodes = {17, 13, 15}, .low = {-7, 3, -2}, .high = {-2, 7, 2.5}};

/* A room in space with a pillar. */
static inline void hall(const double position[3], double v[3])
{
  swirl(position, v);
  if (hypot(position[0] + 4, position[1] - 5) < 0.6)
    v[0] = (double)NAN;
}

static inline double distance_between(const double a[3], const double b[3], int dimension)
{
  double sum = 0.0;
  for (int k = 0; k < 3 && k < dimension; ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sqrt(sum);
}

/* Degrees between two vectors. */
static inline double degrees_between(const double *a, const double *b, int dimension)
{
  double dot = 0.0, aa = 0.0, bb = 0.0;
  for (int k = 0; k < 3 && k < dimension; ++k) {
    dot += a[k] * b[k];
    aa += a[k] * a[k];
    bb += b[k] * b[k];
  }
  return acos(fmax(-1.0, fmin(1.0, dot / sqrt(aa * bb)))) / DEGREE;
}

#endif
