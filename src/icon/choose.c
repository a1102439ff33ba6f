#include "icon/choose.h"

#include "base/memory.h"
#include "base/vector.h"
#include "icon/territory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of the cluster that the arrow is compared with, in 2D and 3D; more change the
 * choice no more. */
enum { POINTS_FLAT = 150, POINTS_SOLID = 250, ARROW_POINTS = 32 };

/* An arrow stands for the points of the cluster up to about this share of the spine's
 * length from it: which ones lie farther away counts less and less. */
static const double REACH = 0.2;

/* An arrow's cost is its distance from the cluster's points over its width to this power:
 * 20 % more distance is as good when the arrow is twice as wide. */
static const double WIDTH_EXPONENT = 0.25;

/* No line in 2D is traced from where one has passed already: nearer than this share of
 * the distance from the middle of the spine to the boundary. */
static const double PASSED = 0.2;

/* A cluster is thin whose spine is longer than THIN times its width. */
static const double THIN = 3.0;

/* Of an arrow to the ends of its line: the largest width over the largest length, and the
 * steps by which it is made longer. */
static const double WIDEST_STRETCHED = 0.02;
enum { STRETCHES = 8 };

/* Longest step: no longer than a cell of the data, where the field has its bends. */
static double step_limit(const fg_field *field, const fg__interior *interior)
{
  const fg_field_arrays *contents = fg_field_contents(field);
  double step = interior->spacing;
  for (int a = 0; a < interior->window->dimension; a++) {
    int n = contents->size[a];
    step = fmin(step, (contents->axis[a][n - 1] - contents->axis[a][0]) / (n - 1));
  }
  return step;
}

/* Whether a node is one of every stride-th along an axis; in 3D alike from either end. */
static bool is_taken(const fg__window *window, int index, int axis, int stride)
{
  int last = window->nodes[axis] - 1;
  if (axis >= window->dimension)
    return true;
  if (window->dimension == 2)
    return index % stride == last % stride / 2;
  return (abs(2 * index - last) - last % 2) / 2 % stride == 0;
}

static fg_status add_point(const fg__choice *choice, int x, int y, int z)
{
  const fg__window *window = choice->interior->window;
  fg__chooser *chooser = choice->chooser;
  size_t needed = (size_t)chooser->point_count + 1;
  if (!fg__grow((void **)&chooser->point, &chooser->point_capacity, needed,
                sizeof *chooser->point))
    return fg__fail_memory(choice->context, "points of a cluster",
                           needed * sizeof *chooser->point);
  fg__window_position(window, fg__window_node(window, x, y, z),
                      chooser->point[chooser->point_count++]);
  return FG_STATUS_OK;
}

/* Nodes inside the cluster, every stride-th along each axis. */
static fg_status collect_points(const fg__choice *choice)
{
  const fg__window *window = choice->interior->window;
  size_t inside = 0;
  for (size_t i = 0; i < fg__window_count(window); i++)
    inside += window->level[i] > 0;
  int stride = (int)ceil(window->dimension == 2 ? sqrt((double)inside / POINTS_FLAT)
                                                : cbrt((double)inside / POINTS_SOLID));
  stride = stride < 1 ? 1 : stride;
  choice->chooser->point_count = 0;
  fg_status status = FG_STATUS_OK;
  for (int z = 0; z < window->nodes[2]; z++)
    for (int y = 0; y < window->nodes[1]; y++) {
      if (!is_taken(window, z, 2, stride) || !is_taken(window, y, 1, stride))
        continue;
      const float *row = window->level + fg__window_node(window, 0, y, z);
      for (int x = 0; x < window->nodes[0] && status == FG_STATUS_OK; x++)
        if (row[x] > 0 && is_taken(window, x, 0, stride))
          status = add_point(choice, x, y, z);
    }
  return status;
}

static const fg__territory *territory_of(const fg__choice *choice)
{
  return choice->interior->territory;
}

