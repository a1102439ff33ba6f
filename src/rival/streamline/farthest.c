#include "rival/streamline/farthest.h"

#include "base/memory.h"
#include "rival/method.h"
#include "rival/streamline/voids.h"

#include <math.h>
#include <stdlib.h>

/* The search for a separation ends when it is known to this share, or after so many
 * placings. */
static const double CLOSE = 0.01;
enum { ATTEMPTS = 24 };

/* Where a raster is too coarse for the number, one of half the spacing is tried, up to so
 * many cells: 1025 nodes along the sides of a square, 145 along those of a cube. */
enum { MOST_CELLS = 3000000 };

/* No separation below so many cells is tried: seeds are cells. */
static const double NARROWEST = 1.5;

/* Steps of the search while one of its ends is not known. */
static const double WIDER = 1.5;

typedef struct seeding {
  fg__placing placing;
  fg__voids voids;
} seeding;

/* The first seed is the cell farthest from the domain's boundary. */
static fg_status first_seed(seeding *work, int *cell)
{
  fg__voids inner;
  const fg__placing *placing = &work->placing;
  fg_status status = fg__voids_create(&inner, placing->context, placing->domain);
  if (status != FG_STATUS_OK)
    return status;
  fg__voids_add_boundary(&inner);
  fg__voids_update(&inner);
  status = fg__voids_take_farthest(&inner, placing->context, cell);
  fg__voids_clear(&inner);
  return status;
}

/* Tries the line through a cell. */
static fg_status try_cell(seeding *work, int cell)
{
  fg__placing *placing = &work->placing;
  double seed[3];
  bool kept;
  fg__domain_center(placing->domain, cell, seed);
  fg_status status = fg__placing_try(placing, seed, &kept);
  if (status != FG_STATUS_OK || !kept)
    return status;
  for (int i = placing->first; i <= placing->last; i++)
    fg__voids_add(&work->voids, placing->points.position[i]);
  fg__voids_update(&work->voids);
  return FG_STATUS_OK;
}

static fg_status place_all(seeding *work, int most)
{
  const fg__lines *lines = work->placing.lines;
  double least = lines->separation * lines->separation;
  int cell = -1;
  fg_status status = first_seed(work, &cell);
  while (status == FG_STATUS_OK && cell >= 0 && work->voids.square[cell] >= least &&
         lines->count < most) {
    status = try_cell(work, cell);
    if (status == FG_STATUS_OK)
      status = fg__voids_take_farthest(&work->voids, work->placing.context, &cell);
  }
  return status;
}

fg_status fg__farthest_place(fg__lines *out, fg_context *context,
                             const fg__domain *domain, double separation, int most)
{
  seeding work = {0};
  fg_status status = fg__voids_create(&work.voids, context, domain);
  if (status == FG_STATUS_OK)
    status = fg__placing_start(&work.placing, context, domain, out, separation,
                               FG__FARTHEST_TEST, false);
  if (status == FG_STATUS_OK)
    status = place_all(&work, most);
  fg__placing_end(&work.placing);
  fg__voids_clear(&work.voids);
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

/* Places lines on a raster and draws them, unless they are too few and `finer` rasters
 * are left to be tried: then *enough is false, and nothing is drawn. */
static fg_status draw_on(fg_icons *icons, const fg_rival *rival, const fg__domain *domain,
                         int count, bool finer, bool *enough)
{
  fg__lines lines = {0};
  fg_status status = fg__farthest_search(&lines, rival->context, domain, count);
  *enough = lines.count == count || !finer;
  if (status == FG_STATUS_OK && *enough)
    status = fg__lines_draw(icons, rival->context, domain, &lines);
  fg__lines_clear(&lines);
  return status;
}

fg_status fg__rival_farthest(fg_icons *icons, const fg_rival *rival, int count)
{
  const fg__domain *given = &rival->domain;
  int nodes = rival->options.nodes;
  double cells = fg__domain_cell_count(given), growth = given->dimension == 2 ? 4 : 8;
  bool finer = growth * cells <= MOST_CELLS, enough = false;
  fg_status status = draw_on(icons, rival, given, count, finer, &enough);
  while (!enough && status == FG_STATUS_OK) {
    fg__domain domain;
    nodes = 2 * nodes - 1;
    status = fg__domain_create(&domain, rival->context, given->field, nodes);
    if (status != FG_STATUS_OK)
      return status;
    finer = growth * fg__domain_cell_count(&domain) <= MOST_CELLS;
    status = draw_on(icons, rival, &domain, count, finer, &enough);
    fg__domain_clear(&domain);
  }
  return status;
}
