#include "icon/icons_make.h"

#include "icon/choose.h"
#include "icon/icons.h"
#include "icon/measure.h"

#include "base/memory.h"
#include "base/team.h"
#include "solid/make.h"
#include "solid/slender.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Space between the outline and the cluster's border, in spacings: the zero set is known
 * to about a tenth of a cell, and a tip on the very border looks as if it poked out. */
static const double MARGIN = 0.35;

/* The outline is tested at its vertices and between them, at least this close (in
 * spacings of the density); an arrow that fails is made smaller this many times before it
 * is given up. */
static const double TEST_SPACING = 0.25;
static const double SMALLER = 0.9;
enum { ATTEMPTS = 8, EDGE_BLOCK = 12, MOST_THREADS = 64 };

/* In 3D a cluster's fair share of the domain is its volume over this, the coverage that
 * is usual: by it an arrow counts as plump. */
static const double USUAL_COVERAGE = 0.3;

/* What all threads share; each takes the next cluster until there is none. */
typedef struct icon_job {
  const fg__icon_source *source;
  fg_icon *icon; /* [source->count * FG__ICON_PARTS] */
  atomic_int next;
  atomic_bool halted; /* a thread failed or the caller wants to stop */
} icon_job;

typedef struct icon_worker {
  icon_job *job;
  fg_context *context; /* its own: a context is for one thread at a time */
  fg_context *caller;  /* the caller's, on the caller's own thread, else NULL */
  fg_status status;
} icon_worker;

