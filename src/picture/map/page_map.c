#include "picture/map/page_map.h"

#include <math.h>
#include <stdlib.h>

#include "picture/polygons.h"

/* In units of the font size: from a line's end to its degrees; between two labels; the
 * height of a digit. */
static const double label_gap = 0.45, between = 0.5, digit = 2.0 * FG__HALF_DIGIT;

const fg__color fg__default_land = {0.925, 0.925, 0.918};
const fg__color fg__default_missing = {0.894, 0.906, 0.925};
static const fg__color coast_color = {0.56, 0.56, 0.56};
static const fg__color border_color = {0.70, 0.70, 0.70};
static const fg__color grid_color = {0.83, 0.83, 0.83};
static const fg__color outline_color = {0.333, 0.333, 0.333};
static const fg__color strong_coast = {0.20, 0.20, 0.20};
static const fg__color white = {1.0, 1.0, 1.0};

/* Points. */
static const double coast_width = 0.45, border_width = 0.35, grid_width = 0.45;
static const double outline_width = 0.7, rim_width = 0.5;

/* Coasts on a texture: dark with a pale rim. */
static const double strong_width = 0.6, strong_rim = 1.8, strong_opacity = 0.6;
static const double rim_dashes[] = {3.0, 2.0};

/* Stairs of a coarse grid are rounded on a texture over this share of the frame's longer
 * side, about that of two degrees on a map of the world. */
static const double stairs_share = 1.0 / 170.0;

/* What lies outside of the data, through which land is still to be seen. */
static const double fade = 0.72;

typedef struct anchor {
  double x, y;   /* on the page */
  double out[2]; /* y upwards */
  double width;  /* of the text */
} anchor;

/* How far left the outline comes beside a label at the left rim. */
static double rim_left_of(const fg__page *page, const fg__plane *plane, const anchor *a)
{
  double left = a->x;
  for (size_t n = 0; n < plane->outline.point_count; ++n) {
    double at[2] = {plane->outline.point[n][0], plane->outline.point[n][1]};
    fg__page_project(page, plane->low, at);
    if (fabs(at[1] - a->y) < 0.55 * page->font_size)
      left = fmin(left, at[0]);
  }
  return left;
}

static fg__page_box box_of(const fg__page *page, const fg__plane *plane, anchor a)
{
  const double em = page->font_size;
  if (plane->whole && !plane->disc && a.out[0] < -0.5)
    a.x = rim_left_of(page, plane, &a);
  const double away =
      label_gap * em + 0.5 * fabs(a.out[0]) * a.width + 0.5 * fabs(a.out[1]) * digit * em;
  const double x = a.x + away * a.out[0], y = a.y - away * a.out[1];
  const double half[2] = {0.5 * a.width, FG__HALF_DIGIT * em};
  return (fg__page_box){x - half[0], y - half[1], x + half[0], y + half[1]};
}

/* The first text from a number on that is too near to a box; -1: none. */
static int text_near(const fg__page *page, int from, const fg__page_box *box)
{
  const double gap = between * page->font_size;
  for (int k = from; k < page->text_count; ++k) {
    const fg__page_box *other = &page->text[k].box;
    if (box->x0 - gap < other->x1 && other->x0 < box->x1 + gap &&
        box->y0 - 0.3 * gap < other->y1 && other->y0 < box->y1 + 0.3 * gap)
      return k;
  }
  return -1;
}

static bool is_at(const fg__page_sides *sides, const fg__map_label *label)
{
  return fabs(label->out[0]) > fabs(label->out[1])
             ? (label->out[0] < 0.0 ? sides->left : sides->right)
             : (label->out[1] < 0.0 ? sides->bottom : sides->top);
}

/* Which lines of a family, meridians or parallels, are labelled: every `stride`th from
 * the middle one on. */
typedef struct choice {
  int middle, stride;
  bool crowded; /* one of them found no place */
} choice;

enum { FAMILIES = 2, MOST_STRIDE = 4 };

static bool is_chosen(const choice *families, int line)
{
  const choice *c = &families[line / FG__TICK_LIMIT];
  return abs(line % FG__TICK_LIMIT - c->middle) % c->stride == 0;
}

static void find_middles(choice families[FAMILIES], const fg__graticule *graticule)
{
  for (int f = 0; f < FAMILIES; ++f) {
    int first = FG__TICK_LIMIT, last = 0;
    for (int k = 0; k < graticule->labels; ++k) {
      const int line = graticule->label[k].line - f * FG__TICK_LIMIT;
      if (line < 0 || line >= FG__TICK_LIMIT)
        continue;
      first = line < first ? line : first;
      last = line > last ? line : last;
    }
    /* of three both ends tell more than the middle */
    const bool are_three = last - first == 2 && !graticule->plane->whole;
    families[f] =
        (choice){.middle = are_three ? first : (first + last + 1) / 2, .stride = 1};
  }
}

