#include "place/search.h"

#include "base/memory.h"
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

/* The readers' error counts by its own size, but not below this many degrees: where most
 * of the field is told well, icons would gather in what is left. 8 in place of 4 lowers
 * E_ang by 3 % in smooth fields (geometric mean of six). */
static const double LEAST_ERROR = 8.0;

/* Shorter than this many lambda costs nu times the square of what is missing. */
static const double BRIEF = 0.8;

/* A move is taken when it lowers a region's energy by this share of it: more than the
 * sums' rounding. */
static const double LEAST_FALL = 1e-6;

/* Icons whose seeds are so many lambda from a change are its neighbours. */
static const double NEIGHBOURS = 1.3;

/* Along, across, and the two ways; in 3D two directions across. */
enum { MOST_TRIALS = 10 };

static double reach_of(const fg__place_search *search)
{
  return search->scale.reach / search->scale.lambda;
}

static fg_status set_scale(fg__place_search *search, int count, bool free)
{
  search->scale =
      fg__place_scale_of(search->domain->dimension, count, search->domain->measure, free);
  fg_status status = fg__place_raster_create(&search->raster, search->context,
                                             search->domain, &search->scale);
  if (status != FG_STATUS_OK)
    return status;
  search->map = fg__allocate(search->raster.count, sizeof *search->map);
  search->smooth = fg__allocate(search->raster.count, sizeof *search->smooth);
  if (!search->map || !search->smooth)
    return fg__fail_memory(search->context, "a map of errors",
                           2 * search->raster.count * sizeof *search->map);
  search->price = (fg__place_price){.inverse_error = (float)(1.0 / search->error),
                                    .far = (float)search->scale.far,
                                    .reach = (float)reach_of(search)};
  return FG_STATUS_OK;
}

static void clear_scale(fg__place_search *search)
{
  fg__place_raster_clear(&search->raster);
  free(search->map);
  free(search->smooth);
  search->map = search->smooth = NULL;
}

fg_status fg__place_search_create(fg__place_search *out, fg_context *context,
                                  const fg__place_domain *domain, int count, bool free)
{
  *out = (fg__place_search){.domain = domain, .context = context, .error = 30.0};
  fg_status status = set_scale(out, count, free);
  if (status != FG_STATUS_OK)
    fg__place_search_clear(out);
  return status;
}

static void free_icon(fg__place_icon *icon)
{
  fg__place_tale_clear(&icon->tale);
  free(icon);
}

void fg__place_search_clear(fg__place_search *search)
{
  for (int n = 0; n < search->count; ++n)
    free_icon(search->icon[n]);
  free(search->icon);
  clear_scale(search);
  fg__place_tale_clear(&search->others);
  fg__place_tale_clear(&search->trial);
  fg__place_tale_clear(&search->whole);
  *search = (fg__place_search){0};
}

static fg_status tell(fg__place_search *search, fg__place_tale *out,
                      const fg__place_line *line)
{
  return fg__place_tell(out, search->context, &search->raster, &search->scale, line);
}

fg_status fg__place_search_rescale(fg__place_search *search, int count)
{
  double before = search->scale.lambda;
  bool free = search->scale.free;
  clear_scale(search);
  fg_status status = set_scale(search, count, free);
  double grown = search->scale.lambda / before;
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n) {
    fg__place_icon *icon = search->icon[n];
    for (int k = 0; k < 2; ++k)
      icon->seed.way[k] *= grown;
    icon->step *= grown;
    fg__place_trace(&icon->line, search->domain, &search->scale, &icon->seed);
    if (icon->line.count == 0)
      fg__place_drop(search, n--);
    else
      status = tell(search, &icon->tale, &icon->line);
  }
  return status;
}

fg_status fg__place_add(fg__place_search *search, bool *added, const fg__place_seed *seed,
                        int identity)
{
  *added = false;
  fg__place_icon *icon = fg__allocate(1, sizeof *icon);
  if (!icon || !fg__grow((void **)&search->icon, &search->capacity,
                         (size_t)search->count + 1, sizeof(fg__place_icon *))) {
    free(icon);
    return fg__fail_memory(search->context, "an icon", sizeof *icon);
  }
  icon->seed = *seed;
  icon->step = 0.25 * search->scale.lambda;
  icon->identity = identity;
  fg__place_trace(&icon->line, search->domain, &search->scale, seed);
  fg_status status = FG_STATUS_OK;
  if (icon->line.count > 0)
    status = tell(search, &icon->tale, &icon->line);
  if (status != FG_STATUS_OK || icon->line.count == 0) {
    free_icon(icon);
    return status;
  }
  search->icon[search->count++] = icon;
  *added = true;
  return FG_STATUS_OK;
}

