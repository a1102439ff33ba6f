/* Panels of a page: frames of one size in columns and rows. */
#include "picture/page/page.h"

#include <math.h>
#include <string.h>

#include "picture/map/page_map.h"

/* Width over height that the panels together shall come near to, without a wish for the
 * page's; and what an empty place costs beside a factor e in that. */
static const double wanted_shape = 1.5;
static const double empty_cost = 5.0;

/* In units of the font size: between two panels, and between a label and what it is above
 * of. */
static const double panel_gap = 1.0, label_gap = 0.35;

/* Labels shrink to this share of the texts' size before they are broken into lines. */
static const double least_label = 0.8;
enum { MOST_LABEL_LINES = 2 };

int fg__page_frames(const fg__page_plan *plan, int k)
{
  if (plan->panels == 0)
    return 1;
  return k == 0 ? plan->columns : (plan->panels + plan->columns - 1) / plan->columns;
}

int fg__page_choose_columns(const fg__page_plan *plan)
{
  const double shape =
      (plan->axis[0].high - plan->axis[0].low) / (plan->axis[1].high - plan->axis[1].low);
  const double wanted =
      plan->width > 0.0 && plan->height > 0.0 ? plan->width / plan->height : wanted_shape;
  int best = 1;
  double least = HUGE_VAL;
  for (int columns = 1; columns <= plan->panels; ++columns) {
    const int rows = (plan->panels + columns - 1) / columns;
    const double places = (double)columns * rows;
    const double cost = fabs(log(shape * columns / rows / wanted)) +
                        empty_cost * (places - plan->panels) / places;
    if (cost <= least) {
      least = cost;
      best = columns;
    }
  }
  return best;
}

void fg__page_place_frames(const fg__page *page, fg__page *panel,
                           const fg__page_plan *plan, const double gap[2])
{
  const double wide = page->scale * (plan->axis[0].high - plan->axis[0].low);
  const double high = page->scale * (plan->axis[1].high - plan->axis[1].low);
  for (int k = 0; k < plan->panels; ++k) {
    const int column = k % plan->columns, row = k / plan->columns;
    const double x0 = page->frame.x0 + column * (wide + gap[0]);
    const double y0 = page->frame.y0 + row * (high + gap[1]);
    panel[k].width = page->width;
    panel[k].height = page->height;
    panel[k].scale = page->scale;
    panel[k].frame = (fg__page_box){x0, y0, x0 + wide, y0 + high};
  }
}

void fg__page_place_sides(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                          const fg__page_parts *parts, cairo_t *ruler)
{
  if (parts->axes && plan->graticule)
    fg__page_place_graticule(page, room, plan, parts, ruler);
  else if (parts->axes)
    fg__page_place_axes(page, room, plan, parts, ruler);
}

/* Sides at which no other panel is. */
static fg__page_sides outer_sides(const fg__page_plan *plan, int k)
{
  return (fg__page_sides){.left = k % plan->columns == 0,
                          .right = (k + 1) % plan->columns == 0 || k + 1 == plan->panels,
                          .bottom = k + plan->columns >= plan->panels,
                          .top = k < plan->columns};
}

/* What the texts and ticks of a panel take up round its frame. */
static fg__margins taken(const fg__page *panel)
{
  fg__margins out = {0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < panel->text_count; ++k)
    fg__margins_hold(&out, &panel->frame, &panel->text[k].box);
  for (int k = 0; k < panel->line_count; ++k) {
    const fg__page_line *line = &panel->line[k];
    fg__margins_hold(&out, &panel->frame,
                     &(fg__page_box){line->x0, line->y0, line->x1, line->y1});
  }
  return out;
}

/* What a label must stand above: texts over the frame, not those left of it. */
static double top_of(const fg__page *page)
{
  double top = 0.0;
  for (int k = 0; k < page->text_count; ++k)
    if (page->text[k].box.x1 > page->frame.x0)
      top = fmax(top, page->frame.y0 - page->text[k].box.y0);
  return top;
}

/* The labels' size, and in how many lines they are: all in one where that makes them
 * little smaller. */
