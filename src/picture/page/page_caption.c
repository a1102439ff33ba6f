/* The title and what else is told above a page's frame. */
#include "picture/page/page.h"

#include <math.h>

/* A caption cut to a few letters says nothing; in units of the font size. */
static const double shortest_caption = 8.0;

bool fg__caption_break(fg__caption_lines *out, cairo_t *ruler, const char *title,
                       const char *subtitle, double title_size, double size, double width)
{
  int subtitles;
  out->title_size = fg__page_fit_lines(out->line, FG__TITLE_LINES, &out->titles, ruler,
                                       title, title_size, true, width);
  out->size =
      fg__page_fit_lines(out->line + out->titles, FG__CAPTION_LINES - FG__TITLE_LINES,
                         &subtitles, ruler, subtitle, size, false, width);
  out->count = out->titles + subtitles;
  return out->title_size == title_size && out->size == size;
}

void fg__page_place_caption(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                            cairo_t *ruler)
{
  const double em = page->font_size, pad = 0.6 * em;
  double start = fmin(fmax(page->frame.x0, pad), 0.35 * page->width);
  const double widest = page->width - 2.0 * pad;
  fg__caption_lines lines;
  if (widest < shortest_caption * em)
    return;
  if (!fg__caption_break(&lines, ruler, plan->title, plan->subtitle, 1.1 * em, em,
                         page->width - pad - start)) {
    start = pad;
    fg__caption_break(&lines, ruler, plan->title, plan->subtitle, 1.1 * em, em, widest);
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
