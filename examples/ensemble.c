/* Clusters of what several fields agree on: ensemble A.nc B.nc ... PICTURE.
 *
 * An interfacial energy of one's own, in one file: at each place the mean of the flow
 * energies of all fields. Where they agree clusters grow long along the stream, where
 * they do not they stay round. Arrows are drawn in the first field.
 */
#include <flowgrain/flowgrain.h>
#include <math.h>
#include <stdio.h>

enum { MOST_FIELDS = 16 };

typedef struct ensemble {
  int count;
  const fg_field *field[MOST_FIELDS];
} ensemble;

/* A = a I + (1 - a) mean of e e^T, whose eigenvalues lie between a and 1; in 2D. It reads
 * fields only, so that several threads may call it. */
static void along_most(double tensor[6], const fg_energy_place *place, const void *data)
{
  const ensemble *all = data;
  double xx = 0.0, xy = 0.0, yy = 0.0, members = 0.0;
  for (int n = 0; n < all->count; ++n) {
    double v[3] = {0.0, 0.0, 0.0};
    if (!fg_field_tangent(all->field[n], place->position, v) || hypot(v[0], v[1]) <= 0.0)
      continue;
    double square = v[0] * v[0] + v[1] * v[1];
    xx += v[0] * v[0] / square;
    xy += v[0] * v[1] / square;
    yy += v[1] * v[1] / square;
    members += 1.0;
  }
  double a = place->anisotropy, share = members > 0.0 ? (1.0 - a) / members : 0.0;
  double rest = members > 0.0 ? a : 1.0; /* no direction: I */
  tensor[0] = rest + share * xx;
  tensor[1] = share * xy;
  tensor[2] = rest + share * yy;
}

static fg_status draw(fg_context *context, const ensemble *all, const char *picture)
{
  fg_energy_law law = {.name = "ensemble", .tensor = along_most, .data = all};
  fg_evolution_options options = {.law = &law};
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;
  fg_icons *icons = NULL;
  fg_step step = {0};
  fg_status status = fg_evolution_create(&evolution, context, all->field[0], &options);
  while (!status && !step.stationary && (step.clusters == 0 || step.clusters > 40))
    status = fg_evolution_step(evolution, &step);
  if (!status)
    status = fg_density_create(&density, evolution);
  if (!status)
    status = fg_icons_create(&icons, context, all->field[0], density, NULL);
  if (!status)
    status = fg_picture_write(context, picture, all->field[0], density, icons,
                              &(fg_picture_options){.tint = true});
  if (!status)
    printf("%d arrows in %s\n", fg_icons_count(icons), picture);
  fg_icons_destroy(icons);
  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  return status;
}

int main(int argc, char **argv)
{
  if (argc < 3 || argc - 2 > MOST_FIELDS) {
    fprintf(stderr, "usage: %s INPUT ... PICTURE, at most %d inputs\n", argv[0],
            MOST_FIELDS);
    return 2;
  }
  fg_context *context = NULL;
  fg_field *field[MOST_FIELDS] = {NULL};
  ensemble all = {0};
  fg_status status = fg_context_create(&context);
  for (int n = 0; n < argc - 2 && !status; ++n) {
    status = fg_field_read(&field[n], context, argv[1 + n], NULL);
    if (status)
      break;
    if (fg_field_contents(field[n])->dimension != 2) {
      fprintf(stderr, "%s: is not in two dimensions\n", argv[1 + n]);
      status = FG_STATUS_UNSUPPORTED;
    }
    all.field[all.count++] = field[n];
  }
  if (!status)
    status = draw(context, &all, argv[argc - 1]);
  if (status)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  for (int n = 0; n < MOST_FIELDS; ++n)
    fg_field_destroy(field[n]);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
