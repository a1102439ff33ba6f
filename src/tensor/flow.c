#include <math.h>

#include "tensor/tensor.h"

/* Garcke et al. 2000, section 3: an interface across the streamline costs 1, along it a.
 * Where the velocity vanishes there is no direction to prefer, and a tends to 1. */
void fg__energy_flow(double tensor[6], const double tangent[3], double anisotropy)
{
  double speed = hypot(hypot(tangent[0], tangent[1]), tangent[2]);
  if (!(speed > 0.0)) {
    fg__energy_isotropic(tensor, tangent, anisotropy);
    return;
  }
  double x = tangent[0] / speed, y = tangent[1] / speed, z = tangent[2] / speed;
  tensor[0] = x * x + anisotropy * y * y + anisotropy * z * z;
  tensor[1] = (1.0 - anisotropy) * x * y;
  tensor[2] = y * y + anisotropy * x * x + anisotropy * z * z;
  tensor[3] = z * z + anisotropy * x * x + anisotropy * y * y;
  tensor[4] = (1.0 - anisotropy) * x * z;
  tensor[5] = (1.0 - anisotropy) * y * z;
}
