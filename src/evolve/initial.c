#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/mix.h"
#include "evolve/evolution.h"
#include "evolve/noise.h"
#include "evolve/widen.h"

/* The nodes of a box to be filled, of which members of a team take rows: with noise, or
 * the caller's density. */
typedef struct filling {
  const fg_evolution *e;
  const fg__level *level;
  const fg__box *box;
  const fg__noise *noise;
  const float *values; /* of the box alone, x fastest; NULL: noise or the caller's */
  float *row;          /* one a member */
  float *u;
} filling;

static void fill_part(void *argument, const fg__share *share)
{
  const filling *f = argument;
  const fg_evolution *e = f->e;
  const fg__layout *layout = &f->level->layout;
  const int *nodes = layout->nodes;
  size_t columns = (size_t)(e->mesh.cells[0] + !e->mesh.periodic[0]);
  size_t rows = (size_t)(e->mesh.cells[1] + !e->mesh.periodic[1]);
  float *row = f->row + (size_t)share->member * (size_t)nodes[0];
  int begin, end;
  fg__team_part(share, nodes[1] * nodes[2], 1, &begin, &end);
  for (int n = begin; n < end; ++n) {
    int j = n % nodes[1], k = n / nodes[1];
    int y = f->box->first[1] + j, z = f->box->first[2] + k;
    const float *values = row;
    if (f->values)
      values = f->values + (size_t)n * (size_t)nodes[0];
    else if (e->options.initial)
      values = e->options.initial + ((size_t)z * rows + (size_t)y) * columns +
               f->box->first[0];
    else
      fg__noise_row(f->noise, y, z, f->box->first[0], nodes[0], row);
    float *to = fg__row(f->level, f->u, j, k);
    for (int i = 0; i < nodes[0]; ++i)
      to[fg__column(layout, i)] = values[i];
  }
}

static fg_status fill_box(const fg_evolution *e, const fg__level *level,
                          const fg__box *box, const fg__noise *noise, const float *values,
                          float *u)
{
  size_t count = (size_t)fg__team_members(e->team) * (size_t)level->layout.nodes[0];
  filling f = {
      .e = e, .level = level, .box = box, .noise = noise, .values = values, .u = u};
  f.row = fg__allocate(count, sizeof *f.row);
  if (!f.row)
    return fg__fail_memory(e->context, "the noise", count * sizeof *f.row);
  fg__team_run(e->team, fill_part, &f);
  free(f.row);
  return FG_STATUS_OK;
}

/* Shifts the noise so that its mean is met exactly. Sums are exact: it does not matter
 * who holds which nodes. Nodes without mass become 0. */
static void settle_mean(const fg__multigrid *multigrid, double mean)
{
  fg__array_shape shape = fg__multigrid_shape(multigrid, 0);
  float *u = fg__multigrid_u(multigrid), *ones = fg__multigrid_p(multigrid);
  for (size_t n = 0; n < shape.size; ++n)
    (ones - shape.first)[n] = 1.0F;
  double weight = fg__pass_changes(multigrid, ones, ones, ones, ones).u;
  double sum = fg__pass_changes(multigrid, u, u, u, u).u;
  fg__pass_shift(multigrid, u, mean - sum / weight);
}

/* In a part of a few nodes behind a mask the noise may have a mean beyond the wells,
 * which no evolution within the part could change: it becomes a pure phase. */
static fg_status settle_parts(const fg_evolution *e, const fg__multigrid *multigrid,
                              double mean)
{
  float *u = fg__multigrid_u(multigrid);
  fg__means means;
  fg_status status = fg__means_create(&means, e->context, multigrid, u);
  if (!status && fg__means_bound(&means, -1.0, 1.0)) {
    fg__means_restore(&means, multigrid, u);
    settle_mean(multigrid, mean);
  }
  fg__means_clear(&means);
  return status;
}

/* What the boxes get of the density of a finer mesh; the caller frees each and the list.
 */
static fg_status take_halved(float ***out, const fg_evolution *e)
{
  int count;
  const fg__box *own = fg__own_boxes(&e->mesh.partition, &count);
  float **values = *out = fg__allocate((size_t)count, sizeof *values);
  bool whole = values;
  for (int b = 0; b < count && whole; ++b) {
    values[b] = fg__allocate((size_t)fg__box_count(&own[b]), sizeof **values);
    whole = values[b];
  }
  fg_status status = FG_STATUS_OK;
  if (!whole)
    status =
        fg__fail_memory(e->context, "a coarser density", (size_t)count * sizeof *values);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  return status ? status
                : fg__halved_deliver(e->halved, e->context, &e->mesh.partition, values);
}

static void free_list(float **values, int count)
{
  for (int b = 0; b < count && values; ++b)
    free(values[b]);
  free(values);
}

fg_status fg__evolution_fill(fg_evolution *evolution, const fg__multigrid *multigrid)
{
  fg_evolution *e = evolution;
  double mean = 2.0 * e->options.coverage - 1.0;
  double correlation = sqrt(e->info.gamma * e->options.anisotropy);
  fg__noise noise =
      fg__noise_of(e->mesh.dimension, e->mesh.cells, e->mesh.spacing, e->mesh.periodic,
                   mean, e->options.noise, correlation, e->options.seed);
  int count;
  const ptrdiff_t *offset;
  const fg__level *box = fg__multigrid_boxes(multigrid, &count, &offset);
  const fg__box *place = fg__own_boxes(&e->mesh.partition, &(int){0});
  float *u = fg__multigrid_u(multigrid), **values = NULL;
  fg_status status = FG_STATUS_OK;
  if (e->halved)
    status = take_halved(&values, e);
  for (int b = 0; b < count && !status; ++b)
    status =
        fill_box(e, &box[b], &place[b], &noise, values ? values[b] : NULL, u + offset[b]);
  free_list(values, count);
  status = fg__ranks_agree(e->mesh.ranks, e->context, status);
  if (status)
    return status;
  fg__pass_fill_ghosts(multigrid, u);
  if (e->halved) {
    fg__widen_interfaces(multigrid, e->info.gamma, 1.0 - fg__evolution_alpha(e),
                         fg__evolution_least_spacing(e));
    settle_mean(multigrid, e->halved_mean);
  } else if (e->options.initial) {
    e->initial_fingerprint = fg__mix_floats(0, 0, e->options.initial, e->nodes);
    if (!fg__ranks_alike(e->ranks, e->initial_fingerprint))
      return fg__fail(e->context, FG_STATUS_ARGUMENT,
                      "the %d ranks have different initial densities", e->ranks->count);
    fg__pass_shift(multigrid, u, 0.0);
  } else {
    settle_mean(multigrid, mean);
    status = settle_parts(e, multigrid, mean);
  }
  return status;
}
