#include "picture/page/page.h"

#include <math.h>

/* In units of the font size. */
static const double bar_thickness = 0.85;
static const double tick_length = 0.3;
static const double line_height = 1.25;
static const double key_gap = 1.4;      /* between the frame's labels and a key */
static const double shortest_bar = 4.5; /* two ticks and their labels */
static const double shortest_beside_size = 12.0; /* below the frame */
static const double longest_bar = 36.0;          /* longer ones only draw the eye */
static const double least_short_bar = 14.0;
static const double short_bar_share = 0.5; /* of the frame's side */
static const double between_keys = 3.0, frame_gap = 0.7;
static const double widest_arrow = 7.0;
static const double shortest_arrow = 0.8;

/* Says that the reference arrow shows a length, not a speed. */
static const char size_words[] = "length";

/* The longest bar along a side of the frame. */
static double bar_limit(const fg__page *page, const fg__page_plan *plan, double side)
{
  const double em = page->font_size;
  const double most =
      plan->short_key ? fmax(short_bar_share * side, least_short_bar * em) : side;
  return fmin(fmin(most, longest_bar * em), side);
}

static const fg__tick_axis *length_axis(const fg__page_plan *plan)
{
  return plan->length.factor > 0.0 ? &plan->length : &plan->axis[0];
}

/* The reference arrow: a nice length near that of a typical arrow, as far as there is
 * room. Returns its length in coordinates, 0 when it would be too short to see. */
static double reference_length(const fg__page *page, const fg__page_plan *plan)
{
  const double em = page->font_size;
  double most = widest_arrow * em / page->scale;
  /* nice lengths are at most a factor 2.5 apart: from 0.65 to 1.6 of the typical */
  double length =
      fg__ticks_step(length_axis(plan), 0.65 * fmin(plan->arrow_length, most / 1.6));
  return length * page->scale >= shortest_arrow * em ? length : 0.0;
}

typedef struct size_key {
  double length; /* points */
  char text[FG__AXIS_BYTES];
  double width; /* of the whole key */
} size_key;

static bool measure_size_key(size_key *out, const fg__page *page,
                             const fg__page_plan *plan, cairo_t *ruler)
{
  double length = reference_length(page, plan);
  if (!(length > 0.0))
    return false;
  out->length = length * page->scale;
  fg__axis_write_length(out->text, length_axis(plan), length);
  double text = fg__text_width(ruler, out->text, page->font_size, false);
  double words = fg__text_width(ruler, size_words, page->font_size, false);
  out->width = fmax(out->length, fmax(text, words));
  return true;
}

/* Breaks the colour key's label into lines. The default one is shortened to its unit
 * where it is longer than its room; one given by the options is broken into lines. */
static void break_label(fg__bar_label *out, const fg__page_plan *plan, cairo_t *ruler,
                        double font_size, double room)
{
  const char *text = plan->speed.label;
  out->count = 0;
  if (plan->speed.units[0] && fg__text_width(ruler, text, font_size, false) > room)
    text = plan->speed.units;
  if (plan->speed.units[0] && fg__text_width(ruler, text, font_size, false) > room)
    return;
  out->size = fg__page_fit_lines(out->line, FG__LABEL_LINES, &out->count, ruler, text,
                                 font_size, false, room);
}

/* Where a bar lies along its side, and from where to where its label may reach. */
typedef struct bar_place {
  double start, end, label_low, label_high;
} bar_place;

/* The longest label about the bar's middle. */
static double label_room(const bar_place *at)
{
  const double middle = 0.5 * (at->start + at->end);
  return fmax(at->end - at->start,
              2.0 * fmin(middle - at->label_low, at->label_high - middle));
}

/* An end beyond which there are speeds is a point; the bar is that much shorter. */
static void add_points(fg__page *page, const fg__page_plan *plan, double *start,
                       double *end)
{
  for (int k = 0; k < 2; ++k)
    page->color_key_point[k] =
        plan->speeds_beyond[k] ? bar_thickness * page->font_size : 0.0;
  *start += page->color_key_point[0];
  *end -= page->color_key_point[1];
}

