#include <math.h>

#include "tensor/eigenvalues.h"

static const double TWO_THIRDS_PI = 2.09439510239319549;

/* (M - mean I) / radius has the eigenvalues 2 cos(phi + 2 pi n / 3), and 2 cos(3 phi) is
 * its determinant. */
void fg__eigenvalues(double eigenvalue[3], const double matrix[6])
{
  double mean = (matrix[0] + matrix[2] + matrix[3]) / 3.0;
  double x = matrix[0] - mean, y = matrix[2] - mean, z = matrix[3] - mean;
  double xy = matrix[1], xz = matrix[4], yz = matrix[5];
  double squares = x * x + y * y + z * z + 2.0 * (xy * xy + xz * xz + yz * yz);
  double radius = sqrt(squares / 6.0);
  double determinant =
      x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
  double cosine = 0.5 * determinant / (radius * radius * radius);
  /* a multiple of I, as nearly as double can tell; or the ratio is rounded beyond 1 */
  if (!(fabs(cosine) <= 1.0))
    cosine = cosine < 0.0 ? -1.0 : 1.0;
  double angle = acos(cosine) / 3.0;
  eigenvalue[0] = mean + 2.0 * radius * cos(angle);
  eigenvalue[2] = mean + 2.0 * radius * cos(angle + TWO_THIRDS_PI);
  eigenvalue[1] = 3.0 * mean - eigenvalue[0] - eigenvalue[2];
}
