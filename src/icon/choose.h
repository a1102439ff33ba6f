/* Which streamline stands for a cluster. */
#ifndef FG__CHOOSE_H
#define FG__CHOOSE_H

#include "icon/arrow.h"
#include "skeleton/spine.h"

/* What a choice works with, to be kept from cluster to cluster; all zero at first. */
typedef struct fg__chooser {
  fg__streamline best, tried;
  fg__stations stations;
  double (*sample)[2]; /* points of the cluster, evenly spread */
  size_t sample_capacity;
  int sample_count;
  unsigned char *passed; /* nodes near which a line was tried */
  size_t passed_capacity;
} fg__chooser;

/* Tries streamlines through the spine's centre, through other points of it and through
 * points beside it, fits an arrow to each, and keeps in chooser->best the one whose arrow
 * lies nearest to all of the cluster: the smallest mean square distance, which asks for a
 * long arrow through the middle at once. No arrow fits: arrow->width is 0. MEMORY. */
fg_status fg__choose_arrow(fg__arrow *arrow, fg__chooser *chooser, fg_context *context,
                           const fg_field *field, const fg__room *room,
                           const fg__spine *spine);
void fg__chooser_clear(fg__chooser *chooser);

#endif
