/* Critical points of the field that a reader finds. */
#include "critical/directions.h"
#include "score/measures.h"

/* The critical points of the field or, with one, of the reader. */
static fg_status find_points(fg__points *points, fg__directions *directions,
                             fg_context *context, const fg__harmonic *harmonic,
                             fg__threads *threads)
{
  const fg__domain_raster *raster = directions->raster;
  for (size_t n = 0; n < raster->cells; ++n)
    if (harmonic)
      fg__directions_set(directions, n, harmonic->known[n], harmonic->value[0][n],
                         harmonic->value[1][n]);
    else
      fg__directions_set(directions, n, raster->inside[n],
                         (double)raster->direction[0][n],
                         (double)raster->direction[1][n]);
  return fg__directions_find(points, directions, context, threads);
}

fg_status fg__score_critical(double *f1, fg_context *context,
                             const fg__domain_raster *raster,
                             const fg__harmonic *harmonic, double lambda,
                             fg__threads *threads)
{
  fg__directions directions;
  fg__points found[2] = {0};
  size_t matched = 0;
  fg_status status = fg__directions_create(&directions, context, raster, lambda);
  for (int n = 0; n < 2 && status == FG_STATUS_OK; ++n)
    status = find_points(&found[n], &directions, context, n ? harmonic : NULL, threads);
  if (status == FG_STATUS_OK)
    status = fg__points_match(&matched, context, &found[0], &found[1]);
  const size_t all = fg__points_left(&found[0]) + fg__points_left(&found[1]);
  *f1 = all ? 2.0 * (double)matched / (double)all : 1.0;
  fg__points_clear(&found[0]);
  fg__points_clear(&found[1]);
  fg__directions_clear(&directions);
  return status;
}