static void place_labels(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, choice families[FAMILIES],
                         cairo_t *ruler)
{
  const fg__graticule *graticule = plan->graticule;
  const fg__plane *plane = graticule->plane;
  const int from = page->text_count;
  bool done[FAMILIES * FG__TICK_LIMIT] = {false};
  int family_of[FG__PAGE_TEXTS];
  for (int k = 0; k < graticule->labels; ++k) {
    const fg__map_label *label = &graticule->label[k];
    double at[2] = {label->at[0], label->at[1]};
    fg__page_project(page, plane->low, at);
    const anchor a = {.x = at[0],
                      .y = at[1],
                      .out = {label->out[0], label->out[1]},
                      .width =
                          fg__text_width(ruler, label->text, page->font_size, false)};
    const fg__page_box box = box_of(page, plane, a);
    const int family = label->line / FG__TICK_LIMIT;
    if (done[label->line] || !is_chosen(families, label->line))
      continue;
    const int near = text_near(page, from, &box);
    if (!plane->disc && !is_at(&parts->sides, label)) {
      done[label->line] = near < 0;
      continue;
    }
    if (near >= 0) {
      const bool between_others = family_of[near] == family;
      const bool at_first_side = label->out[family == 0 ? 1 : 0] < -0.5;
      families[family].crowded =
          families[family].crowded || plane->whole || (between_others && at_first_side);
      /* a line between two that have theirs at this side needs none at the other */
      done[label->line] = between_others;
      continue;
    }
    done[label->line] = true;
    family_of[page->text_count] = family;
    fg__page_text *text = fg__page_next_text(page, label->text);
    if (!text)
      return;
    text->quiet = true;
    text->x = box.x0;
    text->y = box.y1;
    text->box = (fg__page_box){box.x0, text->y - FG__TEXT_ASCENT * page->font_size,
                               box.x1, text->y + FG__TEXT_DESCENT * page->font_size};
    fg__margins_hold(room, &page->frame, &text->box);
  }
}

void fg__page_place_graticule(fg__page *page, fg__margins *room,
                              const fg__page_plan *plan, const fg__page_parts *parts,
                              cairo_t *ruler)
{
  const fg__margins before = *room;
  const int texts = page->text_count;
  choice families[FAMILIES];
  find_middles(families, plan->graticule);
  for (;;) {
    bool again = false;
    place_labels(page, room, plan, parts, families, ruler);
    /* every second degree is read more easily than those that have room */
    for (int f = 0; f < FAMILIES; ++f) {
      again = again || (families[f].crowded && families[f].stride < MOST_STRIDE);
      families[f].stride += families[f].crowded && families[f].stride < MOST_STRIDE;
      families[f].crowded = false;
    }
    if (!again)
      return;
    page->text_count = texts;
    *room = before;
  }
}

static void set_color(cairo_t *cairo, fg__color color)
{
  cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
}

static void add_lines(cairo_t *cairo, const fg__polygons *lines, bool closed)
{
  for (size_t k = 0; k < lines->count; ++k) {
    cairo_new_sub_path(cairo);
    for (size_t n = lines->start[k]; n < lines->start[k + 1]; ++n)
      cairo_line_to(cairo, lines->point[n][0], lines->point[n][1]);
    if (closed)
      cairo_close_path(cairo);
  }
}

static void stroke(cairo_t *cairo, const fg__polygons *lines, double width,
                   fg__color color)
{
  if (!lines->count)
    return;
  add_lines(cairo, lines, false);
  cairo_set_line_width(cairo, width);
  set_color(cairo, color);
  cairo_stroke(cairo);
}

void fg__map_clip(cairo_t *cairo, const fg__map_scene *scene)
{
  if (!scene->outline.count)
    return;
  add_lines(cairo, &scene->outline, true);
  cairo_clip(cairo);
}

static void fill_missing(cairo_t *cairo, const fg__map_scene *scene,
                         const fg__map_style *style)
{
  if (!scene->missing.count)
    return;
  add_lines(cairo, &scene->missing, true);
  cairo_set_source_rgba(cairo, style->missing.red, style->missing.green,
                        style->missing.blue, scene->missing_on_land ? fade : 1.0);
  cairo_fill(cairo);
}

