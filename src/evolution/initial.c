#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"
#include "evolution/evolution.h"
#include "evolution/widen.h"
#include "field/noise.h"

/* The nodes of a block to be filled by rows, which threads share: with noise, the
 * caller's density or that of a finer mesh. */
typedef struct filling {
  const fg_evolution *e;
  const fg__level *level;
  const fg__box *block;
  const fg__noise *noise;
  const float *values; /* that of a finer mesh, of the block, x fastest; NULL: another */
  float *row;          /* one a thread */
  float *u;
} filling;

static void fill_part(void *argument, const fg__thread *thread)
{
  const filling *f = argument;
  const fg_evolution *e = f->e;
  const fg__layout *layout = &f->level->layout;
  const int *nodes = layout->nodes;
  size_t columns = (size_t)(e->mesh.cells[0] + !e->mesh.periodic[0]);
  size_t rows = (size_t)(e->mesh.cells[1] + !e->mesh.periodic[1]);
  float *row = f->row + (size_t)thread->index * (size_t)nodes[0];
  int begin, end;
  fg__threads_range(thread, nodes[1] * nodes[2], 1, &begin, &end);
  for (int n = begin; n < end; ++n) {
    int j = n % nodes[1], k = n / nodes[1];
    int y = f->block->first[1] + j, z = f->block->first[2] + k;
    const float *values = row;
    if (f->values)
      values = f->values + (size_t)n * (size_t)nodes[0];
    else if (e->options.initial)
      values = e->options.initial + ((size_t)z * rows + (size_t)y) * columns +
               f->block->first[0];
    else
      fg__noise_row(f->noise, y, z, f->block->first[0], nodes[0], row);
    float *to = fg__row(f->level, f->u, j, k);
    for (int i = 0; i < nodes[0]; ++i)
      to[fg__column(layout, i)] = values[i];
  }
}

static fg_status fill_block(const fg_evolution *e, const fg__level *level,
                            const fg__box *block, const fg__noise *noise,
                            const float *values, float *u)
{
  size_t count = (size_t)fg__threads_count(e->threads) * (size_t)level->layout.nodes[0];
  filling f = {
      .e = e, .level = level, .block = block, .noise = noise, .values = values, .u = u};
  f.row = fg__allocate(count, sizeof *f.row);
  if (!f.row)
    return fg__fail_memory(e->context, "the noise", count * sizeof *f.row);
  fg__threads_run(e->threads, fill_part, &f);
  free(f.row);
  return FG_STATUS_OK;
}

/* Shifts u to a mean. Sums are exact, so that the result does not depend on blocks. Nodes
 * without mass become 0. */
static void set_mean(const fg__multigrid *multigrid, double mean)
{
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  float *u = fg__multigrid_u(multigrid), *ones = fg__multigrid_p(multigrid);
  for (size_t n = 0; n < shape.size; ++n)
    (ones - shape.first)[n] = 1.0F;
  double weight = fg__pass_changes(multigrid, ones, ones, ones, ones).u;
  double sum = fg__pass_changes(multigrid, u, u, u, u).u;
  fg__pass_shift(multigrid, u, mean - sum / weight);
}

/* In a subdomain of a few nodes the noise may have a mean beyond the minima of the double
 * well, which the evolution would conserve: the subdomain becomes a pure phase. A density
 * of a finer mesh is widened and keeps the mean of each subdomain. */
static fg_status bound_subdomain_means(const fg_evolution *e,
                                       const fg__multigrid *multigrid, double mean)
{
  float *u = fg__multigrid_u(multigrid);
  fg__mass_constraint masses;
  fg_status status = fg__mass_constraint_create(&masses, e->context, multigrid, u);
  bool bounded = !status && fg__mass_constraint_bound(&masses, -1.0, 1.0);
  if (!status && e->coarsened)
    fg__widen_interfaces(multigrid, e->info.gamma,
                         fg__theta_held(fg__evolution_splitting(e)),
                         fg__evolution_least_spacing(e));
  if (bounded || e->coarsened) {
    fg__mass_constraint_restore(&masses, multigrid, u);
    set_mean(multigrid, mean);
  }
  fg__mass_constraint_clear(&masses);
  return status;
}

/* The block's part of the density coarsened from a finer mesh; the caller frees it. */
static fg_status receive_coarsened(float **out, const fg_evolution *e)
{
  size_t count = (size_t)fg__box_count(fg__own_block(&e->mesh.partition));
  float *values = *out = fg__allocate(count, sizeof *values);
  fg_status status = FG_STATUS_OK;
  if (!values)
    status = fg__fail_memory(e->context, "a coarser density", count * sizeof *values);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  return status ? status
                : fg__coarsened_deliver(e->coarsened, e->context, &e->mesh.partition,
                                        values);
}

fg_status fg__evolution_fill(fg_evolution *evolution, const fg__multigrid *multigrid)
{
  fg_evolution *e = evolution;
  double mean = 2.0 * e->options.coverage - 1.0;
  double correlation = sqrt(e->info.gamma * e->options.anisotropy);
  fg__noise noise =
      fg__noise_of(e->mesh.dimension, e->mesh.cells, e->mesh.spacing, e->mesh.periodic,
                   mean, e->options.noise, correlation, e->options.seed);
  float *u = fg__multigrid_u(multigrid), *values = NULL;
  fg_status status = FG_STATUS_OK;
  if (e->coarsened)
    status = receive_coarsened(&values, e);
  if (!status)
    status = fill_block(e, fg__multigrid_finest(multigrid),
                        fg__own_block(&e->mesh.partition), &noise, values, u);
  free(values);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  if (status)
    return status;
  fg__pass_fill_ghosts(multigrid, u);
  if (e->coarsened) {
    fg__coarsened_fill_holes(multigrid, e->coarsened_mean);
    status = bound_subdomain_means(e, multigrid, e->coarsened_mean);
  } else if (e->options.initial) {
    e->initial_fingerprint = fg__mix_floats(0, 0, e->options.initial, e->nodes);
    if (!fg__ranks_alike(e->ranks, e->initial_fingerprint))
      return fg__fail(e->context, FG_STATUS_ARGUMENT,
                      "the %d ranks have different initial densities", e->ranks->count);
    fg__pass_shift(multigrid, u, 0.0);
  } else {
    set_mean(multigrid, mean);
    status = bound_subdomain_means(e, multigrid, mean);
  }
  return status;
}
