/* Multigrid hierarchies of a process alone over tensors that are written down, for tests
 * and benchmarks. */
#ifndef FG__MULTIGRID_TEST_H
#define FG__MULTIGRID_TEST_H

#include "solver/multigrid.h"

/* Of the mesh its dimension, cells, periods and spacings are read. MEMORY. */
static inline fg_status multigrid_of_tensor(fg__multigrid *out, fg_context *context,
                                            const fg__mesh *mesh,
                                            const fg__tensor *tensor, double gamma,
                                            fg__threads *threads)
{
  fg__mesh alone = *mesh;
  fg__cells_of_box cells = {0};
  alone.ranks = &fg__single_rank;
  fg_status status =
      fg__partition_create(&alone.partition, context, alone.ranks, mesh->dimension,
                           mesh->cells, mesh->periodic, (const int[3]){1, 1, 1}, 1);
  if (!status)
    status = fg__cells_from_tensor(&cells, context, tensor, mesh->dimension,
                                   alone.partition.cells, mesh->periodic, threads);
  bool masked = false;
  const int *count = alone.partition.cells;
  for (long n = 0; n < (long)count[0] * count[1] * count[2]; ++n)
    masked = masked || !tensor->active[n];
  if (!status)
    status = fg__multigrid_create(out, context, &alone, &cells, masked, gamma, threads);
  fg__partition_clear(&alone.partition);
  return status;
}

#endif
