#include "picture/page/page.h"

#include <math.h>
#include <string.h>

/* In units of the font size: a tick's length, and between texts side by side. */
static const double tick_length = 0.35, word_gap = 0.8;

/* Distance of ticks in units of the font size that reads easily; what short axes with
 * fewer than FEW_TICKS ticks may go down to; and the most ticks. */
static const double default_spacing = 5.0;
static const double default_spacing_upright = 4.2;
static const double least_spacing_upright = 2.4;
enum { DEFAULT_TICKS = 12, FEW_TICKS = 4, TRIES = 16 };

static bool labels_fit(const fg__ticks *ticks, const fg__tick_axis *axis, cairo_t *ruler,
                       double length, double font_size, bool upright)
{
  double points = length / (axis->high - axis->low);
  double line = (FG__TEXT_ASCENT + FG__TEXT_DESCENT) * font_size;
  double end = -HUGE_VAL;
  for (int k = 0; k < ticks->count; ++k) {
    double middle = points * (ticks->position[k] - axis->low);
    double size =
        upright ? line : fg__text_width(ruler, ticks->text[k], font_size, false);
    double gap = upright ? 0.1 * font_size : word_gap * font_size;
    if (middle - 0.5 * size < end + gap)
      return false;
    end = middle + 0.5 * size;
  }
  return true;
}

/* Where one number is all that has room, the first and the last of finer ticks. */
static void choose_two(fg__ticks *out, const fg__tick_axis *axis, cairo_t *ruler,
                       double length, double font_size, bool upright, double step)
{
  for (int k = 0; k < TRIES && out->count < 2; ++k) {
    fg__ticks finer;
    step = fg__ticks_step_below(axis, step);
    fg__ticks_fill(&finer, axis, step);
    if (finer.count < 2)
      continue;
    const int last = finer.count - 1;
    finer.position[1] = finer.position[last];
    memmove(finer.text[1], finer.text[last], sizeof finer.text[1]);
    finer.count = 2;
    if (!labels_fit(&finer, axis, ruler, length, font_size, upright))
      return;
    *out = finer;
  }
}

void fg__page_choose_ticks(fg__ticks *out, const fg__tick_axis *axis, cairo_t *ruler,
                           double length, double font_size, bool upright)
{
  double range = axis->high - axis->low;
  double spacing = (upright ? default_spacing_upright : default_spacing) * font_size;
  double step =
      fg__ticks_step(axis, fmax(range * spacing / length, range / DEFAULT_TICKS));
  for (int k = 0; k < TRIES; ++k) {
    fg__ticks_fill(out, axis, step);
    if (labels_fit(out, axis, ruler, length, font_size, upright))
      break;
    step = fg__ticks_step(axis, 1.05 * step);
    out->count = 0;
  }
  for (int k = 0; k < TRIES && out->count < FEW_TICKS; ++k) {
    fg__ticks finer;
    step = fg__ticks_step_below(axis, step);
    bool close = upright && step * length < least_spacing_upright * font_size * range;
    fg__ticks_fill(&finer, axis, step);
    if ((close && out->count >= 2) ||
        !labels_fit(&finer, axis, ruler, length, font_size, upright))
      break;
    *out = finer;
  }
  choose_two(out, axis, ruler, length, font_size, upright, step);
}

static void place_x_label(fg__page *page, fg__margins *room, const char *label,
                          cairo_t *ruler)
{
  const double em = page->font_size;
  const fg__page_box *frame = &page->frame;
  const fg__words words = {.text = label, .align = FG__ALIGN_MIDDLE};
  fg__page_add_text(page, room, ruler, &words, 0.5 * (frame->x0 + frame->x1),
                    frame->y1 + room->bottom + (0.15 + FG__TEXT_ASCENT) * em);
}

/* Upwards beside the tick labels; a label of a letter or two, or one that is longer than
 * the frame is high, stays level. */
static void place_y_label(fg__page *page, fg__margins *room, const char *label,
                          cairo_t *ruler)
{
  const double em = page->font_size;
  const fg__page_box *frame = &page->frame;
  const double middle = 0.5 * (frame->y0 + frame->y1), left = frame->x0 - room->left;
  const double width = fg__text_width(ruler, label, em, false);
  const bool level = width <= 2.0 * em || width > frame->y1 - frame->y0;
  const fg__words words = {.text = label,
                           .upwards = !level,
                           .align = level ? FG__ALIGN_END : FG__ALIGN_MIDDLE};
  fg__page_add_text(page, room, ruler, &words,
                    left - (level ? 0.6 : 0.3 + FG__TEXT_DESCENT) * em,
                    level ? middle + FG__HALF_DIGIT * em : middle);
}

void fg__page_place_axes(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, cairo_t *ruler)
{
  const fg__page_box *frame = &page->frame;
  const fg__scale scales[] = {{.axis = &plan->axis[0],
                               .from = {frame->x0, frame->y1},
                               .to = {frame->x1, frame->y1},
                               .tick = tick_length,
                               .numbers = parts->sides.bottom},
                              {.axis = &plan->axis[1],
                               .from = {frame->x0, frame->y1},
                               .to = {frame->x0, frame->y0},
                               .side = -1,
                               .tick = tick_length,
                               .numbers = parts->sides.left}};
  for (int k = 0; k < 2; ++k)
    fg__page_add_ticks(page, room, ruler, &scales[k]);
  if (!parts->axis_labels)
    return;
  if (plan->axis[1].label[0] && parts->sides.left)
    place_y_label(page, room, plan->axis[1].label, ruler);
  if (plan->axis[0].label[0] && parts->sides.bottom)
    place_x_label(page, room, plan->axis[0].label, ruler);
}
