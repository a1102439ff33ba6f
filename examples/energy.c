/* An energy of one's own: clusters that lie across the flow instead of along it: energy
 * INPUT PICTURE, of a field in two dimensions.
 *
 *     cc energy.c $(pkg-config --cflags --libs flowgrain) -lm -o energy
 *     ./energy synth:vortex3 rays.svg
 *
 * ensemble.c has another, of several fields.
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>

/* I - (1 - a) e e^T, with the unit vector e of the flow: interfaces across it are cheap.
 * Several threads call it at once. */
static void across(double tensor[6], const fg_energy_place *place, const void *data)
{
  const double *v = place->direction, square = v[0] * v[0] + v[1] * v[1];
  const double share = square > 0.0 ? (1.0 - place->anisotropy) / square : 0.0;
  (void)data;
  tensor[0] = 1.0 - share * v[0] * v[0];
  tensor[1] = -share * v[0] * v[1];
  tensor[2] = 1.0 - share * v[1] * v[1];
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT PICTURE\n", argv[0]);
    return 2;
  }
  static const int clusters[] = {60};
  const fg_energy_law law = {.name = "across", .tensor = across, .axes = true};
  const fg_run_options options = {.kind = FG_RUN_CLUSTERS,
                                  .numbers = clusters,
                                  .count = 1,
                                  .evolution = {.law = &law}};
  const fg_picture_options clusters_alone = {.tint = true, .no_arrows = true};
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
  if (!status && scale)
    status = fg_picture_write(context, argv[2], field, scale->density, scale->icons,
                              &clusters_alone);
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_run_destroy(run);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