/* Land and lines that end at the outline need no clip, which is slow, and long in SVG. */
static void save(cairo_t *cairo, const fg__map_scene *scene, const fg__map_style *style)
{
  cairo_save(cairo);
  if (scene->contained && !style->on_texture)
    cairo_reset_clip(cairo);
}

fg_status fg__map_cover_smooth(fg__map_cover *cover, fg_context *context,
                               const double low[2], const double high[2])
{
  const double distance = stairs_share * fmax(high[0] - low[0], high[1] - low[1]);
  if (fg__polygons_add_smooth(&cover->smooth, &cover->exact, distance, low, high))
    return FG_STATUS_OK;
  return fg__fail_memory(context, "a map's outlines",
                         cover->exact.point_count * sizeof *cover->exact.point);
}

void fg__map_cover_clear(fg__map_cover *cover)
{
  fg__polygons_clear(&cover->exact);
  fg__polygons_clear(&cover->smooth);
}

void fg__map_draw_land(cairo_t *cairo, const fg__map_scene *scene,
                       const fg__map_style *style, const fg__map_cover *cover)
{
  save(cairo, scene, style);
  if (cover) {
    add_lines(cairo, &cover->smooth, true);
    set_color(cairo, style->missing);
    cairo_fill_preserve(cairo);
    add_lines(cairo, &cover->exact, true);
    if (scene->missing_on_land) /* else of the sea alone: land covers what there is on it
                                 */
      cairo_clip(cairo);
    cairo_new_path(cairo);
  }
  if (!scene->missing_on_land && !cover)
    fill_missing(cairo, scene, style);
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  add_lines(cairo, &scene->land, true);
  set_color(cairo, style->land);
  cairo_fill(cairo);
  if (!style->transparent && scene->lakes.count) {
    add_lines(cairo, &scene->lakes, true);
    set_color(cairo, scene->missing_lakes ? style->missing : white);
    cairo_fill(cairo);
  }
  cairo_restore(cairo);
}

static void draw_rim(cairo_t *cairo, const fg__map_scene *scene)
{
  cairo_save(cairo);
  cairo_set_dash(cairo, rim_dashes, 2, 0.0);
  stroke(cairo, &scene->rim, rim_width, coast_color);
  cairo_restore(cairo);
}

static void draw_strong(cairo_t *cairo, const fg__map_scene *scene)
{
  add_lines(cairo, &scene->banks, false);
  add_lines(cairo, &scene->shore, false);
  cairo_set_line_width(cairo, strong_rim);
  cairo_set_source_rgba(cairo, 1.0, 1.0, 1.0, strong_opacity);
  cairo_stroke_preserve(cairo);
  cairo_set_line_width(cairo, strong_width);
  set_color(cairo, strong_coast);
  cairo_stroke(cairo);
  stroke(cairo, &scene->borders, border_width, strong_coast);
}

void fg__map_draw_lines(cairo_t *cairo, const fg__map_scene *scene,
                        const fg__map_style *style)
{
  save(cairo, scene, style);
  stroke(cairo, &scene->graticule, grid_width, grid_color);
  if (style->on_texture) { /* which ends where the data do */
    draw_strong(cairo, scene);
  } else {
    stroke(cairo, &scene->borders, border_width, border_color);
    stroke(cairo, &scene->banks, coast_width, coast_color);
    stroke(cairo, &scene->shore, coast_width, coast_color);
    if (scene->missing_on_land)
      fill_missing(cairo, scene, style);
    draw_rim(cairo, scene);
  }
  cairo_restore(cairo);
}

void fg__map_draw_outline_in(cairo_t *cairo, const fg__map_scene *scene, double width,
                             double height)
{
  if (!scene->outline.count)
    return;
  cairo_set_line_width(cairo, outline_width);
  set_color(cairo, outline_color);
  cairo_save(cairo);
  cairo_rectangle(cairo, 0.0, 0.0, width, height);
  cairo_clip(cairo);
  add_lines(cairo, &scene->outline, true);
  cairo_stroke(cairo);
  cairo_restore(cairo);
  cairo_save(cairo);
  fg__map_clip(cairo, scene);
  cairo_rectangle(cairo, 0.5 * outline_width, 0.5 * outline_width, width - outline_width,
                  height - outline_width);
  cairo_stroke(cairo);
  cairo_restore(cairo);
}

void fg__map_draw_outline(cairo_t *cairo, const fg__map_scene *scene)
{
  if (!scene->outline.count)
    return;
  add_lines(cairo, &scene->outline, true);
  cairo_set_line_width(cairo, outline_width);
  set_color(cairo, outline_color);
  cairo_stroke(cairo);
}
