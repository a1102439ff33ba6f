/* One evolution shared by several processes: ranks INPUT PICTURE draws an arrow in each
 * of about 40 clusters, the same on any number of ranks.
 *
 *     cc ranks.c $(pkg-config --cflags --libs flowgrain) -o ranks
 *     mpirun -n 4 ./ranks synth:vortex3 vortices.svg
 *
 * Every rank reads its part of the field and makes the same calls; rank 0 gets the icons.
 */
#include <flowgrain/flowgrain.h>
#include <stdio.h>

static fg_status read_shared(fg_field **out, fg_context *context, const char *input,
                             int *rank)
{
  int count;
  fg_status status = fg_ranks(context, rank, &count);
  if (!status)
    status = fg_field_read_part(out, context, input, NULL, *rank, count);
  status = fg_ranks_agree(context, status, NULL, NULL);
  return status ? status : fg_field_join(context, *out);
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT PICTURE\n", argv[0]);
    return 2;
  }
  static const int clusters[] = {40};
  const fg_run_options options = {
      .kind = FG_RUN_CLUSTERS, .numbers = clusters, .count = 1};
  int rank = 0;
  fg_context *context = NULL;
  fg_field *field = NULL;
  fg_run *run = NULL;
  const fg_run_scale *scale = NULL;
  fg_status status = fg_context_create(&context);
  if (!status)
    status = read_shared(&field, context, argv[1], &rank);
  if (!status)
    status = fg_run_create(&run, context, field, &options);
  if (!status)
    status = fg_run_next(&scale, run);
  if (!status && scale && scale->icons) { /* rank 0 */
    status = fg_picture_write(context, argv[2], field, NULL, scale->icons, NULL);
    printf("%d arrows in %s\n", fg_icons_count(scale->icons), argv[2]);
  }
  if (status && rank == 0) /* all have the same message */
    fprintf(stderr, "%s: %s\n", fg_status_name(status), fg_context_message(context));
  fg_run_destroy(run);
  fg_field_destroy(field);
  fg_context_destroy(context);
  return status ? 1 : 0;
}
