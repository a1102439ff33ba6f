/* A page for browsers that shows a field's arrows at every scale: in 2D placed anew by
 * the page, in 3D those of a run. Included by flowgrain.h. */
#ifndef FLOWGRAIN_VIEW_H
#define FLOWGRAIN_VIEW_H

#include "flowgrain/run.h"
#include "flowgrain/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A scale of a run, borrowed. Icons that are placed keep their `id` from scale to scale;
 * others go into that of the cluster where their middle lies, else the nearest. */
typedef struct fg_view_scale {
  const fg_icons *icons;
  const fg_density *density; /* of the clusters that are shown; NULL: none */
} fg_view_scale;

/* A zero field means its default, in brackets. */
typedef struct fg_view_options {
  int most, fewest;   /* in 2D: arrows, or clusters, of the finest and the coarsest scale
                         [200, 12] */
  uint64_t seed;      /* of the clusters that arrows start from [1] */
  fg_run_kind kind;   /* what the page begins with [arrows] */
  fg_lengths lengths; /* of placed arrows [free] */
  double anisotropy, coverage; /* as in fg_evolution_options */
  const char *palette;         /* as in fg_picture_options [gale] */
  double speed_min, speed_max; /* ends of the colour key; both 0: [from the field] */
  const char *title;           /* NULL: the field's title */
  const fg_view_scale *scales; /* of a run, finest first: in 3D at least one; in 2D the
                                  page opens with the first's arrows, where they are
                                  placed [made by the page] */
  int scale_count;
  double azimuth, elevation; /* in 3D: where the viewer stands first, as in
                                fg_solid_options */
} fg_view_options;

/* Writes a page of HTML that holds a field and all else that it needs; it is opened from
 * disk and loads nothing. Velocities are rounded to 11 bits. In 2D it has the library for
 * WebAssembly, of more than 300,000 samples means of neighbours, and the arrows that it
 * opens with. In 3D it has the scales' icons, the surfaces of their clusters, simplified,
 * and the velocity on an even raster of at most 48^3 nodes. `options` may be NULL in 2D.
 * UNSUPPORTED (a build without FLOWGRAIN_VIEWER), ARGUMENT (a part of a field, numbers,
 * 3D without scales), FILE_ACCESS, MEMORY. */
FG_API fg_status fg_view_write(fg_context *context, const char *path,
                               const fg_field *field, const fg_view_options *options);

#ifdef __cplusplus
}
#endif

#endif