static void bar_below(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                      cairo_t *ruler, const bar_place *at, double y0)
{
  const double em = page->font_size, y1 = y0 + bar_thickness * em;
  double x0 = at->start, x1 = at->end;
  fg__bar_label label;
  page->has_color_key = true;
  page->color_key_upright = false;
  add_points(page, plan, &x0, &x1);
  page->color_key = (fg__page_box){x0, y0, x1, y1};
  const fg__scale scale = {.axis = &plan->speed,
                           .from = {x0, y1},
                           .to = {x1, y1},
                           .tick = tick_length,
                           .numbers = true};
  fg__page_add_ticks(page, room, ruler, &scale);
  double baseline = y1 + (tick_length + FG__TICK_GAP + FG__TEXT_ASCENT) * em;
  break_label(&label, plan, ruler, em, label_room(at));
  for (int k = 0; k < label.count; ++k) {
    const fg__words words = {
        .text = label.line[k], .size = label.size, .align = FG__ALIGN_MIDDLE};
    baseline += line_height * (k ? label.size : em);
    fg__page_add_text(page, room, ruler, &words, 0.5 * (x0 + x1), baseline);
  }
}

/* The reference arrow from a point on, and below it its length and what it shows. */
static void add_size(fg__page *page, fg__margins *room, const size_key *key,
                     cairo_t *ruler, const double tail[2], const double text[2],
                     fg__align align)
{
  const fg__words words[] = {{.text = key->text, .align = align},
                             {.text = size_words, .align = align, .quiet = true}};
  page->has_size_key = true;
  page->size_key[0] = tail[0];
  page->size_key[1] = tail[1];
  page->size_key_length = key->length;
  for (int k = 0; k < 2; ++k)
    fg__page_add_text(page, room, ruler, &words[k], text[0],
                      text[1] + k * line_height * page->font_size);
}

static void size_below(fg__page *page, fg__margins *room, const size_key *key,
                       cairo_t *ruler, double middle, double y0)
{
  const double em = page->font_size;
  const double tail[2] = {middle - 0.5 * key->length, y0 + 0.5 * bar_thickness * em};
  const double text[2] = {
      middle, y0 + (bar_thickness + tick_length + FG__TICK_GAP + FG__TEXT_ASCENT) * em};
  add_size(page, room, key, ruler, tail, text, FG__ALIGN_MIDDLE);
}

/* One row under the frame: the bar at its left end, a short one in its middle or as near
 * to that as the reference arrow at the right end lets it. */
static void place_below(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                        const fg__page_parts *parts, cairo_t *ruler)
{
  const double em = page->font_size;
  const fg__page_box *frame = &page->frame;
  double y0 = frame->y1 + room->bottom + frame_gap * em;
  double wide = frame->x1 - frame->x0;
  size_key key;
  bool has_size = parts->size_key && measure_size_key(&key, page, plan, ruler);
  double room_for_bar = wide;
  if (has_size && parts->color_key)
    room_for_bar = wide - key.width - between_keys * em;
  if (has_size && parts->color_key && room_for_bar < shortest_beside_size * em) {
    has_size = false;
    room_for_bar = wide;
  }
  const double length = fmin(bar_limit(page, plan, wide), room_for_bar);
  if (has_size) {
    const double x0 = frame->x1 - key.width;
    size_below(page, room, &key, ruler, frame->x1 - 0.5 * key.width, y0);
    room->left = fmax(room->left, frame->x0 - x0);
  }
  if (parts->color_key && length >= shortest_bar * em) {
    const double indent =
        plan->short_key ? fmin(0.5 * (wide - length), room_for_bar - length) : 0.0;
    const double x0 = frame->x0 + indent, x1 = x0 + length;
    const bar_place at = {x0, x1, plan->short_key ? frame->x0 : x0,
                          plan->short_key ? frame->x0 + room_for_bar : x1};
    bar_below(page, room, plan, ruler, &at, y0);
  }
}

static void bar_beside(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                       cairo_t *ruler, const bar_place *at, double x0)
{
  const double em = page->font_size, x1 = x0 + bar_thickness * em;
  double above = -at->start, below = -at->end;
  fg__bar_label label;
  page->has_color_key = true;
  page->color_key_upright = true;
  add_points(page, plan, &below, &above);
  page->color_key = (fg__page_box){x0, -above, x1, -below};
  fg__margins_hold(room, &page->frame, &page->color_key);
  const fg__scale scale = {.axis = &plan->speed,
                           .from = {x1, -below},
                           .to = {x1, -above},
                           .side = 1,
                           .tick = tick_length,
                           .numbers = true};
  fg__page_add_ticks(page, room, ruler, &scale);
  double x = page->frame.x1 + room->right + 0.35 * em;
  break_label(&label, plan, ruler, em, label_room(at));
  for (int k = 0; k < label.count; ++k, x += FG__TEXT_DESCENT * em) {
    const fg__words words = {.text = label.line[k],
                             .size = label.size,
                             .upwards = true,
                             .align = FG__ALIGN_MIDDLE};
    x += FG__TEXT_ASCENT * em;
    fg__page_add_text(page, room, ruler, &words, x, -0.5 * (above + below));
  }
}

