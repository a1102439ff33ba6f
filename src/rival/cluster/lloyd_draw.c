/* Clusters about their means as icons. */
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/cluster/lloyd.h"

/* An arrow is a fair share long. */
static const double DEFAULT_LENGTH = 1;

typedef struct drawing {
  const fg_rival *rival;
  double length;
  fg__line line;
} drawing;

/* The arrow through a place; *icon has no points when there is none. */
static fg_status make(drawing *d, fg_icon *icon, const double place[])
{
  return fg__rival_curved(icon, d->rival->context, &d->rival->domain, place, d->length,
                          &d->line);
}

static fg_status draw_cluster(fg_icons *icons, drawing *d, const fg__lloyd *lloyd, int n,
                              bool through_member)
{
  const fg__domain *domain = &d->rival->domain;
  fg_icon icon = {.cluster = n + 1, .area = lloyd->first[n + 1] - lloyd->first[n]};
  for (int k = 0; k < domain->dimension; k++)
    icon.area *= domain->spacing[k];
  fg_status status = FG_STATUS_OK;
  if (!through_member)
    status = make(d, &icon, lloyd->center[n]);
  for (int i = lloyd->first[n];
       i < lloyd->first[n + 1] && !icon.points && status == FG_STATUS_OK; i++) {
    double place[3];
    fg__domain_center(domain, lloyd->member[i], place);
    status = make(d, &icon, place);
  }
  if (status == FG_STATUS_OK && icon.points)
    status = fg__icons_add(icons, d->rival->context, &icon);
  fg__rival_free_points(&icon);
  return status == FG_STATUS_OK ? fg__check_stop(d->rival->context) : status;
}

fg_status fg__lloyd_draw(fg_icons *icons, const fg_rival *rival, const fg__lloyd *lloyd,
                         int count, bool through_member)
{
  double share = rival->options.length > 0 ? rival->options.length : DEFAULT_LENGTH;
  drawing d = {.rival = rival,
               .length = share * fg__domain_fair_share(&rival->domain, count)};
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < lloyd->count && status == FG_STATUS_OK; n++)
    status = draw_cluster(icons, &d, lloyd, n, through_member);
  fg__icons_set_clusters(icons, count, count - fg_icons_count(icons));
  fg__line_clear(&d.line);
  return status;
}
