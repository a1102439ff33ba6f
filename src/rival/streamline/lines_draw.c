/* Long streamlines as icons. */
#include "icon/icons.h"
#include "rival/arrows.h"
#include "rival/streamline/lines.h"

#include <math.h>
#include <stdlib.h>

/* Body width in separations: heads, 2.6 times as wide, then leave half of the way to a
 * line at d_test. Short lines are as slim as other arrows. */
static const double WIDTH = 0.1;

/* Places where lines cross a periodic boundary are looked for at steps of this share of a
 * cell, and met by so many bisections. */
static const double CUT_STEP = 0.5;
enum { BISECTIONS = 40 };

static void turns_at(const fg__domain *domain, const fg__line *line, double s,
                     int turns[3])
{
  double position[3], tangent[3];
  fg__line_at(line, s, NULL, position, tangent);
  fg__domain_turns(domain, position, turns);
}

static bool same_turns(const fg__domain *domain, const fg__line *line, double a, double b)
{
  int at_a[3], at_b[3];
  bool same = true;
  turns_at(domain, line, a, at_a);
  turns_at(domain, line, b, at_b);
  for (int k = 0; k < domain->dimension; k++)
    same = same && at_a[k] == at_b[k];
  return same;
}

/* The last place of a line, from `from` on, before it crosses a periodic boundary; *next:
 * the first behind it, or `to` when there is none. */
static double find_cut(const fg__domain *domain, const fg__line *line, double from,
                       double to, double *next)
{
  double step = CUT_STEP * fg__domain_cell_size(domain), low = from;
  *next = to;
  for (double s = from; s < to; low = s) {
    s = fmin(s + step, to);
    if (same_turns(domain, line, from, s))
      continue;
    double high = s;
    for (int i = 0; i < BISECTIONS; i++) {
      double middle = (low + high) / 2;
      if (same_turns(domain, line, from, middle))
        low = middle;
      else
        high = middle;
    }
    *next = high;
    return low;
  }
  return to;
}

typedef struct drawing {
  fg_icons *icons;
  fg_context *context;
  const fg__domain *domain;
  const fg__lines *lines;
  fg__line line;
} drawing;

static fg_status add_piece(drawing *d, fg_icon *icon, double from, double to)
{
  double length = to - from, separation = d->lines->separation;
  double width = fmin(WIDTH * separation, FG__RIVAL_WIDTH * length);
  fg_status status =
      fg__rival_piece(icon, d->context, d->domain, &d->line, from, to, width);
  icon->area = length * separation;
  if (d->domain->dimension == 3)
    icon->area *= separation;
  if (status == FG_STATUS_OK && icon->points)
    status = fg__icons_add(d->icons, d->context, icon);
  fg__rival_free_points(icon);
  return status;
}

static fg_status add_line(drawing *d, int index)
{
  const fg__lines_part *part = &d->lines->part[index];
  const fg__domain *domain = d->domain;
  fg_icon icon = {.cluster = index + 1};
  double longest = 0, next = 0;
  fg_status status = fg__lines_trace(&d->line, d->context, domain, d->lines, part->seed,
                                     fmax(-part->from, part->to));
  double begin = d->line.start + part->from, end = d->line.start + part->to;
  if (status != FG_STATUS_OK || d->line.count < 2)
    return status;
  for (double from = begin; from < end; from = next)
    longest = fmax(longest, find_cut(domain, &d->line, from, end, &next) - from);
  double least = fmin(longest, FG__LINES_SHORTEST * d->lines->separation);
  for (double from = begin; from < end && status == FG_STATUS_OK; from = next) {
    double to = find_cut(domain, &d->line, from, end, &next);
    if (to - from >= least)
      status = add_piece(d, &icon, from, to);
  }
  return status;
}

fg_status fg__lines_draw(fg_icons *icons, fg_context *context, const fg__domain *domain,
                         const fg__lines *lines)
{
  drawing d = {.icons = icons, .context = context, .domain = domain, .lines = lines};
  int dropped = 0;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < lines->count && status == FG_STATUS_OK; i++) {
    int before = fg_icons_count(icons);
    status = add_line(&d, i);
    dropped += fg_icons_count(icons) == before;
  }
  fg__icons_set_clusters(icons, lines->count, dropped);
  fg__line_clear(&d.line);
  return status;
}