/* Root of the mean square distance from the cluster's points to a part of the line just
 * tried, in a cluster weighed with an arrow's width: the less the better. */
static double cost_of(const fg__choice *choice, double tail, double tip, double width)
{
  const fg__chooser *chooser = choice->chooser;
  double line[ARROW_POINTS][3], sum = 0;
  int hint = 0;
  for (int k = 0; k < ARROW_POINTS; k++)
    fg__streamline_at(&chooser->tried, tail + (tip - tail) * k / (ARROW_POINTS - 1),
                      &hint, line[k], NULL);
  for (int i = 0; i < chooser->point_count; i++) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < ARROW_POINTS; k++) {
      double d[3];
      fg__subtract(line[k], chooser->point[i], d);
      double square = fg__dot(d, d);
      nearest = square < nearest ? square : nearest;
    }
    sum += nearest / (nearest + choice->reach);
  }
  const double apart = sqrt(sum / fmax(chooser->point_count, 1));
  return choice->stretched > 0.0 ? apart : apart / pow(width, WIDTH_EXPONENT);
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

static void mark_passed(const fg__choice *choice)
{
  const fg__streamline *line = &choice->chooser->tried;
  int place[2];
  for (int i = 0; i < line->count && line->dimension == 2; i++) {
    int node = node_at(choice->interior->window, line->node[i].position, place);
    if (node >= 0)
      choice->chooser->passed[node] = 1;
  }
}

bool fg__choice_has_passed(const fg__choice *choice, const double point[2])
{
  const fg__window *window = choice->interior->window;
  int place[2], reach = choice->passed_reach;
  if (node_at(window, point, place) < 0)
    return true;
  for (int y = place[1] - reach; y <= place[1] + reach; y++)
    for (int x = place[0] - reach; x <= place[0] + reach; x++)
      if (x >= 0 && y >= 0 && x < window->nodes[0] && y < window->nodes[1] &&
          choice->chooser->passed[y * window->nodes[0] + x])
        return true;
  return false;
}

double fg__stretched_length(const fg__chooser *chooser, const fg__interior *interior,
                            const fg__spine *spine)
{
  const fg__territory *territory = interior->territory;
  const double width = 2.0 * fg__interior_distance(interior, spine->middle);
  if (territory)
    return territory->longest;
  return chooser->to_ends && interior->window->dimension == 2 &&
                 spine->length > THIN * width
             ? HUGE_VAL
             : 0.0;
}

void fg__arrow_stretch(fg__arrow *arrow, const fg__streamline *line, double longest,
                       double margin)
{
  const fg__arrow chosen = *arrow;
  const double end = fg__streamline_length(line) - margin;
  const double most = fmin(longest, end - margin);
  const double middle = 0.5 * (chosen.tail + chosen.tip);
  const double first = fmax(margin, fmin(middle - 0.5 * most, end - most));
  const double last = first + most;
  double at[3];
  arrow->width = fmin(arrow->width, WIDEST_STRETCHED * longest);
  for (int k = STRETCHES; k > 0; --k) {
    const double share = (double)k / STRETCHES;
    arrow->tail = chosen.tail + share * fmin(first - chosen.tail, 0.0);
    arrow->tip = chosen.tip + share * fmax(last - chosen.tip, 0.0);
    arrow->turning = fabs(fg__streamline_at(line, arrow->tip, NULL, at, NULL) -
                          fg__streamline_at(line, arrow->tail, NULL, at, NULL));
    if (arrow->turning <= FG__LARGEST_TURNING)
      return;
  }
  *arrow = chosen;
}

/* Whether the arrow passes through the territory's own cluster. */
static bool meets_cluster(const fg__choice *choice, const fg__arrow *arrow)
{
  const fg__territory *territory = territory_of(choice);
  const fg__streamline *line = &choice->chooser->tried;
  bool meets = false;
  for (int i = 0; i < line->count && !meets; i++)
    meets = line->node[i].s >= arrow->tail && line->node[i].s <= arrow->tip &&
            fg__territory_meets(territory, choice->interior->window->cluster,
                                line->node[i].position);
  return meets;
}

