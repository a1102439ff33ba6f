/* Evenly spaced streamlines as icons. */
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/evenly.h"
#include "rival/method.h"

#include <math.h>
#include <stdlib.h>

/* Body width in separations: heads, 2.6 times as wide, then leave half of the way to a
 * line at d_test. Short lines are as slim as other arrows. */
static const double WIDTH = 0.1;

static fg_status add_line(fg_icons *icons, const fg_rival *rival,
                          const fg__evenly *evenly, int index, fg__streamline *line)
{
  const fg__evenly_line *part = &evenly->line[index];
  double at_seed, length = part->to - part->from;
  fg_icon icon = {.cluster = index + 1, .area = length * evenly->separation};
  fg_status status = fg__evenly_trace(line, rival->context, &rival->domain, part->seed,
                                      fmax(-part->from, part->to), &at_seed);
  if (status == FG_STATUS_OK)
    status = fg__rival_piece(&icon, rival->context, &rival->domain, line,
                             at_seed + part->from, at_seed + part->to,
                             fmin(WIDTH * evenly->separation, FG__RIVAL_WIDTH * length));
  if (status == FG_STATUS_OK && icon.points)
    status = fg__icons_add(icons, rival->context, &icon);
  free((void *)(uintptr_t)icon.points);
  return status;
}

fg_status fg__rival_streamlines(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__evenly evenly = {0};
  fg__streamline line = {0};
  fg_status status = fg__evenly_search(&evenly, rival->context, &rival->domain, count);
  for (int i = 0; i < evenly.count && status == FG_STATUS_OK; i++)
    status = add_line(icons, rival, &evenly, i, &line);
  fg__icons_set_clusters(icons, evenly.count, evenly.count - fg_icons_count(icons));
  fg__streamline_clear(&line);
  fg__evenly_clear(&evenly);
  return status;
}
