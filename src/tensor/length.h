/* Lengths by arithmetic that has the same bits with every C library: hypot has not. */
#ifndef FG__LENGTH_H
#define FG__LENGTH_H

#include <math.h>

static inline double fg__length(double x, double y, double z)
{
  static const double least = 0x1p-500,
                      most = 0x1p500; /* no square over- or underflows */
  double greatest = fmax(fabs(x), fmax(fabs(y), fabs(z)));
  double unit = greatest < least ? 0x1p500 : greatest > most ? 0x1p-500 : 1.0;
  x *= unit;
  y *= unit;
  z *= unit;
  return sqrt(x * x + y * y + z * z) / unit;
}

#endif
