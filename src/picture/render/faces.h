/* The triangles of a rendered picture: arrows and the halos round them, transparent
 * surfaces, and what casts shadows. */
#ifndef FG__FACES_H
#define FG__FACES_H

#include "picture/render/render.h"

/* What a triangle belongs to. */
typedef enum fg__face_kind {
  FG__FACE_ARROW,
  FG__FACE_HALO,      /* of an arrow: it hides what is farther off */
  FG__FACE_CLUSTERS,  /* a transparent surface */
  FG__FACE_SILHOUETTE /* another, seen almost as an outline alone */
} fg__face_kind;

typedef struct fg__face {
  int corner[3];
  int part; /* number of the arrow, from 0 */
  fg__face_kind kind;
  bool clipped; /* what lies beyond the box is not seen: it goes on across a period */
} fg__face;

/* Where a corner is seen: pixel coordinates times the depth before the eye, and that
 * depth. Functions that are linear in such coordinates are linear in the picture. */
typedef struct fg__corner {
  double at[3];
  float normal[3]; /* unit, in the view box */
  float share;     /* of the way through the colours; of an arrow */
} fg__corner;

typedef struct fg__faces {
  fg__corner *corner;
  fg__face *face;
  size_t corner_count, corner_capacity, face_count, face_capacity;
} fg__faces;

/* A triangle that hides the light overhead, in the view box. */
typedef struct fg__caster {
  double at[3][3];
  bool clipped;
} fg__caster;

/* The dot on the tip of a head that points at the viewer: the sign of mechanics for an
 * arrow out of the page. */
typedef struct fg__tip {
  double at[3]; /* of the tip, in the view box */
  double reach; /* of the dot along the cone's side, likewise; 0: none */
  double slope; /* the cone's radius for each step along its side */
} fg__tip;

typedef struct fg__geometry {
  fg__faces solid; /* arrows and halos, without triangles that are never seen */
  fg__faces layer; /* transparent surfaces */
  fg__tip *tip;    /* of each arrow, by its number */
  size_t tip_capacity;
  fg__caster *caster; /* without triangles that face down */
  size_t caster_count, caster_capacity;
} fg__geometry;

/* Makes all triangles of a picture. `out` is to be cleared also after a failure. MEMORY,
 * STOPPED. */
fg_status fg__geometry_make(fg__geometry *out, fg_context *context,
                            const fg__rendering *about);
void fg__geometry_clear(fg__geometry *geometry);

#endif
