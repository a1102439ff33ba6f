#include "place/descent.h"

#include "base/memory.h"
#include "icon/icons.h"
#include "place/search/even.h"

#include <math.h>
#include <stdlib.h>

typedef struct effort {
  int sweeps;            /* of the descent */
  int exchanges;         /* of icons, */
  int icons_an_exchange; /* and one more for so many icons; 0: none */
  int failures;          /* exchanges in a row that may fail before they end */
} effort;

static const effort EFFORTS[] = {[FG_EFFORT_NORMAL] = {14, 13, 30, 5},
                                 [FG_EFFORT_QUICK] = {8, 0, 0, 0},
                                 [FG_EFFORT_THOROUGH] = {14, 13, 30, 5}};

/* From so many icons on the number of exchanges falls: each takes time in proportion to
 * the number of icons and changes a smaller share of the picture. */
enum { MOST_EXCHANGED = 1500 };

/* The least spacing of icons, lambda, in distances between samples; and a number of icons
 * that any field may have. */
static const double FINEST = 0.125;
enum { ALWAYS = 200 };

/* Sweeps after a scale is complete. */
enum { SETTLING = 3 };

/* A coarser scale is reached in a chain of scales, whose numbers of icons fall by this
 * ratio; in each, icons move by so much. */
const double fg__place_chain_ratio = 0.8;
static const double CHAIN_STEP = 0.1; /* in lambda */

/* The chain's ratio may be smaller by so much of a step rather than take one more. */
static const double SHORT_OF_A_STEP = 0.3;

const fg__place_schedule fg__place_first_schedule = {0.8, 1.25};

/* Gaps are filled evenly up to this share of the icons that a first scale begins with;
 * the others come where readers err most. */
static const double EVEN_SHARE = 0.84;

/* The most ink of a free placement (fg__place_ink). Where it would be more its penalty
 * comes to what leaves so much, as ink that is left unused is error. */
static const double MOST_INK = 1.495, WANTED_INK = 1.488, LEAST_INK = 1.475;
enum { MOST_INK_STEPS = 12 };

/* By how much the ink falls where its penalty rises by 1, about; the largest change of
 * the penalty at once; the share of it while icons still get fewer. */
static const double INK_PER_PENALTY = 0.4, MOST_PENALTY_STEP = 0.4, CHAIN_SHARE = 0.5;

/* Icons that are nearly right move by so many lambda, and at least by LAST_LEAST_STEP. */
static const double SMALL_STEP = 0.1, LAST_LEAST_STEP = 0.02;

/* The largest share of lines that may touch others, and how the penalty grows for it. */
static const double MOST_TOUCHING = 0.002, TOUCH_GROWTH = 2.0;
enum { MOST_PARTINGS = 3 };

/* From icons of another placement, as of an animation's frame before, so that they stay:
 * the first steps, in lambda, those where ink is too much, and the least fall by an
 * exchange as a share of the energy. Above a share of the most ink its penalty begins
 * with what it usually comes to: without it all become longer first. */
static const double NEAR_STEP = 0.03, NEAR_SHORTER = 0.1, NEAR_FALL = 0.01;
static const double NEAR_INK = 0.9, NEAR_INK_PENALTY = 0.64;

double fg__descent_most(const fg__place_domain *domain)
{
  const double least = FINEST * domain->data_step;
  const double most = domain->measure / pow(least, domain->dimension);
  return fmin(fmax(floor(most), ALWAYS), FG__MOST_ARROWS);
}

/* Refuses more icons than have room. */
static fg_status check_fineness(const fg__place_descent *descent, int count)
{
  if (count > FG__MOST_ARROWS)
    return fg__fail(descent->context, FG_STATUS_ARGUMENT,
                    "%d arrows are too many to be placed: %d can be", count,
                    FG__MOST_ARROWS);
  const double most = fg__descent_most(descent->domain);
  if (count <= most)
    return FG_STATUS_OK;
  return fg__fail(descent->context, FG_STATUS_ARGUMENT,
                  "%d arrows do not fit into this field: %.0f do, each for an eighth of "
                  "the distance between samples",
                  count, most);
}

fg_status fg__descent_fail(const fg__place_descent *descent, int wanted, int fitting)
{
  return fg__fail(descent->context, FG_STATUS_ARGUMENT,
                  "%d arrows do not fit into this field: %d do", wanted, fitting);
}

