/* Moves of single icons that lower the energy. */
#include "place/search/search.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest step of moves in lambda, and the growth after a move that was accepted. */
static const double LARGEST_STEP = 0.35;
static const double GROWTH = 1.3;

/* A step shrinks by this factor where no move lowered the energy, that to the minimum of
 * the parabolas through the trials included. */
static const double SHRINKAGE = 0.35;

/* Ways from the seed in a free placement, in lambda. */
static const double SHORTEST_WAY = 0.1;

/* Ways that differ by less, in lambda, are the same. */
static const double SAME_WAY = 1e-6;

/* A move is taken when it lowers a region's energy by this share of it: more than the
 * sums' rounding. */
static const double LEAST_FALL = 1e-6;

/* A minimum of parabolas is tried where it promises this share. */
static const double LEAST_PROMISE = 1e-4;

/* Icons whose seeds are so many lambda from a change are its neighbours. */
static const double NEIGHBOURS = 1.3;

/* Half of the least distance between lines of icons that are visited in the same round,
 * about, in lambda. */
static const float BETWEEN = 1.0F;

/* The axes of moves: across (in 3D two directions), along, and the two ways. */
enum { ALONG = 2, WAYS = 3, AXES = 5, MOVES = 2 * AXES };

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
  fg__cross(direction, axis, out[0]);
  double size = fg__length(out[0]);
  for (int k = 0; k < 3; ++k)
    out[0][k] /= size;
  fg__cross(direction, out[0], out[1]);
  return 2;
}

/* The sample of a line an arc length from its seed, at its ends at most. */
static int sample_along(const fg__place_search *search, const fg__place_line *line,
                        double way)
{
  int n = line->seed;
  double left = fabs(way) / search->scale.sampling;
  while (left > 0.5 && n > 0 && n + 1 < line->count) {
    n += way < 0.0 ? -1 : 1;
    left -= 1.0;
  }
  return n;
}

/* Moves both ends of a line along the flow, as far as the ways are long enough. */
static void slide(double way[2], double step, double shortest)
{
  const int behind = step > 0.0 ? 0 : 1;
  const double most = fg__least(fabs(step), fg__most(way[behind] - shortest, 0.0));
  way[behind] -= most;
  way[1 - behind] += most;
}

/* A seed moved along its axes. A line of free length slides along the flow: its ways
 * change, and the seed stays. Across, it moves from its middle, which becomes the seed.
 */
static fg__place_seed moved(const fg__place_search *search, const fg__place_icon *icon,
                            const double step[AXES])
{
  const fg__place_scale *scale = &search->scale;
  const fg__place_line *line = &icon->line;
  const bool aside = step[0] != 0.0 || step[1] != 0.0;
  const double way = !scale->free ? step[ALONG]
                     : aside      ? (line->way[1] - line->way[0]) / 2.0
                                  : 0.0;
  const int from = sample_along(search, line, way);
  fg__place_seed seed = icon->seed;
  double direction[3], side[2][3];
  for (int k = 0; k < 3; ++k) {
    direction[k] = (double)line->tangent[k][from];
    if (from != line->seed)
      seed.position[k] =
          scale->origin[k] + (double)line->position[k][from] * scale->lambda;
  }
  if (scale->free) {
    seed.way[0] += (from - line->seed) * scale->sampling;
    seed.way[1] -= (from - line->seed) * scale->sampling;
    slide(seed.way, step[ALONG], SHORTEST_WAY * scale->lambda);
  }
  const int sides = across(side, scale->dimension, direction);
  for (int n = 0; n < sides; ++n)
    for (int k = 0; k < scale->dimension; ++k)
      seed.position[k] += step[n] * side[n][k];
  for (int n = 0; n < 2 && scale->free; ++n)
    seed.way[n] = fg__most(seed.way[n] + step[WAYS + n], SHORTEST_WAY * scale->lambda);
  return seed;
}

static bool is_too_long(const fg__place_scale *scale, const fg__place_seed *seed)
{
  return scale->free &&
         seed->way[0] + seed->way[1] > scale->longest + SAME_WAY * scale->lambda;
}

/* The seed after one of an icon's moves: to one side of an axis by its step. False where
 * there is no such move. */
