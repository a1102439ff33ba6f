#include "icon/choose.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of the cluster that the arrow is compared with; more change the choice no more.
 */
enum { SAMPLES = 150, ARROW_SAMPLES = 32 };

/* Other places on the spine to start from, in parts of its length. */
static const double PLACES[] = {0.35, 0.65, 0.2, 0.8};
static const double RING_PLACES[] = {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875};

/* Starts beside the centre, in distances to the border there; at half radius an arrow
 * round the core of a vortex has as much room inside as outside. */
static const double ASIDE[] = {0.45, -0.45};
static const double HALF_RADIUS = 0.5;

/* A cluster whose spine is shorter than this many of its radii is a disc: the spine has
 * no direction worth the name. */
static const double DISC = 2.0;

/* Where the best arrow is shorter than this share of the spine, restless or slim (in
 * lengths), the flow leaves the cluster across it or is rough: then points all over the
 * cluster are tried as well, at most so many. */
static const double SHORT = 0.65;
static const double RESTLESS = 1.25;
static const double SLIM = 0.045;
enum { SPREAD = 16 };

/* No line is traced from where one has passed already: nearer than this share of the
 * distance from the centre to the border. */
static const double PASSED = 0.2;

/* The best line so far is shifted sideways by this share of the distance to the border,
 * then by half of it. */
static const double SHIFT = 0.2;
enum { SHIFTS = 1 };

/* An arrow stands for the points of the cluster up to about this share of the spine's
 * length from it: which ones lie farther away counts less and less. */
static const double REACH = 0.2;

/* A choice that keeps 20 % more distance from the cluster's points is as good when its
 * arrow is twice as wide. */
static const double WIDTH_WORTH = 0.25;

typedef struct candidate_search {
  fg__chooser *chooser;
  fg_context *context;
  const fg_field *field;
  const fg__window *window;
  const fg__room *room;
  fg__streamline_limits limits;
  int passed_reach; /* in nodes */
  double reach;     /* square of the distance that an arrow stands for */
  fg__arrow arrow;  /* best so far */
  double cost;
} candidate_search;

/* Longest step: no longer than a cell of the data, where the bilinear field has its
 * bends. */
static double step_limit(const fg_field *field, const fg__window *window)
{
  const fg_field_arrays *contents = fg_field_contents(field);
  double step = fmin(window->spacing[0], window->spacing[1]);
  for (int a = 0; a < 2; a++) {
    int n = contents->size[a];
    step = fmin(step, (contents->axis[a][n - 1] - contents->axis[a][0]) / (n - 1));
  }
  return step;
}

/* Nodes inside the cluster, every stride-th along both axes. */
static fg_status collect_samples(const candidate_search *search)
{
  const fg__window *window = search->window;
  fg__chooser *chooser = search->chooser;
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1], inside = 0;
  for (size_t i = 0; i < nodes; i++)
    inside += window->level[i] > 0;
  int stride = (int)ceil(sqrt((double)inside / SAMPLES));
  if (stride < 1)
    stride = 1;
  chooser->sample_count = 0;
  for (int j = (window->nodes[1] - 1) % stride / 2; j < window->nodes[1]; j += stride)
    for (int i = (window->nodes[0] - 1) % stride / 2; i < window->nodes[0]; i += stride) {
      if (!(window->level[j * window->nodes[0] + i] > 0))
        continue;
      if (!fg__grow((void **)&chooser->sample, &chooser->sample_capacity,
                    (size_t)chooser->sample_count + 1, sizeof *chooser->sample))
        return fg__fail_memory(search->context, "points of a cluster",
                               ((size_t)chooser->sample_count + 1) *
                                   sizeof *chooser->sample);
      double *sample = chooser->sample[chooser->sample_count++];
      sample[0] = window->origin[0] + i * window->spacing[0];
      sample[1] = window->origin[1] + j * window->spacing[1];
    }
  return FG_STATUS_OK;
}

/* Root of the mean square distance from the cluster's points to a part of the line just
 * tried, weighed with an arrow's width: the less the better. */
static double cost_of(const candidate_search *search, double tail, double tip,
                      double width)
{
  const fg__chooser *chooser = search->chooser;
  double line[ARROW_SAMPLES][2], tangent[2], sum = 0;
  int hint = 0;
  for (int k = 0; k < ARROW_SAMPLES; k++)
    fg__streamline_at(&chooser->tried, tail + (tip - tail) * k / (ARROW_SAMPLES - 1),
                      &hint, line[k], tangent);
  for (int i = 0; i < chooser->sample_count; i++) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < ARROW_SAMPLES; k++) {
      double dx = line[k][0] - chooser->sample[i][0];
      double dy = line[k][1] - chooser->sample[i][1];
      double square = dx * dx + dy * dy;
      nearest = square < nearest ? square : nearest;
    }
    sum += nearest / (nearest + search->reach);
  }
  double rms = sqrt(sum / fmax(chooser->sample_count, 1));
  return rms / pow(width, WIDTH_WORTH);
}

