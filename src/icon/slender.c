#include "icon/slender.h"

#include "base/vector.h"

/* The head's length: of lambda, and at most of the arrow's length. */
static const double head_of_share = 0.2, head_of_length = 0.42;

/* Widths of the head in its lengths, of the body in the head's and of the tail in the
 * body's: under three body widths a cone looks like an arrow's, not a mushroom's. */
static const double head_aspect = 0.76, body_of_head = 0.36, tail_of_body = 0.35;

/* Over its own width a body turns by no more, radians: where its radius is 0.7 of the
 * curve's; beyond 1 sections of a round bend would cross. An elbow, which is short, may
 * be as sharp: its sections cross within the body. */
static const double largest_turn = 1.4;

/* Widths that are tried, each in the one before. If the last is too wide, the line has a
 * corner, where no width helps. */
static const double thinner = 0.95, thinnest = 0.4;

/* The line under a head turns by no more, radians: a cone bent further is a claw. A head
 * is not made smaller than this share of itself for that. */
static const double head_turning = 0.6, least_head = 0.5;

/* What is thicker than this many slender arrows is made thinner. */
static const double plump = 1.5;

static double piece_of(const fg_icon *icon, int n, double along[3])
{
  fg__subtract(icon->points[n + 1], icon->points[n], along);
  double length = fg__length(along);
  fg__normalise(along);
  return length;
}

/* Between two pieces of the line. */
static double turn_between(const fg_icon *icon, int one, int other)
{
  double before[3], after[3];
  piece_of(icon, one, before);
  piece_of(icon, other, after);
  return 2 * asin(fmin(fg__distance(before, after) / 2, 1));
}

/* Whether a body of that width turns too much somewhere. */
static bool is_too_wide(const fg_icon *icon, double width)
{
  double ignored[3];
  for (int n = 0; n + 1 < icon->point_count; ++n) {
    double passed = 0;
    for (int m = n + 1; m + 1 < icon->point_count && passed < width; ++m) {
      if (turn_between(icon, n, m) > largest_turn)
        return true;
      passed += piece_of(icon, m, ignored);
    }
  }
  return false;
}

/* How far from the tip the line has turned by the angle that a head may span. */
static double straight_end(const fg_icon *icon)
{
  double last[3], here[3], passed = 0;
  piece_of(icon, icon->point_count - 2, last);
  for (int n = icon->point_count - 2; n >= 0; --n) {
    double length = piece_of(icon, n, here);
    if (2 * asin(fmin(fg__distance(last, here) / 2, 1)) > head_turning)
      return passed;
    passed += length;
  }
  return HUGE_VAL;
}

void fg__solid_set_slender(fg_icon *icon, double lambda)
{
  double length = 0, ignored[3];
  for (int n = 0; n + 1 < icon->point_count; ++n)
    length += piece_of(icon, n, ignored);
  double head = 0;
  if (length > 0 && lambda > 0) {
    double full = fmin(head_of_share * lambda, head_of_length * length);
    head = fmax(fmin(full, straight_end(icon)), least_head * full);
    double width = body_of_head * head_aspect * head;
    double factor = 1;
    while (factor > thinnest && is_too_wide(icon, factor * width))
      factor *= thinner;
    head *= factor > thinnest ? factor : 1;
  }
  icon->head_length = head;
  icon->head_width = head_aspect * head;
  icon->width = body_of_head * icon->head_width;
  icon->tail_width = tail_of_body * icon->width;
}

void fg__solid_slim(fg_icon *icon, double lambda)
{
  if (!(icon->width > 0))
    return;
  fg_icon slender = *icon;
  fg__solid_set_slender(&slender, lambda);
  double factor = fmin(1, plump * slender.width / icon->width);
  icon->width *= factor;
  icon->tail_width *= factor;
  icon->head_length *= factor;
  icon->head_width *= factor;
}
