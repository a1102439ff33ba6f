/* Arrows at the points of a grid: hedgehog (straight) and grid-curved. */
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/lattice.h"
#include "rival/method.h"

#include <math.h>
#include <stdlib.h>

/* Length of the longest arrow: in 2D in spacings, so that a gap is left between a head
 * and the next tail; in 3D, where arrows in a row are seldom seen one behind the other,
 * in fair shares. */
static const double LONGEST = 0.92, LONGEST_IN_SPACE = 1;

static double longest_arrow(const fg_rival *rival, const fg__lattice *lattice, int count)
{
  const fg__domain *domain = &rival->domain;
  if (domain->dimension == 2 && !(rival->options.length > 0))
    return LONGEST * fg__lattice_spacing(lattice, domain);
  double shares = rival->options.length > 0 ? rival->options.length : LONGEST_IN_SPACE;
  return shares * fg__domain_fair_share(domain, count);
}

static double largest_speed(const fg__lattice *lattice, const fg__domain *domain)
{
  double largest = 0, point[3];
  for (int i = 0; i < fg__lattice_count(lattice); i++) {
    fg__lattice_point(lattice, domain, i, point);
    largest = fmax(largest, fg__domain_speed(domain, point));
  }
  return largest;
}

static double share_of(const fg__lattice *lattice, const fg__domain *domain)
{
  double share = 1;
  for (int k = 0; k < domain->dimension; k++)
    share *= lattice->spacing[k];
  return share;
}

/* One arrow, added to the list when there is one; *drawn says so. */
static fg_status add_arrow(fg_icons *icons, bool *drawn, const fg_rival *rival,
                           const fg__lattice *lattice, const double point[],
                           double length, int number, fg__line *line)
{
  fg_icon icon = {.cluster = number, .area = share_of(lattice, &rival->domain)};
  fg_status status =
      line ? fg__rival_curved(&icon, rival->context, &rival->domain, point, length, line)
           : fg__rival_straight(&icon, rival->context, &rival->domain, point, length);
  *drawn = status == FG_STATUS_OK && icon.points;
  if (*drawn)
    status = fg__icons_add(icons, rival->context, &icon);
  fg__rival_free_points(&icon);
  return status;
}

static fg_status draw_grid(fg_icons *icons, const fg_rival *rival, int count,
                           fg__line *line)
{
  fg__lattice lattice;
  const fg__domain *domain = &rival->domain;
  fg_status status = fg__lattice_choose(&lattice, rival->context, domain, count);
  if (status != FG_STATUS_OK)
    return status;
  double longest = longest_arrow(rival, &lattice, count);
  double fastest = largest_speed(&lattice, domain);
  int number = 0, dropped = 0;
  for (int i = 0; i < fg__lattice_count(&lattice) && status == FG_STATUS_OK; i++) {
    double point[3], length = longest;
    fg__lattice_point(&lattice, domain, i, point);
    if (!fg__domain_moves(domain, point))
      continue;
    if (rival->options.length_by_speed)
      length *= fg__domain_speed(domain, point) / fastest;
    bool drawn;
    status = add_arrow(icons, &drawn, rival, &lattice, point, length, ++number, line);
    dropped += !drawn;
    if (status == FG_STATUS_OK)
      status = fg__check_stop(rival->context);
  }
  fg__icons_set_clusters(icons, number, dropped);
  return status;
}

fg_status fg__rival_hedgehog(fg_icons *icons, const fg_rival *rival, int count)
{
  return draw_grid(icons, rival, count, NULL);
}

fg_status fg__rival_grid_curved(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__line line = {0};
  fg_status status = draw_grid(icons, rival, count, &line);
  fg__line_clear(&line);
  return status;
}
