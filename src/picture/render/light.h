/* How light falls on what is seen: plain arithmetic. */
#ifndef FG__LIGHT_H
#define FG__LIGHT_H

#include <stdint.h>

#include "picture/palette.h"
#include "picture/render/render.h"

/* Light, 0 to 1 a component, linear. */
typedef struct fg__light {
  double red, green, blue, alpha;
} fg__light;

/* Tables of functions from 0 to 1 to the same: between entries they are linear, which is
 * exact to a hundredth of a level of 255. */
enum { FG__TONES = 4096 };
typedef struct fg__tones {
  float linear[FG__TONES + 1];  /* sRGB's level to light */
  float encoded[FG__TONES + 1]; /* and back */
  float rim[FG__TONES + 1];     /* how much is seen of an outline's side */
} fg__tones;

void fg__tones_make(fg__tones *out);

/* Unit vector towards the lamp: from behind the viewer's left shoulder and above. */
void fg__lamp_direction(const fg__camera *camera, double out[3]);

/* The radius over its distance of a small bright disc straight overhead, whose soft
 * shadows on the floor lie under what casts them. */
static const double fg__overhead_size = 0.013;

/* Place `number` of `count` that fill the disc evenly, as horizontal steps for each step
 * upwards, and one of as many that fill the square from 0 to 1. */
void fg__overhead_place(int number, int count, double slope[2], double place[2]);

/* What is known of a point. */
typedef struct fg__lit {
  double normal[3], to_viewer[3], lamp[3]; /* unit */
  double depth; /* 0 at the nearest corner of the box, 1 at the farthest */
} fg__lit;

fg__light fg__light_arrow(const fg__tones *tones, fg__color color, const fg__lit *lit);

/* `lit`: the share of the disc overhead that is seen from there. */
fg__light fg__light_wall(int axis, double lit);

/* A thin line along an edge of the box. */
fg__light fg__light_edge(const fg__tones *tones, double depth);

/* Light that a transparent surface sends itself; alpha: what it hides of what is behind,
 * more where it is seen from the side. */
fg__light fg__light_isosurface(const fg__lit *lit);

/* The same of a surface that is to be seen as an outline alone, almost; cut: at its end.
 */
fg__light fg__light_silhouette(const fg__tones *tones, const fg__lit *lit, bool cut);

/* To premultiplied bytes, over white unless `transparent`. */
uint32_t fg__light_pixel(const fg__tones *tones, fg__light light, bool transparent);

#endif
