/* Clusters of a field, found by several processes that share one evolution; the first of
 * them writes their arrows: ranks INPUT PICTURE.
 *
 *     mpicc ranks.c $(pkg-config --cflags --libs flowgrain) -o ranks
 *     mpirun -n 4 ./ranks synth:vortex3 vortices.svg
 */
#include <flowgrain/flowgrain.h>
#include <flowgrain/mpi.h>
#include <stdio.h>

static fg_status evolve(fg_evolution *evolution, int clusters)
{
  fg_step step;
  fg_status status;
  do
    status = fg_evolution_step(evolution, &step);
  while (!status && !step.stationary && (step.clusters == 0 || step.clusters > clusters));
  return status;
}

/* Icons of a shared density are found by all ranks, and come to rank 0. */
static fg_status draw(fg_context *context, const char *path, const fg_field *field,
                      const fg_density *density, int rank)
{
  fg_icons *icons = NULL;
  fg_status status = fg_icons_create(&icons, context, field, density, NULL);
  if (!status && rank == 0)
    status = fg_picture_write(context, path, field, NULL, icons, NULL);
  if (!status && rank == 0)
    printf("%d arrows in %s\n", fg_icons_count(icons), path);
  fg_icons_destroy(icons);
  return fg_ranks_agree(context, status, NULL, NULL);
}

int main(int argc, char **argv)
{
  int rank, count;
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_evolution *evolution = NULL;
  fg_density *density = NULL;

  MPI_Init(&argc, &argv);
  fg_status status = fg_context_create(&context);
  if (!status)
    status = fg_context_set_communicator(context, MPI_COMM_WORLD);
  fg_ranks(context, &rank, &count);
  if (!status && argc != 3)
    status = FG_STATUS_ARGUMENT;
  if (!status)
    status = fg_field_read(&field, context, argv[1], NULL);
  if (!status)
    status = fg_evolution_create(&evolution, context, field, NULL);
  if (!status)
    status = evolve(evolution, 40);
  if (!status)
    status = fg_density_create(&density, evolution);
  if (!status)
    status = draw(context, argv[2], field, density, rank);
  if (status && rank == 0)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));

  fg_density_destroy(density);
  fg_evolution_destroy(evolution);
  fg_field_destroy(field);
  fg_context_destroy(context);
  MPI_Finalize();
  return status ? 1 : 0;
}
