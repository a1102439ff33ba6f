#include "picture/render/box_axes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/page/draw.h"

/* In font sizes. */
static const double tick_length = 0.35, number_gap = 0.3, label_gap = 0.55;
static const double least_step = 4.0; /* from one number to the next */
static const double shortest_axis = 3.0, shortest_named = 1.0;
static const double bar_width = 0.9, name_gap = 0.8, label_line = 1.2;
static const double digit_height = 0.72;

/* Two numbers side by side read as one when they are nearer than this; the same number of
 * two axes, at the corner where they meet, is written once within `corner_gap`. */
static const double least_gap[2] = {0.6, 0.25};
static const double corner_gap = 1.2;

/* Texts in the way of another are tried so much farther off the box, in steps; shared
 * ones no farther than that, else they seem to belong to nothing. */
static const double aside_step = 0.25, most_aside = 2.5, shared_aside = 1.5;

/* Of so many numbers of an axis the first and the last are dispensable; of SOME where
 * another axis has the same number at the corner. */
enum { SOME = 3, MANY = 4 };

static const double ink = 0.22;

/* An end of the edge with an axis' numbers, in the view box. */
static void edge_end(const fg__view_box *view_box, const int edge[3], int axis,
                     double along, double out[3])
{
  for (int k = 0; k < 3; ++k)
    out[k] = k == axis ? along : edge[k] * view_box->half[k];
}

static void pixel_at(const fg__view_box *view_box, const fg__camera *camera,
                     const int edge[3], int axis, double along, double out[2])
{
  double point[3];
  edge_end(view_box, edge, axis, along, point);
  fg__camera_project(camera, point, out);
}

/* The lowest edge of the outline, or the leftmost for z. */
static void choose_edge(int out[3], const fg__view_box *view_box,
                        const fg__camera *camera, int axis)
{
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  double best = -HUGE_VAL;
  for (int n = 0; n < 4; ++n) {
    int edge[3] = {0, 0, 0};
    double middle[2];
    edge[a] = n & 1 ? 1 : -1;
    edge[b] = n & 2 ? 1 : -1;
    if (fg__camera_sees_inside(camera, view_box, a, edge[a]) ==
        fg__camera_sees_inside(camera, view_box, b, edge[b]))
      continue;
    pixel_at(view_box, camera, edge, axis, 0.0, middle);
    double merit = axis == 2 ? -middle[0] : middle[1] - 1e-3 * middle[0];
    if (merit > best) {
      best = merit;
      memcpy(out, edge, sizeof edge);
    }
  }
}

static double widest_of(const fg__ticks *ticks, double em, cairo_t *ruler)
{
  double widest = 0.0;
  for (int n = 0; n < ticks->count; ++n)
    widest = fmax(widest, fg__text_width(ruler, ticks->text[n], em, false));
  return widest;
}

/* At least two numbers, without which there is no scale to be read: those of the largest
 * step that has them, or the first and the last of these where not all have room. `along`
 * is the edge, pixels. */
static void refine_ticks(fg__box_axes *out, int axis, const double along[2],
                         cairo_t *ruler)
{
  fg__ticks *ticks = &out->ticks[axis];
  const fg__tick_axis *of = &out->axis[axis];
  const double range = of->high - of->low;
  double step = fg__ticks_step(of, range);
  fg__ticks_fill(ticks, of, step);
  while (ticks->count < 2 && step > 0.1 * range) {
    step = fg__ticks_step_below(of, step);
    fg__ticks_fill(ticks, of, step);
  }
  const double x = fabs(along[0]) * step / range, y = fabs(along[1]) * step / range;
  if (ticks->count <= 2 ||
      x >= widest_of(ticks, out->em, ruler) + least_gap[0] * out->em ||
      y >= (digit_height + least_gap[1]) * out->em)
    return;
  const int last = ticks->count - 1;
  ticks->position[1] = ticks->position[last];
  memcpy(ticks->text[1], ticks->text[last], sizeof ticks->text[1]);
  ticks->count = 2;
}

