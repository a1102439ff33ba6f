/* The texts and lines of a page. */
#include "picture/page/page.h"

#include <stdio.h>
#include <string.h>

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
  added->align = align;
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
  added->align = FG__ALIGN_MIDDLE;
  added->x = x;
  added->y = y + 0.5 * width;
  added->box = (fg__page_box){x - FG__TEXT_ASCENT * added->size, added->y - width,
                              x + FG__TEXT_DESCENT * added->size, added->y};
  return width;
}

void fg__page_resize_text(fg__page *page, cairo_t *ruler, double size)
{
  fg__page_text *text = &page->text[page->text_count - 1];
  const double width = fg__text_width(ruler, text->text, size, false);
  text->size = size;
  if (text->upwards) {
    text->y = 0.5 * (text->box.y0 + text->box.y1 + width);
    text->box = (fg__page_box){text->x - FG__TEXT_ASCENT * size, text->y - width,
                               text->x + FG__TEXT_DESCENT * size, text->y};
    return;
  }
  if (text->align == FG__ALIGN_MIDDLE)
    text->x = 0.5 * (text->box.x0 + text->box.x1 - width);
  text->box = (fg__page_box){text->x, text->y - FG__TEXT_ASCENT * size, text->x + width,
                             text->y + FG__TEXT_DESCENT * size};
}

void fg__page_add_line(fg__page *page, double x0, double y0, double x1, double y1)
{
  if (page->line_count < FG__PAGE_LINES)
    page->line[page->line_count++] = (fg__page_line){x0, y0, x1, y1};
}

/* Where a line of a caption that is too long ends: before the last middle dot between its
 * parts, else after the last word that is whole. *next: where what follows begins. */
static size_t line_end(const char *line, size_t length, size_t *next)
{
  static const char dot[] = " \xC2\xB7 ";
  const char *last = NULL;
  for (const char *at = strstr(line, dot); at && at < line + length;
       at = strstr(at + 1, dot))
    last = at;
  *next = length;
  if (!last || last == line)
    return length;
  *next = (size_t)(last - line) + sizeof dot - 1;
  return (size_t)(last - line);
}

bool fg__page_break_lines(char line[][FG__PAGE_TEXT_BYTES], int limit, int *count,
                          cairo_t *ruler, const char *text, double size, bool bold,
                          double width)
{
  bool fits = true;
  const char *rest = text + strspn(text, " ");
  for (*count = 0; *rest && *count < limit; rest += strspn(rest, " ")) {
    char *out = line[(*count)++];
    snprintf(out, FG__PAGE_TEXT_BYTES, "%s", rest);
    size_t kept = strlen(out);
    while (*count < limit && fg__text_width(ruler, out, size, bold) > width) {
      size_t length = strlen(out);
      while (length > 0 && out[length - 1] != ' ')
        --length;
      while (length > 0 && out[length - 1] == ' ')
        --length;
      if (length == 0)
        break; /* one long word */
      out[line_end(out, length, &kept)] = '\0';
    }
    fits = fits && fg__text_width(ruler, out, size, bold) <= width;
    rest += kept;
    fg__text_shorten(ruler, out, FG__PAGE_TEXT_BYTES, size, bold, width);
  }
  return fits;
}

double fg__page_fit_lines(char line[][FG__PAGE_TEXT_BYTES], int limit, int *count,
                          cairo_t *ruler, const char *text, double size, bool bold,
                          double width)
{
  static const double share[] = {1.0, 0.9, 0.8, 0.67};
  enum { SHARES = sizeof share / sizeof *share };
  int k = 0;
  while (!fg__page_break_lines(line, limit, count, ruler, text, share[k] * size, bold,
                               width) &&
         k < SHARES - 1)
    ++k;
  return share[k] * size;
}
