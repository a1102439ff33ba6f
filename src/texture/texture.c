#include "texture/texture.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/threads.h"
#include "texture/contrast.h"

enum { LEAST_LONGEST = 16, MOST_PIXELS = 16384, DEFAULT_LONGEST = 1024 };

static const double least_length = 2.0, most_length = 400.0;

/* Shorter streaks hardly show their direction. */
static const double least_default_length = 20.0;

/* Contrast is evened over windows of this radius: wide enough to hold many streaks. */
static const double window_radius = 0.6;
enum { LEAST_WINDOW = 12 };

struct fg_texture {
  fg_texture_arrays contents;
  float *value, *speed;
};

typedef struct texture_kind {
  fg__texture_paint *paint;
  int (*margin)(double length);
  /* of streaks, as a share of the picture's longest side: as long as they may be and
     still turn with the field (by eye); single spots fade out towards their ends */
  double length;
  double cut; /* of its contrast (contrast.h); 0: its values are to be left alone */
} texture_kind;

static fg_status leave_plain(float *value, fg_context *context, const fg__canvas *canvas)
{
  const size_t count = (size_t)canvas->raster.size[0] * (size_t)canvas->raster.size[1];
  for (size_t n = 0; n < count; ++n)
    value[n] = 1.0F;
  return fg__check_stop(context);
}

static const texture_kind kinds[] = {
    [FG_TEXTURE_LIC] = {fg__lic_paint, fg__lic_margin, 1.0 / 25.0, 2.0},
    [FG_TEXTURE_SPOTS] = {fg__spots_paint, fg__spots_margin, 1.0 / 18.0, 2.0},
    [FG_TEXTURE_CLUSTERS] = {fg__clusters_paint, fg__no_margin, 1.0 / 25.0, 0.0},
    [FG_TEXTURE_STRIPES] = {fg__stripes_paint, fg__no_margin, 1.0 / 25.0, 0.8},
    [FG_TEXTURE_DIFFUSION] = {fg__diffusion_paint, fg__diffusion_margin, 1.0 / 20.0, 1.5},
    [FG_TEXTURE_SPEED] = {leave_plain, fg__no_margin, 1.0 / 25.0, 0.0},
};

static fg_status check_options(fg_context *context, const fg_texture_options *o)
{
  const int last = (int)(sizeof kinds / sizeof *kinds) - 1;
  if ((int)o->kind < 0 || (int)o->kind > last)
    return fg__fail(context, FG_STATUS_ARGUMENT, "texture: unknown kind %d",
                    (int)o->kind);
  if (o->longest && (o->longest < LEAST_LONGEST || o->longest > MOST_PIXELS))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: %d pixels along the longest side, %d to %d are possible",
                    o->longest, LEAST_LONGEST, MOST_PIXELS);
  if (o->length != 0.0 && !(o->length >= least_length && o->length <= most_length))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: streaks of %g pixels, %g to %g are possible", o->length,
                    least_length, most_length);
  if (o->clusters < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: %d clusters; at least 1, or 0 for the default, is needed",
                    o->clusters);
  if (!(o->max_time >= 0.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: clusters until t = %g; 0 (no limit) or more is needed",
                    o->max_time);
  if (o->threads < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: threads: %d; at least 1, or 0 for all cores, is needed",
                    o->threads);
  return FG_STATUS_OK;
}

static double side_of(const fg_field_arrays *field, int k)
{
  return field->period[k] > 0.0 ? field->period[k]
                                : field->axis[k][field->size[k] - 1] - field->axis[k][0];
}

static fg_status choose_size(int size[2], fg_context *context,
                             const fg_field_arrays *field, const fg_texture_options *o)
{
  const double side[2] = {side_of(field, 0), side_of(field, 1)};
  const int longest = o->longest ? o->longest : DEFAULT_LONGEST;
  double wanted[2];
  for (int k = 0; k < 2; ++k) {
    const int other = o->size[1 - k];
    const double from = other ? other : longest;
    const double unit = other ? side[1 - k] : fmax(side[0], side[1]);
    wanted[k] = o->size[k] ? o->size[k] : fmax(floor(from * (side[k] / unit) + 0.5), 1.0);
  }
  for (int k = 0; k < 2; ++k)
    if (!(wanted[k] >= 1.0 && wanted[k] <= MOST_PIXELS))
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "texture: %g x %g pixels, 1 to %d are possible", wanted[0],
                      wanted[1], MOST_PIXELS);
  for (int k = 0; k < 2; ++k)
    size[k] = (int)wanted[k];
  return FG_STATUS_OK;
}