/* Arrow and words in a column whose lower end is at y1. */
static void size_beside(fg__page *page, fg__margins *room, const size_key *key,
                        cairo_t *ruler, double x0, double y1)
{
  const double em = page->font_size;
  const double text[2] = {x0, y1 - (FG__TEXT_DESCENT + line_height) * em};
  const double tail[2] = {x0, text[1] - (FG__TEXT_ASCENT + 0.6) * em};
  add_size(page, room, key, ruler, tail, text, FG__ALIGN_START);
  room->right = fmax(room->right, x0 + key->length - page->frame.x1);
}

/* Whether degrees or numbers stand to the right of the frame. */
static bool has_words_at_right(const fg__page *page)
{
  for (int n = 0; n < page->text_count; ++n)
    if (page->text[n].box.x0 >= page->frame.x1)
      return true;
  return false;
}

/* A column to the right of the frame: the bar from its top, the reference arrow at its
 * lower end; a bar alone, or a short one, in the middle. */
static void place_beside(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, cairo_t *ruler)
{
  const double em = page->font_size;
  const fg__page_box *frame = &page->frame;
  const double size_height = 5.6 * em; /* arrow, two lines, and the gap above them */
  const double gap = (has_words_at_right(page) ? key_gap : 0.5) * em;
  double x0 = frame->x1 + fmax(room->right + gap, key_gap * em);
  double high = frame->y1 - frame->y0;
  size_key key;
  bool has_size =
      parts->size_key && high >= size_height && measure_size_key(&key, page, plan, ruler);
  if (has_size && parts->color_key && high - size_height < shortest_bar * em)
    has_size = false;
  double y0 = frame->y0;
  const double y1 = has_size ? frame->y1 - size_height : frame->y1;
  const double length = fmin(bar_limit(page, plan, high), y1 - y0);
  if (!has_size || plan->short_key)
    y0 += fmin(0.5 * (high - length), y1 - y0 - length);
  const bar_place at = {y0, y0 + length, plan->short_key ? frame->y0 : y0,
                        plan->short_key ? y1 : y0 + length};
  if (parts->color_key && length >= shortest_bar * em)
    bar_beside(page, room, plan, ruler, &at, x0);
  if (has_size)
    size_beside(page, room, &key, ruler, x0, frame->y1);
}

void fg__page_place_keys(fg__page *page, fg__margins *room, const fg__page_plan *plan,
                         const fg__page_parts *parts, cairo_t *ruler)
{
  if (parts->keys_below)
    place_below(page, room, plan, parts, ruler);
  else
    place_beside(page, room, plan, parts, ruler);
}

/* In units of the font size: more between a texture and its bar than between a frame and
 * one, below the label, and room for half a number beyond either end. */
static const double lone_gap = 0.2, lone_edge = 0.6, lone_indent = 2.0;

static void place_lone_key(fg__page *page, const fg__page_plan *plan, cairo_t *ruler)
{
  const double em = page->font_size;
  const double length = bar_limit(page, plan, page->width - 2.0 * lone_indent * em);
  const double y0 = page->frame.y1 + (lone_gap + frame_gap) * em;
  fg__margins room = {0};
  if (length < shortest_bar * em)
    return;
  const double x0 = 0.5 * (page->width - length);
  const bar_place at = {x0, x0 + length, page->frame.x0, page->frame.x1};
  bar_below(page, &room, plan, ruler, &at, y0);
  page->height += room.bottom + lone_edge * em;
}

static void move_down(fg__page *page, double by)
{
  for (int n = 0; n < page->text_count; ++n) {
    page->text[n].y += by;
    page->text[n].box.y0 += by;
    page->text[n].box.y1 += by;
  }
  page->frame.y0 += by;
  page->frame.y1 += by;
  page->height += by;
}

void fg__page_place_lone(fg__page *page, const fg__page_plan *plan, double step)
{
  fg__margins room = {0};
  cairo_t *ruler = fg__text_ruler();
  page->font_size = fg__page_font_size(plan);
  if (plan->title[0] || plan->subtitle[0]) {
    fg__page_place_caption(page, &room, plan, ruler);
    if (room.top > 0.0)
      move_down(page, step * ceil((room.top + lone_edge * page->font_size) / step));
  }
  if (plan->color_key)
    place_lone_key(page, plan, ruler);
  cairo_destroy(ruler);
}
