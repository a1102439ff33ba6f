#include "tensor/tensor.h"

void fg__tensor_unit(double tensor[6])
{
  tensor[0] = tensor[2] = tensor[3] = 1.0;
  tensor[1] = tensor[4] = tensor[5] = 0.0;
}

static void tensor_at(double tensor[6], const fg_energy_place *place, const void *data)
{
  (void)place;
  (void)data;
  fg__tensor_unit(tensor);
}

/* The model of Cahn and Hilliard (1958): no direction is preferred. */
const fg_energy_law fg__law_isotropic = {
    .name = "isotropic", .tensor = tensor_at, .anisotropy = 1.0};
