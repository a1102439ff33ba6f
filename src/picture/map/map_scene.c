#include "picture/map/map_scene.h"

#include <math.h>

#include "picture/map/land.h"
#include "picture/map/missing.h"
#include "picture/map/stroke.h"
#include "picture/polygons.h"

/* Metres on the ground in a point from which on coasts are generalised for 1 to 110, and
 * to 50 million, whose edges are 84 and 13 km long (half of the coasts' length): about
 * two points. A world map 480 points wide has 76 km in a point, one of Europe 10. */
static const double coarse_from = 40e3, middle_from = 6e3;

/* Points: vertices that move a line by less are dropped; what is smaller than a speck is
 * not drawn; coordinates are multiples of a grain, which have few digits in SVG. */
static const double line_tolerance = 0.18, rim_tolerance = 0.4, arrow_tolerance = 0.05;
static const double speck = 0.7;
static const double grain = 1.0 / 8.0;

/* What is drawn about an arrow, its rim. */
static const double clip_slack = 0.5;

/* Of degrees inside a map, and between them and arrows, where there is room and at least,
 * in units of the font size. */
static const double inside_size = 0.88, arrow_gap = 0.4, least_arrow_gap = 0.1;

typedef struct placing {
  const fg__page *page;
  const fg__plane *plane;
} placing;

static double rounded(double x)
{
  return grain * floor(x / grain + 0.5);
}

static void place_all(const placing *p, fg__polygons *polygons)
{
  for (size_t n = 0; n < polygons->point_count; ++n)
    fg__page_project(p->page, p->plane->low, polygons->point[n]);
}

static bool is_speck(const fg__polygons *polygons, size_t k)
{
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (size_t n = polygons->start[k]; n < polygons->start[k + 1]; ++n)
    for (int i = 0; i < 2; ++i) {
      low[i] = fmin(low[i], polygons->point[n][i]);
      high[i] = fmax(high[i], polygons->point[n][i]);
    }
  return fmax(high[0] - low[0], high[1] - low[1]) < speck;
}

/* Drops specks, and rounds. */
static void tidy(fg__polygons *polygons, bool specks_too)
{
  size_t lines = 0, points = 0;
  for (size_t k = 0; k < polygons->count; ++k) {
    const size_t first = polygons->start[k], end = polygons->start[k + 1];
    if (!specks_too && is_speck(polygons, k))
      continue;
    polygons->start[lines++] = points;
    for (size_t n = first; n < end; ++n, ++points)
      for (int i = 0; i < 2; ++i)
        polygons->point[points][i] = rounded(polygons->point[n][i]);
  }
  if (polygons->count)
    polygons->start[lines] = points;
  polygons->count = lines;
  polygons->point_count = points;
}

static void finish(const placing *p, fg__polygons *polygons, double tolerance,
                   bool specks_too)
{
  place_all(p, polygons);
  fg__polygons_simplify(polygons, tolerance);
  tidy(polygons, specks_too);
}

static fg__coast_detail detail_of(const placing *p)
{
  const double metres = p->plane->metres / p->page->scale;
  return metres >= coarse_from   ? FG__COAST_110M
         : metres >= middle_from ? FG__COAST_50M
                                 : FG__COAST_10M;
}

/* Loops and lines of another go to the end of these. */
static bool copy(fg__polygons *out, const fg__polygons *from)
{
  for (size_t k = 0; k < from->count; ++k) {
    if (!fg__polygons_begin(out))
      return false;
    for (size_t n = from->start[k]; n < from->start[k + 1]; ++n)
      if (!fg__polygons_add(out, from->point[n]))
        return false;
  }
  return true;
}

static fg_status add_coasts(fg__map_scene *out, fg_context *context, const placing *p,
                            const fg_field *field, bool borders)
{
  const fg__coast_detail detail = detail_of(p);
  fg__missing missing = {.area = {.point = NULL}};
  fg_status status =
      fg__land_trace(&out->land, &out->shore, context, p->plane, FG__COAST_LAND, detail);
  if (!status)
    status = fg__land_trace(&out->lakes, &out->banks, context, p->plane, FG__COAST_LAKES,
                            detail);
  if (!status && borders)
    status =
        fg__land_trace(NULL, &out->borders, context, p->plane, FG__COAST_BORDERS, detail);
  if (!status)
    status =
        fg__missing_find(&missing, context, p->plane, field, &out->land, &out->lakes);
  out->coasts = true;
  out->missing = missing.area;
  out->missing_on_land = missing.on_land;
  out->missing_lakes = missing.lakes;
  out->rim = missing.rim;
  finish(p, &out->land, line_tolerance, false);
  finish(p, &out->lakes, line_tolerance, false);
  finish(p, &out->shore, line_tolerance, false);
  finish(p, &out->banks, line_tolerance, false);
  finish(p, &out->borders, line_tolerance, true);
  finish(p, &out->missing, rim_tolerance, true);
  finish(p, &out->rim, rim_tolerance, false);
  return status;
}