static double fit_labels(int *limit, const fg__page_plan *plan, cairo_t *ruler, double em,
                         double width)
{
  char line[MOST_LABEL_LINES][FG__PAGE_TEXT_BYTES];
  double widest = 0.0, size = em;
  int lines;
  for (int k = 0; k < plan->panels; ++k)
    widest = fmax(widest, fg__text_width(ruler, plan->panel_label[k], em, false));
  *limit = least_label * widest <= width ? 1 : MOST_LABEL_LINES;
  if (*limit == 1)
    return widest > width ? em * width / widest : em;
  for (int k = 0; k < plan->panels; ++k)
    size = fmin(size, fg__page_fit_lines(line, *limit, &lines, ruler,
                                         plan->panel_label[k], em, false, width));
  return size;
}

/* Labels of panels side by side begin at one height. */
static void place_labels(fg__page *row, int count, double top, int limit, double size,
                         const char (*label)[FG__PAGE_TEXT_BYTES], cairo_t *ruler)
{
  char line[MOST_LABEL_LINES][FG__PAGE_TEXT_BYTES];
  const double width = row->frame.x1 - row->frame.x0;
  const double em = row->font_size, step = 1.25 * size;
  fg__margins room = {0}; /* found from all texts of the panel */
  int lines, most = 1;
  for (int k = 0; k < count; ++k) {
    fg__page_break_lines(line, limit, &lines, ruler, label[k], size, false, width);
    most = lines > most ? lines : most;
  }
  for (int k = 0; k < count; ++k) {
    double y = row->frame.y0 - top - label_gap * em - FG__TEXT_DESCENT * size;
    y -= (most - 1) * step;
    fg__page_break_lines(line, limit, &lines, ruler, label[k], size, false, width);
    for (int n = 0; n < lines; ++n, y += step) {
      const fg__words words = {.text = line[n], .size = size};
      fg__page_add_text(&row[k], &room, ruler, &words, row[k].frame.x0, y);
    }
  }
}

/* What lies round the panels of a row that begins with panel k. */
static void place_row(fg__page *panel, int k, int limit, double size,
                      const fg__page_plan *plan, const fg__page_parts *parts,
                      cairo_t *ruler)
{
  const int left = plan->panels - k;
  const int count = left < plan->columns ? left : plan->columns;
  double top = 0.0;
  for (int n = k; n < k + count; ++n) {
    fg__margins room = {0.0, 0.0, 0.0, 0.0};
    fg__page_parts its = *parts;
    its.sides = outer_sides(plan, n);
    fg__page_place_sides(&panel[n], &room, plan, &its, ruler);
    top = fmax(top, top_of(&panel[n]));
  }
  place_labels(&panel[k], count, top, limit, size, &plan->panel_label[k], ruler);
}

void fg__page_place_panels(fg__page *panel, fg__margins *room, double between[2],
                           const fg__page_plan *plan, const fg__page_parts *parts,
                           cairo_t *ruler)
{
  const double gap = panel_gap * panel->font_size;
  const double width = panel->frame.x1 - panel->frame.x0;
  const int columns = plan->columns;
  int limit;
  if (plan->no_frame)
    return;
  const double size = fit_labels(&limit, plan, ruler, panel->font_size, width);
  for (int k = 0; k < plan->panels; k += columns)
    place_row(panel, k, limit, size, plan, parts, ruler);
  for (int k = 0; k < plan->panels; ++k) {
    const fg__margins own = taken(&panel[k]);
    const bool has_next = k % columns != columns - 1 && k + 1 < plan->panels;
    const bool has_below = k + columns < plan->panels;
    if (k % columns == 0)
      room->left = fmax(room->left, own.left);
    if (k % columns == columns - 1)
      room->right = fmax(room->right, own.right);
    if (k < columns)
      room->top = fmax(room->top, own.top);
    if (k / columns == (plan->panels - 1) / columns)
      room->bottom = fmax(room->bottom, own.bottom);
    if (has_next)
      between[0] = fmax(between[0], own.right + taken(&panel[k + 1]).left + gap);
    if (has_below)
      between[1] = fmax(between[1], own.bottom + taken(&panel[k + columns]).top + gap);
  }
}
