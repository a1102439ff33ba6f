/* Soft shadows on the floor of the box. */
#ifndef FG__SHADOW_H
#define FG__SHADOW_H

#include "picture/render/bands.h"
#include "picture/render/faces.h"

/* The light overhead is a disc, of which so many places are looked at. */
enum { FG__LAMPS = 16 };

typedef struct fg__lamp {
  double slope[2]; /* horizontal steps for each step upwards */
  double place[2]; /* within a texel, 0 to 1, from where it is looked at */
} fg__lamp;

/* A raster over the floor: from how many places of the disc no light comes there. */
typedef struct fg__shadow {
  double low[2], height; /* of the floor, in the view box */
  double texel;          /* side of a texel, in the view box */
  int size[2];
  uint8_t *hidden; /* [size[1]][size[0]]; NULL: from none */
  fg__lamp lamp[FG__LAMPS];
  const fg__caster *caster;
  const double *bound; /* half sides of the box */
  fg__bands bands;
} fg__shadow;

/* Prepares a raster with texels of about the size of pixels. `out` is to be cleared also
 * after a failure; geometry and `about` must stay. MEMORY. */
fg_status fg__shadow_make(fg__shadow *out, fg_context *context,
                          const fg__rendering *about, const fg__geometry *geometry);
void fg__shadow_clear(fg__shadow *shadow);

/* Fills one of shadow->bands.count bands; several threads may fill different ones.
 * marks: room for FG__BAND * size[0] numbers. */
void fg__shadow_fill(fg__shadow *shadow, int band, uint32_t *marks);

/* The share of the light overhead that comes to a point of the floor. */
double fg__shadow_light(const fg__shadow *shadow, const double place[3]);

#endif
