#include "tensor/tensor.h"

/* The model of Cahn and Hilliard (1958): no direction is preferred. */
void fg__energy_isotropic(double tensor[6], const double tangent[3], double anisotropy)
{
  (void)tangent;
  (void)anisotropy;
  tensor[0] = tensor[2] = tensor[3] = 1.0;
  tensor[1] = tensor[4] = tensor[5] = 0.0;
}
