#include "place/placement.h"

#include "base/memory.h"
#include "icon/icons.h"
#include "place/search/even.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct effort {
  int sweeps;            /* of the descent */
  int exchanges;         /* of icons, */
  int icons_an_exchange; /* and one more for so many icons; 0: none */
  int failures;          /* exchanges in a row that may fail before they end */
  int first_others;      /* other placements that are tried of a first scale, */
  int others;            /* and of one that is reached from a finer one */
} effort;

static const effort EFFORTS[] = {[FG_EFFORT_NORMAL] = {14, 13, 30, 5, 1, 4},
                                 [FG_EFFORT_QUICK] = {8, 0, 0, 0, 0, 0},
                                 [FG_EFFORT_THOROUGH] = {14, 13, 30, 5, 4, 4}};

/* From so many icons on the number of exchanges falls: each takes time in proportion to
 * the number of icons and changes a smaller share of the picture. */
enum { MOST_EXCHANGED = 1500 };

/* The least spacing of icons, lambda, in distances between samples; and a number of icons
 * that any field may have. */
static const double FINEST = 0.125;
enum { ALWAYS = 200 };

/* Sweeps after the first scale is complete. */
enum { SETTLING = 3 };

typedef struct descent {
  double ratio; /* of the numbers of icons in a chain of scales */
  double start; /* of a first scale: icons where the chain begins, as a multiple of those
                   wanted */
} descent;

static const descent FIRST = {0.8, 1.25};

/* The descent ends in a local minimum that depends on where it starts. So other
 * placements are made, of a first scale from even points, and the best is kept. */
static const descent OTHERS[] = {{0.65, 1.5}, {0.72, 1.75}, {0.58, 1.75}, {0.5, 2.0}};

/* Where a hundredth of the lines touches others, an error counts as so many hundredths
 * more. */
static const double TOUCHING_COUNTS = 4.0;

/* Other placements start from a finer scale that has at least so many times as many
 * icons.
 */
static const double LEAST_FINER = 1.5;

/* Without FG_EFFORT_THOROUGH there are other placements in 2D only, of up to so many
 * icons of free or fair lengths. */
enum { FEW_FREE = 40, FEW_FAIR = 80 };

/* A coarser scale is reached in a chain of scales, whose numbers of icons fall by this
 * ratio; in each, icons move by so much. */
static const double CHAIN_RATIO = 0.8;
static const double CHAIN_STEP = 0.1; /* in lambda */

/* The most ink of a free placement (fg__place_ink); its penalty grows until that holds.
 */
static const double MOST_INK = 1.48;
static const double FIRST_INK_PENALTY = 0.25;
static const double INK_PENALTY_GROWTH = 1.6;
enum { MOST_INK_STEPS = 12 };

/* From icons of another placement, as of an animation's frame before, so that they stay:
 * the first steps, in lambda, those where ink is too much, and the least fall by an
 * exchange as a share of the energy. Above a share of the most ink its penalty begins
 * with what it usually comes to: without it all become longer first. */
static const double NEAR_STEP = 0.03, NEAR_SHORTER = 0.1, NEAR_FALL = 0.01;
static const double NEAR_INK = 0.9, NEAR_INK_PENALTY = 0.64;

struct fg_placement {
  fg_context *context;
  fg_placement_options options;
  fg__place_domain domain;
  fg__place_search search;
  bool begun;
};

const fg__place_search *fg__placement_search(const fg_placement *placement)
{
  return &placement->search;
}

fg_context *fg__placement_context(const fg_placement *placement)
{
  return placement->context;
}

const fg_field *fg__placement_field(const fg_placement *placement)
{
  return placement->domain.field;
}

fg_status fg_placement_create(fg_placement **out, fg_context *context,
                              const fg_field *field, const fg_placement_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "placement: no %s given",
                    out ? "field" : "place for the result");
  *out = NULL;
  if (options &&
      (options->effort < FG_EFFORT_NORMAL || options->effort > FG_EFFORT_THOROUGH ||
       options->lengths < FG_LENGTHS_FREE || options->lengths > FG_LENGTHS_FAIR))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "placement: effort %d or lengths %d is not known",
                    (int)options->effort, (int)options->lengths);
  fg_placement *placement = fg__allocate(1, sizeof *placement);
  if (!placement)
    return fg__fail_memory(context, "a placement", sizeof *placement);
  placement->context = context;
  if (options)
    placement->options = *options;
  fg_status status = fg__place_domain_create(&placement->domain, context, field);
  if (status != FG_STATUS_OK) {
    free(placement);
    return status;
  }
  *out = placement;
  return FG_STATUS_OK;
}

