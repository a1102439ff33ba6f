/* What light comes from a point of a rendered picture. */
#ifndef FG__SHADE_H
#define FG__SHADE_H

#include "picture/render/light.h"
#include "picture/render/shadow.h"
#include "picture/render/visible.h"

typedef struct fg__shading {
  const fg__rendering *about;
  const fg__view *view;
  const fg__shadow *shadow;
  fg__tones tones;
  double lamp[3];
  double nearest, farthest; /* distances of the box's corners from the eye */
  double margin;            /* round the box, within which halos are looked for */
  double thickest;          /* radius of a head */
  double low[2], high[2];   /* pixels between which the box lies */
} fg__shading;

/* view, shadow: they may be filled later. */
void fg__shading_make(fg__shading *out, const fg__rendering *about, const fg__view *view,
                      const fg__shadow *shadow);

/* What is seen at a point: the page, a side of the box by its axis, an edge of the box,
 * or from FG__SEEN_ARROW on an arrow or its halo, two numbers each. */
enum { FG__SEEN_PAGE, FG__SEEN_WALL, FG__SEEN_EDGE = FG__SEEN_WALL + 3, FG__SEEN_ARROW };

typedef struct fg__shade_at {
  double x, y; /* pixels */
  const fg__face_at *nearest;
  const fg__layer *layer;
  int layers;
  int seen;            /* found */
  double direction[3]; /* likewise; unit */
} fg__shade_at;

/* Light of transparent surfaces, and the share of light that they let through. */
typedef struct fg__haze {
  fg__light light;
  double left;
} fg__haze;

/* haze: of the point's transparent surfaces when it is known; where its `left` is
 * negative it is found. */
fg__light fg__shade_point(const fg__shading *shading, fg__shade_at *point,
                          fg__haze *haze);

#endif
