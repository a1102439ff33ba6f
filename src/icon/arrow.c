#include "icon/arrow.h"

#include "base/memory.h"
#include "icon/territory.h"

#include <math.h>
#include <stdlib.h>

/* Readability (in spacings): shorter or narrower is too small to read in print. */
static const double SHORTEST = 3.0;
static const double NARROWEST_HEAD = 1.2;

/* Largest width in lengths: with it the head takes 22 % of the length. Wider ones are
 * stubs; a fat cluster does not make a fat arrow. */
static const double LARGEST_WIDTH = 0.075;

/* Arrows slimmer than this, in lengths, look like threads with a knot: the cluster gets a
 * shorter and bolder one instead. */
static const double SLIMMEST = 0.03;

/* The narrowest arrow may be wider in lengths than others: its head, a third of it, is
 * what a reader needs to see which way it points. */
static const double SMALL_ARROW_WIDTH = 0.11;

/* Shares of the free way to the boundary that a body's and a head's half width may take.
 */
static const double BODY_SHARE = 0.5;
static const double HEAD_SHARE = 0.85;

/* Largest half width in radii of curvature, both over a width to either side, where the
 * outline's normals smooth the rest; and how far the line may turn within the head. */
static const double BODY_BEND = 0.3;
static const double HEAD_TURNING = 0.5;

/* Places where a head's sides are looked at; the finished outline is tested everywhere.
 */
enum { HEAD_CHECKS = 3 };

/* Share of the barbs' clearance that the line must have where the head begins. */
static const double CLEARANCE_ENOUGH = 0.8;

/* Within a head the line stays within this share of its half width: its triangle is
 * straight. */
static const double HEAD_BOW = 0.55;

/* What uneven bending costs (see bending_of): a right angle within a tenth of the arrow
 * costs 40 % of its score, a smooth S of 60 degrees to either side a tenth. */
static const double UNEVEN_COST = 0.03;

/* Beyond this turning (radians) an arrow must deserve it: each radian more costs. */
static const double LONG_TURNING = 2.4;
static const double TURNING_COST = 0.06;

/* A bent arrow looks less long: rings and horseshoes may be slimmer, by this share a
 * radian, so that a ring of 300 degrees is judged by 0.7 of its way. */
static const double ROLLED_UP = 0.08;

/* What it costs when the arrow lies at one end of its line. */
static const double ASIDE_COST = 0.15;

/* Parts of one arrow that run against each other are at least this share as far apart as
 * on a circle of the same turning and length: no hairpins, and rings and horseshoes
 * pass. It applies from 120 degrees on. */
static const double ROUNDNESS = 0.55;
static const double AGAINST = 2.094;

/* Parts closer together than this (in widths, between outlines) seem to touch. */
static const double SELF_GAP = 1.0;

/* Widths are tried downwards by this factor, tails cut by these shares of the length. */
static const double WIDTH_STEP = 0.92;
static const double CUTS[] = {0, 0.1, 0.2, 0.3, 0.45, 0.6};

/* Turn between two points of the centreline, radians, and their distance in spacings. */
static const double POINT_TURN = 0.017;
static const double POINT_SPACING = 1.0;

/* One streamline's search for its best arrow. */
typedef struct arrow_search {
  fg__arc_samples *samples;
  const fg__interior *interior;
  double narrowest; /* width */
  double rolled_up; /* the most that any part of the line may be longer, see below */
  double width;     /* tried now */
  double weight;    /* what it makes of a length */
  fg__arrow best;
  double score; /* of `best`: length, times width to FG__WIDTH_EXPONENT, over bending */
} arrow_search;

double fg__arrow_widest(double length, const fg__interior *interior)
{
  if (interior->window->dimension == 3)
    return fg__arrow_widest_solid(length);
  return fmax(LARGEST_WIDTH * length,
              NARROWEST_HEAD * interior->spacing / FG__HEAD_WIDTH);
}

/* Whether the straight head fits with its tip at a sample; *base is the sample where it
 * begins. */