/* Numbers along x need their width, those along z their height. */
static void choose_ticks(fg__box_axes *out, int axis, const double along[2],
                         cairo_t *ruler)
{
  const double pixels = fmax(hypot(along[0], along[1]), 1.0);
  fg__ticks *ticks = &out->ticks[axis];
  const fg__tick_axis *of = &out->axis[axis];
  double range = of->high - of->low;
  double step = fg__ticks_step(of, range * fmin(least_step * out->em / pixels, 1.0));
  for (int turn = 0; turn < 6; ++turn) {
    fg__ticks_fill(ticks, of, step);
    const double widest = widest_of(ticks, out->em, ruler);
    if (ticks->count > 0 && (widest + out->em) < pixels * step / range)
      break;
    step = fg__ticks_step(of, 1.2 * step);
  }
  if (ticks->count < 2)
    refine_ticks(out, axis, along, ruler);
}

void fg__box_axes_of(fg__box_axes *out, const fg_field_arrays *field,
                     const fg__view_box *view_box, const fg__camera *camera, double em,
                     cairo_t *ruler)
{
  memset(out, 0, sizeof *out);
  out->em = em;
  for (int k = 0; k < 3; ++k) {
    double extent = view_box->high[k] - view_box->low[k];
    for (int m = 0; m < 3; ++m)
      if (strcmp(field->axis_units[k], field->axis_units[m]) == 0)
        extent = fmax(extent, view_box->high[m] - view_box->low[m]);
    fg__axis_of_numbers(&out->axis[k], view_box->low[k], view_box->high[k], extent,
                        field->axis_name[k], field->axis_units[k]);
    double from[2], to[2];
    choose_edge(out->edge[k], view_box, camera, k);
    pixel_at(view_box, camera, out->edge[k], k, -view_box->half[k], from);
    pixel_at(view_box, camera, out->edge[k], k, view_box->half[k], to);
    const double along[2] = {to[0] - from[0], to[1] - from[1]};
    out->length[k] = hypot(along[0], along[1]);
    out->edge[k][k] = out->length[k] > shortest_axis * em;
    choose_ticks(out, k, along, ruler);
  }
}

void fg__box_axes_bare(fg__box_axes *axes, const fg_field_arrays *field, int axis)
{
  fg__tick_axis *of = &axes->axis[axis];
  snprintf(of->label, sizeof of->label, "%s", field->axis_name[axis]);
  axes->ticks[axis].count = 0;
  axes->edge[axis][axis] = axes->length[axis] > shortest_named * axes->em;
}

static bool are_same(const fg__box_text *a, const fg__box_text *b)
{
  return strcmp(a->text, b->text) == 0 && (a->shared || b->shared);
}

static bool are_apart(const fg__box_text *a, const fg__box_text *b, double em)
{
  const bool same = are_same(a, b);
  const double across = (same ? corner_gap : least_gap[0]) * em;
  const double upright = (same ? corner_gap : least_gap[1]) * em;
  return a->box.x0 >= b->box.x1 + across || b->box.x0 >= a->box.x1 + across ||
         a->box.y0 >= b->box.y1 + upright || b->box.y0 >= a->box.y1 + upright;
}

/* The first text that is in the way of another; NULL: none. */
static const fg__box_text *in_the_way(const fg__box_axes *axes, const fg__box_text *text)
{
  for (int n = 0; n < axes->texts; ++n)
    if (!are_apart(text, &axes->text[n], axes->em))
      return &axes->text[n];
  return NULL;
}

/* A text whose box lies beyond a point: it touches it at the side it comes from, or lies
 * aside. One that is dispensable does not, nor one that stands there already. */
