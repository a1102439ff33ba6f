/* The texts and lines of a page. */
#include "picture/page/page.h"

#include <math.h>
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

void fg__page_project(const fg__page *page, const double low[2], double point[2])
{
  point[0] = page->frame.x0 + page->scale * (point[0] - low[0]);
  point[1] = page->frame.y1 - page->scale * (point[1] - low[1]);
}

void fg__margins_hold(fg__margins *room, const fg__page_box *frame,
                      const fg__page_box *box)
{
  room->left = fmax(room->left, frame->x0 - box->x0);
  room->right = fmax(room->right, box->x1 - frame->x1);
  room->top = fmax(room->top, frame->y0 - box->y0);
  room->bottom = fmax(room->bottom, box->y1 - frame->y1);
}

static double start_of(double at, double width, fg__align align)
{
  return align == FG__ALIGN_START    ? at
         : align == FG__ALIGN_MIDDLE ? at - 0.5 * width
                                     : at - width;
}

static const fg__page_text unplaced = {.size = 0.0};

const fg__page_text *fg__page_add_text(fg__page *page, fg__margins *room, cairo_t *ruler,
                                       const fg__words *words, double x, double y)
{
  fg__page_text *added = fg__page_next_text(page, words->text);
  if (!added)
    return &unplaced;
  const double size = words->size > 0.0 ? words->size : page->font_size;
  const double width = fg__text_width(ruler, added->text, size, words->bold);
  const double above = FG__TEXT_ASCENT * size, below = FG__TEXT_DESCENT * size;
  added->size = size;
  added->bold = words->bold;
  added->quiet = words->quiet;
  added->upwards = words->upwards;
  added->align = words->align;
  added->x = words->upwards ? x : start_of(x, width, words->align);
  added->y = words->upwards ? y + width + start_of(0.0, width, words->align) : y;
  added->box = words->upwards
                   ? (fg__page_box){x - above, added->y - width, x + below, added->y}
                   : (fg__page_box){added->x, y - above, added->x + width, y + below};
  fg__margins_hold(room, &page->frame, &added->box);
  return added;
}

void fg__page_add_ticks(fg__page *page, fg__margins *room, cairo_t *ruler,
                        const fg__scale *scale)
{
  const double em = page->font_size, length = scale->tick * em;
  const double *from = scale->from, *to = scale->to;
  const bool upright = scale->side != 0;
  const double gap = length + FG__TICK_GAP * em;
  const fg__tick_axis *axis = scale->axis;
  fg__ticks ticks;
  fg__page_choose_ticks(&ticks, axis, ruler, upright ? from[1] - to[1] : to[0] - from[0],
                        em, upright);
  for (int k = 0; k < ticks.count; ++k) {
    const double share = (ticks.position[k] - axis->low) / (axis->high - axis->low);
    const double x = from[0] + share * (to[0] - from[0]);
    const double y = from[1] + share * (to[1] - from[1]);
    const double end[2] = {upright ? x + scale->side * length : x,
                           upright ? y : y + length};
    fg__page_add_line(page, x, y, end[0], end[1]);
    fg__margins_hold(room, &page->frame, &(fg__page_box){x, y, end[0], end[1]});
    if (!scale->numbers)
      continue;
    const fg__words number = {.text = ticks.text[k],
                              .align = !upright          ? FG__ALIGN_MIDDLE
                                       : scale->side < 0 ? FG__ALIGN_END
                                                         : FG__ALIGN_START};
    fg__page_add_text(page, room, ruler, &number, upright ? x + scale->side * gap : x,
                      upright ? y + FG__HALF_DIGIT * em : y + gap + FG__TEXT_ASCENT * em);
  }
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