fg_status fg__choice_try(fg__choice *choice, const double start[3])
{
  fg__chooser *chooser = choice->chooser;
  const fg__interior *interior = choice->interior;
  fg_status status = fg__streamline_trace(&chooser->tried, choice->context, choice->field,
                                          interior->window, start, &choice->limits);
  if (status != FG_STATUS_OK || chooser->tried.count < 2)
    return status;
  mark_passed(choice);
  /* an arrow takes a part of the line: it can only be farther from the cluster's points
   */
  double length = fg__streamline_length(&chooser->tried);
  if (!(length > 0) ||
      cost_of(choice, 0, length, fg__arrow_widest(length, interior)) >= choice->cost)
    return FG_STATUS_OK;
  fg__arrow arrow;
  status = fg__arrow_fit(&arrow, choice->context, &chooser->tried, interior,
                         &chooser->samples);
  if (status != FG_STATUS_OK || !(arrow.width > 0))
    return status;
  fg__arrow drawn = arrow;
  if (choice->stretched > 0.0)
    fg__arrow_stretch(&drawn, &chooser->tried, choice->stretched, interior->margin);
  if (territory_of(choice) && !meets_cluster(choice, &drawn))
    return FG_STATUS_OK;
  double cost = cost_of(choice, drawn.tail, drawn.tip, drawn.width);
  cost *= choice->stretched > 0.0 ? 1.0 : arrow.bending;
  if (cost < choice->cost) {
    fg__streamline line = chooser->best;
    chooser->best = chooser->tried;
    chooser->tried = line;
    choice->cost = cost;
    choice->arrow = arrow;
  }
  return FG_STATUS_OK;
}

static fg_status prepare(fg__choice *choice, double spine_length)
{
  const fg__window *window = choice->interior->window;
  fg__chooser *chooser = choice->chooser;
  double sides = 0, reach = REACH * spine_length + choice->radius;
  for (int k = 0; k < window->dimension; k++)
    sides += window->nodes[k] * window->spacing[k];
  choice->limits =
      (fg__streamline_limits){.step = step_limit(choice->field, choice->interior),
                              .length = 4 * sides,
                              .turning = FG__LARGEST_TURNING};
  choice->reach = reach * reach;
  if (window->dimension == 2) {
    choice->passed_reach = (int)(PASSED * choice->radius / choice->interior->spacing);
    size_t nodes = fg__window_count(window);
    if (!fg__grow((void **)&chooser->passed, &chooser->passed_capacity, nodes, 1))
      return fg__fail_memory(choice->context, "the lines of a cluster", nodes);
    memset(chooser->passed, 0, nodes);
  }
  return collect_points(choice);
}

fg_status fg__choose_arrow(fg__arrow *arrow, fg__chooser *chooser, fg_context *context,
                           const fg_field *field, const fg__interior *interior,
                           const fg__spine *spine)
{
  *arrow = (fg__arrow){0};
  if (spine->count < 1)
    return FG_STATUS_OK;
  fg__choice choice = {.chooser = chooser,
                       .context = context,
                       .field = field,
                       .interior = interior,
                       .radius = fg__interior_distance(interior, spine->middle),
                       .cost = HUGE_VAL};
  choice.stretched = fg__stretched_length(chooser, interior, spine);
  fg_status status = prepare(&choice, spine->length);
  if (status == FG_STATUS_OK)
    status = fg__choice_try_starts(&choice, spine);
  *arrow = choice.arrow;
  return status;
}

void fg__chooser_clear(fg__chooser *chooser)
{
  fg__streamline_clear(&chooser->best);
  fg__streamline_clear(&chooser->tried);
  fg__arc_samples_clear(&chooser->samples);
  free(chooser->passed);
  free(chooser->point);
  *chooser = (fg__chooser){0};
}
