/* Makes a texture image of a field. */
#include "command/command.h"
#include "folder/file.h"
#include "folder/made.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/settings.h"
#include "option/validation.h"
#include "series/places.h"

static int write_texture(fg_context *context, const texture_settings *settings,
                         const fg_field *field, const fg_texture *texture)
{
  const fg_texture_style style = settings_texture_style(settings, texture);
  fg_status status = fg_texture_write(context, settings->output, field, texture, &style);
  return status ? complain_of(context, status, settings->output)
                : made_record(settings->output);
}

static int paint(fg_context *context, const texture_settings *settings,
                 const fg_field *field)
{
  const fg_evolution_options evolution =
      settings_evolution(&settings->evolution, &settings->work);
  fg_texture_options options = settings_texture(settings);
  options.evolution = &evolution;
  fg_texture *texture = NULL;
  fg_status status = fg_texture_create(&texture, context, field, &options);
  int code = status ? complain_of(context, status, settings->reading.input)
                    : write_texture(context, settings, field, texture);
  fg_texture_destroy(texture);
  return code;
}

/* Options of the colour key need colours of speed. */
static int check_key(const texture_settings *settings)
{
  const picture_settings *picture = &settings->picture;
  const given_option of_colors[] = {
      {"key", settings->key},
      {"speed-range", picture->speed_range[1] > picture->speed_range[0]}};
  const given_option label = {"label", picture->label != NULL};
  if (!picture->palette && settings->kind == FG_TEXTURE_SPEED)
    return EXIT_DONE;
  if (!picture->palette)
    return refuse_given("texture", of_colors, 2,
                        "only with --palette, whose colours it "
                        "shows") ||
                   refuse_given("texture", &label, 1, "only with --key")
               ? EXIT_USAGE
               : EXIT_DONE;
  if (picture->palette[0] == '#' &&
      refuse_given("texture", of_colors, 2, "not with --palette %s, which is one colour",
                   picture->palette))
    return EXIT_USAGE;
  return settings->key ? EXIT_DONE
                       : refuse_given("texture", &label, 1, "only with --key");
}

/* --width and --dpi determine --pixels. */
static int check_pixels(const texture_settings *settings)
{
  const picture_settings *picture = &settings->picture;
  const given_option pixels = {"pixels", settings->pixels > 0};
  return picture->width > 0.0 && picture->dpi > 0.0
             ? refuse_given("texture", &pixels, 1,
                            "not with both --width and --dpi, from which they follow")
             : EXIT_DONE;
}

static int check_options(const texture_settings *settings)
{
  const given_option of_clusters[] = {
      {"clusters", settings->number.count > 0},
      {"max-time", settings->max_time > 0.0},
      {"nodes", settings->evolution.nodes > 0},
      {"energy", settings->evolution.energy != NULL},
      {"anisotropy", settings->evolution.anisotropy > 0.0},
      {"coverage", settings->evolution.coverage > 0.0},
      {"gamma", settings->evolution.gamma > 0.0},
      {"noise", settings->evolution.noise > 0.0},
  };
  const char *const inputs[] = {settings->reading.input, settings->reading.vars_from,
                                settings->reading.mesh_from, settings->evolution.energy};
  const given_option length = {"length", settings->length > 0.0};
  int code = EXIT_DONE;
  if (settings->kind == FG_TEXTURE_CLUSTERS)
    code = refuse_given("texture", &length, 1, "not with --kind clusters");
  else
    code =
        refuse_given("texture", of_clusters, sizeof of_clusters / sizeof of_clusters[0],
                     "only with --kind clusters");
  if (!code)
    code = check_pixels(settings);
  if (!code)
    code = check_key(settings);
  if (!code)
    code = check_picture_name(settings->output, "texture");
  return code ? code : check_is_no_input(settings->output, inputs, 3);
}

int command_texture(const void *given)
{
  const texture_settings *settings = given;
  int code = check_options(settings);
  if (code)
    return code;
  fg_context *context;
  if (create_context(&context))
    return EXIT_FAILED;
  interrupt_start(context);
  fg_field *field = NULL;
  code = places_read(&field, context, &settings->reading);
  if (!code)
    code = paint(context, settings, field);
  interrupt_end();
  fg_field_destroy(field);
  fg_context_destroy(context);
  return code;
}