fg_status fg__map_scene_create(fg__map_scene *out, fg_context *context,
                               const fg__page *page, const fg__graticule *graticule,
                               const fg_field *field, const fg__map_layers *layers)
{
  const placing p = {page, graticule->plane};
  fg_status status = FG_STATUS_OK;
  *out = (fg__map_scene){.coasts = false};
  if (!copy(&out->outline, &graticule->plane->outline) ||
      (!layers->no_graticule && !copy(&out->graticule, &graticule->line)))
    status = fg__fail_memory(context, "a map's lines",
                             graticule->line.point_count * sizeof(double[2]));
  finish(&p, &out->outline, 0.02, true);
  finish(&p, &out->graticule, 0.05, true);
  if (!status && !layers->no_coast)
    status = add_coasts(out, context, &p, field, layers->borders);
  out->contained = p.plane->whole && !p.plane->disc && !out->missing.count;
  if (status)
    fg__map_scene_clear(out);
  return status;
}

fg_status fg__map_scene_rim(fg__map_scene *scene, fg_context *context,
                            const fg__polygons *arrows)
{
  if (!copy(&scene->arrow_rims, arrows))
    return fg__fail_memory(context, "the arrows' rims",
                           arrows->point_count * sizeof *arrows->point);
  fg__polygons_simplify(&scene->arrow_rims, arrow_tolerance);
  tidy(&scene->arrow_rims, true);
  return FG_STATUS_OK;
}

static bool boxes_touch(const fg__page_box *a, const fg__page_box *b)
{
  return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

static bool loops_touch_box(const fg__polygons *loops, const fg__page_box *box)
{
  const double low[2] = {box->x0, box->y0}, high[2] = {box->x1, box->y1};
  for (size_t k = 0; k < loops->count; ++k)
    for (size_t n = loops->start[k]; n < loops->start[k + 1]; ++n) {
      const size_t next = n + 1 < loops->start[k + 1] ? n + 1 : loops->start[k];
      double share[2];
      fg__clip_edge(share, loops->point[n], loops->point[next], low, high);
      if (share[0] <= share[1])
        return true;
    }
  return false;
}

bool fg__map_scene_holds(const fg__map_scene *scene, const fg__page *page,
                         const fg__polygons *loops, size_t loop)
{
  const fg__page_box *frame = &page->frame;
  const size_t first = loops->start[loop], end = loops->start[loop + 1];
  fg__page_box box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t n = first; n < end; ++n) {
    const double *at = loops->point[n];
    box = (fg__page_box){fmin(box.x0, at[0]), fmin(box.y0, at[1]), fmax(box.x1, at[0]),
                         fmax(box.y1, at[1])};
  }
  if (box.x0 < frame->x0 + clip_slack || box.x1 > frame->x1 - clip_slack ||
      box.y0 < frame->y0 + clip_slack || box.y1 > frame->y1 - clip_slack)
    return false;
  if (!scene->outline.count)
    return true;
  /* all of a box that the outline does not touch lies on the same side */
  const bool apart = !loops_touch_box(&scene->outline, &box);
  bool inside = true;
  for (size_t n = first; n < end && inside && (n == first || !apart); ++n)
    inside =
        fg__polygon_contains(&scene->outline, 0, loops->point[n][0], loops->point[n][1]);
  return inside;
}

/* What degrees inside a map are placed with. */
typedef struct labelling {
  const fg__map_scene *scene;
  fg__page *page;
  const fg__graticule *graticule;
  const fg__polygons *arrows;
  cairo_t *ruler;
} labelling;

/* Free of the outline and of other texts, inside of the frame. */
static bool has_room(const labelling *l, const fg__page_box *box)
{
  const fg__page_box *frame = &l->page->frame;
  const fg__polygons *outline = &l->scene->outline;
  if (box->x0 < frame->x0 || box->y0 < frame->y0 || box->x1 > frame->x1 ||
      box->y1 > frame->y1)
    return false;
  for (int k = 0; k < l->page->text_count; ++k)
    if (boxes_touch(&l->page->text[k].box, box))
      return false;
  if (outline->count && !fg__polygon_contains(outline, 0, 0.5 * (box->x0 + box->x1),
                                              0.5 * (box->y0 + box->y1)))
    return false;
  return !loops_touch_box(outline, box);
}

