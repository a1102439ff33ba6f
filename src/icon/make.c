#include "icon/make.h"

#include "base/memory.h"
#include "icon/measure.h"
#include "skeleton/march.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Space in 2D between the outline and the cluster's boundary, in spacings: the zero set
 * is known to about a tenth of a cell, and a tip on the very boundary looks as if it
 * poked out. */
static const double MARGIN = 0.35;

/* The outline is tested at its vertices and between them, at least this close (in
 * spacings of the density). */
static const double TEST_SPACING = 0.25;
enum { EDGE_BLOCK = 12 };

/* An arrow that does not lie inside is made this much smaller, up to ATTEMPTS times; in
 * 2D one that is seen best up to ATTEMPTS_FLAT times. */
static const double SMALLER_FLAT = 0.9, SMALLER_SOLID = 0.93;
enum { ATTEMPTS_FLAT = 8, ATTEMPTS = 12 };

/* In 2D the least width over the length: slimmer ones are hairlines in print. */
static const double SLIMMEST = 0.003;

static bool edge_is_inside(const fg__interior *interior, const double a[2],
                           const double b[2])
{
  double length = hypot(b[0] - a[0], b[1] - a[1]);
  double free_way = fg__interior_distance(interior, a);
  if (free_way - FG__DISTANCE_ERROR * interior->spacing > length)
    return true;
  int pieces = (int)ceil(length / (TEST_SPACING * interior->spacing)) + 1;
  for (int i = 0; i < pieces; i++) {
    double t = (double)i / pieces;
    if (!fg__interior_has(interior, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
      return false;
  }
  return true;
}

static double side_of(const double a[2], const double b[2], const double c[2])
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool edges_meet(const double a[2], const double b[2], const double c[2],
                       const double d[2])
{
  for (int k = 0; k < 2; k++)
    if ((a[k] < c[k] && a[k] < d[k] && b[k] < c[k] && b[k] < d[k]) ||
        (a[k] > c[k] && a[k] > d[k] && b[k] > c[k] && b[k] > d[k]))
      return false;
  return side_of(a, b, c) * side_of(a, b, d) <= 0 &&
         side_of(c, d, a) * side_of(c, d, b) <= 0;
}

/* The box of some edges in a row. */
typedef struct edge_box {
  double low[2], high[2];
} edge_box;

static edge_box box_of(const double (*vertices)[2], int count, int first, int beyond)
{
  edge_box box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (int i = first; i <= beyond; i++)
    for (int k = 0; k < 2; k++) {
      double x = vertices[i < count ? i : 0][k];
      box.low[k] = x < box.low[k] ? x : box.low[k];
      box.high[k] = x > box.high[k] ? x : box.high[k];
    }
  return box;
}

static bool boxes_meet(const edge_box *a, const edge_box *b)
{
  return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] &&
         b->low[1] <= a->high[1];
}

/* Whether an edge from [i, i_beyond) meets one from [j, j_beyond) that is no neighbour.
 */
static bool blocks_meet(const double (*vertices)[2], int count, int i_first, int i_beyond,
                        int j_first, int j_beyond)
{
  for (int i = i_first; i < i_beyond; i++)
    for (int j = j_first > i + 2 ? j_first : i + 2; j < j_beyond; j++)
      if ((i > 0 || j < count - 1) &&
          edges_meet(vertices[i], vertices[i + 1], vertices[j],
                     vertices[j + 1 < count ? j + 1 : 0]))
        return true;
  return false;
}

/* Compares edges only where the boxes of EDGE_BLOCK of them meet. */
static bool is_simple(const double (*vertices)[2], int count)
{
  for (int i = 0; i < count; i += EDGE_BLOCK) {
    int i_beyond = i + EDGE_BLOCK < count ? i + EDGE_BLOCK : count;
    edge_box a = box_of(vertices, count, i, i_beyond);
    for (int j = i; j < count; j += EDGE_BLOCK) {
      int j_beyond = j + EDGE_BLOCK < count ? j + EDGE_BLOCK : count;
      edge_box b = box_of(vertices, count, j, j_beyond);
      if (boxes_meet(&a, &b) && blocks_meet(vertices, count, i, i_beyond, j, j_beyond))
        return false;
    }
  }
  return true;
}

static fg_status test_outline(bool *sound, fg_context *context, const fg_icon *icon,
                              const fg__interior *interior)
{
  double(*vertices)[2];
  int count;
  fg_status status = fg_icon_outline(icon, &vertices, &count);
  if (status != FG_STATUS_OK)
    return fg__fail(context, status, "the outline of an arrow of %d points: %s",
                    icon->point_count, fg_status_name(status));
  *sound = is_simple((const double(*)[2])vertices, count);
  for (int i = 0; i < count && *sound; i++)
    *sound = edge_is_inside(interior, vertices[i], vertices[(i + 1) % count]);
  free(vertices);
  return FG_STATUS_OK;
}

static fg_status lies_inside(bool *inside, fg_context *context, const fg_icon *icon,
                             const fg__window *window)
{
  fg_surface *solid;
  fg_status status = fg_icon_solid(&solid, context, icon);
  *inside = status == FG_STATUS_OK;
  if (status != FG_STATUS_OK)
    return status;
  for (int i = 0; i < solid->vertex_count && *inside; i++)
    *inside = fg__window_level(window, solid->vertex[i]) > 0;
  fg_surface_destroy(solid);
  return FG_STATUS_OK;
}

/* Whether the outline in 2D is simple and inside, or the solid in 3D is inside. */
static fg_status test(bool *sound, fg_context *context, const fg_icon *icon,
                      const fg__interior *interior)
{
  return interior->window->dimension == 2
             ? test_outline(sound, context, icon, interior)
             : lies_inside(sound, context, icon, interior->window);
}

static void free_line(const double (**points)[3])
{
  free((void *)(uintptr_t)*points);
  *points = NULL;
}

void fg__icon_free(fg_icon *icon)
{
  free_line(&icon->points);
  free_line(&icon->spine);
  free_line(&icon->streamline);
  icon->point_count = icon->spine_count = icon->streamline_count = 0;
}

/* Sets the icon's points to the arrow's, made smaller until it is sound: it was chosen by
 * samples. Without points no size is. `shorter`: the share by which its length goes with
 * its width. */
static fg_status shape(fg_icon *icon, fg_context *context, const fg__interior *interior,
                       const fg__streamline *line, const fg__arrow *chosen,
                       double shorter, int attempts)
{
  fg__arrow arrow = *chosen;
  bool flat = line->dimension == 2, sound = false;
  double smaller = flat ? SMALLER_FLAT : SMALLER_SOLID;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < attempts && !sound; i++) {
    if (flat && arrow.width < SLIMMEST * (arrow.tip - arrow.tail))
      break;
    double(*points)[3] = NULL;
    free_line(&icon->points);
    status = fg__arrow_centerline(&points, &icon->point_count, context, line, &arrow,
                                  interior->spacing);
    icon->points = (const double(*)[3])points;
    if (status != FG_STATUS_OK || icon->point_count < 2)
      break;
    fg__icon_set_width(icon, line->dimension, arrow.width);
    status = test(&sound, context, icon, interior);
    if (status != FG_STATUS_OK)
      break;
    double less = shorter * (1 - smaller) / 2 * (arrow.tip - arrow.tail);
    arrow.width *= smaller;
    arrow.tail += less;
    arrow.tip -= less;
  }
  if (!sound || status != FG_STATUS_OK) {
    free_line(&icon->points);
    icon->point_count = 0;
  }
  return status;
}

