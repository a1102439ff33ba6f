/* A curved arrow through each centre of a centroidal Voronoi tessellation. */
#include "rival/cluster/lloyd.h"

fg_status fg__rival_voronoi(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__lloyd lloyd;
  fg_status status = fg__lloyd_create(&lloyd, rival->context, &rival->domain, count, 0);
  if (status == FG_STATUS_OK)
    status = fg__lloyd_draw(icons, rival, &lloyd, count, false);
  fg__lloyd_clear(&lloyd);
  return status;
}
