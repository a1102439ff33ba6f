#include "picture/page/texture_image.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/palette.h"

/* Greys from nearly black to white; black itself would outshine what is drawn above. */
static const double darkest = 0.08;

/* What a colour becomes at a texture's darkest and lightest places: so much of itself,
 * and so much nearer to white. By eye: the colours stay what they are, the streaks stay
 * to be seen in slow (light) and fast (dark) places. */
static const double shade = 0.72, light = 0.82;

/* The fastest hundredth of the pixels share the last colour: a single fast place, near a
 * pole say, would leave the rest with one. */
static const double slower_share = 0.99;
enum { BINS = 4096 };

static double fastest(const fg_texture_arrays *texture, size_t count)
{
  double most = 0.0;
  for (size_t n = 0; n < count; ++n)
    if ((double)texture->speed[n] > most) /* false for NaN */
      most = (double)texture->speed[n];
  return most;
}

fg_status fg__texture_range(double range[2], fg_context *context,
                            const fg_texture_arrays *texture,
                            const fg_texture_style *style)
{
  range[0] = style->speed_min;
  range[1] = style->speed_max;
  if (range[1] > range[0])
    return FG_STATUS_OK;
  const size_t count = (size_t)texture->size[0] * (size_t)texture->size[1];
  const double most = fastest(texture, count);
  range[0] = 0.0;
  range[1] = most > 0.0 ? most : 1.0;
  size_t *bin = fg__allocate(BINS + 1, sizeof *bin);
  if (!bin)
    return fg__fail_memory(context, "the range of speeds", BINS * sizeof *bin);
  size_t known = 0;
  for (size_t n = 0; n < count; ++n) {
    const double speed = (double)texture->speed[n];
    if (isnan(speed))
      continue;
    ++bin[(int)(speed / range[1] * BINS)];
    ++known;
  }
  size_t slower = 0;
  int at = 0;
  while (at < BINS && (double)slower < slower_share * (double)known)
    slower += bin[at++];
  free(bin);
  range[1] *= (double)at / BINS;
  return FG_STATUS_OK;
}

void fg__texture_beyond(bool beyond[2], const fg_texture_arrays *texture,
                        const double range[2])
{
  const size_t count = (size_t)texture->size[0] * (size_t)texture->size[1];
  for (size_t n = 0; n < count; ++n) {
    beyond[0] = beyond[0] || (double)texture->speed[n] < range[0];
    beyond[1] = beyond[1] || (double)texture->speed[n] > range[1];
  }
}

typedef struct coloring {
  const fg_texture_arrays *texture;
  fg__palette palette;
  bool grey;
  double range[2];
  double fade;
} coloring;

static uint32_t byte_of(double share)
{
  return (uint32_t)(255.0 * share + 0.5);
}

static uint32_t pixel_of(fg__color color, double fade)
{
  const double part[3] = {color.red, color.green, color.blue};
  uint32_t pixel = 255;
  for (int k = 0; k < 3; ++k)
    pixel = pixel << 8 | byte_of(part[k] + fade * (1.0 - part[k]));
  return pixel;
}

static fg__color mix(fg__color from, fg__color to, double share)
{
  return (fg__color){from.red + share * (to.red - from.red),
                     from.green + share * (to.green - from.green),
                     from.blue + share * (to.blue - from.blue)};
}

/* The colour of a speed; between bands the edge is as smooth as one that is drawn. */
static fg__color color_of_speed(const coloring *c, size_t n)
{
  const int bands = c->palette.bands;
  const double width = c->range[1] - c->range[0], speed = (double)c->texture->speed[n],
               share = (speed - c->range[0]) / width;
  const size_t wide = (size_t)c->texture->size[0];
  if (!bands || n < wide || n % wide == 0)
    return fg__palette_color(&c->palette, share);
  const double steepest = hypot(speed - (double)c->texture->speed[n - 1],
                                speed - (double)c->texture->speed[n - wide]) *
                          bands / width,
               edge = floor(share * bands + 0.5),
               beyond = (share * bands - edge) / steepest; /* pixels; NaN, infinite */
  if (!(fabs(beyond) < 0.5))
    return fg__palette_color(&c->palette, share);
  return mix(fg__palette_color(&c->palette, (edge - 0.5) / bands),
             fg__palette_color(&c->palette, (edge + 0.5) / bands), 0.5 + beyond);
}

