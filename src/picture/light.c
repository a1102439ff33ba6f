#include "picture/light.h"

#include <math.h>

#include "base/mix.h"
#include "solid/vector.h"

/* Shares of the light, chosen by eye so that a lit face has the colour of the key. */
static const double lamp_share = 0.66, sky_share = 0.46, viewer_share = 0.12;
static const double shine = 0.22, shine_power = 36.0;

/* What is far fades by this share towards this level, as eyes see them (sRGB): depth is
 * seen in colour, too. Of linear light, a tenth of white outshines a dark colour. */
static const double fade = 0.22, far_level = 0.92;

/* On the walls: what a shadow and a hidden sky take away; the tone of a wall (floor and
 * ceiling are the lightest), and of its lines. */
static const double shadow_depth = 0.45, corner_depth = 0.5;
static const double wall_tone[3] = {0.80, 0.86, 0.93};
static const double line_tone = 0.55;

/* Of the clusters' surfaces: what they hide where they face the viewer, and at the rim.
 */
static const double skin_alpha = 0.10, skin_rim = 0.62;
static const double skin_color[3] = {0.62, 0.74, 0.88};

/* The lamp's radius over its distance. */
static const double lamp_size = 0.05;

static const double full_turn = 6.283185307179586;

/* 1 / p and 1 / p^2 of the real root p of p^3 = p + 1. */
static const double plastic[2] = {0.7548776662466927, 0.5698402909980532};

static double fraction(double x)
{
  return x - floor(x);
}

void fg__light_numbers(int x, int y, int index, int kind, double out[2])
{
  uint64_t pixel = (uint64_t)(uint32_t)x << 32 | (uint32_t)y;
  uint64_t hash = fg__mix(fg__mix(pixel) ^ (uint64_t)(unsigned)kind);
  for (int k = 0; k < 2; ++k) {
    double shift = (double)(uint32_t)(hash >> 32 * k) / 4294967296.0;
    out[k] = fraction(shift + plastic[k] * index);
  }
}

void fg__lamp_direction(const fg__camera *camera, double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = -0.42 * camera->right[k] - 0.42 * camera->forward[k] + 0.25 * camera->up[k];
  out[2] += 1.05; /* up in the world: shadows fall on the floor */
  fg__normalise(out);
}

/* A point of the unit disc. */
static void disc(const double number[2], double out[2])
{
  double radius = sqrt(number[0]), angle = full_turn * number[1];
  out[0] = radius * cos(angle);
  out[1] = radius * sin(angle);
}

static void bases(const double axis[3], double one[3], double other[3])
{
  fg__any_normal(axis, one);
  fg__cross(axis, one, other);
}

void fg__lamp_sample(const double lamp[3], const double number[2], double out[3])
{
  double one[3], other[3], at[2];
  bases(lamp, one, other);
  disc(number, at);
  fg__along(lamp, lamp_size * at[0], one, out);
  fg__along(out, lamp_size * at[1], other, out);
  fg__normalise(out);
}

void fg__sky_sample(const double normal[3], const double number[2], double out[3])
{
  double one[3], other[3], at[2];
  bases(normal, one, other);
  disc(number, at);
  double height = sqrt(fmax(1.0 - number[0], 0.0));
  for (int k = 0; k < 3; ++k)
    out[k] = height * normal[k] + at[0] * one[k] + at[1] * other[k];
}

/* sRGB to linear light and back (IEC 61966-2-1). */
static double linear(double level)
{
  return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

static double encoded(double light)
{
  if (!(light > 0.0))
    return 0.0;
  if (light >= 1.0)
    return 1.0;
  return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

fg__light fg__light_arrow(fg__color color, const fg__lit *lit)
{
  double facing = fmax(fg__dot(lit->normal, lit->lamp), 0.0) * lit->lamp_seen;
  double sky = lit->sky_seen * (0.7 + 0.3 * lit->normal[2]);
  double light = lamp_share * facing + sky_share * sky +
                 viewer_share * fmax(fg__dot(lit->normal, lit->to_viewer), 0.0);
  double half[3];
  fg__along(lit->lamp, 1, lit->to_viewer, half);
  fg__normalise(half);
  double glint =
      shine * lit->lamp_seen * pow(fmax(fg__dot(lit->normal, half), 0.0), shine_power);
  const double level[3] = {linear(color.red), linear(color.green), linear(color.blue)};
  double out[3], far = fade * lit->depth;
  for (int k = 0; k < 3; ++k)
    out[k] = linear((1.0 - far) * encoded(level[k] * light + glint) + far * far_level);
  return (fg__light){out[0], out[1], out[2], 1.0};
}

fg__light fg__light_wall(int axis, double line, const fg__lit *lit)
{
  double tone = wall_tone[axis] * (1.0 - line * (1.0 - line_tone));
  tone *= 1.0 - shadow_depth * (1.0 - lit->lamp_seen);
  tone *= 1.0 - corner_depth * (1.0 - lit->sky_seen);
  return (fg__light){tone, tone, tone, 1.0};
}

fg__light fg__light_skin(const fg__lit *lit)
{
  double facing = fabs(fg__dot(lit->normal, lit->to_viewer)), side = 1.0 - facing;
  double alpha = skin_alpha + (skin_rim - skin_alpha) * side * side * side;
  double light = 0.72 + 0.28 * fg__dot(lit->normal, lit->lamp);
  return (fg__light){alpha * skin_color[0] * light, alpha * skin_color[1] * light,
                     alpha * skin_color[2] * light, alpha};
}

uint32_t fg__light_pixel(fg__light light, bool transparent)
{
  double alpha = fmin(fmax(light.alpha, 0.0), 1.0), rest = 1.0 - alpha;
  double channel[3] = {light.red, light.green, light.blue};
  uint32_t out = 0;
  for (int k = 0; k < 3; ++k) {
    double level = transparent ? (alpha > 0.0 ? alpha * encoded(channel[k] / alpha) : 0.0)
                               : encoded(channel[k] + rest);
    out = out << 8 | (uint32_t)lround(255.0 * level);
  }
  return out | (uint32_t)lround(255.0 * (transparent ? alpha : 1.0)) << 24;
}
