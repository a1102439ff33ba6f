/* The texts and lines of a page. */
#include "picture/page/page.h"

#include <stdio.h>

fg__page_text *fg__page_next_text(fg__page *page, const char *text)
{
  if (page->text_count == FG__PAGE_TEXTS)
    return NULL;
  fg__page_text *added = &page->text[page->text_count++];
  *added = (fg__page_text){.size = page->font_size};
  snprintf(added->text, sizeof added->text, "%s", text);
  return added;
}

static double start_of(double x, double width, fg__align align)
{
  return align == FG__ALIGN_START    ? x
         : align == FG__ALIGN_MIDDLE ? x - 0.5 * width
                                     : x - width;
}

double fg__page_add_text(fg__page *page, cairo_t *ruler, const char *text, double x,
                         double y, fg__align align)
{
  fg__page_text *added = fg__page_next_text(page, text);
  if (!added)
    return 0.0;
  double width = fg__text_width(ruler, added->text, added->size, false);
  added->x = start_of(x, width, align);
  added->y = y;
  added->box = (fg__page_box){added->x, y - FG__TEXT_ASCENT * added->size,
                              added->x + width, y + FG__TEXT_DESCENT * added->size};
  return width;
}

double fg__page_add_text_upwards(fg__page *page, cairo_t *ruler, const char *text,
                                 double x, double y)
{
  fg__page_text *added = fg__page_next_text(page, text);
  if (!added)
    return 0.0;
  double width = fg__text_width(ruler, added->text, added->size, false);
  added->upwards = true;
  added->x = x;
  added->y = y + 0.5 * width;
  added->box = (fg__page_box){x - FG__TEXT_ASCENT * added->size, added->y - width,
                              x + FG__TEXT_DESCENT * added->size, added->y};
  return width;
}

void fg__page_add_line(fg__page *page, double x0, double y0, double x1, double y1)
{
  if (page->line_count < FG__PAGE_LINES)
    page->line[page->line_count++] = (fg__page_line){x0, y0, x1, y1};
}
