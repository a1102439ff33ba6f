#include "picture/page/page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/map/page_map.h"

/* A figure's usual size in a journal, between one and two columns. */
static const double usual_width = 480.0;

/* 9 points at the usual width: what journals ask for. It grows with the root of the size,
 * as on posters; below 7 points print is unreadable. */
static const double usual_font = 9.0;
static const double smallest_font = 7.0;

/* Without a wish for a height, a frame is at most so many page widths high: it then fits
 * on a page. */
static const double tallest_frame = 1.4;

/* Wider domains have their keys below, others beside them: the page then comes out nearer
 * to the golden section than the domain. */
static const double wide_domain = 1.3;

/* Of the scale that a bare domain would have, what decorations must leave. */
static const double least_share = 0.45;

/* A caption cut to a few letters says nothing; in units of the font size. */
static const double shortest_caption = 8.0;

/* Passes in which the margins may grow until everything fits; three is usual. */
enum { PASSES = 12 };

static double font_size(const fg__page_plan *plan)
{
  if (plan->font_size > 0.0)
    return plan->font_size;
  double size = plan->width > 0.0 ? plan->width : usual_width;
  if (plan->height > 0.0)
    size = fmin(size, tallest_frame * plan->height);
  return fmax(usual_font * sqrt(size / usual_width), smallest_font);
}

static double extent(const fg__page_plan *plan, int k)
{
  return plan->axis[k].high - plan->axis[k].low;
}

/* Lines of a caption, the title's first. */
typedef struct caption {
  char line[FG__CAPTION_LINES][FG__PAGE_TEXT_BYTES];
  int titles, count;
  double title_size, size;
} caption;

/* Titles that are too long for their lines shrink, so far as they are still read. */
static void break_caption(caption *out, const fg__page_plan *plan, cairo_t *ruler,
                          double em, double width)
{
  out->title_size = fg__page_fit_lines(out->line, FG__TITLE_LINES, &out->titles, ruler,
                                       plan->title, 1.1 * em, true, width);
  out->size =
      fg__page_fit_lines(out->line + out->titles, FG__CAPTION_LINES - FG__TITLE_LINES,
                         &out->count, ruler, plan->subtitle, em, false, width);
  out->count += out->titles;
}

/* The caption stands above whatever else stands above the frame. */
static void place_caption(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                          cairo_t *ruler)
{
  const double em = page->font_size, pad = 0.6 * em;
  double start = fmin(fmax(page->frame.x0, pad), 0.35 * page->width);
  double width = page->width - pad - start;
  caption lines;
  if (width < shortest_caption * em)
    return;
  break_caption(&lines, plan, ruler, em, width);
  double y = page->frame.y0 - room->top - 0.7 * em - FG__TEXT_DESCENT * em;
  for (int k = lines.count - 1; k >= 0; --k) {
    fg__page_text *added = fg__page_next_text(page, lines.line[k]);
    if (!added)
      return;
    added->bold = k < lines.titles;
    added->quiet = !added->bold;
    added->size = added->bold ? lines.title_size : lines.size;
    added->x = start;
    added->y = y;
    double wide = fg__text_width(ruler, lines.line[k], added->size, added->bold);
    added->box = (fg__page_box){start, y - FG__TEXT_ASCENT * added->size, start + wide,
                                y + FG__TEXT_DESCENT * added->size};
    y -= 1.3 * added->size;
    room->top = page->frame.y0 - added->box.y0;
  }
}

/* Page and frame for the given margins; false when nothing is left for the frame. */
static bool place_frame(fg__page *page, const fg__page_plan *plan,
                        const fg__margins *margins, double narrowest)
{
  double widest = plan->width > 0.0 ? plan->width : usual_width;
  double wide = widest - margins->left - margins->right;
  double high = plan->height > 0.0 ? plan->height - margins->top - margins->bottom
                                   : tallest_frame * widest;
  if (!(wide > 0.0 && high > 0.0))
    return false;
  if (plan->no_frame && !(plan->height > 0.0))
    high = HUGE_VAL; /* the domain's box and nothing else */
  page->scale = fmin(wide / extent(plan, 0), high / extent(plan, 1));
  double frame_wide = page->scale * extent(plan, 0);
  double frame_high = page->scale * extent(plan, 1);
  page->width = widest;
  if (!(plan->width > 0.0))
    page->width =
        fmin(fmax(margins->left + frame_wide + margins->right, narrowest), widest);
  page->height =
      plan->height > 0.0 ? plan->height : margins->top + frame_high + margins->bottom;
  double spare_x = page->width - margins->left - margins->right - frame_wide;
  double spare_y = page->height - margins->top - margins->bottom - frame_high;
  page->frame.x0 = margins->left + 0.5 * spare_x;
  page->frame.y0 = margins->top + 0.5 * spare_y;
  page->frame.x1 = page->frame.x0 + frame_wide;
  page->frame.y1 = page->frame.y0 + frame_high;
  return true;
}