static void place_text(fg__box_axes *axes, const fg__box_text *what, const double at[2],
                       const double away[2], cairo_t *ruler)
{
  const double em = axes->em, width = fg__text_width(ruler, what->text, em, false);
  const double height = digit_height * em;
  const double most = what->dispensable ? 0.0 : what->shared ? shared_aside : most_aside;
  for (double aside = 0.0; aside <= most; aside += aside_step) {
    double x = at[0] + away[0] * (width / 2.0 + aside * em) - width / 2.0;
    double y = at[1] + away[1] * (height / 2.0 + aside * em) + height / 2.0;
    fg__box_text text = *what;
    text.box = (fg__pane){x, y - height, x + width, y};
    const fg__box_text *other = in_the_way(axes, &text);
    if (!other) {
      axes->text[axes->texts++] = text;
      return;
    }
    if (are_same(&text, other))
      return;
  }
}

/* The ends of an axis' edge, pixels, and the direction away from the box there. */
static void find_edge(const fg__box_axes *axes, const fg__view_box *view_box,
                      const fg__camera *camera, int axis, double end[2][2],
                      double away[2])
{
  const int *edge = axes->edge[axis];
  const double origin[3] = {0.0, 0.0, 0.0};
  double middle[2];
  pixel_at(view_box, camera, edge, axis, -view_box->half[axis], end[0]);
  pixel_at(view_box, camera, edge, axis, view_box->half[axis], end[1]);
  fg__camera_project(camera, origin, middle);
  double length = hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]);
  away[0] = (end[1][1] - end[0][1]) / length;
  away[1] = -(end[1][0] - end[0][0]) / length;
  double side = (end[0][0] - middle[0]) * away[0] + (end[0][1] - middle[1]) * away[1];
  for (int k = 0; k < 2; ++k)
    away[k] = side < 0.0 ? -away[k] : away[k];
}

static void tick_at(const fg__box_axes *axes, const fg__view_box *view_box,
                    const fg__camera *camera, int axis, int n, double out[2])
{
  pixel_at(view_box, camera, axes->edge[axis], axis,
           fg__view_box_place(view_box, axis, axes->ticks[axis].position[n]), out);
}

static void place_axis(fg__box_axes *axes, const fg__view_box *view_box,
                       const fg__camera *camera, int axis, cairo_t *ruler)
{
  const fg__ticks *ticks = &axes->ticks[axis];
  double end[2][2], away[2], at[2], em = axes->em;
  const double widest = widest_of(ticks, em, ruler);
  find_edge(axes, view_box, camera, axis, end, away);
  for (int n = 0; n < ticks->count; ++n) {
    tick_at(axes, view_box, camera, axis, n, at);
    for (int k = 0; k < 2; ++k)
      at[k] += (tick_length + number_gap) * em * away[k];
    const bool at_corner = n == 0 || n == ticks->count - 1;
    const fg__box_text number = {.text = ticks->text[n],
                                 .dispensable = at_corner && ticks->count >= MANY,
                                 .shared =
                                     ticks->count >= (n == 0 ? SOME : MANY) && at_corner};
    place_text(axes, &number, at, away, ruler);
  }
  double beyond = (tick_length + number_gap + label_gap) * em + fabs(away[0]) * widest +
                  fabs(away[1]) * digit_height * em;
  for (int k = 0; k < 2; ++k)
    at[k] = (end[0][k] + end[1][k]) / 2.0 + beyond * away[k];
  const fg__box_text name = {.text = axes->axis[axis].label};
  place_text(axes, &name, at, away, ruler);
}

void fg__box_axes_place(fg__box_axes *axes, fg__pane *bounds,
                        const fg__view_box *view_box, const fg__camera *camera,
                        cairo_t *ruler)
{
  axes->texts = 0;
  for (int k = 0; k < 3; ++k)
    if (axes->edge[k][k])
      place_axis(axes, view_box, camera, k, ruler);
  for (int n = 0; n < axes->texts; ++n) {
    const fg__pane *box = &axes->text[n].box;
    *bounds = (fg__pane){fmin(bounds->x0, box->x0), fmin(bounds->y0, box->y0),
                         fmax(bounds->x1, box->x1), fmax(bounds->y1, box->y1)};
  }
}

