/* On azimuthal planes: what lies farther from the centre than is shown is moved to the
 * circle of that distance, along its direction. */
#include <math.h>

#include "picture/map/tracer.h"
#include "sphere/sphere.h"

/* Places along the circle. */
static const double rim_step = 2.0;

/* Directions from the centre; `pushed`: that of the last place on the circle. */
typedef struct walk {
  fg__tracer *tracer;
  double sine, cosine; /* of the centre's latitude */
  double least;        /* cosine of the distance of the circle */
  double direction, pushed, net;
  double before[2]; /* of a line: the last place */
  bool begun, inside, ever_inside, ever_outside;
} walk;

static double turn_between(double from, double to)
{
  return remainder(to - from, 360.0);
}

static walk walk_of(fg__tracer *t)
{
  const fg__plane *plane = t->plane;
  return (walk){.tracer = t,
                .sine = sin(plane->center[1] * FG__RADIANS),
                .cosine = cos(plane->center[1] * FG__RADIANS),
                .least = cos(plane->reach * FG__RADIANS)};
}

/* Whether a place is within reach, and its direction from the centre. */
static bool look(const walk *w, const double place[2], double *direction)
{
  const double turn = (place[0] - w->tracer->plane->center[0]) * FG__RADIANS;
  const double s = sin(place[1] * FG__RADIANS), c = cos(place[1] * FG__RADIANS);
  *direction =
      atan2(c * sin(turn), w->cosine * s - w->sine * c * cos(turn)) / FG__RADIANS;
  return w->sine * s + w->cosine * c * cos(turn) >= w->least;
}

/* Adds the place on the circle in a direction. */
static void push_rim(walk *w, double direction)
{
  const double sine = sqrt(fmax(1.0 - w->least * w->least, 0.0));
  const double s = sin(direction * FG__RADIANS), c = cos(direction * FG__RADIANS);
  const double up = w->sine * w->least + w->cosine * sine * c;
  const double turn =
      atan2(s * sine, w->cosine * w->least - w->sine * sine * c) / FG__RADIANS;
  fg__stroke_add(&w->tracer->stroke, w->tracer->plane->center[0] + turn,
                 asin(fmin(fmax(up, -1.0), 1.0)) / FG__RADIANS);
  w->pushed = direction;
}

static void push_arc(walk *w, double direction)
{
  const double turn = turn_between(w->pushed, direction), from = w->pushed;
  const double pieces = ceil(fabs(turn) / rim_step);
  for (double k = 1.0; k <= pieces; k += 1.0)
    push_rim(w, from + turn * k / pieces);
}

static void visit_area(walk *w, const double place[2], bool cut)
{
  (void)cut;
  double direction;
  const bool inside = look(w, place, &direction);
  if (w->begun)
    w->net += turn_between(w->direction, direction);
  if (inside) {
    if (w->begun && !w->inside)
      push_arc(w, w->direction);
    fg__stroke_add(&w->tracer->stroke, place[0], place[1]);
    w->ever_inside = true;
  } else {
    if (!w->begun || w->inside)
      push_rim(w, direction);
    else if (fabs(turn_between(w->pushed, direction)) >= rim_step)
      push_arc(w, direction);
    w->ever_outside = true;
  }
  w->direction = direction;
  w->inside = inside;
  w->begun = true;
}

/* Visits places all along a part, but for its first. cut: on the data's own cut. */
static void follow(walk *w, const fg__coast_part *p,
                   void (*visit)(walk *w, const double place[2], bool cut))
{
  for (size_t n = 0; n < fg__part_edges(p); ++n) {
    double a[2], b[2];
    fg__part_edge(p, n, a, b);
    const bool cut = fg__edge_is_cut(a, b);
    const double wide = fabs(b[0] - a[0]) * cos(0.5 * (a[1] + b[1]) * FG__RADIANS);
    const double length = fmax(wide, fabs(b[1] - a[1]));
    const int pieces = (int)fmax(ceil(length / w->tracer->step), 1.0);
    for (int k = 1; k <= pieces; ++k) {
      const double share = (double)k / pieces;
      visit(w,
            (const double[2]){a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])},
            cut);
    }
  }
}

/* Whether a place lies inside a ring: crossings of its meridian on the way north, of all
 * turns of the ring that has, and of the way to the pole where a ring goes round it. */
static bool ring_contains(const fg__coast_part *p, const double place[2])
{
  bool inside = p->turn != 0.0 && p->low[1] + p->high[1] > 0.0;
  for (size_t n = 0; n < p->count; ++n) {
    double a[2], b[2];
    fg__part_edge(p, n, a, b);
    const double west = fmin(a[0], b[0]), east = fmax(a[0], b[0]);
    const double at = place[0] + 360.0 * ceil((west - place[0]) / 360.0);
    if (!(at >= west && at < east))
      continue;
    const double latitude = a[1] + (b[1] - a[1]) * (at - a[0]) / (b[0] - a[0]);
    inside = inside != (latitude > place[1]);
  }
  return inside;
}

static void add_circle(fg__tracer *t)
{
  walk w = walk_of(t);
  for (double direction = 0.0; direction < 360.0; direction += rim_step)
    push_rim(&w, direction);
  fg__stroke_end(&t->stroke, t->areas, t->plane, true);
}

/* A ring round the antipode comes out inside out: the circle turns it right again. */
static void trace_area(fg__tracer *t, const fg__coast_part *p)
{
  const fg__plane *plane = t->plane;
  walk w = walk_of(t);
  visit_area(&w, p->point[0], false);
  follow(&w, p, visit_area);
  if (!w.ever_inside && fabs(w.net) < 180.0)
    t->stroke.count = 0;
  fg__stroke_end(&t->stroke, t->areas, plane, true);
  const double antipode[2] = {plane->center[0] + 180.0, -plane->center[1]};
  if ((w.ever_outside || fabs(w.net) > 180.0) && ring_contains(p, antipode))
    add_circle(t);
}

/* One place beyond the circle is kept at either end of a line. */
static void visit_line(walk *w, const double place[2], bool cut)
{
  fg__tracer *t = w->tracer;
  const bool now = look(w, place, &w->direction) && !cut;
  if (now && !w->inside && w->begun)
    fg__stroke_add(&t->stroke, w->before[0], w->before[1]);
  if (now || w->inside)
    fg__stroke_add(&t->stroke, place[0], place[1]);
  if (!now)
    fg__stroke_end(&t->stroke, t->lines, t->plane, false);
  w->inside = now;
  w->begun = true;
  w->before[0] = place[0];
  w->before[1] = place[1];
}

static void trace_lines(fg__tracer *t, const fg__coast_part *p)
{
  walk w = walk_of(t);
  visit_line(&w, p->point[0], false);
  follow(&w, p, visit_line);
  fg__stroke_end(&t->stroke, t->lines, t->plane, false);
}

void fg__trace_round(fg__tracer *t, const fg__coast_part *p)
{
  int turns[2];
  fg__part_turns(turns, p, t->plane);
  if (turns[0] > turns[1])
    return;
  if (t->areas && p->closed)
    trace_area(t, p);
  if (t->lines)
    trace_lines(t, p);
}
