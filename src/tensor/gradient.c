#include <math.h>

#include "tensor/length.h"
#include "tensor/tensor.h"

/* Samples are floats: a change of the speed below some units of their last place is none.
 */
static const double least_change = 0x1p-20;

/* The speed `step` away along an axis, or that of the place itself where the field ends;
 * *reached is how far away it is. */
static double speed_beside(const fg_energy_place *place, int axis, double step,
                           double here, double *reached)
{
  double at[3] = {place->position[0], place->position[1], place->position[2]};
  double v[3] = {0.0, 0.0, 0.0};
  at[axis] += step;
  bool inside = fg_field_velocity(place->field, at, v);
  *reached = inside ? step : 0.0;
  return inside ? fg__length(v[0], v[1], v[2]) : here;
}

/* The paper's closing section: along the level sets of a scalar interfaces cost a, across
 * them 1. Here the scalar is the speed, and its gradient the difference over a cell;
 * where that vanishes no direction is preferred. */
static void tensor_at(double tensor[6], const fg_energy_place *place, const void *data)
{
  (void)data;
  int dimension = fg_field_contents(place->field)->dimension;
  double v[3] = {0.0, 0.0, 0.0}, e[3] = {0.0, 0.0, 0.0};
  fg_field_velocity(place->field, place->position, v);
  double here = fg__length(v[0], v[1], v[2]), change = 0.0;
  for (int k = 0; k < 3 && k < dimension; ++k) {
    double low, high, half = 0.5 * place->spacing[k];
    double above = speed_beside(place, k, half, here, &high);
    double below = speed_beside(place, k, -half, here, &low);
    change = fmax(change, fabs(above - below));
    if (high > low)
      e[k] = (above - below) / (high - low);
  }
  double slope = fg__length(e[0], e[1], e[2]);
  fg__tensor_unit(tensor);
  if (!(slope > 0.0 && change > least_change * here))
    return;
  double x = e[0] / slope, y = e[1] / slope, z = e[2] / slope;
  double saved = 1.0 - place->anisotropy;
  tensor[0] -= saved * x * x;
  tensor[1] -= saved * x * y;
  tensor[2] -= saved * y * y;
  tensor[3] -= saved * z * z;
  tensor[4] -= saved * x * z;
  tensor[5] -= saved * y * z;
}

const fg_energy_law fg__law_gradient = {
    .name = "gradient", .tensor = tensor_at, .axes = true};
