#include "picture/page/texture_key.h"

#include <math.h>

/* As in the pictures of arrows: 9 points on a page of 480, growing with the root of it.
 */
static const double usual_font = 9.0, usual_width = 480.0, smallest_font = 7.0;

/* In units of the font size. */
static const double gap = 0.9; /* between texture and bar */
static const double thickness = 0.85, tick_length = 0.3, label_gap = 0.3;
static const double line_height = 1.25, edge = 0.6;
static const double indent = 2.0; /* room for half a number beyond either end */
static const double shortest_bar = 6.0, longest_bar = 36.0;

void fg__texture_key_place(fg__page *page, const double range[2], const char *units)
{
  page->font_size = fmax(usual_font * sqrt(page->width / usual_width), smallest_font);
  const double em = page->font_size;
  const double length = fmin(page->width - 2.0 * indent * em, longest_bar * em);
  if (!(length >= shortest_bar * em))
    return;
  fg__tick_axis axis;
  fg__ticks ticks;
  cairo_t *ruler = fg__text_ruler();
  fg__axis_of_numbers(&axis, range[0], range[1], range[1] - range[0], "speed", units);
  fg__page_choose_ticks(&ticks, &axis, ruler, length, em, false);
  const double x0 = 0.5 * (page->width - length), y0 = page->frame.y1 + gap * em;
  const double y1 = y0 + thickness * em;
  page->has_color_key = true;
  page->color_key = (fg__page_box){x0, y0, x0 + length, y1};
  double baseline = y1 + (tick_length + label_gap + FG__TEXT_ASCENT) * em;
  for (int k = 0; k < ticks.count; ++k) {
    const double share = (ticks.position[k] - axis.low) / (axis.high - axis.low);
    const double x = x0 + share * length;
    fg__page_add_line(page, x, y1, x, y1 + tick_length * em);
    fg__page_add_text(page, ruler, ticks.text[k], x, baseline, FG__ALIGN_MIDDLE);
  }
  baseline += line_height * em;
  if (fg__text_width(ruler, axis.label, em, false) <= page->width)
    fg__page_add_text(page, ruler, axis.label, 0.5 * page->width, baseline,
                      FG__ALIGN_MIDDLE);
  cairo_destroy(ruler);
  page->height = baseline + (FG__TEXT_DESCENT + edge) * em;
}