static fg__color color_of(const coloring *c, size_t n)
{
  static const fg__color white = {1.0, 1.0, 1.0};
  const double value = (double)c->texture->value[n];
  if (c->grey) {
    const double grey = darkest + (1.0 - darkest) * value;
    return (fg__color){grey, grey, grey};
  }
  const fg__color color = color_of_speed(c, n);
  if (c->texture->kind == FG_TEXTURE_SPEED)
    return color;
  const fg__color dark = {shade * color.red, shade * color.green, shade * color.blue};
  return mix(dark, mix(color, white, light), value);
}

static void paint(cairo_surface_t *surface, const coloring *c)
{
  const int *size = c->texture->size;
  unsigned char *bytes = cairo_image_surface_get_data(surface);
  const size_t stride = (size_t)cairo_image_surface_get_stride(surface);
  cairo_surface_flush(surface);
  for (int j = 0; j < size[1]; ++j) {
    /* cairo's rows are aligned for what it keeps in them */
    uint32_t *out = (uint32_t *)(void *)(bytes + (size_t)(size[1] - 1 - j) * stride);
    const size_t at = (size_t)j * (size_t)size[0];
    for (int i = 0; i < size[0]; ++i)
      out[i] = pixel_of(color_of(c, at + (size_t)i), c->fade);
  }
  cairo_surface_mark_dirty(surface);
}

/* Takes the colour of a neighbour that is nearer to what is known. */
static void take_nearer(uint32_t *pixel, int *distance, size_t at, size_t neighbour,
                        size_t pixel_at, size_t pixel_of_neighbour)
{
  if (distance[neighbour] + 1 >= distance[at])
    return;
  distance[at] = distance[neighbour] + 1;
  pixel[pixel_at] = pixel[pixel_of_neighbour];
}

/* Missing pixels take the colour of the nearest that is not (city-block distances in two
 * sweeps, Rosenfeld and Pfaltz 1966). What is missing is covered by outlines that are
 * smoother than its pixels. */
static fg_status spread(cairo_surface_t *surface, fg_context *context,
                        const fg_texture_arrays *texture)
{
  const size_t wide = (size_t)texture->size[0], high = (size_t)texture->size[1];
  const size_t count = wide * high;
  const int far = texture->size[0] + texture->size[1];
  const size_t stride = (size_t)cairo_image_surface_get_stride(surface) / 4;
  uint32_t *pixel = (uint32_t *)(void *)cairo_image_surface_get_data(surface);
  int *distance = fg__allocate(count, sizeof *distance);
  if (!distance)
    return fg__fail_memory(context, "a texture's image", count * sizeof *distance);
  for (size_t n = 0; n < count; ++n)
    distance[n] = isnan(texture->speed[n]) ? far : 0;
  /* rows from below in the texture, from above in the image */
  for (size_t n = 0; n < count; ++n) {
    const size_t i = n % wide, at = (high - 1 - n / wide) * stride + i;
    if (i > 0)
      take_nearer(pixel, distance, n, n - 1, at, at - 1);
    if (n >= wide)
      take_nearer(pixel, distance, n, n - wide, at, at + stride);
  }
  for (size_t n = count; n-- > 0;) {
    const size_t i = n % wide, at = (high - 1 - n / wide) * stride + i;
    if (i + 1 < wide)
      take_nearer(pixel, distance, n, n + 1, at, at + 1);
    if (n + wide < count)
      take_nearer(pixel, distance, n, n + wide, at, at - stride);
  }
  free(distance);
  return FG_STATUS_OK;
}

static fg_status make_image(cairo_surface_t **out, fg_context *context, const coloring *c)
{
  const int *size = c->texture->size;
  cairo_surface_t *surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, size[0], size[1]);
  if (cairo_surface_status(surface)) {
    cairo_surface_destroy(surface);
    return fg__fail_memory(context, "a texture's image",
                           (size_t)size[0] * (size_t)size[1] * 4);
  }
  paint(surface, c);
  const fg_status status = spread(surface, context, c->texture);
  cairo_surface_mark_dirty(surface);
  *out = surface;
  return status;
}

fg_status fg__texture_image(cairo_surface_t **out, fg_context *context,
                            const fg_texture_arrays *texture,
                            const fg_texture_style *style)
{
  coloring c = {.texture = texture, .grey = !style->palette, .fade = style->fade};
  fg_status status = fg__palette_create(&c.palette, context, style->palette);
  if (!status && !c.grey)
    status = fg__texture_range(c.range, context, texture, style);
  return status ? status : make_image(out, context, &c);
}

fg_status fg__texture_image_speeds(cairo_surface_t **out, fg_context *context,
                                   const fg_texture_arrays *texture,
                                   const fg__palette *palette, const double range[2])
{
  const coloring c = {
      .texture = texture, .palette = *palette, .range = {range[0], range[1]}};
  return make_image(out, context, &c);
}
