#include "drawn/background.h"

static fg_texture_kind kind_of(const picture_settings *settings)
{
  return (fg_texture_kind)(settings->background - 1); /* 0: none */
}

bool background_needs_density(const picture_settings *settings)
{
  return settings->background && kind_of(settings) == FG_TEXTURE_CLUSTERS;
}

int background_check(const picture_settings *settings, int ranks)
{
  if (!settings->background)
    return EXIT_DONE;
  if (kind_of(settings) == FG_TEXTURE_STRIPES && ranks > 1) {
    complain("--background stripes: not with %d processes", ranks);
    advise("Draw it afterwards: `flowgrain draw DIR -o PICTURE --background stripes`.");
    return EXIT_USAGE;
  }
  return EXIT_DONE;
}

fg_status background_make(fg_texture **texture, fg_context *context,
                          const picture_settings *settings, int threads,
                          const int size[2], const fg_field *field,
                          const fg_density *density)
{
  const fg_texture_options wanted = {.kind = kind_of(settings),
                                     .size = {size[0], size[1]},
                                     .density = density,
                                     .threads = threads};
  if (!settings->background)
    return FG_STATUS_OK;
  const fg_texture_arrays *last = fg_texture_contents(*texture);
  const bool fits = last && wanted.kind != FG_TEXTURE_CLUSTERS &&
                    last->size[0] == size[0] && last->size[1] == size[1];
  if (fits)
    return FG_STATUS_OK;
  fg_texture_destroy(*texture);
  *texture = NULL;
  return fg_texture_create(texture, context, field, &wanted);
}

fg_status background_choose(fg_picture_options *options, fg_texture **texture,
                            fg_context *context, const picture_settings *settings,
                            int threads, const fg_field *field, const fg_density *density,
                            const fg_icons *icons)
{
  int size[2];
  if (!settings->background)
    return FG_STATUS_OK;
  fg_status status = fg_picture_frame(size, context, field, icons, options);
  if (!status)
    status = background_make(texture, context, settings, threads, size, field, density);
  options->background = *texture;
  background_range(options, settings);
  return status;
}

void background_range(fg_picture_options *options, const picture_settings *settings)
{
  if (!settings->background || kind_of(settings) != FG_TEXTURE_SPEED)
    return;
  options->speed_min = settings->speed_range[0];
  options->speed_max = settings->speed_range[1];
}
