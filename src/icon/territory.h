/* Icons of territories: of what is nearer to a cluster than to any other. */
#ifndef FG__TERRITORY_H
#define FG__TERRITORY_H

#include "base/context.h"
#include "flowgrain/density.h"

typedef struct fg__territory {
  const fg_density *density;
  int *cluster;   /* of each label of the territories, from 1, the cluster in `density` */
  double longest; /* of an arrow */
} fg__territory;

/* The territories of a density's clusters as clusters of another density: positive where
 * the way to a neighbour's is longer than a twentieth of the mean extent; ways go round
 * what is masked. Sets the members but for out->density; free(out->cluster). MEMORY,
 * ARGUMENT (a distributed density). */
fg_status fg__territories_create(fg_density **territories, fg__territory *out,
                                 fg_context *context, const fg_density *density);

/* The longest arrow; infinite where there is no territory. */
double fg__territory_longest(const fg__territory *territory);

/* Whether a place is in the own cluster of the territory of that label. */
bool fg__territory_meets(const fg__territory *territory, int label,
                         const double position[]);

#endif
