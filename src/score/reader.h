/* What readers make of a picture, and how far they are off. */
#ifndef FG__READER_H
#define FG__READER_H

#include "score/samples.h"

/* Degrees between two directions of any length; 90 when one has none. */
double fg__angle(const double a[3], const double b[3]);

/* The angles of a reader to the field, a number a cell (those of cells that do not count
 * do not matter), as the error. */
fg_status fg__reader_error(fg_reader_error *out, fg_context *context,
                           const fg__domain_raster *raster, const float *angle);

/* The readers that look at nearest tangents: at that of all, and at each icon's by
 * (d^2 + (lambda / 20)^2)^-1.5, in 3D ^-2. All arrays have a number a cell; distance: to
 * the nearest sample, infinite without. Exact: for every row of cells each icon's samples
 * form a lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012). MEMORY,
 * STOPPED. */
typedef struct fg__nearest {
  float *angle, *weighted_angle, *distance;
} fg__nearest;

fg_status fg__nearest_create(fg__nearest *out, fg_context *context,
                             const fg__domain_raster *raster, const fg__samples *samples,
                             double lambda, fg__threads *threads);
void fg__nearest_clear(fg__nearest *nearest);

/* The reader that continues the tangents harmonically. */
typedef struct fg__harmonic {
  double *value[3];     /* a number a cell; 0 where no icon leads to */
  unsigned char *known; /* cells in parts of the domain that an icon enters */
} fg__harmonic;

/* Tangents are summed by cell and normalised; elsewhere in the domain each component is
 * the mean of the neighbouring cells' (5, in 3D 7 points; no flux through the boundary).
 * `tolerance` is that of the residual, relative to that of zero [0: 0.01 degrees of the
 * mean angle]. MEMORY, STOPPED, NO_CONVERGENCE. */
fg_status fg__harmonic_create(fg__harmonic *out, fg_context *context,
                              const fg__domain_raster *raster, const fg__samples *samples,
                              double tolerance);
void fg__harmonic_clear(fg__harmonic *diffusion);

/* A number a cell. */
void fg__harmonic_angles(float *angle, const fg__domain_raster *raster,
                         const fg__harmonic *diffusion);

#endif
