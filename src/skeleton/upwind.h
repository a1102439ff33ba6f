/* A node of a front that marches at speed 1: what its upwind neighbours say. */
#ifndef FG__UPWIND_H
#define FG__UPWIND_H

#include <math.h>
#include <stdbool.h>

/* Upwind side of one axis: a term weight (T - value)^2 of |grad T|^2. */
typedef struct fg__upwind {
  double weight, value;
  double nearest; /* T of the neighbour; the solution must not lie below it */
} fg__upwind;

/* Solves the sum of weight (T - value)^2 = 1 for the later T; false when there is none
 * that is later than the neighbours it was made from. */
static inline bool fg__upwind_solve(const fg__upwind *term, int terms, double *out)
{
  double a = 0.0, b = 0.0, c = -1.0, latest = 0.0;
  for (int k = 0; k < terms; ++k) {
    a += term[k].weight;
    b += term[k].weight * term[k].value;
    c += term[k].weight * term[k].value * term[k].value;
    latest = fmax(latest, term[k].nearest);
  }
  double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0))
    return false;
  *out = (b + sqrt(discriminant)) / a;
  return *out >= latest;
}

#endif