static bool move_of(fg__place_seed *out, const fg__place_search *search,
                    const fg__place_icon *icon, int move)
{
  const fg__place_scale *scale = &search->scale;
  const int axis = move / 2;
  double step[AXES] = {0};
  if ((axis == 1 && scale->dimension == 2) || (axis >= WAYS && !scale->free))
    return false;
  step[axis] = move & 1 ? -icon->step : icon->step;
  *out = moved(search, icon, step);
  return !(scale->free && axis >= ALONG) ||
         (memcmp(out->way, icon->seed.way, sizeof out->way) != 0 &&
          !is_too_long(scale, out));
}

/* What a visit has found, which comes true after all of a round. */
typedef struct fg__place_visit {
  int index;          /* of the icon */
  fg__place_box room; /* of its tries, about: those of a round lie apart */
  bool taken;         /* another line is better: */
  fg__place_line line;
  fg__place_contribution contribution;
  fg__place_window window;
} visit;

void fg__place_visits_clear(fg__place_search *search)
{
  for (size_t n = 0; n < search->visit_count; ++n) {
    fg__place_contribution_clear(&search->visit[n].contribution);
    fg__place_window_clear(&search->visit[n].window);
  }
  free(search->visit);
  search->visit = NULL;
  search->visit_count = 0;
}

static void swap_contributions(fg__place_contribution *a, fg__place_contribution *b)
{
  fg__place_contribution kept = *a;
  *a = *b;
  *b = kept;
}

/* The energy of a region without the diffusion reader's errors, from the contributions of
 * all other icons and of a line in place of the icon's. */
static double region_energy(const fg__place_worker *worker, const fg__place_box *box,
                            const fg__place_contribution *contribution,
                            const fg__place_line *line)
{
  const fg__place_search *search = worker->search;
  return fg__place_cost(NULL, &search->raster, box, &worker->others, contribution,
                        &search->weights) +
         fg__place_line_penalty(&search->scale, &worker->beside, line);
}

static bool is_same_length(const fg__place_line *a, const fg__place_line *b,
                           double tolerance)
{
  return a->count == b->count && fabs(a->way[0] - b->way[0]) <= tolerance &&
         fabs(a->way[1] - b->way[1]) <= tolerance;
}

/* Shortens the ways of a seed in a free placement to those that its line reaches. A way
 * stays where the line would then be another: where it breaks or ends in a hook it is
 * shortened once more. So a seed always gives its icon's line. */
static void clip_ways(fg__place_icon *icon, const fg__place_search *search,
                      const fg__place_line *line)
{
  const fg__place_scale *scale = &search->scale;
  for (int k = 0; k < 2 && scale->free; ++k) {
    fg__place_seed clipped = icon->seed;
    fg__place_line other;
    clipped.way[k] = line->way[k];
    if (!(clipped.way[k] < icon->seed.way[k]))
      continue;
    fg__place_trace_on(&other, search->domain, scale, &clipped, &icon->steps);
    if (is_same_length(&other, line, SAME_WAY * scale->lambda))
      icon->seed = clipped;
  }
}

