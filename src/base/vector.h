/* Vectors of three numbers, and the lesser of two. */
#ifndef FG__VECTOR_H
#define FG__VECTOR_H

#include <math.h>

/* fmin and fmax of what is not NaN: in inner loops a call takes longer. */
static inline double fg__least(double a, double b)
{
  return a < b ? a : b;
}

static inline double fg__most(double a, double b)
{
  return a > b ? a : b;
}

static inline double fg__dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double fg__length(const double a[3])
{
  return sqrt(fg__dot(a, a));
}

static inline double fg__distance(const double a[3], const double b[3])
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

/* out = a - b */
static inline void fg__subtract(const double a[3], const double b[3], double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = a[k] - b[k];
}

/* out = a + t b */
static inline void fg__add_scaled(const double a[3], double t, const double b[3],
                                  double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = a[k] + t * b[k];
}

/* out = a + t (b - a) */
static inline void fg__lerp(const double a[3], double t, const double b[3], double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = a[k] + t * (b[k] - a[k]);
}

/* Scales a vector to length 1; false, and unchanged, where its length is 0 or not finite.
 */
static inline int fg__normalise(double a[3])
{
  double length = fg__length(a);
  if (!(length > 0.0) || !isfinite(length))
    return 0;
  for (int k = 0; k < 3; ++k)
    a[k] /= length;
  return 1;
}

/* A unit vector perpendicular to the unit vector a: the coordinate axis of a's smallest
 * component less its projection on a. */
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
