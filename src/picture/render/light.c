#include "picture/render/light.h"

#include <math.h>

#include "base/mix.h"
#include "base/vector.h"

/* Shares of the light, chosen by eye so that a lit face has the colour of the key. */
static const double lamp_share = 0.62, sky_share = 0.42, viewer_share = 0.14;
static const double shine = 0.20, shine_power = 30.0;

/* What is far fades by this share towards this level, as eyes see them (sRGB): depth is
 * seen in colour, too. Of linear light, a tenth of white outshines a dark colour. */
static const double fade = 0.42, far_level = 0.95;

/* The tone of a wall (the floor is the darkest, so that its shadows have a ground), of
 * the box's edges, and what a shadow takes away. */
static const double wall_tone[3] = {0.955, 0.955, 0.915};
static const double edge_tone = 0.66, shadow_depth = 0.27;

/* Of the clusters' surfaces: what they hide where they face the viewer, and at the rim.
 */
static const double skin_alpha = 0.10, skin_rim = 0.62;
static const double skin_color[3] = {0.62, 0.74, 0.88};

/* Likewise of the domain's or the moving volume's outline; at the rim only what is seen
 * from very near its side counts. */
static const double outline_alpha = 0.075, outline_rim = 0.75, outline_power = 2.4;
static const double cut_alpha = 0.5;
static const double outline_color[3] = {0.42, 0.49, 0.60};

/* The overhead disc's radius over its distance. */
static const double overhead_size = 0.013;

static const double full_turn = 6.283185307179586;

/* 1 / p and 1 / p^2 of the real root p of p^3 = p + 1, times 2^64. */
static const uint64_t plastic[2] = {13925035116211876495U, 10511698010929265437U};

/* The curve's square has so many pixels a side: no picture is larger. */
enum { CURVE_SIDE = 1 << 13 };

uint64_t fg__light_order(int x, int y)
{
  uint64_t order = 0;
  for (int side = CURVE_SIDE / 2; side > 0; side /= 2) {
    int right = (x & side) != 0, upper = (y & side) != 0;
    order = 4 * order + (uint64_t)((3 * right) ^ upper);
    if (upper)
      continue;
    if (right) { /* the quarter runs the other way, and is turned */
      x = ~x;
      y = ~y;
    }
    int swap = x;
    x = y;
    y = swap;
  }
  return order;
}

void fg__light_numbers(uint64_t index, int kind, double out[2])
{
  uint64_t shift = fg__mix((uint64_t)(unsigned)kind);
  for (int k = 0; k < 2; ++k) /* whole numbers wrap round */
    out[k] = (double)((index * plastic[k] + (shift << 32 * k)) >> 11) * 0x1p-53;
}

void fg__lamp_direction(const fg__camera *camera, double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = -0.42 * camera->right[k] - 0.42 * camera->forward[k] + 0.25 * camera->up[k];
  out[2] += 1.05; /* up in the world: shadows fall on the floor */
  fg__normalise(out);
}

void fg__overhead_sample(const double number[2], double out[3])
{
  double radius = overhead_size * sqrt(number[0]), angle = full_turn * number[1];
  out[0] = radius * cos(angle);
  out[1] = radius * sin(angle);
  out[2] = 1.0;
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

/* Fades a level of linear light with the distance. */
static double faded(double light, double depth)
{
  double far = fade * depth;
  return linear((1.0 - far) * encoded(light) + far * far_level);
}

fg__light fg__light_arrow(fg__color color, const fg__lit *lit)
{
  double facing = fmax(fg__dot(lit->normal, lit->lamp), 0.0);
  double light = lamp_share * facing + sky_share * (0.7 + 0.3 * lit->normal[2]) +
                 viewer_share * fmax(fg__dot(lit->normal, lit->to_viewer), 0.0);
  double half[3];
  fg__along(lit->lamp, 1, lit->to_viewer, half);
  fg__normalise(half);
  double glint = shine * pow(fmax(fg__dot(lit->normal, half), 0.0), shine_power);
  return (fg__light){faded(linear(color.red) * light + glint, lit->depth),
                     faded(linear(color.green) * light + glint, lit->depth),
                     faded(linear(color.blue) * light + glint, lit->depth), 1.0};
}

fg__light fg__light_wall(int axis, double lit)
{
  double tone = wall_tone[axis] * (1.0 - shadow_depth * (1.0 - lit));
  return (fg__light){tone, tone, tone, 1.0};
}

fg__light fg__light_edge(double depth)
{
  double tone = faded(edge_tone, depth);
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

fg__light fg__light_silhouette(const fg__lit *lit, bool cut)
{
  double side = 1.0 - fmin(fabs(fg__dot(lit->normal, lit->to_viewer)), 1.0);
  double alpha = outline_alpha + (outline_rim - outline_alpha) * pow(side, outline_power);
  alpha = fmax(alpha, cut ? cut_alpha : 0.0) * (1.0 - fade * lit->depth);
  return (fg__light){alpha * outline_color[0], alpha * outline_color[1],
                     alpha * outline_color[2], alpha};
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
