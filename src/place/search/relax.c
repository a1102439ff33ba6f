/* Moves of single icons that lower the energy. */
#include "place/search/search.h"

#include "place/angle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps of moves in lambda: where they begin, the largest, and below which an icon rests.
 */
static const double LARGEST_STEP = 0.35;
static const double SMALLEST_STEP = 0.02;
static const double GROWTH = 1.3;

/* Ways from the seed in a free placement, in lambda. */
static const double SHORTEST_WAY = 0.1;

/* A move is taken when it lowers a region's energy by this share of it: more than the
 * sums' rounding. */
static const double LEAST_FALL = 1e-6;

/* Icons whose seeds are so many lambda from a change are its neighbours. */
static const double NEIGHBOURS = 1.3;

/* Along, across, and the two ways; in 3D two directions across. */
enum { MOST_TRIALS = 10 };

/* Two unit vectors across a direction; the second only in 3D. */
static int across(double out[2][3], int dimension, const double direction[3])
{
  if (dimension == 2) {
    out[0][0] = -direction[1];
    out[0][1] = direction[0];
    out[0][2] = 0.0;
    return 1;
  }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (fabs(direction[k]) < fabs(direction[least]))
      least = k;
  double axis[3] = {0};
  axis[least] = 1.0;
  fg__place_cross(out[0], direction, axis);
  double size = fg__place_norm(out[0]);
  for (int k = 0; k < 3; ++k)
    out[0][k] /= size;
  fg__place_cross(out[1], direction, out[0]);
  return 2;
}

/* The place on a line an arc length from its seed, at its ends at most. */
static void along(double out[3], const fg__place_search *search,
                  const fg__place_line *line, double way)
{
  int n = line->seed;
  double left = fabs(way) / search->scale.sampling;
  while (left > 0.5 && n > 0 && n + 1 < line->count) {
    n += way < 0.0 ? -1 : 1;
    left -= 1.0;
  }
  for (int k = 0; k < 3; ++k)
    out[k] = search->domain->low[k] + (double)line->position[k][n] * search->scale.lambda;
}

/* The seeds that an icon may move to. */
static int list_trials(fg__place_seed trial[MOST_TRIALS], const fg__place_search *search,
                       const fg__place_icon *icon)
{
  const fg__place_scale *scale = &search->scale;
  double direction[3], side[2][3];
  int count = 0;
  for (int k = 0; k < 3; ++k)
    direction[k] = (double)icon->line.tangent[k][icon->line.seed];
  int sides = across(side, scale->dimension, direction);
  for (int n = 0; n < 2 * sides; ++n, ++count) {
    trial[count] = icon->seed;
    for (int k = 0; k < scale->dimension; ++k)
      trial[count].position[k] += (n & 1 ? -icon->step : icon->step) * side[n / 2][k];
  }
  for (int n = 0; n < 2; ++n, ++count) {
    trial[count] = icon->seed;
    along(trial[count].position, search, &icon->line, n ? -icon->step : icon->step);
  }
  for (int n = 0; n < 4 && scale->free; ++n) {
    fg__place_seed next = icon->seed;
    double *way = &next.way[n / 2];
    *way = fmax(*way + (n & 1 ? -icon->step : icon->step), SHORTEST_WAY * scale->lambda);
    if (*way != icon->seed.way[n / 2] && next.way[0] + next.way[1] <= scale->longest)
      trial[count++] = next;
  }
  return count;
}

static void swap_tales(fg__place_tale *a, fg__place_tale *b)
{
  fg__place_tale kept = *a;
  *a = *b;
  *b = kept;
}

/* The energy of a region, told by the others and a line. */
static double price(const fg__place_search *search, const fg__place_box *box,
                    const fg__place_tale *tale, const fg__place_line *line)
{
  return fg__place_cost(NULL, &search->raster, box, &search->others, tale,
                        &search->price) +
         fg__place_own_price(search, line);
}

/* A seed in a free placement has the ways that its line really goes. */
static void settle(fg__place_icon *icon, const fg__place_scale *scale)
{
  for (int k = 0; k < 2 && scale->free; ++k)
    icon->seed.way[k] =
        fmax(fmin(icon->seed.way[k], icon->line.way[k]), SHORTEST_WAY * scale->lambda);
}

