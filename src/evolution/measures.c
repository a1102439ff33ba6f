#include <math.h>

#include "evolution/evolution.h"

/* Half-width of an interface along the stream in cells; at 1 an isotropic pattern pins.
 */
static const double interface_cells = 1.1, isotropic_interface_cells = 1.5;

double fg__evolution_spacing(const fg_evolution *e)
{
  double h = 0.0;
  for (int k = 0; k < e->mesh.dimension; ++k)
    h = fmax(h, e->mesh.spacing[k]);
  return h;
}

double fg__evolution_least_spacing(const fg_evolution *e)
{
  double h = (double)INFINITY;
  for (int k = 0; k < e->mesh.dimension; ++k)
    h = fmin(h, e->mesh.spacing[k]);
  return h;
}

double fg__evolution_cell_volume(const fg_evolution *e)
{
  double volume = 1.0;
  for (int k = 0; k < e->mesh.dimension; ++k)
    volume *= e->mesh.spacing[k];
  return volume;
}

double fg__evolution_unit(const fg_evolution *e)
{
  return ldexp(1.0, e->coarsenings);
}

double fg__evolution_interface_energy(const fg_evolution *e)
{
  double h = fg__evolution_spacing(e);
  bool isotropic = e->options.law->anisotropy >= 1.0;
  double width = (isotropic ? isotropic_interface_cells : interface_cells) * h;
  if (e->options.gamma > 0.0) /* of the first mesh */
    return ldexp(e->options.gamma, 2 * e->coarsenings);
  return width * width / e->options.anisotropy;
}

fg__splitting fg__evolution_splitting(const fg_evolution *e)
{
  return (fg__splitting){e->options.theta, e->options.alpha};
}

/* In linear theory the mode k grows at k^2 (c - a gamma k^2), c = -Psi''(mean): at most
 * at this rate. Where the mean itself is stable the minima's own curvature sets the pace.
 */
double fg__evolution_growth_rate(const fg_evolution *e)
{
  double mean = 2.0 * e->options.coverage - 1.0;
  double curvature = fmax(fabs(6.0 * mean * mean - 2.0), 1.0);
  return curvature * curvature / (4.0 * e->options.anisotropy * e->info.gamma);
}
