/* The figures of a score beside the readers' errors. */
#ifndef FG__SCORE_MEASURES_H
#define FG__SCORE_MEASURES_H

#include "score/reader.h"

/* Mean distance between the ends of streamlines of the field and of the reader by
 * diffusion, over the radius that they are followed in: 0.15 of the domain's side, from
 * the first 500 points of the Halton sequence that lie in the domain. */
double fg__score_advection(const fg__domain_raster *raster, const fg__harmonic *harmonic,
                           fg__threads *threads);

/* F1 measure of the field's critical points that the reader by diffusion shows, in 2D.
 * MEMORY. */
fg_status fg__score_critical(double *f1, fg_context *context,
                             const fg__domain_raster *raster,
                             const fg__harmonic *harmonic, double lambda,
                             fg__threads *threads);

/* Share of the samples nearer than a tenth of lambda to another icon. MEMORY. */
fg_status fg__score_clutter(double *share, fg_context *context,
                            const fg__domain_raster *raster, const fg__samples *samples,
                            double lambda);

/* Mean angle between samples and field, degrees; NaN without any. */
double fg__score_tangency(const fg__domain_raster *raster, const fg__samples *samples);

/* Mean and greatest distance of cells in the domain to the nearest icon, over lambda. */
void fg__score_voids(double *mean, double *most, const fg__domain_raster *raster,
                     const float *distance, double lambda);

#endif