/* The node next to a point, or -1 outside the window. */
static int node_at(const fg__window *window, const double point[2], int place[2])
{
  for (int a = 0; a < 2; a++) {
    double x = (point[a] - window->origin[a]) / window->spacing[a] + 0.5;
    if (!(x >= 0) || !(x < window->nodes[a]))
      return -1;
    place[a] = (int)x;
  }
  return place[1] * window->nodes[0] + place[0];
}

static void mark_passed(const candidate_search *search)
{
  const fg__streamline *line = &search->chooser->tried;
  int place[2];
  for (int i = 0; i < line->count; i++) {
    int node = node_at(search->window, line->node[i].position, place);
    if (node >= 0)
      search->chooser->passed[node] = 1;
  }
}

/* Whether a line has passed near a point. */
static bool was_passed(const candidate_search *search, const double point[2])
{
  const fg__window *window = search->window;
  int place[2], reach = search->passed_reach;
  if (node_at(window, point, place) < 0)
    return true;
  for (int y = place[1] - reach; y <= place[1] + reach; y++)
    for (int x = place[0] - reach; x <= place[0] + reach; x++)
      if (x >= 0 && y >= 0 && x < window->nodes[0] && y < window->nodes[1] &&
          search->chooser->passed[y * window->nodes[0] + x])
        return true;
  return false;
}

/* Tries the streamline through a point. */
static fg_status consider(candidate_search *search, const double start[2])
{
  fg__chooser *chooser = search->chooser;
  fg_status status = fg__streamline_trace(&chooser->tried, search->context, search->field,
                                          search->window, start, &search->limits);
  if (status != FG_STATUS_OK || chooser->tried.count < 2)
    return status;
  mark_passed(search);
  /* an arrow takes a part of the line: it can only be farther from the cluster's points
   */
  double length = fg__streamline_length(&chooser->tried);
  double widest = fg__arrow_widest(length, search->room->spacing);
  if (cost_of(search, 0, length, widest) >= search->cost)
    return FG_STATUS_OK;
  fg__arrow arrow;
  status = fg__arrow_fit(&arrow, search->context, &chooser->tried, search->room,
                         &chooser->stations);
  if (status != FG_STATUS_OK || !(arrow.width > 0))
    return status;
  double cost = cost_of(search, arrow.tail, arrow.tip, arrow.width) * arrow.unrest;
  if (cost < search->cost) {
    fg__streamline line = chooser->best;
    chooser->best = chooser->tried;
    chooser->tried = line;
    search->cost = cost;
    search->arrow = arrow;
  }
  return FG_STATUS_OK;
}

/* The same, but for points where a line has passed. */
static fg_status consider_unpassed(candidate_search *search, double x, double y)
{
  double start[2] = {x, y};
  return was_passed(search, start) ? FG_STATUS_OK : consider(search, start);
}

/* Tries points at multiples of a radius beside a point, along a direction. */
static fg_status consider_aside(candidate_search *search, const double center[2],
                                const double direction[2], double radius,
                                const double *multiple, size_t count)
{
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < count && status == FG_STATUS_OK; i++)
    status = consider_unpassed(search, center[0] + multiple[i] * radius * direction[0],
                               center[1] + multiple[i] * radius * direction[1]);
  return status;
}

/* Unit normal of the flow; the first axis where there is no flow. */
static void find_normal(const candidate_search *search, const double position[2],
                        double normal[2])
{
  double tangent[3] = {0}, size = 0;
  if (fg_field_tangent(search->field, position, tangent))
    size = hypot(tangent[0], tangent[1]);
  normal[0] = size > 0 ? -tangent[1] / size : 1;
  normal[1] = size > 0 ? tangent[0] / size : 0;
}

static fg_status consider_spine(candidate_search *search, const fg__spine *spine)
{
  const double *place = spine->closed ? RING_PLACES : PLACES;
  size_t count = spine->closed ? sizeof RING_PLACES / sizeof *RING_PLACES
                               : sizeof PLACES / sizeof *PLACES;
  fg_status status = FG_STATUS_OK;
  for (size_t i = 0; i < count && status == FG_STATUS_OK; i++) {
    int index = (int)lround(place[i] * (spine->count - 1));
    if (spine->closed)
      index = (spine->center + index) % spine->count;
    status = consider_unpassed(search, spine->point[index][0], spine->point[index][1]);
  }
  return status;
}

