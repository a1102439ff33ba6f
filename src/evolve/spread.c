#include "evolve/spread.h"

#include <string.h>

void fg__spread_use(fg__spread *spread, float *u, float *w, float *p)
{
  spread->u = u;
  spread->w = w;
  spread->p = p;
  for (int b = 0; b < spread->count; ++b) {
    fg__level *box = &spread->box[b];
    box->u = u + spread->offset[b];
    box->w = w + spread->offset[b];
    box->p = p + spread->offset[b];
  }
}

void fg__spread_pointers(const fg__spread *spread, int count, float *const array[],
                         float *const *out[])
{
  for (int a = 0; a < count; ++a) {
    float **to = spread->pointer + a * spread->count;
    for (int b = 0; b < spread->count; ++b)
      to[b] = array[a] + spread->offset[b];
    out[a] = to;
  }
}

void fg__spread_exchange(const fg__spread *spread, int count, float *const array[],
                         unsigned colours)
{
  float *const *places[FG__MOST_EXCHANGED];
  fg__spread_pointers(spread, count, array, places);
  fg__exchange_fill(spread->exchange, count, places, colours);
}

/* The end slices of so many arrays, for the neighbours named by the set of slices. */
static void pass_slices(const fg__spread *spread, int count, float *const array[],
                        unsigned slices)
{
  const fg__level *box = &spread->box[0];
  ptrdiff_t floats = fg__slice_floats(box), end = floats * fg__slices(box);
  fg__run run[2 * FG__MOST_EXCHANGED + 1];
  int runs = 0;
  for (int a = 0; a < count; ++a) {
    /* where slice 0 begins with its ghosts */
    float *first = array[a] + spread->offset[0] - box->layout.first + floats;
    if (slices & FG__FIRST_SLICE)
      run[runs++] = (fg__run){first, first + end, (size_t)floats, false};
    if (slices & FG__LAST_SLICE)
      run[runs++] = (fg__run){first + end - floats, first - floats, (size_t)floats, true};
  }
  if (slices & FG__GATHERED_SLICE)
    run[runs++] = (fg__run){spread->handed, spread->taken,
                            FG__RESTRICTED * (size_t)fg__gathered_floats(box), true};
  fg__slabs_exchange(&spread->slabs, run, runs);
}

void fg__spread_exchange_ends(const fg__spread *spread, int count, float *const array[])
{
  if (spread->in_slabs)
    pass_slices(spread, count, array, FG__FIRST_SLICE | FG__LAST_SLICE);
  else
    fg__spread_exchange(spread, count, array, FG__ALL_COLOURS);
}

/* What a member on its own, whose neighbours are other ranks, has to tell them. */
typedef struct meeting {
  const fg__spread *spread;
} meeting;

static void meet(void *argument, unsigned slices)
{
  const meeting *m = argument;
  float *const both[] = {m->spread->u, m->spread->w};
  bool solution = slices & (FG__FIRST_SLICE | FG__LAST_SLICE);
  pass_slices(m->spread, solution ? 2 : 0, both, slices);
}

static fg__share share_of(meeting *m)
{
  return (fg__share){.members = 1, .meet = meet, .argument = m};
}

static void smooth(const fg__spread *spread, const fg__kernel *kernel, float tau,
                   bool linear)
{
  float *const both[] = {spread->u, spread->w};
  for (int colour = 0; colour < 1 << kernel->dimension; ++colour) {
    for (int b = 0; b < spread->count; ++b)
      kernel->smooth_one_colour(&spread->box[b], tau, linear, colour);
    fg__spread_exchange(spread, 2, both, 1U << colour);
  }
}

void fg__spread_descend(const fg__spread *fine, const fg__spread *coarse,
                        const fg__kernel *kernel, float tau, bool linear)
{
  if (fine->in_slabs) {
    fg__share share = share_of(&(meeting){fine});
    (linear ? kernel->smooth_restrict_linear
            : kernel->restrict_residuals)(&fine->box[0], &coarse->box[0], tau, &share);
    return;
  }
  if (linear)
    smooth(fine, kernel, tau, true);
  for (int b = 0; b < fine->count; ++b) {
    float *out[FG__RESTRICTED];
    for (int n = 0; n < FG__RESTRICTED; ++n)
      out[n] = fine->residual[n] + fine->offset[b];
    kernel->find_residuals(&fine->box[b], tau, linear, out);
  }
  fg__spread_exchange(fine, FG__RESTRICTED, fine->residual, FG__ALL_COLOURS);
  for (int b = 0; b < fine->count; ++b) {
    const float *from[FG__RESTRICTED];
    for (int n = 0; n < FG__RESTRICTED; ++n)
      from[n] = fine->residual[n] + fine->offset[b];
    kernel->restrict_arrays(&fine->box[b], from, &coarse->box[b]);
  }
  memset(coarse->u, 0, coarse->size * sizeof *coarse->u);
  memset(coarse->w, 0, coarse->size * sizeof *coarse->w);
}

void fg__spread_find_space(const fg__spread *coarse, const fg__kernel *kernel, float tau)
{
  float *const both[] = {coarse->scale, coarse->scale_inverse};
  fg__share alone = fg__alone();
  for (int b = 0; b < coarse->count; ++b)
    kernel->find_scale(&coarse->box[b], &alone);
  fg__spread_exchange_ends(coarse, 2, both);
  for (int b = 0; b < coarse->count; ++b)
    kernel->find_curvature(&coarse->box[b], tau, &alone);
}

void fg__spread_unscale(const fg__spread *coarse, const fg__kernel *kernel)
{
  fg__share alone = fg__alone();
  for (int b = 0; b < coarse->count; ++b)
    kernel->unscale(&coarse->box[b], &alone);
}

bool fg__spread_ascend(const fg__spread *coarse, const fg__spread *fine,
                       const fg__kernel *kernel, float tau, bool linear, bool more)
{
  if (fine->in_slabs) {
    fg__share share = share_of(&(meeting){fine});
    more = more && !linear;
    (more     ? kernel->correct_smooth_restrict
     : linear ? kernel->correct_smooth_linear
              : kernel->correct_smooth)(&coarse->box[0], &fine->box[0], tau, &share);
    return more;
  }
  float *const both[] = {fine->u, fine->w};
  for (int b = 0; b < fine->count; ++b)
    kernel->correct(&coarse->box[b], &fine->box[b], linear);
  fg__spread_exchange(fine, 2, both, FG__ALL_COLOURS);
  smooth(fine, kernel, tau, linear);
  return false;
}
