#include "picture/page/symbols.h"

#include <math.h>

#include "picture/palette.h"

static const double PI = 3.14159265358979323846;

/* A sign's radius in units of lambda, and its bounds in points. */
static const double SHARE = 0.13, SMALLEST = 2.6, LARGEST = 5.0;

/* In units of the radius: lines, the reach of a saddle's arms, the strokes of heads, and
 * half of a plus. */
static const double LINE = 0.28, ARM = 1.25, HEAD = 0.7, HALF = 0.45;
static const double THINNEST = 0.7; /* points */

/* Radians: the gap of a ring, and between a head's strokes and its line. */
static const double GAP = 1.0, HEAD_ANGLE = 0.65;

/* Points: what sets signs off from what lies below. */
static const double RIM = 0.7;

/* In units of the font size. */
static const double KEY_RADIUS = 0.36, KEY_GAP = 0.4, BETWEEN = 1.3, ROW = 1.3;
static const double ABOVE = 0.7;

static const fg__color COLOR = {0.68, 0.02, 0.32};

/* How signs are named, by kind and flow. */
static const struct {
  fg_critical_kind kind;
  int outward;
  const char *name;
} KEY[FG__SYMBOL_KINDS] = {
    {FG_CRITICAL_SADDLE, 0, "saddle"},         {FG_CRITICAL_CENTRE, 0, "centre"},
    {FG_CRITICAL_SPIRAL, 1, "outward spiral"}, {FG_CRITICAL_SPIRAL, -1, "inward spiral"},
    {FG_CRITICAL_SOURCE, 1, "source"},         {FG_CRITICAL_SINK, -1, "sink"}};

static void add_line(cairo_t *cairo, double x, double y, double dx, double dy)
{
  cairo_move_to(cairo, x - dx, y - dy);
  cairo_line_to(cairo, x + dx, y + dy);
}

/* The strokes of a head whose tip is at x, y, in a direction. */
static void add_head(cairo_t *cairo, double x, double y, double angle, double length)
{
  for (int side = -1; side <= 1; side += 2) {
    const double back = angle + PI + side * HEAD_ANGLE;
    cairo_move_to(cairo, x, y);
    cairo_line_to(cairo, x + length * cos(back), y + length * sin(back));
  }
}

static void add_saddle(cairo_t *cairo, const fg__symbol *symbol)
{
  const double reach = ARM * symbol->radius, head = HEAD * symbol->radius;
  for (int k = 0; k < 2; ++k) {
    const double dx = reach * symbol->axis[k][0], dy = reach * symbol->axis[k][1];
    add_line(cairo, symbol->x, symbol->y, dx, dy);
    for (int end = -1; end <= 1 && k == 0; end += 2)
      add_head(cairo, symbol->x + end * dx, symbol->y + end * dy,
               atan2(end * dy, end * dx), head);
  }
}

/* Angles run clockwise on the page; a head is turned in a little, as the arc is. */
static void add_ring(cairo_t *cairo, const fg__symbol *symbol)
{
  const double x = symbol->x, y = symbol->y, radius = symbol->radius;
  const double half = symbol->sense ? PI - 0.5 * GAP : PI, top = -0.5 * PI;
  cairo_new_sub_path(cairo);
  cairo_arc(cairo, x, y, radius, top + PI - half, top + PI + half);
  if (!symbol->sense)
    cairo_close_path(cairo);
  if (symbol->sense) {
    const double end = top + PI - symbol->sense * half;
    add_head(cairo, x + radius * cos(end), y + radius * sin(end),
             end - symbol->sense * (0.5 * PI - 0.25), HEAD * radius);
  }
  if (symbol->outward)
    add_line(cairo, x, y, HALF * radius, 0.0);
  if (symbol->outward > 0)
    add_line(cairo, x, y, 0.0, HALF * radius);
}

