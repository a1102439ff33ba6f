/* Clusters of a field, found by several processes that share one evolution; the first of
 * them draws an arrow in each of about 40: ranks INPUT PICTURE.
 *
 *     mpicc ranks.c $(pkg-config --cflags --libs flowgrain) -o ranks
 *     mpirun -n 4 ./ranks synth:vortex3 vortices.svg
 *
 * Every rank makes the same calls, and reads its part of the field.
 */
#include <flowgrain/flowgrain.h>
#include <flowgrain/mpi.h>
#include <stdio.h>

static fg_status draw(fg_context *context, const char *input, const char *picture)
{
  static const int clusters[] = {40};
  const fg_run_options options = {
      .kind = FG_RUN_CLUSTERS, .numbers = clusters, .count = 1};
  int rank, count;
  fg_field *field = NULL;
  fg_run *run = NULL;
  const fg_run_scale *scale = NULL;
  fg_ranks(context, &rank, &count);
  fg_status status = fg_field_read_slab(&field, context, input, NULL, rank, count);
  status = fg_ranks_agree(context, status, NULL, NULL);
  if (!status)
    status = fg_field_join(context, field);
  if (!status)
    status = fg_run_create(&run, context, field, &options);
  if (!status)
    status = fg_run_next(&scale, run);
  if (!status && scale && rank == 0) { /* the others have no icons */
    status = fg_picture_write(context, picture, field, NULL, scale->icons, NULL);
    printf("%d arrows in %s\n", fg_icons_count(scale->icons), picture);
  }
  if (status && rank == 0)
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_run_destroy(run);
  fg_field_destroy(field);
  return status;
}

int main(int argc, char **argv)
{
  fg_context *context = NULL;
  MPI_Init(&argc, &argv);
  fg_status status = argc == 3 ? fg_context_create(&context) : FG_STATUS_ARGUMENT;
  if (!status)
    status = fg_context_set_communicator(context, MPI_COMM_WORLD);
  if (!status)
    status = draw(context, argv[1], argv[2]);
  fg_context_destroy(context);
  MPI_Finalize();
  return status ? 1 : 0;
}
