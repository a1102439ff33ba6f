/* A page for browsers that shows a field's arrows at every scale, live. Included by
 * flowgrain.h. */
#ifndef FLOWGRAIN_VIEW_H
#define FLOWGRAIN_VIEW_H

#include "flowgrain/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A zero field means its default, in brackets. */
typedef struct fg_view_options {
  int most, fewest;   /* arrows, or clusters, of the finest and the coarsest scale
                         [200, 12] */
  uint64_t seed;      /* of the clusters that arrows start from [1] */
  fg_run_kind kind;   /* what the page begins with [arrows] */
  fg_lengths lengths; /* of placed arrows [free] */
  double anisotropy, coverage; /* as in fg_evolution_options */
  const char *palette;         /* as in fg_picture_options [gale] */
  double speed_min;  /* ends of the colour key; both 0: [found from the field] */
  double speed_max;  /* */
  const char *title; /* NULL: what the field says of itself */
} fg_view_options;

/* Writes a page of HTML that holds a field in 2D, the library for WebAssembly and all
 * else that it needs; it is opened from disk and loads nothing. Velocities are rounded to
 * 11 bits; of more than 300,000 samples the page has means of neighbours. `options` may
 * be NULL. UNSUPPORTED (3D; a build without FLOWGRAIN_VIEWER), ARGUMENT (a part of a
 * field, numbers), FILE_ACCESS, MEMORY. */
FG_API fg_status fg_view_write(fg_context *context, const char *path,
                               const fg_field *field, const fg_view_options *options);

#ifdef __cplusplus
}
#endif

#endif