/* Where a label's text would stand, with a little room round it. */
static fg__page_box box_of(const labelling *l, const fg__map_label *label)
{
  const double size = inside_size * l->page->font_size, pad = 0.12 * size;
  const double half = 0.5 * fg__text_width(l->ruler, label->text, size, false) + pad;
  double at[2] = {label->at[0], label->at[1]};
  fg__page_project(l->page, l->graticule->plane->low, at);
  return (fg__page_box){at[0] - half, at[1] - 0.5 * size - pad, at[0] + half,
                        at[1] + 0.5 * size + pad};
}

/* Whether a label has room, and arrows keep a distance of `gap` font sizes. */
static bool is_free(const labelling *l, const fg__map_label *label, double gap)
{
  const double apart = gap * l->page->font_size;
  const fg__page_box box = box_of(l, label);
  const fg__page_box wider = {box.x0 - apart, box.y0 - apart, box.x1 + apart,
                              box.y1 + apart};
  return has_room(l, &box) && !loops_touch_box(l->arrows, &wider);
}

static void add_label(const labelling *l, const fg__map_label *label)
{
  const fg__page_box box = box_of(l, label);
  fg__page_text *text =
      has_room(l, &box) ? fg__page_next_text(l->page, label->text) : NULL;
  if (!text)
    return;
  text->size = inside_size * l->page->font_size;
  text->quiet = true;
  text->x = box.x0 + 0.12 * text->size;
  text->y = 0.5 * (box.y0 + box.y1) + FG__HALF_DIGIT * text->size;
  text->box = box;
  text->halo = true;
}

/* Which of the places that each line has is free for most lines: labels in a row. */
static int best_place(const labelling *l)
{
  int free_places[FG__MAP_LABELS] = {0}, best = 0;
  for (int k = 0, place = 0; k < l->graticule->insides; ++k, ++place) {
    const fg__map_label *label = &l->graticule->inside[k];
    if (k > 0 && label->line != label[-1].line)
      place = 0;
    free_places[place] += is_free(l, label, arrow_gap);
  }
  for (int place = 1; place < FG__MAP_LABELS; ++place)
    if (free_places[place] > free_places[best])
      best = place;
  return best;
}

/* The free one of a line's labels that is nearest to the best place; NULL: none is free.
 */
static const fg__map_label *nearest_free(const labelling *l, const fg__map_label *label,
                                         int count, int best, double gap)
{
  const fg__map_label *nearest = NULL;
  double least = HUGE_VAL;
  for (int k = 0; k < count; ++k) {
    const double away =
        hypot(label[k].at[0] - label[best].at[0], label[k].at[1] - label[best].at[1]);
    if (away < least && is_free(l, &label[k], gap)) {
      nearest = &label[k];
      least = away;
    }
  }
  return nearest;
}

/* One of a line's labels; one that is needed stands over arrows rather than nowhere. */
static void label_line(const labelling *l, const fg__map_label *label, int count,
                       int best)
{
  const fg__map_label *chosen = nearest_free(l, label, count, best, arrow_gap);
  if (!chosen)
    chosen = nearest_free(l, label, count, best, least_arrow_gap);
  if (!chosen && label->needed)
    chosen = &label[best];
  if (chosen)
    add_label(l, chosen);
}

void fg__map_scene_label(const fg__map_scene *scene, fg__page *page,
                         const fg__graticule *graticule, const fg__polygons *arrows,
                         cairo_t *ruler)
{
  const labelling l = {scene, page, graticule, arrows, ruler};
  const int best = best_place(&l);
  for (int first = 0, end; first < graticule->insides; first = end) {
    const fg__map_label *label = &graticule->inside[first];
    int count = 1;
    while (first + count < graticule->insides && label[count].line == label->line)
      ++count;
    end = first + count;
    label_line(&l, label, count, best < count ? best : 0);
  }
}

void fg__map_scene_clear(fg__map_scene *scene)
{
  fg__polygons_clear(&scene->land);
  fg__polygons_clear(&scene->lakes);
  fg__polygons_clear(&scene->shore);
  fg__polygons_clear(&scene->banks);
  fg__polygons_clear(&scene->borders);
  fg__polygons_clear(&scene->missing);
  fg__polygons_clear(&scene->rim);
  fg__polygons_clear(&scene->graticule);
  fg__polygons_clear(&scene->outline);
  fg__polygons_clear(&scene->arrow_rims);
}
