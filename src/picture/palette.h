/* Colour maps for marks on a white page: every colour stands out from it. */
#ifndef FG__PALETTE_H
#define FG__PALETTE_H

#include "base/context.h"

typedef struct fg__color {
  double red, green, blue; /* sRGB, 0 to 1 */
} fg__color;

/* A colour map's samples; between them colours are mixed linearly in sRGB. */
enum { FG__PALETTE_SAMPLES = 65 };
typedef struct fg__palette {
  fg__color sample[FG__PALETTE_SAMPLES];
  bool uniform; /* one colour: nothing for a key to explain */
  int bands; /* of equal width, from the colour at one end to that at the other; 0: none
              */
} fg__palette;

/* Finds a colour map by name (NULL: the default), or makes one of "#rrggbb". ARGUMENT. */
fg_status fg__palette_create(fg__palette *out, fg_context *context, const char *name);

/* Makes a colour map, or one colour, a map of pale bands for what lies behind arrows: the
 * slowest white, the fastest `fade` of the way to white. */
void fg__palette_make_pale(fg__palette *palette, double fade, int bands);

/* The colour at a share of the way from slow (0) to fast (1); clamped. */
fg__color fg__palette_color(const fg__palette *palette, double share);

/* Reads "#rrggbb". */
bool fg__color_read(fg__color *out, const char *text);

/* Reads "#rrggbb"; NULL: `preset`. ARGUMENT. */
fg_status fg__color_choose(fg__color *out, fg_context *context, const char *text,
                           fg__color preset);

/* Relative luminance, 0 to 1 (WCAG 2.1). */
double fg__color_luminance(fg__color color);

/* Lightness in Oklab, 0 to 1 (Ottosson 2020). */
double fg__color_lightness(fg__color color);

#endif
