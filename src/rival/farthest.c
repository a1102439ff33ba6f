#include "rival/farthest.h"

#include "base/memory.h"
#include "rival/method.h"
#include "rival/voids.h"

#include <math.h>
#include <stdlib.h>

/* The search for a separation ends when it is known to this share, or after so many
 * placings. */
static const double CLOSE = 0.01;
enum { ATTEMPTS = 24 };

/* No separation below so many cells is tried: seeds are cells. */
static const double NARROWEST = 1.5;

/* Steps of the search while one of its ends is not known. */
static const double WIDER = 1.5;

/* Of the cells only those left count from here on: a line through the others is short. */
typedef struct seeding {
  fg__placing placing;
  fg__voids voids;
  unsigned char *left_out;
} seeding;

/* The first seed is the cell farthest from the domain's boundary. */
static fg_status first_seed(seeding *work, int *cell)
{
  fg__voids inner;
  const fg__domain *domain = work->placing.domain;
  fg_status status = fg__voids_create(&inner, work->placing.context, domain);
  if (status != FG_STATUS_OK)
    return status;
  fg__voids_add_boundary(&inner);
  fg__voids_update(&inner);
  *cell = fg__voids_farthest(&inner, work->left_out);
  fg__voids_clear(&inner);
  return FG_STATUS_OK;
}

static fg_status place_all(seeding *work, int most)
{
  fg__placing *placing = &work->placing;
  const fg__domain *domain = placing->domain;
  double least = placing->lines->separation * placing->lines->separation;
  int cell = -1;
  fg_status status = first_seed(work, &cell);
  while (status == FG_STATUS_OK && cell >= 0 && work->voids.square[cell] >= least &&
         placing->lines->count < most) {
    double seed[3];
    bool kept;
    fg__domain_center(domain, cell, seed);
    work->left_out[cell] = 1;
    status = fg__placing_try(placing, seed, &kept);
    if (status == FG_STATUS_OK && kept) {
      for (int i = placing->first; i <= placing->last; i++)
        fg__voids_add(&work->voids, placing->points.position[i]);
      fg__voids_update(&work->voids);
    }
    cell = fg__voids_farthest(&work->voids, work->left_out);
  }
  return status;
}

fg_status fg__farthest_place(fg__lines *out, fg_context *context,
                             const fg__domain *domain, double separation, int most)
{
  seeding work = {0};
  size_t cells = (size_t)fg__domain_cell_count(domain);
  work.left_out = fg__allocate(cells, 1);
  fg_status status =
      work.left_out ? FG_STATUS_OK : fg__fail_memory(context, "seeds", cells);
  if (status == FG_STATUS_OK)
    status = fg__voids_create(&work.voids, context, domain);
  if (status == FG_STATUS_OK)
    status = fg__placing_start(&work.placing, context, domain, out, separation,
                               FG__FARTHEST_TEST, false);
  if (status == FG_STATUS_OK)
    status = place_all(&work, most);
  fg__placing_end(&work.placing);
  fg__voids_clear(&work.voids);
  free(work.left_out);
  return status;
}

/* Keeps the wider of two placings with enough lines, or the one with more. */
static void keep_better(fg__lines *best, fg__lines *tried, int count)
{
  bool enough = tried->count == count && best->count == count;
  if (enough ? tried->separation > best->separation : tried->count > best->count) {
    fg__lines other = *best;
    *best = *tried;
    *tried = other;
  }
}

fg_status fg__farthest_search(fg__lines *out, fg_context *context,
                              const fg__domain *domain, int count)
{
  fg__lines tried = {0};
  double separation = fg__domain_fair_share(domain, count) / 1.5, low = 0,
         high = HUGE_VAL, narrowest = NARROWEST * fg__domain_cell_size(domain);
  fg_status status = FG_STATUS_OK;
  out->count = 0;
  for (int i = 0; i < ATTEMPTS && high > low * (1 + CLOSE); i++) {
    separation = fmax(separation, narrowest);
    status = fg__farthest_place(&tried, context, domain, separation, count);
    if (status != FG_STATUS_OK)
      break;
    bool enough = tried.count == count;
    keep_better(out, &tried, count);
    if (enough)
      low = separation;
    else if (separation <= narrowest)
      break;
    else
      high = separation;
    separation = high == HUGE_VAL ? low * WIDER
                 : low == 0       ? high / WIDER
                                  : sqrt(low * high);
  }
  fg__lines_clear(&tried);
  return status;
}

fg_status fg__rival_farthest(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__lines lines = {0};
  fg_status status = fg__farthest_search(&lines, rival->context, &rival->domain, count);
  if (status == FG_STATUS_OK)
    status = fg__lines_draw(icons, rival->context, &rival->domain, &lines);
  fg__lines_clear(&lines);
  return status;
}
