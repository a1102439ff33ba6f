#include "picture/page/page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/page/symbols.h"

/* The default width: a figure in a journal, between one and two columns. */
static const double default_width = 480.0;

/* 9 points at the default width: what journals ask for. It grows with the root of the
 * size, as on posters; below 7 points print is unreadable. */
static const double default_font = 9.0;
static const double smallest_font = 7.0;

/* Without a wish for a height, a frame is at most so many page widths high: it then fits
 * on a page. */
static const double tallest_frame = 1.4;

/* Wider domains have their keys below, others beside them: the page then comes out nearer
 * to the golden section than the domain. */
static const double wide_domain = 1.3;

/* Of the scale that a bare domain would have, what decorations must leave. */
static const double least_share = 0.45;

/* Of lengths that are sums of the same lengths, points. */
static const double rounding = 1e-9;

/* The widths that are tried for one at which a page has its key. */
static const double key_step = 1.05, most_times = 1e3;

/* Passes in which the margins may grow until everything fits; three is usual, small pages
 * need more. */
enum { PASSES = 24 };

double fg__page_font_size(const fg__page_plan *plan)
{
  if (plan->font_size > 0.0)
    return plan->font_size;
  double size = plan->width > 0.0 ? plan->width : default_width;
  if (plan->height > 0.0)
    size = fmin(size, tallest_frame * plan->height);
  return fmax(default_font * sqrt(size / default_width), smallest_font);
}

static double extent(const fg__page_plan *plan, int k)
{
  return plan->axis[k].high - plan->axis[k].low;
}

/* Page and frame for the given margins, and gaps between panels; false when nothing is
 * left for the frame. */