static bool head_fits(const arrow_search *search, int first, int tip, int *base)
{
  const fg__arc_sample *sample = search->samples->sample;
  double width = search->width, length = FG__HEAD_LENGTH * width;
  int i = tip - (int)lround(length / search->samples->step);
  if (i < first || i >= tip)
    return false;
  /* the barbs have little more clearance than the line beside them */
  if (sample[i].clearance < CLEARANCE_ENOUGH * FG__HEAD_WIDTH / 2 * width / HEAD_SHARE ||
      fabs(sample[tip].turning - sample[i].turning) > HEAD_TURNING)
    return false;
  const double *p = sample[i].position, *q = sample[tip].position;
  double dx = q[0] - p[0], dy = q[1] - p[1], chord = sqrt(dx * dx + dy * dy);
  if (!(chord > 0.8 * length))
    return false;
  dx /= chord;
  dy /= chord;
  for (int k = i + 1; k < tip; k++) {
    double x = sample[k].position[0] - p[0], y = sample[k].position[1] - p[1];
    double left = 1 - (x * dx + y * dy) / chord;
    if (fabs(y * dx - x * dy) > HEAD_BOW * FG__HEAD_WIDTH / 2 * width * left)
      return false;
  }
  const fg__interior *interior = search->interior;
  double margin = interior->margin;
  if (!fg__interior_has(interior, q[0] + margin * dx, q[1] + margin * dy))
    return false;
  *base = i;
  for (int k = 0; k <= HEAD_CHECKS; k++) { /* from the barbs to the tip */
    double left = 1 - (double)k / HEAD_CHECKS;
    double half = FG__HEAD_WIDTH / 2 * width * left / HEAD_SHARE + margin;
    double along = k == 0 ? -FG__HEAD_SWEEP * length : chord * (1 - left);
    double x = p[0] + along * dx, y = p[1] + along * dy;
    if (!fg__interior_has(interior, x - half * dy, y + half * dx) ||
        !fg__interior_has(interior, x + half * dy, y - half * dx))
      return false;
  }
  return true;
}

/* Sets how much of the taper fits at each sample. */
static void find_shares(const arrow_search *search)
{
  fg__arc_sample *sample = search->samples->sample;
  double half = search->width / 2, radii = BODY_BEND * search->samples->bend_window;
  for (int i = 0; i < search->samples->count; i++) {
    double limit = BODY_SHARE * sample[i].clearance;
    if (sample[i].bend * limit > radii)
      limit = radii / sample[i].bend;
    sample[i].share = (limit / half - FG__TAIL_WIDTH) / (1 - FG__TAIL_WIDTH);
  }
}

/* The most upstream tail from which the body fits, or base when there is none. Where only
 * a share of the taper fits, the taper must not have come further: that bounds the tail
 * from upstream. */
static int find_tail(const arrow_search *search, int first, int base)
{
  const fg__arc_sample *sample = search->samples->sample;
  double end = sample[base].s, bound = sample[first].s;
  int tail = base;
  if (sample[base].share < 1)
    return base;
  for (int i = base - 1; i >= first; i--) {
    double share = sample[i].share;
    if (share < 0)
      break;
    if (share < 1)
      bound = fmax(bound, (sample[i].s - share * end) / (1 - share));
    if (sample[i].s < bound)
      break;
    tail = i;
  }
  /* a bound found late may lie beyond samples already taken */
  while (tail < base && sample[tail].s < bound)
    tail++;
  return tail;
}

/* Whether two samples may be on the same arrow. */
static bool go_together(const fg__arc_sample *a, const fg__arc_sample *b, double width)
{
  double turn = fabs(a->turning - b->turning);
  if (turn < AGAINST)
    return true;
  if (turn > FG__LARGEST_TURNING)
    return false;
  double dx = a->position[0] - b->position[0], dy = a->position[1] - b->position[1];
  double circle = (b->s - a->s) * sin(turn / 2) / (turn / 2);
  double least = fmax((0.5 + FG__HEAD_WIDTH / 2 + SELF_GAP) * width, ROUNDNESS * circle);
  return dx * dx + dy * dy > least * least;
}

/* Sets the earliest tail for every tip. */
static void find_earliest(const arrow_search *search)
{
  fg__arc_sample *sample = search->samples->sample;
  int count = search->samples->count;
  double lowest = 0, highest = 0;
  for (int i = 0; i < count; i++) {
    lowest = fmin(lowest, sample[i].turning);
    highest = fmax(highest, sample[i].turning);
    sample[i].earliest = i > 0 ? sample[i - 1].earliest : 0;
    if (highest - lowest < AGAINST)
      continue;
    for (int k = i - 1; k >= sample[i].earliest; k -= 2)
      if (!go_together(&sample[k], &sample[i], search->width)) {
        sample[i].earliest = k + 1;
        break;
      }
  }
}

