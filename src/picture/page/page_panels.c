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

/* What a label must stand above: texts over the frame, not those left of it. */
static double top_of(const fg__page *page)
{
  double top = 0.0;
  for (int k = 0; k < page->text_count; ++k)
    if (page->text[k].box.x1 > page->frame.x0)
      top = fmax(top, page->frame.y0 - page->text[k].box.y0);
  return top;
}

/* Returns how far above the frame it comes. */
static double place_label(fg__page *page, double top, const char *label, cairo_t *ruler)
{
  const double em = page->font_size;
  char line[MOST_LABEL_LINES][FG__PAGE_TEXT_BYTES];
  int lines;
  const double size = fg__page_fit_lines(line, MOST_LABEL_LINES, &lines, ruler, label, em,
                                         false, page->frame.x1 - page->frame.x0);
  double y = page->frame.y0 - top - (label_gap + FG__TEXT_DESCENT) * em;
  for (int k = lines - 1; k >= 0; --k) {
    fg__page_add_text(page, ruler, line[k], page->frame.x0, y, FG__ALIGN_START);
    fg__page_text *text = &page->text[page->text_count - 1];
    text->size = size;
    text->box.x1 = text->x + fg__text_width(ruler, line[k], size, false);
    text->box.y0 = y - FG__TEXT_ASCENT * size;
    text->box.y1 = y + FG__TEXT_DESCENT * size;
    top = page->frame.y0 - text->box.y0;
    y -= 1.25 * size;
  }
  return top;
}

void fg__page_place_panels(fg__page *panel, fg__margins *room, double between[2],
                           const fg__page_plan *plan, const fg__page_parts *parts,
                           cairo_t *ruler)
{
  fg__margins inner = {0.0, 0.0, 0.0, 0.0};
  const int rows = fg__page_frames(plan, 1);
  double top = 0.0;
  if (plan->no_frame)
    return;
  for (int k = 0; k < plan->panels; ++k) {
    const int column = k % plan->columns, row = k / plan->columns;
    fg__margins own = {0.0, 0.0, 0.0, 0.0};
    fg__page_parts its = *parts;
    its.sides = outer_sides(plan, k);
    fg__page_place_sides(&panel[k], &own, plan, &its, ruler);
    top = fmax(top, top_of(&panel[k]));
    fg__margins *const left = column == 0 ? room : &inner;
    fg__margins *const right = column == plan->columns - 1 ? room : &inner;
    fg__margins *const upper = row == 0 ? room : &inner;
    fg__margins *const lower = row == rows - 1 ? room : &inner;
    left->left = fmax(left->left, own.left);
    right->right = fmax(right->right, own.right);
    upper->top = fmax(upper->top, own.top);
    lower->bottom = fmax(lower->bottom, own.bottom);
  }
  for (int k = 0; k < plan->panels; ++k) {
    fg__margins *const upper = k < plan->columns ? room : &inner;
    upper->top =
        fmax(upper->top, place_label(&panel[k], top, plan->panel_label[k], ruler));
  }
  const double gap = panel_gap * panel[0].font_size;
  between[0] = inner.right + inner.left + gap;
  between[1] = inner.bottom + inner.top + gap;
}