/* Lets the margins grow until all the parts fit into them. */
static bool lay_out(fg__page *page, const fg__page_plan *plan,
                    const fg__page_parts *parts, cairo_t *ruler)
{
  const double em = page->font_size;
  const double edge = plan->no_frame ? 0.0 : 0.6 * em;
  fg__margins margins = {edge, edge, edge, edge};
  for (int pass = 0; pass < PASSES; ++pass) {
    page->text_count = 0;
    page->line_count = 0;
    page->has_color_key = false;
    page->has_size_key = false;
    if (!place_frame(page, plan, &margins, parts->caption ? 24.0 * em : 0.0))
      return false;
    fg__margins room = {0.0, 0.0, 0.0, 0.0};
    if (parts->axes && plan->graticule)
      fg__page_place_graticule(page, &room, plan, ruler);
    else if (parts->axes)
      fg__page_place_axes(page, &room, plan, parts, ruler);
    if (parts->color_key || parts->size_key)
      fg__page_place_keys(page, &room, plan, parts, ruler);
    if (parts->caption)
      place_caption(page, &room, plan, ruler);
    bool fits = room.left + edge <= margins.left && room.right + edge <= margins.right &&
                room.top + edge <= margins.top && room.bottom + edge <= margins.bottom;
    if (fits)
      return true;
    margins.left = fmax(margins.left, room.left + edge);
    margins.right = fmax(margins.right, room.right + edge);
    margins.top = fmax(margins.top, room.top + edge);
    margins.bottom = fmax(margins.bottom, room.bottom + edge);
  }
  return false;
}

/* The scale without any decoration: what the others are measured by. */
static double bare_scale(const fg__page_plan *plan)
{
  fg__page bare = {0};
  fg__margins none = {0.0, 0.0, 0.0, 0.0};
  place_frame(&bare, plan, &none, 0.0);
  return bare.scale;
}

static bool keys_below(fg__page *page, const fg__page_plan *plan, fg__page_parts parts,
                       cairo_t *ruler)
{
  if (!(plan->height > 0.0))
    return extent(plan, 0) > wide_domain * extent(plan, 1);
  parts.keys_below = false;
  double beside = lay_out(page, plan, &parts, ruler) ? page->scale : 0.0;
  parts.keys_below = true;
  double below = lay_out(page, plan, &parts, ruler) ? page->scale : 0.0;
  return below > beside;
}

void fg__page_layout(fg__page *out, const fg__page_plan *plan, cairo_t *ruler)
{
  *out = (fg__page){.font_size = font_size(plan),
                    .framed = !plan->no_frame && !plan->outlined};
  fg__page_parts parts = {.axes = !plan->no_frame,
                          .axis_labels = !plan->no_frame,
                          .color_key = plan->color_key && !plan->no_frame,
                          .size_key = plan->size_key && !plan->no_frame,
                          .caption =
                              (plan->title[0] || plan->subtitle[0]) && !plan->no_frame};
  bool *const dispensable[] = {&parts.size_key, &parts.axis_labels, &parts.caption,
                               &parts.color_key, &parts.axes};
  size_t count = sizeof dispensable / sizeof *dispensable;
  double least = least_share * bare_scale(plan);
  for (size_t k = 0; k < count; ++k) {
    parts.keys_below = keys_below(out, plan, parts, ruler);
    if (lay_out(out, plan, &parts, ruler) && out->scale >= least)
      return;
    *dispensable[k] = false;
  }
  fg__page_plan bare = *plan;
  if (!lay_out(out, &bare, &parts, ruler)) {
    /* smaller than its own margins: the domain fills the page */
    bare.no_frame = true;
    lay_out(out, &bare, &parts, ruler);
  }
}
