/* A field at the pixels of a picture. */
#ifndef FG__RASTER_H
#define FG__RASTER_H

#include "base/threads.h"

typedef enum fg__pixel {
  FG__PIXEL_MASKED = 0, /* nothing is known */
  FG__PIXEL_STILL,      /* the velocity is zero: no direction */
  FG__PIXEL_MOVING
} fg__pixel;

/* Pixel (0, 0) is the lower left one, x fastest. Padded arrays reach `margin` pixels
 * beyond the picture on every side: round a periodic axis, else with the boundary's own
 * values. */
typedef struct fg__raster {
  int size[2];
  bool periodic[2];
  int margin;
  int stride, rows;      /* padded */
  float (*direction)[2]; /* padded: unit vectors along the streamlines, in pixels; known
                            pixels' own, in all others what lies round them */
  float *speed;          /* |v|; NaN: masked */
  unsigned char *pixel;  /* fg__pixel */
  bool all_moving;
} fg__raster;

/* size: pixels; margin: at least 0. MEMORY. */
fg_status fg__raster_create(fg__raster *out, fg_context *context, const fg_field *field,
                            const int size[2], int margin, fg__threads *threads);
void fg__raster_clear(fg__raster *raster);

/* Place of the picture's pixel in padded arrays. */
static inline size_t fg__raster_at(const fg__raster *raster, int i, int j)
{
  return (size_t)(j + raster->margin) * (size_t)raster->stride +
         (size_t)(i + raster->margin);
}

/* The picture's row or column that a padded one beyond it repeats, or the nearest. */
static inline int fg__raster_wrap(const fg__raster *raster, int k, int index)
{
  int size = raster->size[k];
  if (index >= 0 && index < size)
    return index;
  if (raster->periodic[k])
    return (index % size + size) % size;
  return index < 0 ? 0 : size - 1;
}

/* Gives every vector of an array of size[0] x size[1] whose pixel does not move the
 * direction of those round it, the nearer the more (pull and push: Gortler, Grzeszczuk,
 * Szeliski and Cohen 1996, section 3.4), and makes all of length 1. MEMORY. */
fg_status fg__fill_directions(float (*direction)[2], fg_context *context,
                              const unsigned char *pixel, const int size[2]);

#endif
