/* Paints an image in brush strokes along its level sets. */
#include <stdio.h>

#include "command/command.h"
#include "folder/file.h"
#include "folder/made.h"
#include "inputs.h"
#include "interrupt.h"
#include "option/settings.h"
#include "progress.h"

static fg_status paint(fg_context *context, const brush_settings *settings,
                       const fg_image *image)
{
  fg_brush_options brush = {.clusters = settings->clusters.number,
                            .cluster_count = settings->clusters.count,
                            .anisotropy = settings->anisotropy,
                            .seed = settings->work.seed,
                            .threads = settings->work.threads};
  fg_painting_options look = {.width = settings->width,
                              .transparent = settings->transparent};
  fg_strokes *strokes = NULL;
  cli_progress progress;
  progress_start(&progress, false, 0);
  progress_stage(&progress, "strokes grow on the image, layer after layer");
  fg_status status = fg_strokes_create(&strokes, context, image, &brush);
  progress_stage(&progress, "painting");
  if (!status)
    status = fg_painting_write(context, settings->output, image, strokes, &look);
  progress_wipe(&progress);
  if (!status && settings->verbose)
    fprintf(stderr, "flowgrain: %d strokes in %d layers\n", fg_strokes_count(strokes),
            fg_strokes_layers(strokes));
  fg_strokes_destroy(strokes);
  return status;
}

int command_brush(const void *given)
{
  const brush_settings *settings = given;
  int code = check_picture_name(settings->output, "brush");
  if (!code)
    code = check_is_no_input(settings->output, &settings->image, 1);
  if (code)
    return code;
  fg_context *context;
  if (create_context(&context))
    return EXIT_FAILED;
  interrupt_start(context);
  fg_image *image = NULL;
  fg_status status = fg_image_read(&image, context, settings->image);
  if (!status)
    status = paint(context, settings, image);
  interrupt_end();
  code = status ? complain_of(context, status, settings->image)
                : made_record(settings->output);
  fg_image_destroy(image);
  fg_context_destroy(context);
  return code;
}