/* How unevenly an arrow bends: length times the integral of squared curvature, over
 * windows of two widths, less the square of all it turns, which is what an even bend has.
 */
static double bending_of(const arrow_search *search, int tail, int tip)
{
  const fg__arc_sample *sample = search->samples->sample;
  double length = sample[tip].s - sample[tail].s, window = search->samples->bend_window;
  double turning = sample[tip].turning - sample[tail].turning;
  double squares = (sample[tip].bend_sum - sample[tail].bend_sum) / (window * window);
  double uneven = length * search->samples->step * squares - turning * turning;
  return 1 + UNEVEN_COST * fmax(uneven, 0) +
         TURNING_COST * fmax(fabs(turning) - LONG_TURNING, 0);
}

static void consider(arrow_search *search, int tail, int tip)
{
  const fg__arc_sample *sample = search->samples->sample;
  double length = sample[tip].s - sample[tail].s;
  double visible = length * search->weight;
  if (visible <= search->score)
    return;
  double total = sample[search->samples->count - 1].s;
  double aside = fabs(sample[tail].s + sample[tip].s - total) / total;
  visible *= 1 - ASIDE_COST * aside;
  double bending = bending_of(search, tail, tip);
  if (visible / bending <= search->score)
    return;
  search->score = visible / bending;
  search->best = (fg__arrow){
      .tail = sample[tail].s,
      .tip = sample[tip].s,
      .width = search->width,
      .turning = fabs(sample[tip].turning - sample[tail].turning),
      .bending = bending,
  };
}

/* How much longer than a straight arrow of the same look one may be that turns. */
static double rolled_up(double turning)
{
  return 1 + ROLLED_UP * turning;
}

static bool is_too_long(const arrow_search *search, int tail, int tip, double slim)
{
  const fg__arc_sample *sample = search->samples->sample;
  double length = sample[tip].s - sample[tail].s;
  double turning = fabs(sample[tip].turning - sample[tail].turning);
  const double longest = fg__territory_longest(search->interior->territory);
  return length > slim * rolled_up(turning) || turning > FG__LARGEST_TURNING ||
         length > longest;
}

/* Tries the arrows of one width that end at a sample and begin at `tail` or later. */
static void try_tails(arrow_search *search, int tail, int base, int tip, double least,
                      double slim)
{
  const fg__arc_sample *sample = search->samples->sample;
  while (tail < base && is_too_long(search, tail, tip, slim))
    tail++;
  double length = sample[tip].s - sample[tail].s;
  for (size_t k = 0; k < sizeof CUTS / sizeof *CUTS; k++) {
    int begin = tail + (int)(CUTS[k] * length / search->samples->step);
    if (begin >= base || sample[tip].s - sample[begin].s < least)
      return;
    consider(search, begin, tip);
  }
}

/* Tries all arrows of one width. */
static void try_width(arrow_search *search, double width, double end_gap)
{
  const fg__arc_sample *sample = search->samples->sample;
  int count = search->samples->count;
  double total = sample[count - 1].s;
  double ratio = width > search->narrowest ? LARGEST_WIDTH : SMALL_ARROW_WIDTH;
  double least = fmax(SHORTEST * search->interior->spacing, width / ratio);
  double slim = width / SLIMMEST, most = slim * search->rolled_up;
  most = fmin(most, fg__territory_longest(search->interior->territory));
  double weight = pow(width / search->interior->spacing, FG__WIDTH_EXPONENT);
  if (fmin(most, total) * weight <= search->score)
    return;
  search->width = width;
  search->weight = weight;
  fg__arc_samples_bend(search->samples, width);
  find_shares(search);
  find_earliest(search);
  int gap = (int)ceil(end_gap / search->samples->step), last = count - 1 - gap;
  for (int tip = last; tip > gap + 1; tip--) {
    double length = sample[tip].s - sample[gap].s;
    if (fmin(length, most) * weight <= search->score)
      break;
    double aside = fabs(sample[gap].s + sample[tip].s - total) / total;
    if (length < most && length * weight * (1 - ASIDE_COST * aside) <= search->score)
      continue;
    int base = tip;
    if (!head_fits(search, gap, tip, &base))
      continue;
    int earliest = sample[tip].earliest > gap ? sample[tip].earliest : gap;
    int tail = find_tail(search, earliest < base ? earliest : base, base);
    try_tails(search, tail, base, tip, least, slim);
  }
}

