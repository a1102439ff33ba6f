/* Making the icons of some clusters, from the whole density or from parts of it. */
#ifndef FG__ICONS_CREATE_H
#define FG__ICONS_CREATE_H

#include "cluster/raster.h"
#include "icon/territory.h"

/* What icons are made from. */
typedef struct fg__icon_source {
  const fg_field *field;
  fg_field *const *field_window; /* [count] with cluster: what serves in place of a field
                                    that ranks share; else NULL */
  const fg_density_arrays *density;
  const fg__labels *labels;
  const fg__territories *territories; /* NULL: arrows stay in their clusters */
  int count;                          /* of icons wanted */
  const int *cluster;                 /* [count] their labels; NULL: 1 ... count */
  const fg__patch *patch;             /* [count] with cluster, else one for all */
} fg__icon_source;

/* Makes icons by up to `threads` threads: icon[source->count], zeroed before. Their
 * points are to be freed, and NULL where no arrow fits. MEMORY, STOPPED. */
fg_status fg__icons_make(fg_icon *icon, fg_context *context,
                         const fg__icon_source *source, int threads);
void fg__icons_free_points(fg_icon *icon, int count);

/* The list of those that have points, in their order. MEMORY. */
fg_status fg__icons_collect(fg_icons **out, fg_context *context, const fg_icon *icon,
                            int clusters);

/* fg_icons_create of a shared density. */
fg_status fg__icons_create_shared(fg_icons **out, fg_context *context,
                                  const fg_field *field, const fg_density *density,
                                  const fg_icon_options *options);

#endif
