/* What the kinds of textures share. */
#ifndef FG__TEXTURE_H
#define FG__TEXTURE_H

#include "flowgrain/texture.h"
#include "texture/raster.h"

/* What a kind is made from. Lengths are in pixels. */
typedef struct fg__canvas {
  const fg_field *field;
  fg__raster raster;
  double length;                         /* of streaks */
  int clusters;                          /* at most; 0: the default */
  double max_time;                       /* no later than about here; 0: no matter */
  const fg_evolution_options *evolution; /* of the clusters; NULL: defaults */
  const fg_density *density;             /* of the clusters to show; NULL: evolve them */
  uint64_t seed;
  fg__threads *threads;
} fg__canvas;

/* One kind: fills value (a number a pixel of the picture, not padded) with what it likes;
 * means and spreads are evened afterwards. MEMORY, STOPPED. */
typedef fg_status fg__texture_paint(float *value, fg_context *context,
                                    const fg__canvas *canvas);

/* How far beyond the picture its raster must reach for streaks of a length. */
int fg__lic_margin(double length);
fg__texture_paint fg__lic_paint;
int fg__spots_margin(double length);
fg__texture_paint fg__spots_paint;
int fg__no_margin(double length);
fg__texture_paint fg__clusters_paint;
fg__texture_paint fg__stripes_paint;
int fg__diffusion_margin(double length);
fg__texture_paint fg__diffusion_paint;

#endif