static fg_status consider_center(candidate_search *search, const double center[2],
                                 double radius, bool disc)
{
  static const double around[] = {HALF_RADIUS, -HALF_RADIUS};
  fg_status status = consider(search, center);
  if (status != FG_STATUS_OK)
    return status;
  double normal[2];
  find_normal(search, center, normal);
  status =
      consider_aside(search, center, normal, radius, ASIDE, sizeof ASIDE / sizeof *ASIDE);
  if (status == FG_STATUS_OK && disc) {
    double along[2] = {normal[1], -normal[0]};
    status = consider_aside(search, center, normal, radius, around, 2);
    if (status == FG_STATUS_OK)
      status = consider_aside(search, center, along, radius, around, 2);
  }
  return status;
}

/* Tries some of the cluster's points, evenly taken from their list. */
static fg_status consider_everywhere(candidate_search *search)
{
  const fg__chooser *chooser = search->chooser;
  int stride = chooser->sample_count > SPREAD ? chooser->sample_count / SPREAD : 1;
  fg_status status = FG_STATUS_OK;
  for (int i = stride / 2; i < chooser->sample_count && status == FG_STATUS_OK;
       i += stride)
    status = consider_unpassed(search, chooser->sample[i][0], chooser->sample[i][1]);
  return status;
}

/* Shifts the best line to either side of its middle. */
static fg_status refine(candidate_search *search, double radius)
{
  double share = SHIFT;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < SHIFTS && search->arrow.width > 0; i++) {
    double middle = (search->arrow.tail + search->arrow.tip) / 2;
    double position[2], tangent[2];
    fg__streamline_at(&search->chooser->best, middle, NULL, position, tangent);
    double local = fmax(fg__distance_at(search->window, search->room->distance, position),
                        radius / 2);
    for (int side = -1; side <= 1 && status == FG_STATUS_OK; side += 2) {
      double shift = side * share * local;
      double start[2] = {position[0] - shift * tangent[1],
                         position[1] + shift * tangent[0]};
      status = consider(search, start);
    }
    share /= 2;
  }
  return status;
}

static fg_status prepare(candidate_search *search, double radius, double reach)
{
  const fg__window *window = search->window;
  fg__chooser *chooser = search->chooser;
  search->limits =
      (fg__streamline_limits){.step = step_limit(search->field, window),
                              .length = 4 * (window->nodes[0] * window->spacing[0] +
                                             window->nodes[1] * window->spacing[1]),
                              .turning = FG__LARGEST_TURNING};
  search->reach = reach * reach;
  search->passed_reach = (int)(PASSED * radius / search->room->spacing);
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  if (!fg__grow((void **)&chooser->passed, &chooser->passed_capacity, nodes, 1))
    return fg__fail_memory(search->context, "the lines of a cluster", nodes);
  memset(chooser->passed, 0, nodes);
  return collect_samples(search);
}

static bool is_poor(const candidate_search *search, const fg__spine *spine)
{
  const fg__arrow *arrow = &search->arrow;
  double length = arrow->tip - arrow->tail;
  return !(length > SHORT * spine->length) || arrow->unrest > RESTLESS ||
         arrow->width < SLIM * length;
}

fg_status fg__choose_arrow(fg__arrow *arrow, fg__chooser *chooser, fg_context *context,
                           const fg_field *field, const fg__room *room,
                           const fg__spine *spine)
{
  *arrow = (fg__arrow){0};
  if (spine->count < 1)
    return FG_STATUS_OK;
  candidate_search search = {.chooser = chooser,
                             .context = context,
                             .field = field,
                             .window = room->window,
                             .room = room,
                             .cost = HUGE_VAL};
  const double *center = spine->point[spine->center];
  double radius = fg__distance_at(room->window, room->distance, center);
  fg_status status = prepare(&search, radius, REACH * spine->length + radius);
  if (status == FG_STATUS_OK)
    status = consider_center(&search, center, radius, spine->length < DISC * radius);
  if (status == FG_STATUS_OK)
    status = consider_spine(&search, spine);
  if (status == FG_STATUS_OK && is_poor(&search, spine))
    status = consider_everywhere(&search);
  if (status == FG_STATUS_OK)
    status = refine(&search, radius);
  *arrow = search.arrow;
  return status;
}

void fg__chooser_clear(fg__chooser *chooser)
{
  fg__streamline_clear(&chooser->best);
  fg__streamline_clear(&chooser->tried);
  fg__stations_clear(&chooser->stations);
  free(chooser->passed);
  free(chooser->sample);
  *chooser = (fg__chooser){0};
}
