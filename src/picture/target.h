/* What rays of a rendered picture meet: the arrows' solids and the clusters' surfaces, in
 * Embree's scenes. */
#ifndef FG__TARGET_H
#define FG__TARGET_H

#include "picture/render.h"

#ifdef FG__EMBREE

#include <embree3/rtcore.h>

typedef struct fg__target {
  const fg__rendering *about;
  fg_context *context;
  RTCDevice device;
  RTCScene scene, skins; /* what hides, and what lets light through */
  fg__color *color;      /* [geometries] */
  int geometries;
  float bound[3]; /* of the box; beyond it nothing is seen */
} fg__target;

/* `out` must stay where it is, and is to be closed also after a failure. MEMORY. */
fg_status fg__target_open(fg__target *out, fg_context *context,
                          const fg__rendering *about);
void fg__target_close(fg__target *target);

/* Rays that are traced together, which takes less time; all zero at first. */
enum { FG__PACKET = 8 };
typedef struct fg__packet {
  struct RTCRay8 ray;
  _Alignas(32) int valid[FG__PACKET];
  int count;
} fg__packet;

/* Adds a ray; when that fills the packet, flushes it, else returns 0. */
int fg__packet_add(fg__packet *packet, const fg__target *target, const double place[3],
                   const double direction[3], float reach);

/* Traces the rays and forgets them; returns how many met nothing. */
int fg__packet_flush(fg__packet *packet, const fg__target *target);

#endif
#endif
