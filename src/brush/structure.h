/* Which way the level sets of an image run: its structure tensor, as an energy. */
#ifndef FG__STRUCTURE_H
#define FG__STRUCTURE_H

#include "base/context.h"

/* A = I - (1 - a) c e e^T at each pixel's centre, e the mean direction of the gradient
 * and c the share of the anisotropy that it is sure enough for; rows from the top, but
 * y upwards in the entries. */
typedef struct fg__structure {
  int width, height;
  float *xx, *xy, *yy;
} fg__structure;

/* From grey values, rows from the top: their gradient's outer product is averaged over a
 * Gaussian of standard deviation `deviation` in pixels (Bigun and Granlund 1987), and
 * with little weight over a wider one, so that even places take the direction of what
 * lies round them. MEMORY. */
fg_status fg__structure_create(fg__structure *out, fg_context *context, const float *grey,
                               int width, int height, double deviation,
                               double anisotropy);
void fg__structure_clear(fg__structure *structure);

/* An fg_energy_tensor whose data is an fg__structure, on a field whose coordinates are
 * pixels from the lower left corner: bilinear between pixels. */
void fg__structure_tensor(double tensor[6], const fg_energy_place *place,
                          const void *data);

#endif