/* Extends a region to hold a box, and gathers the others' contributions to it again. */
static fg_status extend_region(fg__place_worker *worker, fg__place_box *region,
                               const fg__place_box *by, int index, double *now)
{
  const fg__place_icon *icon = worker->search->icon[index];
  fg__place_box_widen(region, by);
  fg_status status = fg__place_gather(worker, region, index);
  if (status == FG_STATUS_OK)
    *now = region_energy(worker, region, &icon->contribution, &icon->line);
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

/* A box widened by the step of an icon's moves. */
static fg__place_box widened(const fg__place_search *search, fg__place_box box,
                             double step)
{
  const fg__place_raster *raster = &search->raster;
  int cells = (int)(step / search->scale.cell) + 1;
  for (int k = 0; k < raster->dimension; ++k) {
    int low = box.low[k] - cells, end = box.low[k] + box.size[k] + cells;
    box.low[k] = low > 0 ? low : 0;
    box.size[k] = (end < raster->cells[k] ? end : raster->cells[k]) - box.low[k];
  }
  return box;
}

/* Tries a seed. *rise is what it adds to the energy; it is taken when that falls. */
static fg_status attempt(double *rise, visit *out, fg__place_worker *worker,
                         const fg__place_seed *seed, fg__place_box *region, double *now)
{
  const fg__place_search *search = worker->search;
  fg__place_icon *icon = search->icon[out->index];
  const bool stays =
      memcmp(seed->position, icon->seed.position, sizeof seed->position) == 0;
  fg__place_line line;
  fg__place_steps elsewhere;
  fg__place_no_steps(&elsewhere);
  fg__place_steps *steps = stays ? &icon->steps : &elsewhere;
  *rise = HUGE_VAL;
  fg__place_trace_on(&line, search->domain, &search->scale, seed, steps);
  if (line.count == 0)
    return FG_STATUS_OK;
  fg_status status = fg__place_contribution_compute(&worker->trial, NULL, &search->raster,
                                                    &search->scale, &line);
  if (status == FG_STATUS_OK && !holds(region, &worker->trial.box))
    status = extend_region(worker, region, &worker->trial.box, out->index, now);
  if (status != FG_STATUS_OK)
    return status;
  *rise = region_energy(worker, region, &worker->trial, &line) - *now;
  double diffusion;
  status = fg__place_diffusion_cost(&diffusion, worker, &icon->line, &line);
  if (status != FG_STATUS_OK)
    return status;
  *rise += diffusion;
  if (*rise < -LEAST_FALL * fabs(*now)) {
    const fg__place_window window = worker->window;
    worker->window = out->window;
    out->window = window;
    swap_contributions(&out->contribution, &worker->trial);
    out->line = line;
    out->taken = true;
    if (!stays)
      icon->steps = elsewhere;
    icon->seed = *seed;
    clip_ways(icon, search, &line);
  }
  return FG_STATUS_OK;
}

/* The step to the minimum of the parabolas through the energies beside an icon, of all
 * axes whose two trials are known; how much lower that lies. */
static double lowest(double step[AXES], const fg__place_icon *icon, double rise[AXES][2])
{
  double fall = 0.0;
  for (int axis = 0; axis < AXES; ++axis) {
    double both = rise[axis][0] + rise[axis][1], more = rise[axis][0] - rise[axis][1];
    step[axis] = 0.0;
    if (!(both > 0.0 && isfinite(both)))
      continue;
    step[axis] = -0.5 * icon->step * more / both;
    fall += 0.125 * more * more / both;
  }
  return fall;
}

/* Tries the icon's moves in turn, beginning with the one that was taken last, and takes
 * the first that lowers the energy; just after a move that one's opposite does not. Where
 * none does, the one to the minimum of the parabolas through them. */
static fg_status make_visit(void *argument, fg__place_worker *worker, int n)
{
  const fg__place_search *search = argument;
  visit *out = &search->visit[n];
  fg__place_icon *icon = search->icon[out->index];
  const int opposite = icon->has_moved ? icon->move ^ 1 : MOVES;
  double now, rise[AXES][2];
  for (int axis = 0; axis < AXES; ++axis)
    rise[axis][0] = rise[axis][1] = HUGE_VAL;
  fg__place_seed seed;
  fg__place_box region = widened(search, icon->contribution.box, icon->step);
  fg_status status =
      extend_region(worker, &region, &icon->contribution.box, out->index, &now);
  icon->has_moved = false;
  for (int k = 0; k < MOVES && status == FG_STATUS_OK; ++k) {
    const int move = (k + icon->move) % MOVES;
    if (move == opposite || !move_of(&seed, search, icon, move))
      continue;
    status = attempt(&rise[move / 2][move & 1], out, worker, &seed, &region, &now);
    if (out->taken) {
      icon->move = move;
      icon->has_moved = true;
      icon->step = fg__least(GROWTH * icon->step, LARGEST_STEP * search->scale.lambda);
      return status;
    }
  }
  double step[AXES], unused;
  if (status == FG_STATUS_OK && lowest(step, icon, rise) > LEAST_PROMISE * fabs(now)) {
    seed = moved(search, icon, step);
    if (!is_too_long(&search->scale, &seed))
      status = attempt(&unused, out, worker, &seed, &region, &now);
  }
  icon->step *= SHRINKAGE;
  return status;
}

/* Takes a visit's line over. */
static void keep(fg__place_search *search, visit *found)
{
  fg__place_icon *icon = search->icon[found->index];
  if (!found->taken)
    return;
  fg__place_diffusion_keep(&search->diffusion, &found->window, &icon->line, &found->line);
  fg__place_forget_removal_costs(search, &icon->contribution.box);
  fg__place_forget_removal_costs(search, &found->contribution.box);
  icon->line = found->line;
  swap_contributions(&icon->contribution, &found->contribution);
  search->box[found->index] = icon->contribution.box;
}

static bool is_apart(const visit *of, int count, const fg__place_box *room)
{
  for (int n = 0; n < count; ++n)
    if (fg__place_boxes_meet(&of[n].room, room))
      return false;
  return true;
}

/* Lists icons that still wait for a visit and lie apart; how many. */
static int list_round(fg__place_search *search)
{
  int count = 0;
  for (int n = 0; n < search->count; ++n) {
    fg__place_icon *icon = search->icon[n];
    if (!icon->waits)
      continue;
    const fg__place_box room = widened(
        search, fg__place_box_around(&search->raster, &icon->line, BETWEEN), icon->step);
    if (!is_apart(search->visit, count, &room))
      continue;
    visit *next = &search->visit[count++];
    next->index = n;
    next->room = room;
    next->taken = icon->waits = false;
  }
  return count;
}

/* Visits all icons that still move, in rounds of those that lie apart; *moving is whether
 * there are any. */
static fg_status sweep(fg__place_search *search, bool *moving)
{
  const size_t before = search->visit_count;
  if (!fg__grow((void **)&search->visit, &search->visit_count, (size_t)search->count,
                sizeof *search->visit))
    return fg__fail_memory(search->context, "visits of icons",
                           (size_t)search->count * sizeof *search->visit);
  for (size_t n = before; n < search->visit_count; ++n)
    search->visit[n] = (visit){.index = 0};
  *moving = false;
  for (int n = 0; n < search->count; ++n) {
    search->icon[n]->waits =
        search->icon[n]->step > search->least_step * search->scale.lambda;
    *moving = *moving || search->icon[n]->waits;
  }
  fg_status status = FG_STATUS_OK;
  int count;
  while (status == FG_STATUS_OK && (count = list_round(search)) > 0) {
    status = fg__place_share(search, make_visit, search, count);
    for (int n = 0; n < count && status == FG_STATUS_OK; ++n)
      keep(search, &search->visit[n]);
  }
  return status;
}

static fg_status relax(fg__place_search *search, int sweeps, bool solve)
{
  bool moving = true;
  fg_status status = FG_STATUS_OK;
  for (int n = 0; n < sweeps && moving && status == FG_STATUS_OK; ++n) {
    status = fg__check_stop(search->context);
    if (status == FG_STATUS_OK && solve)
      status = fg__place_diffusion_solve(&search->diffusion, search->context, true);
    if (status == FG_STATUS_OK)
      status = sweep(search, &moving);
  }
  return status;
}

fg_status fg__place_relax(fg__place_search *search, int sweeps)
{
  return relax(search, sweeps, true);
}

fg_status fg__place_relax_some(fg__place_search *search, int sweeps)
{
  return relax(search, sweeps, false);
}

void fg__place_reactivate(fg__place_search *search, const double place[3], double step)
{
  double near = NEIGHBOURS * search->scale.lambda;
  for (int n = 0; n < search->count; ++n) {
    fg__place_icon *icon = search->icon[n];
    double way[3];
    for (int k = 0; k < 3; ++k)
      way[k] = icon->seed.position[k] - place[k];
    if (fg__dot(way, way) < near * near)
      icon->step = fg__most(icon->step, step * search->scale.lambda);
  }
}

void fg__place_reactivate_all(fg__place_search *search, double step)
{
  for (int n = 0; n < search->count; ++n) {
    search->icon[n]->step = step * search->scale.lambda;
    search->icon[n]->move = 0;
    search->icon[n]->has_moved = false;
  }
}
