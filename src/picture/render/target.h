/* What rays of a rendered picture meet: the arrows' solids, the halos round them and the
 * transparent surfaces, in Embree's scenes. */
#ifndef FG__TARGET_H
#define FG__TARGET_H

#include "picture/render/render.h"

typedef struct fg__target {
  const fg__rendering *about;
  fg_context *context;
  struct RTCDeviceTy *device;
  struct RTCSceneTy *seen;   /* arrows and their halos */
  struct RTCSceneTy *solids; /* arrows alone: they cast shadows */
  struct RTCSceneTy *skins;  /* what lets light through */
  float bound[3];            /* of the box; beyond it nothing is seen */
} fg__target;

/* `out` must stay where it is, and is to be closed also after a failure. MEMORY. */
fg_status fg__target_open(fg__target *out, fg_context *context,
                          const fg__rendering *about);
void fg__target_close(fg__target *target);

/* Where a ray ends. */
typedef struct fg__hit {
  int part;         /* a number of the arrow, from 0; -1: nothing is met */
  bool halo;        /* it passes the arrow so narrowly that only the halo is seen */
  double distance;  /* infinite where nothing is met */
  double normal[3]; /* unit, towards the eye's side; of an arrow */
  double share;     /* of the way through the colours; of an arrow */
} fg__hit;

fg__hit fg__target_hit(const fg__target *target, const double from[3],
                       const double direction[3]);

/* A transparent surface on a ray's way. */
typedef struct fg__veil {
  double distance, normal[3];
  bool silhouette; /* else the clusters' */
} fg__veil;

/* Surfaces on a ray's way, the nearest first; where there are more than FG__MOST_VEILS,
 * some are left out. Returns how many. */
enum { FG__MOST_VEILS = 32 };
int fg__target_veils(const fg__target *target, const double from[3],
                     const double direction[3], fg__veil out[FG__MOST_VEILS]);

/* Rays from one place that are traced together, which takes less time. Returns how many
 * meet no arrow. */
enum { FG__PACKET = 8 };
int fg__target_unhidden(const fg__target *target, const double place[3],
                        const double direction[FG__PACKET][3]);

#endif
