#include <math.h>

#include "tensor/tensor.h"

/* Garcke et al. 2000, section 3: an interface across the streamline costs 1, along it a.
 * Where the velocity vanishes there is no direction to prefer, and a tends to 1. */
void fg__tensor_along(double tensor[6], const double direction[3], double anisotropy)
{
  double speed = hypot(hypot(direction[0], direction[1]), direction[2]);
  if (!(speed > 0.0)) {
    fg__tensor_unit(tensor);
    return;
  }
  double x = direction[0] / speed, y = direction[1] / speed, z = direction[2] / speed;
  tensor[0] = x * x + anisotropy * y * y + anisotropy * z * z;
  tensor[1] = (1.0 - anisotropy) * x * y;
  tensor[2] = y * y + anisotropy * x * x + anisotropy * z * z;
  tensor[3] = z * z + anisotropy * x * x + anisotropy * y * y;
  tensor[4] = (1.0 - anisotropy) * x * z;
  tensor[5] = (1.0 - anisotropy) * y * z;
}

static void tensor_at(double tensor[6], const fg_energy_place *place, const void *data)
{
  (void)data;
  fg__tensor_along(tensor, place->direction, place->anisotropy);
}

const fg_energy_law fg__law_flow = {.name = "flow", .tensor = tensor_at, .axes = true};