void fg__descent_clear(fg__place_descent *descent)
{
  if (descent->search)
    fg__place_search_clear(descent->search);
  free(descent->search);
  descent->search = NULL;
}

fg_status fg__descent_begin(fg__place_descent *descent, int count, fg__place_grain grain)
{
  fg_status status = check_fineness(descent, count);
  if (status != FG_STATUS_OK)
    return status;
  fg__descent_clear(descent);
  descent->search = fg__allocate(1, sizeof *descent->search);
  if (!descent->search)
    return fg__fail_memory(descent->context, "a placement", sizeof *descent->search);
  status =
      fg__place_search_create(descent->search, descent->context, descent->domain, count,
                              descent->options->lengths == FG_LENGTHS_FREE, grain);
  if (status != FG_STATUS_OK) {
    free(descent->search);
    descent->search = NULL;
    return status;
  }
  descent->search->threads = descent->threads;
  return FG_STATUS_OK;
}

/* Starts from icons, and from even points where these are fewer than `even`. */
static fg_status start(fg__place_descent *descent, int count, fg__place_grain grain,
                       int even, const fg_icons *clusters)
{
  fg_status status = fg__descent_begin(descent, count, grain);
  if (status != FG_STATUS_OK)
    return status;
  fg__place_search *search = descent->search;
  for (int n = 0; clusters && n < fg_icons_count(clusters) && status == FG_STATUS_OK;
       ++n) {
    fg__place_seed seed = fg__place_seed_of(fg_icons_at(clusters, n), &search->scale);
    bool added;
    status = fg__place_add(search, &added, &seed, search->next_identity);
    search->next_identity += added;
  }
  return status == FG_STATUS_OK ? fg__place_fill_evenly(search, even) : status;
}

static void adjust_penalty(fg__place_search *search, double share)
{
  const double change = (fg__place_ink(search) - WANTED_INK) / INK_PER_PENALTY;
  const double step = fmax(fmin(change, MOST_PENALTY_STEP), -MOST_PENALTY_STEP);
  if (search->scale.free)
    search->scale.ink = fmax(search->scale.ink + share * step, 0.0);
}

static bool has_other_ink(const fg__place_search *search)
{
  const double ink = fg__place_ink(search);
  return search->scale.free &&
         (ink > MOST_INK || (ink < LEAST_INK && search->scale.ink > 0.0));
}

/* Relaxes, and while there is too much or too little ink changes its penalty and relaxes
 * again, first by steps of `step` lambda. */
static fg_status descend(fg__place_search *search, int sweeps, double step)
{
  search->least_step = LAST_LEAST_STEP;
  fg_status status = fg__place_relax(search, sweeps);
  for (int n = 0; n < MOST_INK_STEPS && status == FG_STATUS_OK && has_other_ink(search);
       ++n) {
    adjust_penalty(search, 1.0);
    fg__place_reactivate_all(search, n > 0 ? SMALL_STEP : step);
    status = fg__place_relax(search, 2);
  }
  return status;
}

/* Raises the penalty of touching lines where too many do. A higher one from the start
 * would raise the error of regular arrangements, as of 150 arrows in a saddle. */
static fg_status part_lines(fg__place_search *search)
{
  double touching;
  fg_status status = fg__place_touching(search, &touching);
  for (int n = 0; n < MOST_PARTINGS && status == FG_STATUS_OK && touching > MOST_TOUCHING;
       ++n) {
    search->scale.touch *= TOUCH_GROWTH;
    fg__place_reactivate_all(search, SMALL_STEP);
    status = descend(search, 2, SMALL_STEP);
    if (status == FG_STATUS_OK)
      status = fg__place_touching(search, &touching);
  }
  return status;
}

/* Relaxes the icons, and adds or removes some until there are as many as the search is
 * for. */
static fg_status relax_to_count(fg__place_search *search)
{
  fg_status status = fg__place_relax(search, 2);
  if (status == FG_STATUS_OK)
    status = fg__place_complete(search);
  if (status == FG_STATUS_OK)
    status = fg__place_set_reference_error(search);
  if (status == FG_STATUS_OK)
    status = fg__place_relax(search, SETTLING);
  return status;
}

static int count_exchanges(const effort *work, int icons)
{
  if (icons <= MOST_EXCHANGED)
    return work->exchanges + icons / work->icons_an_exchange;
  const int most = work->exchanges + MOST_EXCHANGED / work->icons_an_exchange;
  return (int)((int64_t)most * MOST_EXCHANGED / icons);
}

