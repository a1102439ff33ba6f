/* Projections as functions that read/ gives to a dataset: the core, which these files
 * belong to, has no PROJ. They are those of map/map.h. */
#ifndef FG__PROJECTOR_H
#define FG__PROJECTOR_H

#include "base/context.h"

typedef struct fg__map fg__map;

typedef struct fg__projector {
  fg_status (*create)(fg__map **out, fg_context *context, const char *projection);
  void (*destroy)(fg__map *map);
  const char *(*projection)(const fg__map *map);
  double (*center)(const fg__map *map);
  void (*forward)(const fg__map *map, size_t n, const double *longitude,
                  const double *latitude, double *x, double *y);
  void (*inverse)(const fg__map *map, size_t n, const double *x, const double *y,
                  double *longitude, double *latitude);
  void (*turn)(const fg__map *map, size_t n, const double *longitude,
               const double *latitude, float *east, float *north);
} fg__projector;

#endif