/* A ring's spine ends where it begins. */
static fg_status keep_spine(fg_icon *icon, fg_context *context, const fg__spine *spine)
{
  int count = spine->count + spine->closed;
  double(*points)[3] = fg__allocate((size_t)count, sizeof *points);
  if (!points)
    return fg__fail_memory(context, "a spine", (size_t)count * sizeof *points);
  for (int n = 0; n < count; ++n)
    memcpy(points[n], spine->point[n % spine->count], sizeof *points);
  icon->spine = (const double(*)[3])points;
  icon->spine_count = count;
  return FG_STATUS_OK;
}

/* In 3D all of the streamline that the arrow lies on. */
static fg_status keep_streamline(fg_icon *icon, fg_context *context,
                                 const fg__streamline *line, double spacing)
{
  if (line->dimension == 2)
    return FG_STATUS_OK;
  const fg__arrow all = {.tip = fg__streamline_length(line),
                         .turning = line->node[line->count - 1].turning};
  double(*points)[3] = NULL;
  fg_status status = fg__arrow_centerline(&points, &icon->streamline_count, context, line,
                                          &all, spacing);
  icon->streamline = (const double(*)[3])points;
  return status;
}

static fg_status finish(fg_icon *icon, fg_context *context, const fg_field *field,
                        const fg__chooser *chooser, const fg__interior *interior,
                        const fg__spine *spine)
{
  fg__icon_set_center(icon, spine->middle);
  icon->speed = fg__icon_mean_speed(field, icon);
  fg_status status = keep_streamline(icon, context, &chooser->best, interior->spacing);
  if (status == FG_STATUS_OK)
    status = keep_spine(icon, context, spine);
  return status;
}