/* Makes a region hold a box; what the others tell it is then gathered again. */
static fg_status extend_region(fg__place_search *search, fg__place_box *region,
                               const fg__place_box *by, int index, double *now)
{
  const fg__place_icon *icon = search->icon[index];
  fg__place_box_widen(region, by);
  fg_status status = fg__place_gather(&search->others, search, region, index);
  if (status == FG_STATUS_OK)
    *now = price(search, region, &icon->tale, &icon->line);
  return status;
}

static bool holds(const fg__place_box *box, const fg__place_box *other)
{
  for (int k = 0; k < 3; ++k)
    if (other->low[k] < box->low[k] ||
        other->low[k] + other->size[k] > box->low[k] + box->size[k])
      return false;
  return true;
}

/* The box with room for a move of the icon's step. */
static fg__place_box room_of(const fg__place_search *search, const fg__place_icon *icon)
{
  const fg__place_raster *raster = &search->raster;
  fg__place_box box = icon->tale.box;
  int cells = (int)(icon->step / search->scale.cell) + 1;
  for (int k = 0; k < raster->dimension; ++k) {
    int low = box.low[k] - cells, end = box.low[k] + box.size[k] + cells;
    box.low[k] = low > 0 ? low : 0;
    box.size[k] = (end < raster->cells[k] ? end : raster->cells[k]) - box.low[k];
  }
  return box;
}

/* Tries the icon's moves in turn, beginning with the one that was taken last, and takes
 * the first that lowers the energy. */
static fg_status visit(fg__place_search *search, int index)
{
  fg__place_icon *icon = search->icon[index];
  fg__place_seed trial[MOST_TRIALS];
  fg__place_line line;
  int count = list_trials(trial, search, icon);
  double now, after;
  fg__place_box region = room_of(search, icon);
  fg_status status = extend_region(search, &region, &icon->tale.box, index, &now);
  for (int k = 0; k < count && status == FG_STATUS_OK; ++k) {
    int n = (k + icon->move) % count;
    fg__place_trace(&line, search->domain, &search->scale, &trial[n]);
    if (line.count == 0)
      continue;
    status = fg__place_tell(&search->trial, search->context, &search->raster,
                            &search->scale, &line);
    if (status == FG_STATUS_OK && !holds(&region, &search->trial.box))
      status = extend_region(search, &region, &search->trial.box, index, &now);
    if (status != FG_STATUS_OK)
      return status;
    after = price(search, &region, &search->trial, &line);
    double diffusion;
    status = fg__place_diffusion_price(&diffusion, search, &icon->line, &line);
    if (status != FG_STATUS_OK)
      return status;
    after += diffusion;
    if (after < now - LEAST_FALL * fabs(now)) {
      fg__place_diffusion_keep(&search->diffusion, &icon->line, &line);
      icon->seed = trial[n];
      icon->line = line;
      icon->move = n;
      swap_tales(&icon->tale, &search->trial);
      settle(icon, &search->scale);
      icon->step = fmin(GROWTH * icon->step, LARGEST_STEP * search->scale.lambda);
      return FG_STATUS_OK;
    }
  }
  icon->step /= 2.0;
  return status;
}

fg_status fg__place_relax(fg__place_search *search, int sweeps)
{
  bool moving = true;
  fg_status status = FG_STATUS_OK;
  for (int sweep = 0; sweep < sweeps && moving && status == FG_STATUS_OK; ++sweep) {
    moving = false;
    status = fg__check_stop(search->context);
    if (status == FG_STATUS_OK)
      status = fg__place_diffusion_solve(&search->diffusion, search->context, true);
    for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n)
      if (search->icon[n]->step > SMALLEST_STEP * search->scale.lambda) {
        status = visit(search, n);
        moving = true;
      }
  }
  return status;
}

void fg__place_wake(fg__place_search *search, const double place[3], double step)
{
  double near = NEIGHBOURS * search->scale.lambda;
  for (int n = 0; n < search->count; ++n) {
    fg__place_icon *icon = search->icon[n];
    double way[3];
    for (int k = 0; k < 3; ++k)
      way[k] = icon->seed.position[k] - place[k];
    if (fg__place_dot(way, way) < near * near)
      icon->step = fmax(icon->step, step * search->scale.lambda);
  }
}

void fg__place_wake_all(fg__place_search *search, double step)
{
  for (int n = 0; n < search->count; ++n) {
    search->icon[n]->step = step * search->scale.lambda;
    search->icon[n]->move = 0;
  }
}
