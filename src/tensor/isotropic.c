#include "tensor/tensor.h"

/* The model of Cahn and Hilliard (1958): no direction is preferred. */
void fg__energy_isotropic(double tensor[3], const double tangent[2], double anisotropy)
{
  (void)tangent;
  (void)anisotropy;
  tensor[0] = 1.0;
  tensor[1] = 0.0;
  tensor[2] = 1.0;
}