static bool place_frame(fg__page *page, const fg__page_plan *plan,
                        const fg__margins *margins, const double gap[2], double narrowest)
{
  const int across = fg__page_frames(plan, 0), upright = fg__page_frames(plan, 1);
  const double gaps[2] = {(across - 1) * gap[0], (upright - 1) * gap[1]};
  double widest = plan->width > 0.0 ? plan->width : default_width;
  double wide = widest - margins->left - margins->right - gaps[0];
  double high = plan->height > 0.0
                    ? plan->height - margins->top - margins->bottom - gaps[1]
                    : tallest_frame * widest;
  if (!(wide > 0.0 && high > 0.0))
    return false;
  if (plan->no_frame && !(plan->height > 0.0))
    high = HUGE_VAL; /* the domain's box and nothing else */
  page->scale =
      fmin(wide / (across * extent(plan, 0)), high / (upright * extent(plan, 1)));
  double frame_wide = across * page->scale * extent(plan, 0) + gaps[0];
  double frame_high = upright * page->scale * extent(plan, 1) + gaps[1];
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

static void clear(fg__page *page, const fg__page_parts *parts)
{
  page->has_degrees = parts->axes;
  page->text_count = 0;
  page->line_count = 0;
  page->has_color_key = false;
  page->has_size_key = false;
  page->symbol_count = 0;
}

/* Between bare panels: a share of theirs, so that something is left of each. */
static double bare_gap(const fg__page_plan *plan)
{
  const double wide = plan->width > 0.0 ? plan->width : default_width;
  const double high = plan->height > 0.0 ? plan->height : wide;
  return 0.03 * fmin(wide / fg__page_frames(plan, 0), high / fg__page_frames(plan, 1));
}

/* What lies round the frame, or the panels' frames, but for keys and caption. */
static void place_round(fg__page *page, fg__page *panel, fg__margins *room,
                        double between[2], const fg__page_plan *plan,
                        const fg__page_parts *parts, cairo_t *ruler)
{
  if (panel)
    fg__page_place_panels(panel, room, between, plan, parts, ruler);
  else
    fg__page_place_sides(page, room, plan, parts, ruler);
}

/* Lets the margins, and the gaps between panels, grow until all the parts fit into them.
 */
static bool lay_out(fg__page *page, fg__page *panel, const fg__page_plan *plan,
                    const fg__page_parts *parts, cairo_t *ruler)
{
  const double em = page->font_size;
  const double edge = plan->no_frame ? 0.0 : 0.6 * em;
  fg__margins margins = {edge, edge, edge, edge};
  double gap[2] = {0.0, 0.0};
  if (plan->no_frame)
    gap[0] = gap[1] = bare_gap(plan);
  for (int pass = 0; pass < PASSES; ++pass) {
    clear(page, parts);
    if (!place_frame(page, plan, &margins, gap, parts->caption ? 24.0 * em : 0.0))
      return false;
    fg__margins room = {0.0, 0.0, 0.0, 0.0};
    double between[2] = {0.0, 0.0};
    for (int k = 0; panel && k < plan->panels; ++k)
      clear(&panel[k], parts);
    fg__page_place_frames(page, panel, plan, gap);
    place_round(page, panel, &room, between, plan, parts, ruler);
    if (parts->color_key || parts->size_key)
      fg__page_place_keys(page, &room, plan, parts, ruler);
    if (parts->symbols)
      fg__page_place_symbols(page, &room, plan, ruler);
    if (parts->caption)
      fg__page_place_caption(page, &room, plan, ruler);
    const double spare = rounding - edge;
    bool fits = room.left <= margins.left + spare &&
                room.right <= margins.right + spare && room.top <= margins.top + spare &&
                room.bottom <= margins.bottom + spare &&
                between[0] <= gap[0] + rounding && between[1] <= gap[1] + rounding;
    if (fits)
      return !parts->color_key || page->has_color_key;
    margins.left = fmax(margins.left, room.left + edge);
    margins.right = fmax(margins.right, room.right + edge);
    margins.top = fmax(margins.top, room.top + edge);
    margins.bottom = fmax(margins.bottom, room.bottom + edge);
    for (int k = 0; k < 2; ++k)
      gap[k] = fmax(gap[k], between[k]);
  }
  return false;
}

/* The scale without any decoration: what the others are measured by. */
static double bare_scale(const fg__page_plan *plan)
{
  fg__page bare = {0};
  fg__margins none = {0.0, 0.0, 0.0, 0.0};
  place_frame(&bare, plan, &none, (double[2]){0.0, 0.0}, 0.0);
  return bare.scale;
}

static bool keys_below(fg__page *page, fg__page *panel, const fg__page_plan *plan,
                       fg__page_parts parts, cairo_t *ruler)
{
  if (!(plan->height > 0.0))
    return fg__page_frames(plan, 0) * extent(plan, 0) >
           wide_domain * fg__page_frames(plan, 1) * extent(plan, 1);
  parts.keys_below = false;
  double beside = lay_out(page, panel, plan, &parts, ruler) ? page->scale : 0.0;
  parts.keys_below = true;
  double below = lay_out(page, panel, plan, &parts, ruler) ? page->scale : 0.0;
  return below > beside;
}

/* Whether the parts leave the domain its room, the keys where they belong or, where they
 * make a page of free height no narrower, below. */
static bool lay_out_well(fg__page *out, fg__page *panel, const fg__page_plan *plan,
                         fg__page_parts *parts, double least, cairo_t *ruler)
{
  parts->keys_below = keys_below(out, panel, plan, *parts, ruler);
  if (lay_out(out, panel, plan, parts, ruler) && out->scale >= least)
    return true;
  parts->keys_below = true;
  return lay_out(out, panel, plan, parts, ruler) && out->scale >= least;
}

static bool has_symbols(const fg__page_plan *plan)
{
  bool any = false;
  for (int k = 0; k < FG__SYMBOL_KINDS; ++k)
    any = any || plan->has_symbol[k];
  return any;
}

/* Brings back what was left out in vain, before what did not fit was: the caption, say,
 * of a page that is too narrow. */
static void bring_back(fg__page *out, fg__page *panel, const fg__page_plan *plan,
                       fg__page_parts *parts, double least, cairo_t *ruler)
{
  const bool wanted[] = {plan->title[0] || plan->subtitle[0], parts->axes,
                         has_symbols(plan), plan->size_key};
  bool *const part[] = {&parts->caption, &parts->axis_labels, &parts->symbols,
                        &parts->size_key};
  for (int k = 0; k < 4; ++k) {
    const fg__page_parts before = *parts;
    if (*part[k] || !wanted[k] || plan->no_frame)
      continue;
    *part[k] = true;
    if (!lay_out_well(out, panel, plan, parts, least, ruler)) {
      *parts = before;
      lay_out_well(out, panel, plan, parts, least, ruler);
    }
  }
}

void fg__page_layout(fg__page *out, const fg__page_plan *plan, cairo_t *ruler)
{
  fg__page_layout_panels(out, NULL, plan, ruler);
}

double fg__page_key_width(fg__page *page, fg__page *panel, const fg__page_plan *plan)
{
  fg__page_plan wider = *plan;
  cairo_t *ruler = fg__text_ruler();
  const double width =
      plan->width > 0.0 || plan->height > 0.0 ? plan->width : default_width;
  double times = 1.0;
  fg__page_layout_panels(page, panel, plan, ruler);
  if (!plan->color_key || plan->no_frame || page->has_color_key)
    page->width = 0.0;
  while (page->width > 0.0 && !page->has_color_key && times < most_times) {
    times *= key_step;
    wider.width = times * width;
    wider.height = times * plan->height;
    fg__page_layout_panels(page, panel, &wider, ruler);
  }
  cairo_destroy(ruler);
  return page->width;
}

void fg__page_layout_panels(fg__page *out, fg__page *panel, const fg__page_plan *plan,
                            cairo_t *ruler)
{
  const fg__page empty = {.font_size = fg__page_font_size(plan),
                          .framed = !plan->no_frame && !plan->outlined};
  *out = empty;
  for (int k = 0; panel && k < plan->panels; ++k)
    panel[k] = empty;
  out->framed = empty.framed && !plan->panels;
  fg__page_parts parts = {.axes = !plan->no_frame,
                          .axis_labels = !plan->no_frame,
                          .color_key = plan->color_key && !plan->no_frame,
                          .size_key = plan->size_key && !plan->no_frame,
                          .symbols = has_symbols(plan) && !plan->no_frame,
                          .caption =
                              (plan->title[0] || plan->subtitle[0]) && !plan->no_frame,
                          .sides = {true, true, true, true}};
  bool *const dispensable[] = {&parts.size_key, &parts.axis_labels, &parts.symbols,
                               &parts.caption,  &parts.axes,        &parts.color_key,
                               &parts.axes};
  size_t count = sizeof dispensable / sizeof *dispensable, k = 0;
  double least = least_share * bare_scale(plan);
  while (k < count && !lay_out_well(out, panel, plan, &parts, least, ruler)) {
    *dispensable[k] = false;
    if (dispensable[k] == &parts.color_key) /* which may have left the axes no room */
      parts.axes = !plan->no_frame;
    ++k;
  }
  if (k < count) {
    bring_back(out, panel, plan, &parts, least, ruler);
    return;
  }
  fg__page_plan bare = *plan;
  if (!lay_out(out, panel, &bare, &parts, ruler)) {
    /* smaller than its own margins: the domain fills the page */
    bare.no_frame = true;
    lay_out(out, panel, &bare, &parts, ruler);
  }
}
