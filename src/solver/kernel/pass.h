/* Correction, sweep and restriction of a level, in one pass over its memory. Part of
 * solver/kernel/body.h. */
#ifndef FG__KERNEL_PASS_H
#define FG__KERNEL_PASS_H

#include "solver/kernel/correct.h"
#include "solver/kernel/restrict.h"

static void clear(const fg__level *level, float *array)
{
  memset(array - level->layout.first, 0, level->layout.array_size * sizeof *array);
}

/* What is done to a fine level, in this order, in one pass over its memory. */
typedef struct work {
  bool correct, sweep, restriction;
} work;

/* Stores what the rank above needs of the last slice. */
static void store_gathered(const fg__level *fine, const lines *gathered)
{
  ptrdiff_t floats = fg__gathered_floats(fine);
  for (int n = 0; n < FG__RESTRICTED; ++n)
    memcpy(fine->sent + n * floats, gathered->value[n],
           (size_t)floats * sizeof *fine->sent);
}

/* Takes the slice before the first from what the rank below has sent. */
static void use_received(const fg__level *fine, lines *gathered)
{
  for (int n = 0; n < FG__RESTRICTED; ++n)
    gathered->value[n] = fine->received + n * fg__gathered_floats(fine);
}

/* Slice s is smoothed when those up to s + 1 are corrected. Once slices up to s = 2 S + 2
 * are smoothed, those up to 2 S + 1 have their final residuals, while they are still
 * near. Not so at the start of a part, whose neighbour may be at work still, nor across a
 * periodic boundary within a part, where slice 0 needs the last. */
static void pass(const fg__level *fine, const fg__level *coarse, float tau, bool linear,
                 work todo, const fg__thread *thread)
{
  laplacian l = laplacian_times(fine, tau);
  restriction r = restriction_of(fine, coarse, tau, thread);
  float *const out[] = {coarse->p, coarse->q, coarse->coupling, coarse->shape_curvature};
  slab mine = slab_of(fine, thread);
  int first = mine.begin / 2, last = (mine.end + 1) / 2; /* coarse slices */
  bool together = todo.sweep && todo.restriction &&
                  (!fine->periodic[FG__DIMENSION - 1] || fine->received);
  int started = together && mine.begin == 0 && !fine->received ? first : first + 1;
  if (todo.correct)
    correct_ends(coarse, fine, mine, linear, thread);
  if (todo.sweep)
    begin_sweep(fine, mine, &l, linear, thread);
  for (int s = mine.begin + 2; todo.sweep && s <= mine.end + 1; s += 2) {
    int S = s / 2 - 1;
    for (int next = s; todo.correct && next <= s + 1 && next < mine.end - 1; ++next)
      correct_slice(coarse, fine, next, linear, thread);
    continue_sweep(fine, s, mine, &l, linear);
    if (together && S >= started)
      restrict_slice(&r, S, S == started, out, linear);
  }
  if (todo.restriction && fine->sent) {
    if (!together)
      take_slice(&r, mine.end - 1, &r.slice[0], linear);
    store_gathered(fine, &r.slice[0]);
  }
  fg__threads_exchange(thread, (todo.sweep ? FG__LAST_SLICE : 0U) |
                                   (todo.restriction ? FG__GATHERED_SLICE : 0U));
  if (!todo.restriction)
    return;
  int end = together ? started : last;
  if (fine->received)
    use_received(fine, &r.slice[0]);
  for (int S = first; S < end && S < last; ++S)
    restrict_slice(&r, S, S == first && !fine->received, out, linear);
  if (thread->index == 0)
    clear(coarse, coarse->u);
  if (thread->index == thread->count - 1)
    clear(coarse, coarse->w);
  fg__threads_barrier(thread);
}

static void restrict_residuals(const fg__level *fine, const fg__level *coarse, float tau,
                               const fg__thread *thread)
{
  pass(fine, coarse, tau, false, (work){.restriction = true}, thread);
}

static void smooth_restrict_linear(const fg__level *fine, const fg__level *coarse,
                                   float tau, const fg__thread *thread)
{
  pass(fine, coarse, tau, true, (work){.sweep = true, .restriction = true}, thread);
}

static void correct_smooth(const fg__level *coarse, const fg__level *fine, float tau,
                           const fg__thread *thread)
{
  pass(fine, coarse, tau, false, (work){.correct = true, .sweep = true}, thread);
}

static void correct_smooth_linear(const fg__level *coarse, const fg__level *fine,
                                  float tau, const fg__thread *thread)
{
  pass(fine, coarse, tau, true, (work){.correct = true, .sweep = true}, thread);
}

static void correct_smooth_restrict(const fg__level *coarse, const fg__level *fine,
                                    float tau, const fg__thread *thread)
{
  pass(fine, coarse, tau, false, (work){true, true, true}, thread);
}

#endif
