#include "picture/render/light.h"

#include <math.h>

#include "base/vector.h"

/* Shares of the light, chosen by eye so that a lit face has the colour of the key. */
static const double lamp_share = 0.62, sky_share = 0.42, viewer_share = 0.14;
static const double shine = 0.20;

/* What is far fades by this share towards this level, as eyes see them (sRGB): depth is
 * seen in colour, too. Of linear light, a tenth of white outshines a dark colour. */
static const double fade = 0.42, far_level = 0.95;

/* The tone of a wall (the floor is the darkest, so that its shadows have a ground), of
 * the box's edges, and what a shadow takes away. */
static const double wall_tone[3] = {0.955, 0.955, 0.915};
static const double edge_tone = 0.66, shadow_depth = 0.18;

/* Of the clusters' surfaces: what they hide where they face the viewer, and at the rim.
 */
static const double isosurface_alpha = 0.10, isosurface_rim = 0.62;
static const double isosurface_color[3] = {0.62, 0.74, 0.88};

/* Likewise of the domain's or the moving volume's outline; at the rim only what is seen
 * from very near its side counts. */
static const double outline_alpha = 0.075, outline_rim = 0.75, outline_power = 2.4;
static const double cut_alpha = 0.5;
static const double outline_color[3] = {0.42, 0.49, 0.60};

static const double full_turn = 6.283185307179586;

/* 1 over the golden section, and over it and its square the root p of p^3 = p + 1. */
static const double golden = 0.6180339887498949;
static const double plastic[2] = {0.7548776662466927, 0.5698402909980532};

void fg__lamp_direction(const fg__camera *camera, double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = -0.42 * camera->right[k] - 0.42 * camera->forward[k] + 0.25 * camera->up[k];
  out[2] += 1.05; /* up in the world: shadows fall on the floor */
  fg__normalise(out);
}

void fg__overhead_place(int number, int count, double slope[2], double place[2])
{
  double radius = fg__overhead_size * sqrt((number + 0.5) / count);
  slope[0] = radius * cos(full_turn * golden * number);
  slope[1] = radius * sin(full_turn * golden * number);
  for (int k = 0; k < 2; ++k)
    place[k] = fmod(0.5 + plastic[k] * number, 1.0);
}

/* sRGB to linear light and back (IEC 61966-2-1). */
static double linear_of(double level)
{
  return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

static double encoded_of(double light)
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

void fg__tones_make(fg__tones *out)
{
  for (int n = 0; n <= FG__TONES; ++n) {
    out->linear[n] = (float)linear_of((double)n / FG__TONES);
    out->encoded[n] = (float)encoded_of((double)n / FG__TONES);
    out->rim[n] = (float)pow((double)n / FG__TONES, outline_power);
  }
}

/* A table's value at a place from 0 to 1. */
static double look_up(const float table[FG__TONES + 1], double at)
{
  double place = at > 0.0 ? (at < 1.0 ? at * FG__TONES : FG__TONES) : 0.0;
  int n = place < FG__TONES ? (int)place : FG__TONES - 1;
  return (double)table[n] + (place - n) * ((double)table[n + 1] - (double)table[n]);
}

/* Fades a level of linear light with the distance. */
static double faded(const fg__tones *tones, double light, double depth)
{
  double far = fade * depth;
  return look_up(tones->linear,
                 (1.0 - far) * look_up(tones->encoded, light) + far * far_level);
}

/* The highlight: the cosine to the power of 30. */
static double glint_of(double cosine)
{
  double two = cosine * cosine, four = two * two, eight = four * four;
  return shine * eight * eight * eight * four * two;
}

fg__light fg__light_arrow(const fg__tones *tones, fg__color color, const fg__lit *lit)
{
  double facing = fmax(fg__dot(lit->normal, lit->lamp), 0.0);
  double light = lamp_share * facing + sky_share * (0.7 + 0.3 * lit->normal[2]) +
                 viewer_share * fmax(fg__dot(lit->normal, lit->to_viewer), 0.0);
  double half[3];
  fg__add_scaled(lit->lamp, 1, lit->to_viewer, half);
  fg__normalise(half);
  double glint = glint_of(fmax(fg__dot(lit->normal, half), 0.0)), level[3];
  const double given[3] = {color.red, color.green, color.blue};
  for (int k = 0; k < 3; ++k)
    level[k] = faded(tones, look_up(tones->linear, given[k]) * light + glint, lit->depth);
  return (fg__light){level[0], level[1], level[2], 1.0};
}

fg__light fg__light_wall(int axis, double lit)
{
  double tone = wall_tone[axis] * (1.0 - shadow_depth * (1.0 - lit));
  return (fg__light){tone, tone, tone, 1.0};
}

fg__light fg__light_edge(const fg__tones *tones, double depth)
{
  double tone = faded(tones, edge_tone, depth);
  return (fg__light){tone, tone, tone, 1.0};
}

fg__light fg__light_isosurface(const fg__lit *lit)
{
  double facing = fabs(fg__dot(lit->normal, lit->to_viewer)), side = 1.0 - facing;
  double alpha =
      isosurface_alpha + (isosurface_rim - isosurface_alpha) * side * side * side;
  double light = 0.72 + 0.28 * fg__dot(lit->normal, lit->lamp);
  return (fg__light){alpha * isosurface_color[0] * light,
                     alpha * isosurface_color[1] * light,
                     alpha * isosurface_color[2] * light, alpha};
}

fg__light fg__light_silhouette(const fg__tones *tones, const fg__lit *lit, bool cut)
{
  double side = 1.0 - fmin(fabs(fg__dot(lit->normal, lit->to_viewer)), 1.0);
  double alpha =
      outline_alpha + (outline_rim - outline_alpha) * look_up(tones->rim, side);
  alpha = fmax(alpha, cut ? cut_alpha : 0.0) * (1.0 - fade * lit->depth);
  return (fg__light){alpha * outline_color[0], alpha * outline_color[1],
                     alpha * outline_color[2], alpha};
}

/* A level from 0 to 1 as a byte. */
static uint32_t byte_of(double level)
{
  return (uint32_t)(255.0 * level + 0.5);
}

uint32_t fg__light_pixel(const fg__tones *tones, fg__light light, bool transparent)
{
  double alpha = fmin(fmax(light.alpha, 0.0), 1.0), rest = 1.0 - alpha;
  const double channel[3] = {light.red, light.green, light.blue};
  uint32_t out = byte_of(transparent ? alpha : 1.0);
  for (int k = 0; k < 3; ++k) {
    double level = 0.0;
    if (!transparent)
      level = look_up(tones->encoded, channel[k] + rest);
    else if (alpha > 0.0)
      level = alpha * look_up(tones->encoded, channel[k] / alpha);
    out = out << 8 | byte_of(level);
  }
  return out;
}
