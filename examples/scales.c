/* A run of scales: each as a picture, from many arrows to few: scales INPUT NAME writes
 * NAME-100.svg, NAME-40.svg and NAME-12.svg.
 *
 *     cc scales.c $(pkg-config --cflags --libs flowgrain) -o scales
 *     ./scales synth:vortex3 vortices
 *
 * The run ends even where the clusters come to rest early.
 */
#include <flowgrain/flowgrain.h>
#include <stdio.h>

static fg_status draw(fg_context *context, const fg_field *field,
                      const fg_run_scale *scale, const char *name)
{
  char path[4096];
  snprintf(path, sizeof path, "%s-%d.svg", name, fg_icons_count(scale->icons));
  printf("%s: t = %.3g, %d clusters\n", path, scale->step.time, scale->step.clusters);
  return fg_picture_write(context, path, field, NULL, scale->icons, NULL);
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT NAME\n", argv[0]);
    return 2;
  }
  static const int arrows[] = {100, 40, 12};
  const fg_run_options options = {.numbers = arrows, .count = 3};
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_run *run = NULL;
  const fg_run_scale *scale = NULL;
  fg_status status = fg_context_create(&context);
  if (!status)
    status = fg_field_read(&field, context, argv[1], NULL);
  if (!status)
    status = fg_run_create(&run, context, field, &options);
  if (!status)
    status = fg_run_next(&scale, run);
  while (!status && scale) {
    status = draw(context, field, scale, argv[2]);
    if (!status)
      status = fg_run_next(&scale, run);
  }
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_run_destroy(run);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
