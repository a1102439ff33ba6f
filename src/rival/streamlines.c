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

/* Places where lines cross a periodic border are looked for at steps of this share of a
 * cell, and met by so many bisections. */
static const double CUT_STEP = 0.5;
enum { BISECTIONS = 40 };

static void turns_at(const fg__domain *domain, const fg__streamline *line, double s,
                     int turns[2])
{
  double position[2], tangent[2];
  fg__streamline_at(line, s, NULL, position, tangent);
  fg__domain_turns(domain, position, turns);
}

static bool same_turns(const fg__domain *domain, const fg__streamline *line, double a,
                       double b)
{
  int at_a[2], at_b[2];
  turns_at(domain, line, a, at_a);
  turns_at(domain, line, b, at_b);
  return at_a[0] == at_b[0] && at_a[1] == at_b[1];
}

/* The last place of a line, from `from` on, before it crosses a periodic border; *next:
 * the first behind it, or `to` when there is none. */
static double find_cut(const fg__domain *domain, const fg__streamline *line, double from,
                       double to, double *next)
{
  double step = CUT_STEP * fmin(domain->spacing[0], domain->spacing[1]), low = from;
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
  const fg_rival *rival;
  const fg__evenly *evenly;
  fg__streamline line;
} drawing;

static fg_status add_piece(drawing *d, fg_icon *icon, double from, double to)
{
  double length = to - from, separation = d->evenly->separation;
  fg_status status =
      fg__rival_piece(icon, d->rival->context, &d->rival->domain, &d->line, from, to,
                      fmin(WIDTH * separation, FG__RIVAL_WIDTH * length));
  icon->area = length * separation;
  if (status == FG_STATUS_OK && icon->points)
    status = fg__icons_add(d->icons, d->rival->context, icon);
  free((void *)(uintptr_t)icon->points);
  return status;
}

/* A line is cut where it crosses a periodic border: its longest piece is drawn, and those
 * that are no shorter than a line may be. */
static fg_status add_line(drawing *d, int index)
{
  const fg__evenly_line *part = &d->evenly->line[index];
  const fg__domain *domain = &d->rival->domain;
  fg_icon icon = {.cluster = index + 1};
  double at_seed, longest = 0, next = 0;
  fg_status status = fg__evenly_trace(&d->line, d->rival->context, domain, part->seed,
                                      fmax(-part->from, part->to), &at_seed);
  double begin = at_seed + part->from, end = at_seed + part->to;
  if (status != FG_STATUS_OK || d->line.count < 2)
    return status;
  for (double from = begin; from < end; from = next)
    longest = fmax(longest, find_cut(domain, &d->line, from, end, &next) - from);
  double least = fmin(longest, FG__EVENLY_SHORTEST * d->evenly->separation);
  for (double from = begin; from < end && status == FG_STATUS_OK; from = next) {
    double to = find_cut(domain, &d->line, from, end, &next);
    if (to - from >= least)
      status = add_piece(d, &icon, from, to);
  }
  return status;
}

fg_status fg__rival_streamlines(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__evenly evenly = {0};
  drawing d = {.icons = icons, .rival = rival, .evenly = &evenly};
  int dropped = 0;
  fg_status status = fg__evenly_search(&evenly, rival->context, &rival->domain, count);
  for (int i = 0; i < evenly.count && status == FG_STATUS_OK; i++) {
    int before = fg_icons_count(icons);
    status = add_line(&d, i);
    dropped += fg_icons_count(icons) == before;
  }
  fg__icons_set_clusters(icons, evenly.count, dropped);
  fg__streamline_clear(&d.line);
  fg__evenly_clear(&evenly);
  return status;
}
