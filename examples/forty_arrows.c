/* Draws a field with about forty curved arrows: forty_arrows INPUT PICTURE.
 *
 *     cc forty_arrows.c $(pkg-config --cflags --libs flowgrain) -o forty_arrows
 *     ./forty_arrows synth:vortex3 vortices.svg
 */
#include <flowgrain/flowgrain.h>
#include <stdio.h>

static fg_status coarsen_to(fg_evolution *evolution, int clusters)
{
  fg_step step;
  fg_status status;
  /* clusters is 0 until the first of them have formed */
  do
    status = fg_evolution_step(evolution, &step);
  while (!status && !step.stationary && (step.clusters == 0 || step.clusters > clusters));
  return status;
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT PICTURE\n", argv[0]);
    return 2;
  }
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_icons *icons = NULL;

  fg_status status = fg_context_create(&context);
  if (!status)
    status = fg_field_read(&field, context, argv[1], NULL);
  if (!status)
    status = fg_evolution_create(&evolution, context, field, NULL);
  if (!status)
    status = coarsen_to(evolution, 40);
  if (!status)
    status = fg_density_create(&density, evolution);
  if (!status)
    status = fg_icons_create(&icons, context, field, density, NULL);
  if (!status)
    status = fg_picture_write(context, argv[2], field, density, icons, NULL);
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  else
    printf("%d arrows in %s\n", fg_icons_count(icons), argv[2]);

  fg_icons_destroy(icons);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
