#include "place/best.h"

#include "base/memory.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* A descent ends in a local minimum that depends on where it starts. So other placements
 * are made, of a first scale from even points, and the best is kept. */
static const fg__place_schedule OTHERS[] = {{0.65, 1.5}, {0.72, 1.75}, {0.58, 1.75},
                                            {0.5, 2.0},  {0.76, 1.6},  {0.62, 1.9},
                                            {0.54, 1.4}, {0.46, 2.2}};

/* Others of a first scale, and of one that is reached from a finer one; for few icons and
 * for more. */
typedef struct restarts {
  int first, coarser;
} restarts;
static const restarts OF_FEW[] = {[FG_EFFORT_NORMAL] = {1, 4},
                                  [FG_EFFORT_QUICK] = {0, 0},
                                  [FG_EFFORT_THOROUGH] = {4, 8}},
                      OF_MORE[] = {[FG_EFFORT_NORMAL] = {0, 0},
                                   [FG_EFFORT_QUICK] = {0, 0},
                                   [FG_EFFORT_THOROUGH] = {4, 4}};

/* Few are, in 2D, up to so many of free or fair lengths. */
enum { FEW_FREE = 40, FEW_FAIR = 80 };

/* Others start from a finer scale that has at least so many times as many icons. */
static const double LEAST_FINER = 1.5;

/* Where a hundredth of the lines touches others, an error counts as so many hundredths
 * more. */
static const double TOUCHING_COUNTS = 4.0;

/* The placements to be compared; number 0 is the one that is made without restarts. */
typedef struct multistart {
  const fg__place_descent *from;
  const fg_icons *clusters;
  int count; /* icons wanted */
  int placements;
  bool is_first;
  fg__place_snapshot finer; /* the scale to start from, unless it is the first */
  int next_identity;        /* of that */
  atomic_int begun;         /* placements */
  int fitting;              /* icons of number 0 */
} multistart;

/* One thread, with the best of the placements that it has made. */
typedef struct worker {
  multistart *in;
  fg_context *context;
  fg_status status;
  fg__place_search *search; /* NULL: none yet */
  int number;
  double criterion;
} worker;

/* The readers' error, and more where lines touch. */
static fg_status judge(fg__place_search *search, double *criterion)
{
  double touching = 0.0;
  fg_status status = fg__place_error(search, criterion);
  if (status == FG_STATUS_OK)
    status = fg__place_touching(search, &touching);
  *criterion *= 1.0 + TOUCHING_COUNTS * touching;
  return status;
}

static fg_status restore_finer(fg__place_descent *descent, const multistart *in)
{
  fg_status status = fg__descent_begin(descent, in->finer.count, FG__PLACE_FINE);
  if (status != FG_STATUS_OK)
    return status;
  descent->search->next_identity = in->next_identity;
  return fg__place_restore(descent->search, &in->finer);
}

static fg_status make(fg__place_descent *descent, const multistart *in, int number)
{
  const fg__place_schedule *by = number > 0 ? &OTHERS[number - 1] : NULL;
  fg_status status;
  if (in->is_first) {
    status = fg__descent_first(descent, in->count, by ? NULL : in->clusters,
                               by ? by : &fg__place_first_schedule);
  } else {
    status = restore_finer(descent, in);
    if (status == FG_STATUS_OK)
      status =
          fg__descent_go_down(descent, in->count, by ? by->ratio : fg__place_chain_ratio);
  }
  return status == FG_STATUS_OK ? fg__descent_refine(descent) : status;
}

/* Of equally good ones the first is the better, whichever thread made it. */
static bool is_better(double criterion, int number, const worker *than)
{
  return !than->search || criterion < than->criterion ||
         (criterion <= than->criterion && number < than->number);
}

/* Makes a placement, and keeps it if it is the best so far. */
static fg_status make_and_compare(worker *own, int number)
{
  multistart *in = own->in;
  double criterion = HUGE_VAL;
  fg__place_descent descent = *in->from;
  descent.context = own->context;
  descent.threads = NULL;
  descent.search = NULL;
  fg_status status = make(&descent, in, number);
  if (status == FG_STATUS_OK)
    status = judge(descent.search, &criterion);
  if (status == FG_STATUS_OK && number == 0)
    in->fitting = descent.search->count;
  if (status == FG_STATUS_OK && descent.search->count >= in->count &&
      is_better(criterion, number, own)) {
    fg__place_search *before = own->search;
    own->search = descent.search;
    own->number = number;
    own->criterion = criterion;
    descent.search = before;
  }
  fg__descent_clear(&descent);
  return status;
}

