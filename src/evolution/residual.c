#include "evolution/residual.h"

#include <math.h>

#include "solver/passes.h"

static double largest_difference(const fg__level *level, const float *a, const float *b)
{
  const int *nodes = level->layout.nodes;
  double largest = 0.0;
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i) {
        ptrdiff_t at = fg__node_at(&level->layout, i, j, k);
        double size = fabs((double)a[at] - (double)b[at]);
        if (level->mass && !(level->mass[at] > 0.0F))
          continue;
        if (!(size <= largest))
          largest = isnan(size) ? (double)INFINITY : size;
      }
  return largest;
}

double fg__residual(const fg__multigrid *multigrid, const fg__subdomains *subdomains,
                    double tau, float *w, float *rest)
{
  const float *u = fg__multigrid_u(multigrid), *p = fg__multigrid_p(multigrid);
  double largest = 0.0;
  fg__pass_evaluate(multigrid, u, w);
  if (multigrid->linear)
    fg__pass_subtract_potential_derivative(multigrid, u, w);
  fg__pass_explicit_part(multigrid, u, w, -tau, rest);
  fg__subdomains_copy(subdomains, p, rest);
  if (!fg__is_idle(&multigrid->partition))
    largest = largest_difference(fg__multigrid_finest(multigrid), rest, p);
  fg__ranks_greatest(multigrid->ranks, &largest, 1);
  return largest;
}
