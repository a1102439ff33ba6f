/* How light falls on what a ray has met: plain arithmetic, without a ray tracer. */
#ifndef FG__LIGHT_H
#define FG__LIGHT_H

#include <stdint.h>

#include "picture/palette.h"
#include "picture/render/render.h"

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

/* A direction to a place of a small bright disc straight overhead, whose soft shadows on
 * the floor lie under what casts them. Its length is 1 to a part in 10^4. */
void fg__overhead_sample(const double number[2], double out[3]);

/* What is known of a point. */
typedef struct fg__lit {
  double normal[3], to_viewer[3], lamp[3]; /* unit */
  double depth; /* 0 at the nearest corner of the box, 1 at the farthest */
} fg__lit;

fg__light fg__light_arrow(fg__color color, const fg__lit *lit);

/* `lit`: the share of the disc overhead that is seen from there. */
fg__light fg__light_wall(int axis, double lit);

/* A thin line along an edge of the box. */
fg__light fg__light_edge(double depth);

/* Light that a transparent surface sends itself; alpha: what it hides of what is behind,
 * more where it is seen from the side. */
fg__light fg__light_skin(const fg__lit *lit);

/* The same of a surface that is to be seen as an outline alone, almost; cut: at its end.
 */
fg__light fg__light_silhouette(const fg__lit *lit, bool cut);

/* To premultiplied bytes, over white unless `transparent`. */
uint32_t fg__light_pixel(fg__light light, bool transparent);

#endif
