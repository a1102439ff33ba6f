#include <math.h>

#include "tensor/tensor.h"

/* Garcke et al. 2000, section 3: an interface across the streamline costs 1, along it a.
 * Where the velocity vanishes there is no direction to prefer, and a tends to 1. */
void fg__energy_flow(double tensor[3], const double tangent[2], double anisotropy)
{
  double speed = hypot(tangent[0], tangent[1]);
  if (!(speed > 0.0)) {
    fg__energy_isotropic(tensor, tangent, anisotropy);
    return;
  }
  double x = tangent[0] / speed, y = tangent[1] / speed;
  tensor[0] = x * x + anisotropy * y * y;
  tensor[1] = (1.0 - anisotropy) * x * y;
  tensor[2] = y * y + anisotropy * x * x;
}
