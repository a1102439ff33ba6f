/* Paints a texture of a field. */
#include "interrupt.h"
#include "rehearse.h"

static int write_texture(fg_context *context, const cli_settings *settings,
                         const fg_field *field, const fg_texture *texture)
{
  const fg_texture_style style = {
      .palette = settings->palette,
      .fade = settings->fade,
      .transparent = settings->transparent,
      .key = settings->key,
  };
  fg_status status = fg_texture_write(context, settings->output, field, texture, &style);
  return status ? complain_of(context, status, settings->output) : EXIT_DONE;
}

static int paint(fg_context *context, const cli_settings *settings, const fg_field *field)
{
  const fg_evolution_options evolution = settings_evolution(settings);
  fg_texture_options options = settings_texture(settings);
  options.evolution = &evolution;
  fg_texture *texture = NULL;
  fg_status status = fg_texture_create(&texture, context, field, &options);
  int code = status ? complain_of(context, status, settings->operand)
                    : write_texture(context, settings, field, texture);
  fg_texture_destroy(texture);
  return code;
}

int command_texture(const cli_settings *settings)
{
  const fg_read_options reading = settings_reading(settings);
  int code = check_picture_name(settings->output, "texture");
  if (!code && rehearse_reading(settings->operand, &reading))
    code = EXIT_FAILED;
  if (code)
    return code;
  fg_context *context;
  if (create_context(&context))
    return EXIT_FAILED;
  interrupt_start(context);
  fg_field *field = NULL;
  fg_status status = fg_field_read(&field, context, settings->operand, &reading);
  code = status ? complain_of(context, status, settings->operand)
                : paint(context, settings, field);
  interrupt_end();
  fg_field_destroy(field);
  fg_context_destroy(context);
  return code;
}
