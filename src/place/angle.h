/* Angles by arithmetic that has the same bits on every machine: no library function but
 * the square root. */
#ifndef FG__PLACE_ANGLE_H
#define FG__PLACE_ANGLE_H

#include <math.h>

#define FG__PLACE_PI 3.14159265358979324

/* arccos by Abramowitz and Stegun 4.4.45, to 7e-5 radians; x is clipped to [-1, 1]. */
static inline double fg__place_arccos(double x)
{
  double a = x < 0.0 ? -x : x;
  a = a < 1.0 ? a : 1.0;
  double angle =
      sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 + a * -0.0187293)));
  return x < 0.0 ? FG__PLACE_PI - angle : angle;
}

#endif
