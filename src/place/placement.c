#include "place/placement.h"

#include "base/memory.h"
#include "icon/icons.h"
#include "place/best.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where the flow crosses a thin domain all lines are short, and few arrows have long
 * ones: they become smaller as long as FEW_IN_ALL of them would fill the domain. */
static const double FEW_IN_ALL = 10000.0;

struct fg_placement {
  fg_placement_options options;
  fg__place_domain domain;
  fg__place_descent now; /* the present scale */
};

const fg__place_search *fg__placement_search(const fg_placement *placement)
{
  static const fg__place_search none = {.count = 0};
  return placement->now.search ? placement->now.search : &none;
}

fg_context *fg__placement_context(const fg_placement *placement)
{
  return placement->now.context;
}

const fg_field *fg__placement_field(const fg_placement *placement)
{
  return placement->domain.given;
}

/* As many as placements that are compared: in a round of visits more would mostly wait.
 */
enum { MOST_THREADS = 9 };

/* Ranks have their own work beside that of the one that places. */
static int count_threads(fg_context *context, const fg_placement_options *options)
{
  int rank, ranks;
  fg_ranks(context, &rank, &ranks);
  const int wanted = options->threads > 0 ? options->threads
                     : ranks > 1          ? 1
                                          : fg__threads_available();
  return wanted < MOST_THREADS ? wanted : MOST_THREADS;
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
  if (options && options->threads < 0)
    return fg__fail(context, FG_STATUS_ARGUMENT, "placement: %d threads",
                    options->threads);
  fg_placement *placement = fg__allocate(1, sizeof *placement);
  if (!placement)
    return fg__fail_memory(context, "a placement", sizeof *placement);
  if (options)
    placement->options = *options;
  placement->now = (fg__place_descent){
      .context = context, .domain = &placement->domain, .options = &placement->options};
  fg_status status = fg__place_domain_create(&placement->domain, context, field);
  if (status != FG_STATUS_OK) {
    free(placement);
    return status;
  }
  /* where no thread is to be had the caller does all */
  fg__threads_create(&placement->now.threads, NULL,
                     count_threads(context, &placement->options));
  *out = placement;
  return FG_STATUS_OK;
}

void fg_placement_destroy(fg_placement *placement)
{
  if (!placement)
    return;
  fg__descent_clear(&placement->now);
  fg__threads_destroy(placement->now.threads);
  fg__place_domain_clear(&placement->domain);
  free(placement);
}

/* Adds an icon that was placed before. Where the domain is narrow it may be short. */
static fg_status add_again(fg_placement *placement, bool *added, const fg_icon *icon)
{
  fg__place_search *search = placement->now.search;
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
  fg_status status =
      fg__descent_begin(&placement->now, fg_icons_count(icons), FG__PLACE_FINE);
  for (int n = 0; n < fg_icons_count(icons) && status == FG_STATUS_OK; ++n) {
    bool added;
    status = add_again(placement, &added, fg_icons_at(icons, n));
    *missing += !added;
  }
  if (placement->now.search)
    placement->now.search->next_identity = fg__icons_next_id(icons) - 1;
  return status;
}

fg_status fg_placement_resume(fg_placement *placement, const fg_icons *icons)
{
  if (!placement || !icons || fg_icons_count(icons) < 1)
    return fg__fail(placement ? placement->now.context : NULL, FG_STATUS_ARGUMENT,
                    "placement: no icons to go on from");
  int missing;
  fg_status status = fg__placement_resume(placement, icons, &missing);
  if (status == FG_STATUS_OK && missing > 0)
    status = fg__fail(placement->now.context, FG_STATUS_ARGUMENT,
                      "placement: %d of %d icons were not placed on this field", missing,
                      fg_icons_count(icons));
  if (status != FG_STATUS_OK)
    fg__descent_clear(&placement->now);
  return status;
}

/* A first scale's icons have numbers without gaps. */
static void number_icons(fg__place_search *search)
{
  for (int n = 0; n < search->count; ++n)
    search->icon[n]->identity = n;
  search->next_identity = search->count;
}

static bool are_placed(const fg_icons *icons)
{
  return icons && fg_icons_count(icons) > 0 && fg__place_is_placed(fg_icons_at(icons, 0));
}

fg_status fg__placement_begin_again(fg_placement *placement, int count)
{
  fg__place_descent *now = &placement->now;
  fg__descent_clear(now);
  placement->domain.small_arrows = 0;
  fg_status status = fg__place_best(now, count, NULL, true);
  if (status != FG_STATUS_ARGUMENT)
    return status;
  fg_context_clear(now->context); /* fewer fit */
  status = fg__descent_first(now, count, NULL, &fg__place_first_schedule);
  return status == FG_STATUS_OK ? fg__descent_refine(now) : status;
}

static fg_status place(fg_placement *placement, int count, const fg_icons *clusters)
{
  fg__place_descent *now = &placement->now;
  fg_status status;
  const bool is_first = !now->search || count > now->search->count;
  if (is_first && are_placed(clusters)) {
    status = fg__descent_near(now, count, clusters);
    if (status == FG_STATUS_OK && now->search->count < count)
      status = fg__descent_fail(now, count, now->search->count);
  } else {
    status = fg__place_best(now, count, clusters, is_first);
  }
  if (status == FG_STATUS_OK && is_first)
    number_icons(now->search);
  return status;
}

/* Whether arrows of half the length leave the rasters small. */
static bool may_be_smaller(const fg__place_domain *domain, int count)
{
  return count <= fg__descent_most(domain) &&
         ldexp(count, domain->dimension * (domain->small_arrows + 1)) <= FEW_IN_ALL;
}

fg_status fg_placement_place(fg_placement *placement, int count, const fg_icons *clusters)
{
  if (!placement || count < 1)
    return fg__fail(placement ? placement->now.context : NULL, FG_STATUS_ARGUMENT,
                    "placement: %d arrows", count);
  fg__place_domain *domain = &placement->domain;
  domain->small_arrows = 0;
  fg_status status = place(placement, count, clusters);
  while (status == FG_STATUS_ARGUMENT && may_be_smaller(domain, count)) {
    fg_context_clear(placement->now.context);
    fg__descent_clear(&placement->now);
    ++domain->small_arrows;
    status = place(placement, count, NULL);
  }
  return status;
}
