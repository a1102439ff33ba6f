/* The title and what else is told above a page's frame. */
#include "picture/page/page.h"

#include <math.h>

/* A caption cut to a few letters says nothing; in units of the font size. */
static const double shortest_caption = 8.0;

/* Lines of a caption, the title's first. */
typedef struct caption {
  char line[FG__CAPTION_LINES][FG__PAGE_TEXT_BYTES];
  int titles, count;
  double title_size, size;
} caption;

/* Titles that are too long for their lines shrink, so far as they are still read. Whether
 * none does. */
static bool break_caption(caption *out, const fg__page_plan *plan, cairo_t *ruler,
                          double em, double width)
{
  const double title_size = 1.1 * em;
  out->title_size = fg__page_fit_lines(out->line, FG__TITLE_LINES, &out->titles, ruler,
                                       plan->title, title_size, true, width);
  out->size =
      fg__page_fit_lines(out->line + out->titles, FG__CAPTION_LINES - FG__TITLE_LINES,
                         &out->count, ruler, plan->subtitle, em, false, width);
  out->count += out->titles;
  return out->title_size == title_size && out->size == em;
}

void fg__page_place_caption(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                            cairo_t *ruler)
{
  const double em = page->font_size, pad = 0.6 * em;
  double start = fmin(fmax(page->frame.x0, pad), 0.35 * page->width);
  const double widest = page->width - 2.0 * pad;
  caption lines;
  if (widest < shortest_caption * em)
    return;
  if (!break_caption(&lines, plan, ruler, em, page->width - pad - start)) {
    start = pad;
    break_caption(&lines, plan, ruler, em, widest);
  }
  fg__margins beyond = {0}; /* the caption's own width asks for no room */
  double y = page->frame.y0 - room->top - 0.7 * em - FG__TEXT_DESCENT * em;
  for (int k = lines.count - 1; k >= 0; --k) {
    const bool bold = k < lines.titles;
    const fg__words words = {.text = lines.line[k],
                             .size = bold ? lines.title_size : lines.size,
                             .bold = bold,
                             .quiet = !bold};
    fg__page_add_text(page, &beyond, ruler, &words, start, y);
    y -= 1.3 * words.size;
  }
  room->top = fmax(room->top, beyond.top);
}