static void work(void *argument, const fg__thread *thread)
{
  worker *own = (worker *)argument + thread->index;
  int number;
  while (own->status == FG_STATUS_OK &&
         (number = atomic_fetch_add(&own->in->begun, 1)) < own->in->placements)
    own->status = make_and_compare(own, number);
}

/* The descent goes on with the best of all, or fails where a thread has failed. */
static fg_status take_best(fg__place_descent *descent, worker *all, int count,
                           const multistart *in)
{
  worker *best = &all[0];
  for (int n = 0; n < count; ++n) {
    if (all[n].status != FG_STATUS_OK)
      return fg__fail(descent->context, all[n].status, "%s",
                      fg_context_message(all[n].context));
    if (all[n].search && is_better(all[n].criterion, all[n].number, best))
      best = &all[n];
  }
  if (in->fitting < in->count || !best->search)
    return fg__descent_fail(descent, in->count, in->fitting);
  fg__descent_clear(descent);
  descent->search = best->search;
  descent->search->context = descent->context;
  descent->search->threads = descent->threads;
  best->search = NULL;
  return FG_STATUS_OK;
}

static fg_status share_out(multistart *in, fg__place_descent *descent)
{
  const int count = fg__threads_count(descent->threads);
  worker *all = fg__allocate((size_t)count, sizeof *all);
  if (!all)
    return fg__fail_memory(descent->context, "placements", (size_t)count * sizeof *all);
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < count && status == FG_STATUS_OK; ++n) {
    all[n].in = in;
    status = fg__context_create_beside(&all[n].context, descent->context);
  }
  if (status == FG_STATUS_OK) {
    fg__threads_run(descent->threads, work, all);
    status = take_best(descent, all, count, in);
  }
  for (int n = 0; n < count; ++n) {
    fg__place_descent left = {.search = all[n].search};
    fg__descent_clear(&left);
    fg_context_destroy(all[n].context);
  }
  free(all);
  return status;
}

/* How many other placements are made. */
static int count_others(const fg__place_descent *descent, int count, bool is_first)
{
  const fg_placement_options *options = descent->options;
  const int few = options->lengths == FG_LENGTHS_FAIR ? FEW_FAIR : FEW_FREE;
  const bool are_few = descent->domain->dimension == 2 && count <= few;
  const restarts *of = &(are_few ? OF_FEW : OF_MORE)[options->effort];
  int others = of->first;
  if (!is_first)
    return descent->search->count >= LEAST_FINER * count ? of->coarser : 0;
  while (others > 0 &&
         OTHERS[others - 1].start * count > fg__descent_most(descent->domain))
    --others;
  return others;
}

/* Makes a single placement, of a coarser scale from the present icons. */
static fg_status place_alone(fg__place_descent *descent, int count,
                             const fg_icons *clusters, bool is_first)
{
  fg_status status =
      is_first ? fg__descent_first(descent, count, clusters, &fg__place_first_schedule)
               : fg__descent_go_down(descent, count, fg__place_chain_ratio);
  if (status == FG_STATUS_OK)
    status = fg__descent_refine(descent);
  if (status == FG_STATUS_OK && descent->search->count < count)
    status = fg__descent_fail(descent, count, descent->search->count);
  return status;
}

fg_status fg__place_best(fg__place_descent *descent, int count, const fg_icons *clusters,
                         bool is_first)
{
  const int others = count_others(descent, count, is_first);
  if (others == 0)
    return place_alone(descent, count, clusters, is_first);
  multistart in = {.from = descent,
                   .clusters = clusters,
                   .count = count,
                   .placements = 1 + others,
                   .is_first = is_first};
  fg_status status = FG_STATUS_OK;
  if (!is_first) {
    in.next_identity = descent->search->next_identity;
    status = fg__place_remember(&in.finer, descent->search);
  }
  if (status == FG_STATUS_OK)
    status = share_out(&in, descent);
  fg__place_snapshot_clear(&in.finer);
  return status;
}
