/* A curved arrow for each cluster of cells by place and direction. */
#include "rival/cluster/lloyd.h"

/* A unit of direction counts as a fair-share length. */
static const double WEIGHT = 1;

fg_status fg__rival_k_means(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__lloyd lloyd;
  fg_status status =
      fg__lloyd_create(&lloyd, rival->context, &rival->domain, count, WEIGHT);
  if (status == FG_STATUS_OK)
    status = fg__lloyd_draw(icons, rival, &lloyd, count, true);
  fg__lloyd_clear(&lloyd);
  return status;
}