fg_status fg__descent_refine(fg__place_descent *descent)
{
  fg__place_search *search = descent->search;
  const effort *work = &EFFORTS[descent->options->effort];
  fg_status status = FG_STATUS_OK;
  if (work->exchanges > 0)
    status = fg__place_exchange(search, count_exchanges(work, search->count),
                                work->failures, 0.0);
  if (status == FG_STATUS_OK) {
    fg__place_reactivate_all(search, 0.1);
    status = descend(search, work->sweeps, 0.2);
  }
  return status == FG_STATUS_OK ? part_lines(search) : status;
}

/* A step of the chain of scales, to fewer icons, which are a little longer. The result
 * depends on the icons' seeds alone, so that a run can be resumed from a file. */
static fg_status thin_to(fg__place_search *search, int count, bool is_last)
{
  fg_status status = fg__place_search_rescale(
      search, count, is_last ? FG__PLACE_FINE : FG__PLACE_COARSE);
  if (status == FG_STATUS_OK)
    status = fg__place_set_reference_error(search);
  fg__place_reactivate_all(search, CHAIN_STEP);
  if (status == FG_STATUS_OK)
    status = fg__place_relax(search, 2);
  /* then only the neighbours of removed icons move */
  fg__place_reactivate_all(search, 0.0);
  if (status == FG_STATUS_OK)
    status = fg__place_thin(search, count);
  if (status == FG_STATUS_OK)
    status = fg__place_complete(search);
  fg__place_reactivate_all(search, CHAIN_STEP);
  if (status == FG_STATUS_OK)
    status = fg__place_relax(search, is_last ? SETTLING : 1);
  adjust_penalty(search, CHAIN_SHARE);
  return status;
}

/* Steps from a number of icons to a smaller one, of about the same ratio. */
static int count_steps(int from, int to, double ratio)
{
  const double steps = ceil(log((double)from / to) / -log(ratio) - SHORT_OF_A_STEP);
  return steps > 1.0 ? (int)steps : 1;
}

/* The numbers between are roots of whole numbers, which are whole or irrational: none
 * lies half-way, and the last digit of pow does not matter. */
fg_status fg__descent_go_down(fg__place_descent *descent, int count, double ratio)
{
  fg__place_search *search = descent->search;
  fg_status status = FG_STATUS_OK;
  const int from = search->count;
  const int steps = count_steps(from, count, ratio);
  search->scale.ink = search->scale.first_ink;
  for (int n = 1; search->scale.count > count && status == FG_STATUS_OK; ++n) {
    const double part = (double)n / steps;
    const int next = (int)(from * pow((double)count / from, part) + 0.5);
    status = thin_to(search, n < steps ? next : count, n >= steps);
  }
  return status;
}

fg_status fg__descent_first(fg__place_descent *descent, int count,
                            const fg_icons *clusters, const fg__place_schedule *by)
{
  const int more = (int)fmin(by->start * count, fg__descent_most(descent->domain));
  const int first = more > count ? more : count;
  fg_status status =
      start(descent, first, first > count ? FG__PLACE_COARSE : FG__PLACE_FINE,
            (int)(EVEN_SHARE * first), clusters);
  if (status == FG_STATUS_OK)
    status = relax_to_count(descent->search);
  return status == FG_STATUS_OK ? fg__descent_go_down(descent, count, by->ratio) : status;
}

fg_status fg__descent_near(fg__place_descent *descent, int count, const fg_icons *icons)
{
  const effort *work = &EFFORTS[descent->options->effort];
  fg_status status = start(descent, count, FG__PLACE_FINE, 0, icons);
  if (status != FG_STATUS_OK)
    return status;
  fg__place_search *search = descent->search;
  if (search->scale.free && fg__place_ink(search) > NEAR_INK * MOST_INK)
    search->scale.ink = NEAR_INK_PENALTY;
  fg__place_reactivate_all(search, NEAR_STEP);
  status = relax_to_count(search);
  if (status == FG_STATUS_OK && work->exchanges > 0)
    status =
        fg__place_exchange(search, count_exchanges(work, search->count), 1, NEAR_FALL);
  return status == FG_STATUS_OK ? descend(search, work->sweeps, NEAR_SHORTER) : status;
}