static double choose_length(const int size[2], const fg_texture_options *o)
{
  if (o->length > 0.0)
    return o->length;
  const double longest = fmax(size[0], size[1]);
  return fmin(fmax(kinds[o->kind].length * longest, least_default_length), most_length);
}

static int choose_threads(const fg_texture_options *o)
{
  return o->threads ? o->threads : fg__threads_available();
}

static fg_status paint(fg_texture *texture, fg_context *context, const fg__canvas *canvas)
{
  const size_t count = (size_t)canvas->raster.size[0] * (size_t)canvas->raster.size[1];
  texture->value = fg__allocate(count, sizeof *texture->value);
  if (!texture->value)
    return fg__fail_memory(context, "a texture", count * sizeof *texture->value);
  fg_status status = kinds[texture->contents.kind].paint(texture->value, context, canvas);
  if (!status)
    status = fg__check_stop(context);
  const double radius = fmax(window_radius * canvas->length, LEAST_WINDOW);
  const double cut = kinds[texture->contents.kind].cut;
  if (!status && cut > 0.0)
    status = fg__contrast_even(texture->value, context, &canvas->raster, (int)radius, cut,
                               canvas->threads);
  return status;
}

static fg_status make(fg_texture *texture, fg_context *context, const fg_field *field,
                      const fg_texture_options *o)
{
  fg__canvas canvas = {.field = field,
                       .seed = o->seed ? o->seed : 1,
                       .clusters = o->clusters,
                       .max_time = o->max_time,
                       .evolution = o->evolution,
                       .density = o->density};
  int size[2];
  fg_status status = choose_size(size, context, fg_field_contents(field), o);
  if (status)
    return status;
  canvas.length = choose_length(size, o);
  const int margin = kinds[o->kind].margin(canvas.length);
  status = fg__threads_create(&canvas.threads, context, choose_threads(o));
  if (!status)
    status =
        fg__raster_create(&canvas.raster, context, field, size, margin, canvas.threads);
  if (!status)
    status = paint(texture, context, &canvas);
  fg__threads_destroy(canvas.threads);
  texture->speed = canvas.raster.speed;
  canvas.raster.speed = NULL;
  fg__raster_clear(&canvas.raster);
  texture->contents.size[0] = size[0];
  texture->contents.size[1] = size[1];
  texture->contents.value = texture->value;
  texture->contents.speed = texture->speed;
  return status;
}

fg_status fg_texture_create(fg_texture **out, fg_context *context, const fg_field *field,
                            const fg_texture_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "texture: a NULL argument");
  *out = NULL;
  fg_texture_options settled = {0};
  if (options)
    settled = *options;
  fg_status status = check_options(context, &settled);
  if (status)
    return status;
  const int dimension = fg_field_contents(field)->dimension;
  if (dimension != 2)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "a field in %d dimensions; textures are made of those in 2",
                    dimension);
  if (fg_field_is_slab(field, NULL, NULL))
    return fg__fail(
        context, FG_STATUS_ARGUMENT,
        "texture: of a part of a field that ranks share; the whole is needed");
  fg_texture *texture = fg__allocate(1, sizeof *texture);
  if (!texture)
    return fg__fail_memory(context, "a texture", sizeof *texture);
  texture->contents.kind = settled.kind;
  status = make(texture, context, field, &settled);
  if (status) {
    fg_texture_destroy(texture);
    return status;
  }
  *out = texture;
  return FG_STATUS_OK;
}

void fg_texture_destroy(fg_texture *texture)
{
  if (!texture)
    return;
  free(texture->value);
  free(texture->speed);
  free(texture);
}

const fg_texture_arrays *fg_texture_contents(const fg_texture *texture)
{
  return texture ? &texture->contents : NULL;
}
