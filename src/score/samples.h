/* Icons as samples of their tangents, which is what readers see of them. */
#ifndef FG__SAMPLES_H
#define FG__SAMPLES_H

#include "critical/raster.h"

typedef struct fg__samples {
  int icons;
  size_t count;             /* in the domain */
  size_t *first;            /* [icons + 1]: an icon's are first[n] to first[n + 1] - 1 */
  double (*position)[3];    /* brought into the period of periodic axes */
  double (*tangent)[3];     /* unit */
  size_t outside;           /* outside the domain */
  double length;            /* sum over icons, as cut */
  double shortest, longest; /* as cut; 0 without icons */
} fg__samples;

/* Cuts every line about its middle to at most `longest` and to what the sum of lengths
 * allows, `all`: one greatest length for all lines. Samples are the middles of equal
 * pieces of at most half a cell, their tangents the pieces' chords. Ends with
 * fg__samples_clear, also after a failure. ARGUMENT (lines far longer than the domain),
 * MEMORY. */
fg_status fg__samples_create(fg__samples *out, fg_context *context,
                             const fg__domain_raster *raster, const fg_icons *icons,
                             double longest, double all);
void fg__samples_clear(fg__samples *samples);

#endif