void fg__place_drop(fg__place_search *search, int index)
{
  free_icon(search->icon[index]);
  --search->count;
  memmove(&search->icon[index], &search->icon[index + 1],
          (size_t)(search->count - index) * sizeof(fg__place_icon *));
}

fg_status fg__place_gather(fg__place_tale *out, fg__place_search *search,
                           const fg__place_box *box, int except)
{
  fg_status status = fg__place_tale_start(out, search->context, search->scale.dimension,
                                          box, (float)reach_of(search));
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n)
    if (n != except)
      fg__place_tale_add(out, &search->icon[n]->tale);
  return status;
}

/* exp(-x) for x >= 0 as (1 - x / 8)^8: the same bits everywhere, and 0 from 8 on. */
static double decay(double x)
{
  double f = 1.0 - x / 8.0;
  f = f > 0.0 ? f * f : 0.0;
  return f * f * f * f;
}

/* A head that touches another arrow's tail makes one arrow of two. */
static double price_of_ends(const fg__place_search *search, const fg__place_line *line,
                            const fg__place_tale *others)
{
  const fg__place_scale *scale = &search->scale;
  double sum = 0.0;
  for (int end = 0; end < 2; ++end) {
    int n = end && line->count > 0 ? line->count - 1 : 0;
    float position[3] = {line->position[0][n], line->position[1][n],
                         line->position[2][n]};
    double square =
        (double)fg__place_near(&search->raster, others, position, search->price.reach);
    double near = fmax(0.0, 1.0 - sqrt(square) * scale->lambda / scale->end_gap);
    sum += scale->ends * near * near;
  }
  return sum;
}

double fg__place_own_price(const fg__place_search *search, const fg__place_line *line,
                           const fg__place_tale *others)
{
  const fg__place_scale *scale = &search->scale;
  double range = scale->crowd_range / scale->lambda, crowd = 0.0;
  double sampling = scale->sampling / scale->lambda,
         length = line->length / scale->lambda;
  for (int n = 0; n < line->count; ++n) {
    float position[3] = {line->position[0][n], line->position[1][n],
                         line->position[2][n]};
    double square =
        (double)fg__place_near(&search->raster, others, position, search->price.reach);
    crowd += (double)line->share[n] * sampling * decay(square / (2.0 * range * range));
  }
  double brief = fmax(0.0, BRIEF - length);
  return 2.0 * scale->crowding * crowd + price_of_ends(search, line, others) +
         scale->brevity * brief * brief + scale->ink * length;
}

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

static void widen(fg__place_box *box, const fg__place_box *by)
{
  if (fg__place_box_count(by) == 0)
    return;
  for (int k = 0; k < 3; ++k) {
    int end = box->low[k] + box->size[k], other = by->low[k] + by->size[k];
    box->low[k] = box->low[k] < by->low[k] ? box->low[k] : by->low[k];
    box->size[k] = (end > other ? end : other) - box->low[k];
  }
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
         fg__place_own_price(search, line, &search->others);
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
  widen(region, by);
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
    status = tell(search, &search->trial, &line);
    if (status == FG_STATUS_OK && !holds(&region, &search->trial.box))
      status = extend_region(search, &region, &search->trial.box, index, &now);
    if (status != FG_STATUS_OK)
      return status;
    after = price(search, &region, &search->trial, &line);
    if (after < now - LEAST_FALL * fabs(now)) {
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

static fg_status gather_whole(fg__place_search *search)
{
  fg__place_box all = {{0}, {0}};
  memcpy(all.size, search->raster.cells, sizeof all.size);
  return fg__place_gather(&search->whole, search, &all, -1);
}

fg_status fg__place_weigh(fg__place_search *search)
{
  fg_status status = gather_whole(search);
  if (status != FG_STATUS_OK)
    return status;
  double error = fg__place_mean_error(&search->raster, &search->whole, reach_of(search));
  search->error = fmax(error, LEAST_ERROR);
  search->price.inverse_error = (float)(1.0 / search->error);
  return FG_STATUS_OK;
}

fg_status fg__place_energy(fg__place_search *search, double *energy)
{
  fg_status status = gather_whole(search);
  *energy = 0.0;
  if (status == FG_STATUS_OK)
    *energy = fg__place_cost(NULL, &search->raster, &search->whole.box, &search->whole,
                             NULL, &search->price);
  for (int n = 0; n < search->count && status == FG_STATUS_OK; ++n) {
    fg__place_icon *icon = search->icon[n];
    status = fg__place_gather(&search->others, search, &icon->tale.box, n);
    if (status == FG_STATUS_OK) /* a pair crowds once */
      *energy += fg__place_own_price(search, &icon->line, &search->others);
  }
  return status;
}

double fg__place_ink(const fg__place_search *search)
{
  double sum = 0.0;
  for (int n = 0; n < search->count; ++n)
    sum += search->icon[n]->line.length;
  return sum / (search->scale.count * search->scale.lambda);
}