void fg__symbol_draw(cairo_t *cairo, const fg__symbol *symbol, double rim)
{
  const double line = fmax(LINE * symbol->radius, THINNEST);
  cairo_save(cairo);
  cairo_new_path(cairo);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  if (symbol->kind == FG_CRITICAL_SADDLE)
    add_saddle(cairo, symbol);
  else
    add_ring(cairo, symbol);
  if (rim > 0.0) {
    cairo_set_line_width(cairo, line + 2.0 * rim);
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_stroke_preserve(cairo);
  }
  cairo_set_line_width(cairo, line);
  cairo_set_source_rgb(cairo, COLOR.red, COLOR.green, COLOR.blue);
  cairo_stroke(cairo);
  cairo_restore(cairo);
}

static fg__symbol symbol_of(const fg_critical_point *point)
{
  fg__symbol out = {
      .kind = point->kind, .sense = point->sense, .outward = point->outward};
  for (int k = 0; k < 2; ++k) {
    out.axis[k][0] = point->axis[k][0];
    out.axis[k][1] = -point->axis[k][1];
  }
  return out;
}

void fg__symbols_draw(cairo_t *cairo, const fg__page *page, const double low[2],
                      const fg_critical_points *points)
{
  const fg__page_box *frame = &page->frame;
  for (int n = 0; n < fg_critical_points_count(points); ++n) {
    const fg_critical_point *point = fg_critical_points_at(points, n);
    fg__symbol symbol = symbol_of(point);
    const double length = page->scale * fg_critical_points_length(points);
    symbol.radius = fmin(fmax(SHARE * length, SMALLEST), LARGEST);
    double at[2] = {point->at[0], point->at[1]};
    fg__page_project(page, low, at);
    symbol.x = at[0];
    symbol.y = at[1];
    const double reach = ARM * symbol.radius;
    if (symbol.x >= frame->x0 + reach && symbol.x <= frame->x1 - reach &&
        symbol.y >= frame->y0 + reach && symbol.y <= frame->y1 - reach)
      fg__symbol_draw(cairo, &symbol, RIM);
  }
}

void fg__symbols_plan(fg__page_plan *plan, const fg_critical_points *points)
{
  for (int n = 0; n < fg_critical_points_count(points); ++n) {
    const fg_critical_point *point = fg_critical_points_at(points, n);
    for (int k = 0; k < FG__SYMBOL_KINDS; ++k)
      if (point->kind == KEY[k].kind && point->outward == KEY[k].outward &&
          !plan->has_symbol[k]) {
        plan->has_symbol[k] = true;
        plan->symbol[k] = symbol_of(point);
      }
  }
}

void fg__page_place_symbols(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                            cairo_t *ruler)
{
  const double em = page->font_size, wide = page->frame.x1 - page->frame.x0;
  const double indent = 2.0 * KEY_RADIUS * em + KEY_GAP * em;
  double width[FG__SYMBOL_KINDS], all = -BETWEEN * em;
  double y = page->frame.y1 + room->bottom + (ABOVE + FG__TEXT_ASCENT) * em;
  for (int k = 0; k < FG__SYMBOL_KINDS; ++k) {
    width[k] = indent + fg__text_width(ruler, KEY[k].name, em, false) + BETWEEN * em;
    all += plan->has_symbol[k] ? width[k] : 0.0;
  }
  const double start = plan->short_key && all < wide ? 0.5 * (wide - all) : 0.0;
  double x = start;
  for (int k = 0; k < FG__SYMBOL_KINDS; ++k) {
    if (!plan->has_symbol[k])
      continue;
    if (x > start && x + width[k] - BETWEEN * em > wide) {
      x = start;
      y += ROW * em;
    }
    fg__symbol *symbol = &page->symbol[page->symbol_count++];
    *symbol = plan->symbol[k];
    symbol->radius = KEY_RADIUS * em;
    symbol->x = page->frame.x0 + x + symbol->radius;
    symbol->y = y - FG__HALF_DIGIT * em;
    fg__page_add_text(page, room, ruler, &(fg__words){.text = KEY[k].name},
                      page->frame.x0 + x + indent, y);
    x += width[k];
  }
}