void fg__box_axes_draw(const fg__writer *writer, const fg__box_axes *axes,
                       const fg__view_box *view_box, const fg__camera *camera)
{
  cairo_t *cairo = writer->surface->cairo;
  double end[2][2], away[2], at[2], tick = tick_length * axes->em;
  cairo_set_source_rgb(cairo, ink, ink, ink);
  cairo_set_line_width(cairo, fmax(axes->em / 16.0, 1.0));
  for (int k = 0; k < 3; ++k) {
    if (!axes->edge[k][k])
      continue;
    find_edge(axes, view_box, camera, k, end, away);
    for (int n = 0; n < axes->ticks[k].count; ++n) {
      tick_at(axes, view_box, camera, k, n, at);
      cairo_move_to(cairo, at[0], at[1]);
      cairo_line_to(cairo, at[0] + tick * away[0], at[1] + tick * away[1]);
    }
  }
  cairo_stroke(cairo);
  for (int n = 0; n < axes->texts; ++n) {
    const double start[2] = {axes->text[n].box.x0, axes->text[n].box.y1};
    fg__write_text(writer, axes->text[n].text, start, false, ink, FG__ALIGN_MIDDLE);
  }
}

double fg__color_bar_width(double height, double em, const fg__tick_axis *speed,
                           const fg__bar_label *label, cairo_t *ruler)
{
  fg__ticks ticks;
  double widest = 0.0;
  fg__page_choose_ticks(&ticks, speed, ruler, height, em, true);
  for (int n = 0; n < ticks.count; ++n)
    widest = fmax(widest, fg__text_width(ruler, ticks.text[n], em, false));
  widest += (bar_width + tick_length + number_gap) * em;
  for (int n = 0; n < label->count; ++n)
    widest = fmax(widest, fg__text_width(ruler, label->line[n], label->size, false));
  return widest;
}

double fg__color_bar_rise(double em, const fg__bar_label *label)
{
  const int more = label->count > 1 ? label->count - 1 : 0;
  return (name_gap + bar_width + FG__TEXT_ASCENT) * em + more * label_line * label->size;
}

void fg__color_bar_draw(const fg__writer *writer, const fg__pane *pane,
                        const fg__palette *palette, const fg__tick_axis *speed,
                        const fg__bar_label *label, const bool beyond[2])
{
  cairo_t *cairo = writer->surface->cairo;
  const double em = writer->em;
  double height = pane->y1 - pane->y0, width = bar_width * em;
  const fg__page_box key = {pane->x0, pane->y0, pane->x0 + width, pane->y1};
  const double point[2] = {beyond[0] ? width : 0.0, beyond[1] ? width : 0.0};
  fg__draw_ramp(cairo, &key, true, point, palette);
  cairo_set_source_rgb(cairo, ink, ink, ink);
  cairo_set_line_width(cairo, fmax(em / 16.0, 1.0));
  cairo_stroke(cairo);
  fg__ticks ticks;
  const double range = speed->high - speed->low;
  fg__page_choose_ticks(&ticks, speed, cairo, height, em, true);
  for (int n = 0; n < ticks.count; ++n) {
    double y = pane->y1 - height * (ticks.position[n] - speed->low) / range;
    cairo_move_to(cairo, pane->x0 + width, y);
    cairo_line_to(cairo, pane->x0 + width + tick_length * em, y);
    cairo_stroke(cairo);
    const double at[2] = {pane->x0 + width + (tick_length + number_gap) * em,
                          y + 0.36 * em};
    fg__write_text(writer, ticks.text[n], at, false, ink, FG__ALIGN_START);
  }
  const double above = (name_gap + (beyond[1] ? bar_width : 0.0)) * em;
  const fg__writer small = {writer->surface, label->size, writer->shapes};
  for (int n = 0; n < label->count; ++n) {
    const double up = above + (label->count - 1 - n) * label_line * label->size;
    const double at[2] = {pane->x0, pane->y0 - up};
    fg__write_text(&small, label->line[n], at, false, ink, FG__ALIGN_START);
  }
}
