/* The icon of one cluster in 3D. */
#ifndef FG__SOLID_MAKE_H
#define FG__SOLID_MAKE_H

#include "solid/core.h"
#include "solid/shaft.h"

/* What a choice works with, to be kept from cluster to cluster; all zero at first. */
typedef struct fg__solid_maker {
  fg__path best, tried;
  fg__shaft_stations stations;
  double (*sample)[3]; /* points of the cluster, evenly spread */
  size_t sample_capacity;
  int sample_count;
} fg__solid_maker;

/* Tries streamlines through the spine's centre, through other points of it, through
 * points beside them and some all over the cluster, fits an arrow to each, and takes the
 * one nearest to all points of the cluster, as in 2D (docs/method/icons.md). Every vertex
 * of its solid (fg_icon_solid) lies in {level > 0}: an arrow that fails that is made
 * smaller. Fills in all of the icon but cluster and area; point_count stays 0 when no
 * arrow fits. fg__solid_icon_free ends its arrays. MEMORY. */
fg_status fg__solid_icon_make(fg_icon *out, fg_context *context, fg__solid_maker *maker,
                              const fg_field *field, const fg__volume *volume);
void fg__solid_icon_free(fg_icon *icon);
void fg__solid_maker_clear(fg__solid_maker *maker);

#endif