void fg_placement_destroy(fg_placement *placement)
{
  if (!placement)
    return;
  if (placement->begun)
    fg__place_search_clear(&placement->search);
  fg__place_domain_clear(&placement->domain);
  free(placement);
}

/* The most icons that are placed; more would be far smaller than the samples resolve. */
static double count_most(const fg_placement *placement)
{
  const fg__place_domain *domain = &placement->domain;
  const double least = FINEST * domain->data_step;
  const double most = domain->measure / pow(least, domain->dimension);
  return fmin(fmax(floor(most), ALWAYS), FG__MOST_ARROWS);
}

/* Refuses more icons than that. */
static fg_status check_fineness(const fg_placement *placement, int count)
{
  if (count > FG__MOST_ARROWS)
    return fg__fail(placement->context, FG_STATUS_ARGUMENT,
                    "%d arrows are too many to be placed: %d can be", count,
                    FG__MOST_ARROWS);
  const double most = count_most(placement);
  if (count <= most)
    return FG_STATUS_OK;
  return fg__fail(placement->context, FG_STATUS_ARGUMENT,
                  "%d arrows do not fit into this field: %.0f do, each for an eighth of "
                  "the distance between samples",
                  count, most);
}

/* Starts a search for `count` icons, of which there are none yet. */
static fg_status begin(fg_placement *placement, int count)
{
  fg_status fine = check_fineness(placement, count);
  if (fine != FG_STATUS_OK)
    return fine;
  if (placement->begun)
    fg__place_search_clear(&placement->search);
  placement->begun = false;
  fg_status status =
      fg__place_search_create(&placement->search, placement->context, &placement->domain,
                              count, placement->options.lengths == FG_LENGTHS_FREE);
  placement->begun = status == FG_STATUS_OK;
  return status;
}

static fg_status start(fg_placement *placement, int count, const fg_icons *clusters)
{
  fg__place_search *search = &placement->search;
  fg_status status = begin(placement, count);
  if (status != FG_STATUS_OK)
    return status;
  if (!clusters)
    return fg__place_start_even(search);
  for (int n = 0; n < fg_icons_count(clusters) && status == FG_STATUS_OK; ++n) {
    fg__place_seed seed = fg__place_seed_of(fg_icons_at(clusters, n), &search->scale);
    bool added;
    status = fg__place_add(search, &added, &seed, search->next_identity);
    search->next_identity += added;
  }
  if (status == FG_STATUS_OK && search->count == 0) /* all clusters were too small */
    status = fg__place_start_even(search);
  return status;
}

/* Adds an icon that was placed before. Where the domain is narrow it may be short. */
static fg_status add_again(fg_placement *placement, bool *added, const fg_icon *icon)
{
  fg__place_search *search = &placement->search;
  fg_status status = FG_STATUS_OK;
  fg__place_seed seed;
  memcpy(seed.position, icon->seed, sizeof seed.position);
  memcpy(seed.way, icon->way, sizeof seed.way);
  *added = false;
  if (icon->id < 1)
    return status;
  do
    status = fg__place_add(search, added, &seed, icon->id - 1);
  while (status == FG_STATUS_OK && !*added && fg__place_shorten(&search->scale));
  return status;
}

fg_status fg__placement_resume(fg_placement *placement, const fg_icons *icons,
                               int *missing)
{
  *missing = 0;
  fg_status status = begin(placement, fg_icons_count(icons));
  for (int n = 0; n < fg_icons_count(icons) && status == FG_STATUS_OK; ++n) {
    bool added;
    status = add_again(placement, &added, fg_icons_at(icons, n));
    *missing += !added;
  }
  placement->search.next_identity = fg__icons_next_id(icons) - 1;
  return status;
}

fg_status fg_placement_resume(fg_placement *placement, const fg_icons *icons)
{
  if (!placement || !icons || fg_icons_count(icons) < 1)
    return fg__fail(placement ? placement->context : NULL, FG_STATUS_ARGUMENT,
                    "placement: no icons to go on from");
  int missing;
  fg_status status = fg__placement_resume(placement, icons, &missing);
  if (status == FG_STATUS_OK && missing > 0)
    status = fg__fail(placement->context, FG_STATUS_ARGUMENT,
                      "placement: %d of %d icons were not placed on this field", missing,
                      fg_icons_count(icons));
  if (status != FG_STATUS_OK && placement->begun) {
    fg__place_search_clear(&placement->search);
    placement->begun = false;
  }
  return status;
}