static bool edge_is_inside(const fg__room *room, const double a[2], const double b[2])
{
  double length = hypot(b[0] - a[0], b[1] - a[1]);
  double free_way = fg__distance_at(room->window, room->distance, a);
  if (free_way - FG__DISTANCE_ERROR * room->spacing > length)
    return true;
  int pieces = (int)ceil(length / (TEST_SPACING * room->spacing)) + 1;
  for (int i = 0; i < pieces; i++) {
    double t = (double)i / pieces;
    if (!fg__room_has(room, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
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
                              const fg__room *room)
{
  double(*vertices)[2];
  int count;
  fg_status status = fg_icon_outline(icon, &vertices, &count);
  if (status != FG_STATUS_OK)
    return fg__fail(context, status, "the outline of an arrow of %d points: %s",
                    icon->point_count, fg_status_name(status));
  *sound = is_simple((const double(*)[2])vertices, count);
  for (int i = 0; i < count && *sound; i++)
    *sound = edge_is_inside(room, vertices[i], vertices[(i + 1) % count]);
  free(vertices);
  return FG_STATUS_OK;
}

static void free_points(fg_icon *icon)
{
  free((void *)(uintptr_t)icon->points);
  icon->points = NULL;
}

/* Turns a chosen arrow into an icon, made smaller until its real outline lies inside and
 * is simple: it was chosen by samples of its sides. */
static fg_status build_icon(fg_icon *icon, fg_context *context, const fg_field *field,
                            const fg__room *room, const fg__streamline *line,
                            const fg__arrow *chosen, const double center[2])
{
  fg__arrow arrow = *chosen;
  icon->kind = fg__icon_kind_of(arrow.turning);
  bool sound = false;
  fg_status status = FG_STATUS_OK;
  for (int i = 0; i < ATTEMPTS && !sound && status == FG_STATUS_OK; i++) {
    double(*points)[3] = NULL;
    free_points(icon);
    status = fg__arrow_centerline(&points, &icon->point_count, context, line, &arrow,
                                  room->spacing);
    icon->points = (const double(*)[3])points;
    if (status != FG_STATUS_OK || icon->point_count < 2)
      break;
    fg__icon_set_width(icon, arrow.width);
    status = test_outline(&sound, context, icon, room);
    double less = (1 - SMALLER) / 2 * (arrow.tip - arrow.tail);
    arrow.width *= SMALLER;
    arrow.tail += less;
    arrow.tip -= less;
  }
  if (!sound || status != FG_STATUS_OK) {
    free_points(icon);
    return status;
  }
  fg__icon_set_center(icon, center);
  icon->speed = fg__icon_mean_speed(field, icon);
  return FG_STATUS_OK;
}

/* What is known of a window while an icon is made in it. */
typedef struct icon_place {
  double *distance;
  fg__room room;
} icon_place;

/* Measures the window's distances and makes it a room. The domain's border counts: an
 * arrow there needs room for its head like elsewhere. */
static fg_status measure_place(icon_place *place, fg_context *context,
                               const fg__window *window)
{
  size_t nodes = (size_t)window->nodes[0] * (size_t)window->nodes[1];
  place->distance = fg__allocate(nodes, sizeof *place->distance);
  if (!place->distance)
    return fg__fail_memory(context, "a distance map", nodes * sizeof *place->distance);
  double spacing = fmin(window->spacing[0], window->spacing[1]);
  place->room = (fg__room){window, place->distance, spacing, MARGIN * spacing};
  return fg__march(place->distance, context, window, true);
}

static const fg_field *field_of(const fg__icon_source *source, int index)
{
  return source->field_window ? source->field_window[index] : source->field;
}

static fg_status make_solids(icon_job *job, fg_context *context, fg__solid_maker *maker,
                             int index)
{
  const fg__icon_source *source = job->source;
  int cluster = source->cluster ? source->cluster[index] : index + 1;
  fg_icon *icon = &job->icon[(size_t)index * FG__ICON_PARTS];
  fg__volume whole = {0};
  fg__volume_part part[FG__WINDOW_PARTS] = {{{0}, 0.0}};
  int parts = 0;
  fg_status status =
      fg__volume_cut(&whole, context, source->density, source->labels,
                     source->cluster ? &source->patch[index] : source->patch, cluster);
  if (status == FG_STATUS_OK)
    status =
        fg__volume_divide(part, &parts, context, source->density, source->labels, &whole);
  for (int k = 0; k < parts && status == FG_STATUS_OK; k++) {
    status = fg__solid_icon_make(&icon[k], context, maker, field_of(source, index),
                                 &part[k].volume);
    icon[k].cluster = cluster;
    icon[k].area = source->labels->area[cluster - 1] * part[k].share;
    fg__solid_slim(&icon[k], cbrt(icon[k].area / USUAL_COVERAGE));
  }
  for (int k = 0; k < parts; k++)
    fg__volume_clear(&part[k].volume);
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
    for (int k = 0; k < 2; ++k)
      points[n][k] = spine->point[n % spine->count][k];
  icon->spine = (const double(*)[3])points;
  icon->spine_count = count;
  return FG_STATUS_OK;
}

/* Makes the icon of a window's cluster, but for its area. */
static fg_status make_icon(fg_icon *icon, fg_context *context, fg__chooser *chooser,
                           const fg_field *field, const fg__window *window)
{
  icon_place place = {0};
  fg__spine spine = {0};
  fg__arrow arrow = {0};
  fg_status status = measure_place(&place, context, window);
  if (status == FG_STATUS_OK)
    status = fg__spine_create(&spine, context, window, place.distance);
  if (status == FG_STATUS_OK)
    status = fg__choose_arrow(&arrow, chooser, context, field, &place.room, &spine);
  if (status != FG_STATUS_OK || !(arrow.width > 0))
    goto cleanup;
  icon->cluster = window->cluster;
  status = build_icon(icon, context, field, &place.room, &chooser->best, &arrow,
                      spine.point[spine.center]);
  if (status == FG_STATUS_OK && icon->points)
    status = keep_spine(icon, context, &spine);
cleanup:
  free(place.distance);
  fg__spine_clear(&spine);
  return status;
}

static fg_status make_icons(icon_job *job, fg_context *context, fg__chooser *chooser,
                            int index)
{
  const fg__icon_source *source = job->source;
  int cluster = source->cluster ? source->cluster[index] : index + 1;
  fg_icon *icon = &job->icon[(size_t)index * FG__ICON_PARTS];
  fg__window whole;
  fg__window_part part[FG__WINDOW_PARTS] = {{{0}, 0.0}};
  int parts = 0;
  fg_status status =
      fg__window_cut(&whole, context, source->density, source->labels,
                     source->cluster ? &source->patch[index] : source->patch, cluster);
  if (status == FG_STATUS_OK)
    status =
        fg__window_divide(part, &parts, context, source->density, source->labels, &whole);
  for (int k = 0; k < parts && status == FG_STATUS_OK; k++) {
    status =
        make_icon(&icon[k], context, chooser, field_of(source, index), &part[k].window);
    icon[k].area = source->labels->area[cluster - 1] * part[k].share;
  }
  for (int k = 0; k < parts; k++)
    fg__window_clear(&part[k].window);
  return status;
}

static void work(void *argument, const fg__share *share)
{
  icon_worker *worker = &((icon_worker *)argument)[share->member];
  icon_job *job = worker->job;
  fg__chooser chooser = {0};
  fg__solid_maker maker = {0};
  bool solid = job->source->density->dimension == 3;
  while (worker->status == FG_STATUS_OK && !atomic_load(&job->halted)) {
    int index = atomic_fetch_add(&job->next, 1);
    if (index >= job->source->count)
      break;
    if (worker->caller)
      worker->status = fg__check_stop(worker->caller);
    if (worker->status == FG_STATUS_OK)
      worker->status = solid ? make_solids(job, worker->context, &maker, index)
                             : make_icons(job, worker->context, &chooser, index);
  }
  if (worker->status != FG_STATUS_OK)
    atomic_store(&job->halted, true);
  fg__chooser_clear(&chooser);
  fg__solid_maker_clear(&maker);
}

/* The caller's thread is the first worker, and the only one where no threads are to be
 * had. */
fg_status fg__icons_make(fg_icon *icon, fg_context *context,
                         const fg__icon_source *source, int threads)
{
  icon_job job = {.source = source, .icon = icon};
  icon_worker workers[MOST_THREADS] = {
      {.job = &job, .context = context, .caller = context}};
  fg__team *team = NULL;
  fg_status status = FG_STATUS_OK;
  threads = threads < MOST_THREADS ? threads : MOST_THREADS;
  threads = threads < source->count ? threads : source->count;
  (void)fg__team_create(&team, NULL, threads);
  threads = fg__team_members(team);
  for (int i = 1; i < threads; i++) {
    workers[i].job = &job;
    (void)fg_context_create(&workers[i].context); /* without one messages are lost */
  }
  fg__team_run(team, work, workers);
  for (int i = 0; i < threads; i++) {
    const icon_worker *worker = &workers[i];
    if (worker->status != FG_STATUS_OK && status == FG_STATUS_OK)
      status = i == 0 ? worker->status
                      : fg__fail(context, worker->status, "%s",
                                 fg_context_message(worker->context));
    if (i > 0)
      fg_context_destroy(worker->context);
  }
  fg__team_destroy(team);
  return status;
}

fg_status fg__icons_collect(fg_icons **out, fg_context *context, const fg_icon *icon,
                            int clusters)
{
  fg_icons *icons = NULL;
  fg_status status = fg__icons_create_empty(&icons, context);
  int drawn = 0;
  for (int i = 0; i < clusters && status == FG_STATUS_OK; i++) {
    const fg_icon *part = &icon[(size_t)i * FG__ICON_PARTS];
    bool has_icon = false;
    for (int k = 0; k < FG__ICON_PARTS && status == FG_STATUS_OK; k++)
      if (part[k].points) {
        status = fg__icons_add(icons, context, &part[k]);
        has_icon = true;
      }
    drawn += has_icon;
  }
  if (status != FG_STATUS_OK) {
    fg_icons_destroy(icons);
    return status;
  }
  fg__icons_set_clusters(icons, clusters, clusters - drawn);
  *out = icons;
  return FG_STATUS_OK;
}

fg_icon *fg__icons_allocate(int clusters)
{
  return fg__allocate((size_t)clusters * FG__ICON_PARTS, sizeof(fg_icon));
}

void fg__icons_free(fg_icon *icon, int clusters)
{
  for (int i = 0; icon && i < clusters * FG__ICON_PARTS; i++)
    fg__solid_icon_free(&icon[i]);
  free(icon);
}