fg_status fg__arrow_fit(fg__arrow *out, fg_context *context,
                        const fg__streamline *streamline, const fg__interior *interior,
                        fg__arc_samples *samples)
{
  if (interior->window->dimension == 3)
    return fg__arrow_fit_solid(out, context, streamline, interior, samples);
  *out = (fg__arrow){0};
  double length = fg__streamline_length(streamline);
  if (length < SHORTEST * interior->spacing)
    return FG_STATUS_OK;
  length = fmin(length, fg__territory_longest(interior->territory));
  double widest = fg__arrow_widest(length, interior);
  fg_status status = fg__arc_samples_place_flat(samples, context, streamline, interior,
                                                widest * FG__HEAD_WIDTH / 2 / HEAD_SHARE);
  if (status != FG_STATUS_OK)
    return status;
  arrow_search search = {.samples = samples,
                         .interior = interior,
                         .narrowest =
                             NARROWEST_HEAD * interior->spacing / FG__HEAD_WIDTH};
  double clearance_found = 0, lowest = 0, highest = 0;
  for (int i = 0; i < samples->count; i++) {
    const fg__arc_sample *sample = &samples->sample[i];
    clearance_found = fmax(clearance_found, sample->clearance);
    lowest = fmin(lowest, sample->turning);
    highest = fmax(highest, sample->turning);
  }
  search.rolled_up = rolled_up(fmin(highest - lowest, FG__LARGEST_TURNING));
  widest = fmin(widest,
                clearance_found * HEAD_SHARE / (CLEARANCE_ENOUGH * FG__HEAD_WIDTH / 2));
  for (double width = widest; width > search.narrowest * (1 + 1e-9); width *= WIDTH_STEP)
    try_width(&search, width, interior->margin);
  if (widest >= search.narrowest)
    try_width(&search, search.narrowest, interior->margin);
  *out = search.best;
  return FG_STATUS_OK;
}

/* Number of straight pieces for a part of one segment of the streamline. */
static int count_pieces(const fg__streamline_node *from, const fg__streamline_node *to,
                        double length, double spacing)
{
  double turn = fabs(to->turning - from->turning) * length / (to->s - from->s);
  double pieces = fmax(turn / POINT_TURN, length / (POINT_SPACING * spacing));
  return (int)fmax(ceil(pieces - 1e-9), 1);
}

fg_status fg__arrow_centerline(double (**points)[3], int *count, fg_context *context,
                               const fg__streamline *streamline, const fg__arrow *arrow,
                               double spacing)
{
  if (streamline->dimension == 3)
    return fg__arrow_centerline_solid(points, count, context, streamline, arrow, spacing);
  const fg__streamline_node *node = streamline->node;
  size_t capacity = 0, used = 0;
  double(*point)[3] = NULL;
  int hint = 0;
  /* pieces much shorter than a point's spacing come from steps cut at the ends */
  double least = 1e-3 * spacing;
  for (int i = 0; i + 1 < streamline->count; i++) {
    double from = fmax(node[i].s, arrow->tail), to = fmin(node[i + 1].s, arrow->tip);
    if (to - from < least)
      continue;
    int pieces = count_pieces(&node[i], &node[i + 1], to - from, spacing);
    if (!fg__grow((void **)&point, &capacity, used + (size_t)pieces + 1, sizeof *point)) {
      free(point);
      return fg__fail_memory(context, "an arrow's centreline",
                             (used + (size_t)pieces + 1) * sizeof *point);
    }
    for (int k = 0; k < pieces; k++, used++)
      fg__streamline_at(streamline, from + (to - from) * k / pieces, &hint, point[used],
                        NULL);
  }
  if (!point) {
    *points = NULL;
    *count = 0;
    return FG_STATUS_OK;
  }
  fg__streamline_at(streamline, arrow->tip, &hint, point[used], NULL);
  used++;
  *points = point;
  *count = (int)used;
  return FG_STATUS_OK;
}