fg_status fg__icon_make(fg_icon *out, fg_context *context, fg__chooser *chooser,
                        const fg_field *field, const fg__window *window)
{
  *out = (fg_icon){.cluster = window->cluster};
  fg__spine spine = {0};
  fg__arrow arrow = {0};
  size_t nodes = fg__window_count(window);
  double *distance = fg__allocate(nodes, sizeof *distance);
  if (!distance)
    return fg__fail_memory(context, "a distance map", nodes * sizeof *distance);
  double spacing = fg__window_spacing(window);
  const fg__interior interior = {window, distance, spacing, MARGIN * spacing,
                                 chooser->territory};
  /* the domain's boundary counts: an arrow there needs clearance for its head as well */
  fg_status status = fg__march(distance, context, window, true);
  if (status == FG_STATUS_OK)
    status = fg__spine_create(&spine, context, window, distance);
  if (status == FG_STATUS_OK)
    status = fg__choose_arrow(&arrow, chooser, context, field, &interior, &spine);
  if (status == FG_STATUS_OK && arrow.width > 0) {
    const double stretched = fg__stretched_length(chooser, &interior, &spine);
    fg__arrow whole = arrow;
    if (stretched > 0.0)
      fg__arrow_stretch(&whole, &chooser->best, stretched, interior.margin);
    /* that to the ends of its line becomes slimmer rather than shorter */
    const struct {
      const fg__arrow *arrow;
      double shorter;
      int attempts;
    } tries[] = {{&whole, 0.1, ATTEMPTS},
                 {&whole, 0.3, ATTEMPTS},
                 {&whole, 1.0, ATTEMPTS},
                 {&arrow, 1.0, window->dimension == 2 ? ATTEMPTS_FLAT : ATTEMPTS}};
    for (int k = stretched > 0.0 ? 0 : 3; k < 4 && !out->points && !status; k++) {
      out->kind = fg__icon_kind_of(tries[k].arrow->turning);
      status = shape(out, context, &interior, &chooser->best, tries[k].arrow,
                     tries[k].shorter, tries[k].attempts);
    }
  }
  if (status == FG_STATUS_OK && out->points)
    status = finish(out, context, field, chooser, &interior, &spine);
  free(distance);
  fg__spine_clear(&spine);
  if (status != FG_STATUS_OK)
    fg__icon_free(out);
  return status;
}
