/* Textures: a picture's every pixel shows which way the field goes there.
 *
 *     fg_texture *texture;
 *     fg_texture_create(&texture, ctx, field, &(fg_texture_options){.longest = 2048});
 *     fg_texture_write(ctx, "wind.png", field, texture, NULL);
 *
 * The kinds, their sources and what they are good for: docs/method/textures.md. */
#ifndef FLOWGRAIN_TEXTURE_H
#define FLOWGRAIN_TEXTURE_H

#include "flowgrain/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fg_texture_kind {
  FG_TEXTURE_LIC = 0, /* line integral convolution (Cabral and Leedom 1993), by the fast
                         algorithm of Stalling and Hege (1995) */
  FG_TEXTURE_SPOTS,   /* spot noise (van Wijk 1991): longer and narrower where the flow is
                         faster */
  FG_TEXTURE_CLUSTERS, /* the clusters themselves: u, from 1 (light) where it is -0.6 or
                          less to 0 where it is 0.6 or more */
  FG_TEXTURE_STRIPES, /* u where it grew from weak noise: stripes along the streamlines */
  FG_TEXTURE_DIFFUSION, /* nonlinear anisotropic diffusion of noise (Preusser and Rumpf
                           1999) */
  FG_TEXTURE_SPEED      /* the speed alone, which a colour map shows: value is 1; behind
                           arrows in pale bands, and they have one dark colour */
} fg_texture_kind;

/* A zero field means its default, in brackets. */
typedef struct fg_texture_options {
  fg_texture_kind kind; /* [line integral convolution] */
  int longest;          /* pixels along the longest side, 16 to 16384 [1024] */
  int size[2];          /* pixels along x and y, 1 to 16384; one of them 0: from the other
                           and the domain's shape; both: from `longest` and that */
  double length; /* of streaks (LIC), the longest spots, four stripes' width together, in
                    pixels, 2 to 400 [a 25th of the longest side, of spots an 18th, of
                    DIFFUSION a 20th; 20 at least]; not for CLUSTERS and SPEED */
  int clusters;  /* CLUSTERS: the first snapshot with no more of them [300; with max_time:
                    none] */
  double max_time; /* CLUSTERS: no later than the first snapshot from this t on [never] */
  const fg_evolution_options *evolution; /* CLUSTERS: how they evolve; its `nodes`, when
                                            0, follow the pixels; seed and threads are
                                            those below [NULL: defaults] */
  const fg_density *density; /* CLUSTERS: these instead, not distributed; borrowed while
                                the texture is made [NULL: an evolution of its own] */
  uint64_t seed;             /* of the noise [1] */
  int threads;               /* the texture does not depend on it [all cores] */
} fg_texture_options;

typedef struct fg_texture fg_texture;

typedef struct fg_texture_arrays {
  fg_texture_kind kind;
  int size[2];        /* pixels along x and y; the first row is that of the least y */
  const float *value; /* 0 to 1, x fastest; of even contrast all over the picture; goes on
                         smoothly where nothing is known, for pictures to cover */
  const float *speed; /* |v| in the input's units; NaN where nothing is known */
} fg_texture_arrays;

/* Makes a texture of the field's box: pixels are those of the picture, however coarse the
 * field's own grid. Same field, options and seed: same texture, on any number of threads.
 * ARGUMENT (options out of range), UNSUPPORTED (a field in 3D), MEMORY, STOPPED. */
FG_API fg_status fg_texture_create(fg_texture **out, fg_context *context,
                                   const fg_field *field,
                                   const fg_texture_options *options);
FG_API void fg_texture_destroy(fg_texture *texture);

/* The texture's arrays, borrowed. */
FG_API const fg_texture_arrays *fg_texture_contents(const fg_texture *texture);

/* A zero field means its default, in brackets. */
typedef struct fg_texture_style {
  const char *palette; /* NULL: grey, of SPEED gale; else a colour map that shows the
                          speed, as for pictures, or "#rrggbb" for one colour */
  double speed_min, speed_max; /* ends of the colour map; equal: from the field */
  double fade;            /* share of the way to white, 0 to 1: a quiet background [0] */
  const char *mask_color; /* "#rrggbb" [light grey] */
  bool transparent;       /* where nothing is known, instead of the mask's colour */
  bool no_coast;          /* of a field on the Earth: no coasts on it, no land where it is
                             missing */
  const char *land;       /* "#rrggbb", colour of land [a pale grey] */
  bool borders;           /* of a field on the Earth: also borders of countries */
  bool key;               /* with a colour map: a key below the texture */
  const char *title, *subtitle; /* above the texture; names in braces as in
                                   fg_picture_options, but for {arrows} [none] */
  const char *label; /* of the key, likewise ["speed" and its units]; "" none */
  double width;      /* of the picture, points [half a point a pixel] */
  double font_size;  /* points [follows from the width] */
  bool outline_text; /* texts are drawn as shapes */
} fg_texture_style;

/* Writes a texture: .png has its very pixels (and round them title and key), .svg and
 * .pdf hold them as an image. What is masked in the field is covered; coasts of a field
 * on the Earth are drawn above. FILE_ACCESS, UNSUPPORTED, ARGUMENT, MEMORY. */
FG_API fg_status fg_texture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_texture *texture,
                                  const fg_texture_style *style);

#ifdef __cplusplus
}
#endif

#endif
