#include "icon/slender.h"

#include "base/vector.h"

/* The head's length: of lambda, and at most of the arrow's length. */
static const double head_of_share = 0.2, head_of_length = 0.42;

/* Widths of the head in its lengths, of the body in the head's and of the tail in the
 * body's: under three body widths a cone looks like an arrow's, not a mushroom's. */
static const double head_aspect = 0.76, body_of_head = 0.36, tail_of_body = 0.35;

/* The body's radius in radii of curvature: beyond 1 its sections would cross. */
static const double largest_bend = 0.7;

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

/* Of the circle through a point and its neighbours, by the turning over the pieces'
 * mean length. */
static double least_radius(const fg_icon *icon)
{
  double before[3], after[3], least = HUGE_VAL;
  double length = piece_of(icon, 0, before);
  for (int n = 1; n + 1 < icon->point_count; ++n) {
    double next = piece_of(icon, n, after);
    double turning = 2 * asin(fmin(fg__distance(before, after) / 2, 1));
    if (turning > 0)
      least = fmin(least, (length + next) / (2 * turning));
    length = next;
    for (int k = 0; k < 3; ++k)
      before[k] = after[k];
  }
  return least;
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
    head *= fmin(1, 2 * largest_bend * least_radius(icon) / width);
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
