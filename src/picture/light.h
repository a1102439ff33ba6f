/* How light falls on what a ray has met: plain arithmetic, without a ray tracer. */
#ifndef FG__LIGHT_H
#define FG__LIGHT_H

#include <stdint.h>

#include "picture/palette.h"
#include "picture/render.h"

/* Light, 0 to 1 a component, linear. */
typedef struct fg__light {
  double red, green, blue, alpha;
} fg__light;

/* Where a pixel stands on a Hilbert curve through a square of pixels: neighbours on it
 * are neighbours in the picture. */
uint64_t fg__light_order(int x, int y);

/* Two numbers in [0, 1): number `index` of a sequence that fills the square evenly (the
 * additive recurrence of the plastic number, Roberts 2018). Pixels that take numbers in
 * turn, in the order above, have each an even set, and so have they together: what one
 * is too dark its neighbours are too light, and the eye sees no grain. `kind` parts uses
 * of one number. */
void fg__light_numbers(uint64_t index, int kind, double out[2]);

/* Unit vector towards the lamp: from behind the viewer's left shoulder and above. */
void fg__lamp_direction(const fg__camera *camera, double out[3]);

/* A unit vector and two others, all at right angles. */
typedef struct fg__bases {
  double axis[3], one[3], other[3];
} fg__bases;

void fg__bases_of(fg__bases *out, const double axis[3]);

/* A direction near the lamp's, as if it were a disc: soft shadows. Its length is 1 to a
 * part in 800. */
void fg__lamp_sample(const fg__bases *lamp, const double number[2], double out[3]);

/* A unit direction round a normal, more often near it (by the cosine). */
void fg__sky_sample(const fg__bases *normal, const double number[2], double out[3]);

/* What is known of a point. */
typedef struct fg__lit {
  double normal[3], to_viewer[3], lamp[3]; /* unit */
  double lamp_seen;                        /* share of the lamp that is not hidden */
  double sky_seen;                         /* likewise of the sky */
  double depth; /* 0 at the nearest corner of the box, 1 at the farthest */
} fg__lit;

fg__light fg__light_arrow(fg__color color, const fg__lit *lit);

/* `line`: how much of a line of the grid covers the point, 0 to 1. */
fg__light fg__light_wall(int axis, double line, const fg__lit *lit);

/* Light that a transparent surface sends itself; alpha: what it hides of what is behind,
 * more where it is seen from the side. */
fg__light fg__light_skin(const fg__lit *lit);

/* To premultiplied bytes, over white unless `transparent`. */
uint32_t fg__light_pixel(fg__light light, bool transparent);

#endif
