#include "rival/streamline/evenly.h"

#include "base/memory.h"
#include "base/vector.h"
#include "icon/icons.h"
#include "rival/method.h"

#include <math.h>
#include <stdlib.h>

/* Seeds are tried beside every so many points of a line; in 3D on so many sides of it, as
 * lines packed most closely have them. */
enum { SEED_STRIDE = 4, SIDES_IN_SPACE = 6 };

/* A hair more than the separation, so that rounding does not put a seed too near to the
 * very point it was made from. */
static const double BESIDE = 1 + 1e-9;

/* Placing ends in the search after so many separations; the number of lines jumps with
 * it, so that not every number can be had. */
enum { ATTEMPTS = 16 };

/* A number of lines is met when it is missed by less than this share. */
static const double CLOSE = 0.02;

/* How the number of lines falls with the separation in 2D: between 1 (all as long as the
 * box) and 2 (all as long as they are apart); in 3D by one more. */
static const double FALL = 1.2;

static const double PI = 3.14159265358979323846;

typedef struct seeding {
  fg__placing placing;
  double (*side)[3]; /* seeds that wait: first those of the first line */
  size_t side_capacity;
  int sides, next_side;
} seeding;

/* Directions across a line; returns their number. */
static int find_sides(const seeding *work, const double tangent[3],
                      double side[SIDES_IN_SPACE][3])
{
  if (work->placing.domain->dimension == 2) {
    for (int n = 0; n < 2; n++) {
      side[n][0] = n ? -tangent[1] : tangent[1];
      side[n][1] = n ? tangent[0] : -tangent[0];
      side[n][2] = 0;
    }
    return 2;
  }
  double across[2][3];
  fg__any_normal(tangent, across[0]);
  fg__cross(tangent, across[0], across[1]);
  for (int n = 0; n < SIDES_IN_SPACE; n++) {
    double angle = 2 * PI * n / SIDES_IN_SPACE;
    for (int k = 0; k < 3; k++)
      side[n][k] = cos(angle) * across[0][k] + sin(angle) * across[1][k];
  }
  return SIDES_IN_SPACE;
}

/* Points on all sides of the line just placed wait to be tried as seeds. */
static fg_status add_sides(seeding *work)
{
  const fg__placing *placing = &work->placing;
  const fg__lines_points *points = &placing->points;
  int samples = (placing->last - placing->first) / SEED_STRIDE + 1;
  size_t most = (size_t)work->sides + SIDES_IN_SPACE * (size_t)samples;
  if (!fg__grow((void **)&work->side, &work->side_capacity, most, sizeof *work->side))
    return fg__fail_memory(placing->context, "seeds", most * sizeof *work->side);
  double away = BESIDE * placing->lines->separation;
  for (int i = placing->first; i <= placing->last; i += SEED_STRIDE) {
    double side[SIDES_IN_SPACE][3];
    int count = find_sides(work, points->tangent[i], side);
    for (int n = 0; n < count; n++)
      fg__add_scaled(points->position[i], away, side[n], work->side[work->sides++]);
  }
  return FG_STATUS_OK;
}

/* Tries a seed, and then all those beside the lines that come of it. */
static fg_status try_seeds(seeding *work, const double first[3])
{
  double seed[3] = {first[0], first[1], first[2]};
  for (;;) {
    bool kept;
    fg_status status = fg__placing_try(&work->placing, seed, &kept);
    if (status == FG_STATUS_OK && kept)
      status = add_sides(work);
    if (status != FG_STATUS_OK || work->next_side == work->sides)
      return status;
    const double *next = work->side[work->next_side++];
    for (int k = 0; k < 3; k++)
      seed[k] = next[k];
  }
}

/* The cell where the flow is fastest; the first of equal ones. */
static int fastest_cell(const fg__domain *domain)
{
  double fastest = -1;
  int found = 0, cells = fg__domain_cell_count(domain);
  for (int i = 0; i < cells; i++) {
    double center[3], velocity[3] = {0};
    fg__domain_center(domain, i, center);
    if (!domain->valid[i] || !fg_field_velocity(domain->field, center, velocity))
      continue;
    double speed = fg__dot(velocity, velocity);
    if (speed > fastest) {
      fastest = speed;
      found = i;
    }
  }
  return found;
}

static fg_status place_all(seeding *work)
{
  const fg__domain *domain = work->placing.domain;
  double seed[3] = {0};
  fg__domain_center(domain, fastest_cell(domain), seed);
  fg_status status = try_seeds(work, seed);
  /* what no line passes: parts behind masks, and places beside short lines */
  int cells = fg__domain_cell_count(domain);
  for (int i = 0; i < cells && status == FG_STATUS_OK; i++) {
    if (!domain->valid[i])
      continue;
    fg__domain_center(domain, i, seed);
    status = try_seeds(work, seed);
  }
  return status;
}

/* In 3D lines end at periodic boundaries: cut there, each would give many arrows. */
fg_status fg__evenly_place(fg__lines *out, fg_context *context, const fg__domain *domain,
                           double separation)
{
  seeding work = {0};
  fg_status status = fg__placing_start(&work.placing, context, domain, out, separation,
                                       FG__EVENLY_TEST, domain->dimension == 2);
  if (status == FG_STATUS_OK)
    status = place_all(&work);
  fg__placing_end(&work.placing);
  free(work.side);
  return status;
}

/* Nearer to the number, and of two as near the one with fewer lines. */
static bool is_better(int count, int best, int wanted)
{
  int miss = abs(count - wanted), least = abs(best - wanted);
  return best < 0 || miss < least || (miss == least && count < best);
}

/* The next separation to try: by the law of fall, or between those known to give too many
 * and too few. */
static double next_separation(const fg__domain *domain, double separation, int lines,
                              int count, double low, double high)
{
  double fall = domain->dimension - 2 + FALL;
  double guess = separation * pow(fmax(lines, 0.5) / count, 1 / fall);
  if (guess > low && guess < high)
    return guess;
  return low > 0 && high < HUGE_VAL ? sqrt(low * high) : guess;
}

fg_status fg__evenly_search(fg__lines *out, fg_context *context, const fg__domain *domain,
                            int count)
{
  fg__lines tried = {0};
  double separation = fg__domain_fair_share(domain, count) / 2, low = 0, high = HUGE_VAL;
  int best = -1;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < ATTEMPTS && (best < 0 || abs(best - count) > CLOSE * count); i++) {
    status = fg__evenly_place(&tried, context, domain, separation);
    if (status != FG_STATUS_OK)
      break;
    int lines = tried.count;
    if (is_better(lines, best, count)) {
      fg__lines other = *out;
      *out = tried;
      tried = other;
      best = lines;
    }
    if (lines > count)
      low = fmax(low, separation);
    else
      high = fmin(high, separation);
    separation = next_separation(domain, separation, lines, count, low, high);
  }
  fg__lines_clear(&tried);
  return status;
}

fg_status fg__rival_streamlines(fg_icons *icons, const fg_rival *rival, int count)
{
  fg__lines lines = {0};
  fg_status status = fg__evenly_search(&lines, rival->context, &rival->domain, count);
  if (status == FG_STATUS_OK)
    status = fg__lines_draw(icons, rival->context, &rival->domain, &lines);
  fg__lines_clear(&lines);
  return status;
}
