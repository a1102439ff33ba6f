/* Curved arrows through points that are drawn by lot, evenly over the domain. */
#include "base/memory.h"
#include "base/mix.h"
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/method.h"

#include <stdlib.h>

/* An arrow is a fair share long. */
static const double DEFAULT_LENGTH = 1;

/* The same lots every time. */
static const uint64_t KEY = 0x66676c6f74730001U;

/* Random points tried for each arrow before the field is taken to have no room for all.
 */
enum { LOTS = 1000 };

/* A number in [0, 1), by lot. */
static double draw_number(uint64_t *lot)
{
  return (double)(fg__mix(KEY ^ (*lot)++) >> 11) * 0x1p-53;
}

/* The cells in which the flow has a direction; *cells is allocated. */
static fg_status list_cells(int **cells, int *count, const fg_rival *rival)
{
  const fg__domain *domain = &rival->domain;
  *count = 0;
  *cells = fg__allocate((size_t)domain->valid_count, sizeof **cells);
  if (!*cells)
    return fg__fail_memory(rival->context, "cells",
                           (size_t)domain->valid_count * sizeof **cells);
  for (int i = 0; i < fg__domain_cell_count(domain); i++)
    if (fg__domain_cell_moves(domain, i))
      (*cells)[(*count)++] = i;
  return FG_STATUS_OK;
}

/* A point of a random cell. */
static void draw_point(const fg__domain *domain, const int *cells, int count,
                       uint64_t *lot, double point[3])
{
  fg__domain_center(domain, cells[(int)(draw_number(lot) * count)], point);
  for (int k = 0; k < domain->dimension; k++)
    point[k] += (draw_number(lot) - 0.5) * domain->spacing[k];
}

fg_status fg__rival_random(fg_icons *icons, const fg_rival *rival, int count)
{
  const fg__domain *domain = &rival->domain;
  double share = rival->options.length > 0 ? rival->options.length : DEFAULT_LENGTH;
  double length = share * fg__domain_fair_share(domain, count);
  int *cells = NULL, moving = 0, drawn = 0;
  uint64_t lot = 0;
  fg__line line = {0};
  fg_status status = list_cells(&cells, &moving, rival);
  for (long left = (long)LOTS * count; left > 0 && moving > 0 && drawn < count; left--) {
    fg_icon icon = {.cluster = drawn + 1, .area = domain->area / count};
    double point[3];
    draw_point(domain, cells, moving, &lot, point);
    status = fg__rival_curved(&icon, rival->context, domain, point, length, &line);
    if (status == FG_STATUS_OK && icon.points) {
      status = fg__icons_add(icons, rival->context, &icon);
      drawn++;
    }
    fg__rival_free_points(&icon);
    if (status == FG_STATUS_OK)
      status = fg__check_stop(rival->context);
    if (status != FG_STATUS_OK)
      break;
  }
  fg__icons_set_clusters(icons, count, count - drawn);
  fg__line_clear(&line);
  free(cells);
  return status;
}
