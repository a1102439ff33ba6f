/* Arrows at the points of a grid: hedgehog (straight) and grid-curved. */
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/lattice.h"
#include "rival/method.h"

#include <math.h>
#include <stdlib.h>

/* Length of the longest arrow in spacings: a gap is left between head and next tail. */
static const double LONGEST = 0.92;

static double speed_at(const fg__domain *domain, const double point[2])
{
  double velocity[3];
  return fg_field_velocity(domain->field, point, velocity)
             ? hypot(velocity[0], velocity[1])
             : 0;
}

static double largest_speed(const fg__lattice *lattice, const fg__domain *domain)
{
  double largest = 0, point[2];
  for (int i = 0; i < lattice->size[0] * lattice->size[1]; i++) {
    fg__lattice_point(lattice, domain, i, point);
    largest = fmax(largest, speed_at(domain, point));
  }
  return largest;
}

/* One arrow, added to the list when there is one; *drawn says so. */
static fg_status add_arrow(fg_icons *icons, bool *drawn, const fg_rival *rival,
                           const fg__lattice *lattice, const double point[2],
                           double length, int number, fg__streamline *line)
{
  fg_icon icon = {.cluster = number, .area = lattice->spacing[0] * lattice->spacing[1]};
  fg_status status =
      line ? fg__rival_curved(&icon, rival->context, &rival->domain, point, length, line)
           : fg__rival_straight(&icon, rival->context, &rival->domain, point, length);
  *drawn = status == FG_STATUS_OK && icon.points;
  if (*drawn)
    status = fg__icons_add(icons, rival->context, &icon);
  free((void *)(uintptr_t)icon.points);
  return status;
}

static fg_status draw_grid(fg_icons *icons, const fg_rival *rival, int count,
                           fg__streamline *line)
{
  fg__lattice lattice;
  const fg__domain *domain = &rival->domain;
  fg_status status = fg__lattice_choose(&lattice, rival->context, domain, count);
  if (status != FG_STATUS_OK)
    return status;
  double longest = LONGEST * fmin(lattice.spacing[0], lattice.spacing[1]);
  double fastest = largest_speed(&lattice, domain);
  int number = 0, dropped = 0;
  for (int i = 0; i < lattice.size[0] * lattice.size[1] && status == FG_STATUS_OK; i++) {
    double point[2], length = longest;
    fg__lattice_point(&lattice, domain, i, point);
    if (!fg__domain_moves(domain, point))
      continue;
    if (rival->options.length_by_speed)
      length *= speed_at(domain, point) / fastest;
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
  fg__streamline line = {0};
  fg_status status = draw_grid(icons, rival, count, &line);
  fg__streamline_clear(&line);
  return status;
}
