/* Making the icons of some clusters, from patches of the density. */
#ifndef FG__ICONS_MAKE_H
#define FG__ICONS_MAKE_H

#include "cluster/window.h"

/* What icons are made from. */
typedef struct fg__icon_source {
  const fg_field *field;
  fg_field *const *field_window; /* [count] what serves in place of a field
                                    that ranks share; else NULL */
  const fg_density_arrays *density;
  const fg__labels *labels;
  int count;              /* of icons wanted */
  const int *cluster;     /* [count] their labels */
  const fg__patch *patch; /* [count] */
  const struct fg__territory
      *territory; /* clusters are territories; NULL: they are not */
  bool to_ends;   /* arrows of thin clusters go to the ends of their lines */
} fg__icon_source;

/* Places for a cluster's icons: one across a periodic boundary may have several. */
enum { FG__ICON_PIECES = FG__WINDOW_PIECES };

/* [clusters * FG__ICON_PIECES], zeroed; NULL when there is no memory. fg__icons_free ends
 * them with their points. */
fg_icon *fg__icons_allocate(int clusters);
void fg__icons_free(fg_icon *icon, int clusters);

/* Makes icons by up to `threads` threads into icon[source->count * FG__ICON_PIECES].
 * Where no arrow fits, and where a cluster has fewer icons, points is NULL. MEMORY,
 * STOPPED. */
fg_status fg__icons_make(fg_icon *icon, fg_context *context,
                         const fg__icon_source *source, int threads);

/* The list of those that have points, in their order. MEMORY. */
fg_status fg__icons_collect(fg_icons **out, fg_context *context, const fg_icon *icon,
                            int clusters);

#endif