/* Relaxes, and while the ink exceeds MOST_INK raises its penalty and relaxes again, by
 * steps of `step` lambda. */
static fg_status descend(fg__place_search *search, int sweeps, double step)
{
  fg_status status = fg__place_relax(search, sweeps);
  for (int n = 0; n < MOST_INK_STEPS && status == FG_STATUS_OK && search->scale.free &&
                  fg__place_ink(search) > MOST_INK;
       ++n) {
    search->scale.ink = fmax(search->scale.ink * INK_PENALTY_GROWTH, FIRST_INK_PENALTY);
    fg__place_reactivate_all(search, step);
    status = fg__place_relax(search, 2);
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

static fg_status refine(fg_placement *placement)
{
  fg__place_search *search = &placement->search;
  const effort *work = &EFFORTS[placement->options.effort];
  fg_status status = FG_STATUS_OK;
  if (work->exchanges > 0)
    status = fg__place_exchange(search, count_exchanges(work, search->count),
                                work->failures, 0.0);
  if (status == FG_STATUS_OK) {
    fg__place_reactivate_all(search, 0.1);
    status = descend(search, work->sweeps, 0.2);
  }
  return status;
}

/* A step of the chain of scales, to fewer icons, which are a little longer. The result
 * depends on the icons' seeds alone, so that a run can be resumed from a file. */
static fg_status thin_to(fg__place_search *search, int count)
{
  fg_status status = fg__place_search_rescale(search, count);
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
    status = fg__place_relax(search, 3);
  return status;
}

static fg_status go_down(fg_placement *placement, int count, double ratio)
{
  fg__place_search *search = &placement->search;
  fg_status status = FG_STATUS_OK;
  for (int now = search->count; search->scale.count > count && status == FG_STATUS_OK;) {
    int next = (int)(ratio * now);
    now = next > count ? next : count;
    status = thin_to(search, now);
  }
  return status;
}

static fg_status check_count(const fg_placement *placement, int count)
{
  if (placement->search.count >= count)
    return FG_STATUS_OK;
  return fg__fail(placement->context, FG_STATUS_ARGUMENT,
                  "%d arrows do not fit into this field: %d do", count,
                  placement->search.count);
}

/* Places a first scale: first more icons, as far as the field may have room for them,
 * of which those stay that tell most. */
static fg_status place_first(fg_placement *placement, int count, const fg_icons *clusters,
                             const descent *by)
{
  const int more = (int)fmin(by->start * count, count_most(placement));
  fg_status status = start(placement, more > count ? more : count, clusters);
  if (status == FG_STATUS_OK)
    status = relax_to_count(&placement->search);
  return status == FG_STATUS_OK ? go_down(placement, count, by->ratio) : status;
}

static bool are_placed(const fg_icons *icons)
{
  return icons && fg_icons_count(icons) > 0 && fg__place_is_placed(fg_icons_at(icons, 0));
}

/* Places icons near those of another placement. */
static fg_status place_near(fg_placement *placement, int count, const fg_icons *icons)
{
  fg__place_search *search = &placement->search;
  const effort *work = &EFFORTS[placement->options.effort];
  fg_status status = start(placement, count, icons);
  if (status != FG_STATUS_OK)
    return status;
  if (search->scale.free && fg__place_ink(search) > NEAR_INK * MOST_INK)
    search->scale.ink = NEAR_INK_PENALTY;
  fg__place_reactivate_all(search, NEAR_STEP);
  status = relax_to_count(search);
  if (status == FG_STATUS_OK && work->exchanges > 0)
    status =
        fg__place_exchange(search, count_exchanges(work, search->count), 1, NEAR_FALL);
  return status == FG_STATUS_OK ? descend(search, work->sweeps, NEAR_SHORTER) : status;
}

fg_status fg__placement_begin_again(fg_placement *placement, int count)
{
  fg_status status = place_first(placement, count, NULL, &FIRST);
  return status == FG_STATUS_OK ? refine(placement) : status;
}

/* Places `count` icons by a chain of scales from the finer scale `from`, or where that is
 * empty from evenly distributed points. */
static fg_status place_otherwise(fg_placement *placement, int count,
                                 const fg__place_snapshot *from, const descent *by)
{
  fg__place_search *search = &placement->search;
  fg_status status;
  if (from->count > 0) {
    status = fg__place_search_rescale(search, from->count);
    if (status == FG_STATUS_OK)
      status = fg__place_restore(search, from);
    if (status == FG_STATUS_OK)
      status = go_down(placement, count, by->ratio);
  } else {
    status = place_first(placement, count, NULL, by);
  }
  return status == FG_STATUS_OK ? refine(placement) : status;
}

/* How bad a placement is: the readers' error, and more where lines touch. */
static fg_status judge(fg__place_search *search, double *badness)
{
  double touching = 0.0;
  fg_status status = fg__place_error(search, badness);
  if (status == FG_STATUS_OK)
    status = fg__place_touching(search, &touching);
  *badness *= 1.0 + TOUCHING_COUNTS * touching;
  return status;
}

/* Tries another placement, and restores the present one where that is no better. */
static fg_status improve(fg_placement *placement, int count,
                         const fg__place_snapshot *from, const descent *by)
{
  fg__place_search *search = &placement->search;
  fg__place_snapshot best = {0};
  double before, after = HUGE_VAL;
  int next_identity = search->next_identity;
  fg_status status = judge(search, &before);
  if (status == FG_STATUS_OK)
    status = fg__place_remember(&best, search);
  if (status == FG_STATUS_OK)
    status = place_otherwise(placement, count, from, by);
  if (search->next_identity < next_identity) /* it began anew */
    search->next_identity = next_identity;
  if (status == FG_STATUS_OK)
    status = judge(search, &after);
  if (status == FG_STATUS_OK && (search->count < best.count || !(after < before))) {
    status = fg__place_search_rescale(search, best.count);
    if (status == FG_STATUS_OK)
      status = fg__place_restore(search, &best);
  }
  fg__place_snapshot_clear(&best);
  return status;
}

/* A first scale's icons have numbers without gaps. */
static void number_icons(fg__place_search *search)
{
  for (int n = 0; n < search->count; ++n)
    search->icon[n]->identity = n;
  search->next_identity = search->count;
}

/* How many other placements are tried. */
static int count_others(const fg_placement *placement, int count, bool is_first)
{
  const bool fair = placement->options.lengths == FG_LENGTHS_FAIR;
  const bool few =
      placement->domain.dimension == 2 && count <= (fair ? FEW_FAIR : FEW_FREE);
  const effort *work = &EFFORTS[placement->options.effort];
  int others = is_first ? work->first_others : work->others;
  if (placement->options.effort != FG_EFFORT_THOROUGH && !few)
    return 0;
  if (!is_first)
    return placement->search.count >= LEAST_FINER * count ? others : 0;
  while (others > 0 && OTHERS[others - 1].start * count > count_most(placement))
    --others;
  return others;
}

fg_status fg_placement_place(fg_placement *placement, int count, const fg_icons *clusters)
{
  if (!placement || count < 1)
    return fg__fail(placement ? placement->context : NULL, FG_STATUS_ARGUMENT,
                    "placement: %d arrows", count);
  fg__place_search *search = &placement->search;
  fg__place_snapshot finer = {0};
  fg_status status = FG_STATUS_OK;
  const bool is_first = !placement->begun || count > search->count;
  const bool is_near = is_first && are_placed(clusters);
  const int others = is_near ? 0 : count_others(placement, count, is_first);
  if (is_near) {
    status = place_near(placement, count, clusters);
  } else if (is_first) {
    status = place_first(placement, count, clusters, &FIRST);
  } else {
    if (others > 0)
      status = fg__place_remember(&finer, search);
    if (status == FG_STATUS_OK)
      status = go_down(placement, count, CHAIN_RATIO);
  }
  if (status == FG_STATUS_OK && !is_near)
    status = refine(placement);
  if (status == FG_STATUS_OK)
    status = check_count(placement, count);
  for (int n = 0; n < others && status == FG_STATUS_OK; ++n)
    status = improve(placement, count, &finer, &OTHERS[n]);
  if (status == FG_STATUS_OK && is_first)
    number_icons(search);
  fg__place_snapshot_clear(&finer);
  return status;
}
