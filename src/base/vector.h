/* Vectors of three numbers. */
#ifndef FG__VECTOR_H
#define FG__VECTOR_H

#include <math.h>

static inline double fg__dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double fg__length(const double a[3])
{
  return sqrt(fg__dot(a, a));
}

static inline double fg__apart(const double a[3], const double b[3])
{
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return fg__length(d);
}

static inline void fg__cross(const double a[3], const double b[3], double out[3])
{
  const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
  for (int k = 0; k < 3; ++k)
    out[k] = c[k];
}

/* out = a + t b */
static inline void fg__along(const double a[3], double t, const double b[3],
                             double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = a[k] + t * b[k];
}

/* The point that is a share of the way from one to another. */
static inline void fg__between(const double a[3], double share, const double b[3],
                               double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = a[k] + share * (b[k] - a[k]);
}

/* Makes a vector one long; false, and unchanged, when it has no direction. */
static inline int fg__normalise(double a[3])
{
  double length = fg__length(a);
  if (!(length > 0.0) || !isfinite(length))
    return 0;
  for (int k = 0; k < 3; ++k)
    a[k] /= length;
  return 1;
}

/* A unit vector across a unit vector, along the coordinate axis that is least in it. */
static inline void fg__any_normal(const double a[3], double out[3])
{
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (fabs(a[k]) < fabs(a[least]))
      least = k;
  for (int k = 0; k < 3; ++k)
    out[k] = (k == least) - a[least] * a[k];
  fg__normalise(out);
}

#endif
