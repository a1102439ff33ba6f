#include "picture/page/draw.h"

#include <math.h>

/* Ink for the frame and words: softer than black, so that the arrows come first. */
static const fg__color ink = {0.15, 0.16, 0.18};
static const fg__color quiet_ink = {0.40, 0.41, 0.43};

const fg__color fg__default_mask = {0.855, 0.855, 0.845};

/* Points. Journals ask for lines of at least half a point. */
static const double frame_width = 0.6;
static const double coast_width = 0.4;
static const double rim_width = 0.9;
static const double rim_width_on_map = 0.25;

/* Of a text over other things, in units of its size. */
static const double halo_width = 0.2;

/* Opacity of a tint through which a texture, or land, is still to be seen. */
static const double tint_on_texture = 0.55;

static void set_color(cairo_t *cairo, fg__color color)
{
  cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
}

static void add_loop(cairo_t *cairo, const fg__polygons *polygons, size_t loop)
{
  cairo_new_sub_path(cairo);
  for (size_t n = polygons->start[loop]; n < polygons->start[loop + 1]; ++n)
    cairo_line_to(cairo, polygons->point[n][0], polygons->point[n][1]);
  cairo_close_path(cairo);
}

void fg__draw_path(cairo_t *cairo, const fg__polygons *polygons)
{
  for (size_t loop = 0; loop < polygons->count; ++loop)
    add_loop(cairo, polygons, loop);
}

static fg__color darker(fg__color color, double share)
{
  return (fg__color){share * color.red, share * color.green, share * color.blue};
}

void fg__draw_mask(cairo_t *cairo, const fg__polygons *mask, fg__color color)
{
  fg__draw_path(cairo, mask);
  set_color(cairo, color);
  cairo_fill_preserve(cairo);
  cairo_set_line_width(cairo, coast_width);
  set_color(cairo, darker(color, 0.78));
  cairo_stroke(cairo);
}

/* Pixels that are as large as those of the surface are taken as they are. */
static void draw_background(cairo_t *cairo, const fg__page_box *box,
                            cairo_surface_t *background)
{
  const double wide = cairo_image_surface_get_width(background);
  const double high = cairo_image_surface_get_height(background);
  double pixel[2] = {(box->x1 - box->x0) / wide, (box->y1 - box->y0) / high};
  cairo_save(cairo);
  cairo_translate(cairo, box->x0, box->y0);
  cairo_scale(cairo, pixel[0], pixel[1]);
  cairo_set_source_surface(cairo, background, 0.0, 0.0);
  pixel[0] = pixel[1] = 1.0;
  cairo_user_to_device_distance(cairo, &pixel[0], &pixel[1]);
  if (fabs(pixel[0] - 1.0) < 0.02 && fabs(pixel[1] - 1.0) < 0.02)
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(cairo_get_source(cairo), CAIRO_EXTEND_PAD);
  cairo_rectangle(cairo, 0.0, 0.0, wide, high);
  cairo_fill(cairo);
  cairo_restore(cairo);
}

static void draw_areas(cairo_t *cairo, const fg__scene *scene, const fg__style *style)
{
  const bool coasts = style->map && style->map->coasts;
  if (coasts)
    fg__map_draw_land(cairo, style->map, &style->map_style,
                      style->background ? style->cover : NULL);
  if (scene->tint.count) {
    fg__draw_path(cairo, &scene->tint);
    cairo_set_source_rgba(cairo, style->tint.red, style->tint.green, style->tint.blue,
                          style->background || coasts ? tint_on_texture : 1.0);
    cairo_fill(cairo);
  }
  if (scene->mask.count && !coasts)
    fg__draw_mask(cairo, &scene->mask, style->mask);
  if (style->map)
    fg__map_draw_lines(cairo, style->map, &style->map_style);
}

/* On a texture or a map each has a pale rim, which sets it off. */
static void draw_arrow(cairo_t *cairo, const fg__scene *scene, size_t loop,
                       const fg__polygons *rims, double rim)
{
  if (rim > 0.0) {
    add_loop(cairo, rims, loop);
    cairo_set_line_width(cairo, 2.0 * rim);
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_stroke(cairo);
  }
  add_loop(cairo, &scene->arrows, loop);
  set_color(cairo, scene->arrow_color[loop]);
  cairo_fill(cairo);
}

/* A clip is written once for each path in SVG, and that of a map is long: only the arrows
 * that it cuts have it. */
static void draw_arrows(cairo_t *cairo, const fg__page *page, const fg__scene *scene,
                        const fg__style *style)
{
  const double rim = style->background && !style->on_speeds ? rim_width
                     : style->background || style->map      ? rim_width_on_map
                                                            : 0.0;
  const fg__polygons *rims = style->map ? &style->map->arrow_rims : &scene->arrows;
  for (size_t loop = 0; loop < scene->arrows.count; ++loop) {
    const bool whole =
        style->map && fg__map_scene_holds(style->map, page, &scene->arrows, loop);
    cairo_save(cairo);
    if (whole)
      cairo_reset_clip(cairo);
    draw_arrow(cairo, scene, loop, rims, rim);
    cairo_restore(cairo);
  }
}

/* Spines dotted, centres as rings: points. */
static void draw_skeletons(cairo_t *cairo, const fg__scene *scene)
{
  static const double dot = 1.5, gap = 3.2, ring = 2.6;
  const double dots[] = {0.0, gap};
  cairo_save(cairo);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_dash(cairo, dots, 2, 0.0);
  cairo_set_line_width(cairo, dot);
  set_color(cairo, ink);
  for (size_t loop = 0; loop < scene->spines.count; ++loop) {
    cairo_new_sub_path(cairo);
    for (size_t n = scene->spines.start[loop]; n < scene->spines.start[loop + 1]; ++n)
      cairo_line_to(cairo, scene->spines.point[n][0], scene->spines.point[n][1]);
  }
  cairo_stroke(cairo);
  cairo_set_dash(cairo, NULL, 0, 0.0);
  for (size_t n = 0; n < scene->centers.point_count; ++n) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, scene->centers.point[n][0], scene->centers.point[n][1], ring, 0.0,
              2.0 * acos(-1.0));
  }
  cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
  cairo_fill_preserve(cairo);
  cairo_set_line_width(cairo, 0.5 * dot);
  set_color(cairo, ink);
  cairo_stroke(cairo);
  cairo_restore(cairo);
}

static void add_box(cairo_t *cairo, const fg__page_box *box)
{
  cairo_rectangle(cairo, box->x0, box->y0, box->x1 - box->x0, box->y1 - box->y0);
}

/* A key's outline, with a point at an end beyond which there are speeds. */
static void add_key(cairo_t *cairo, const fg__page_box *key, bool upright,
                    const double point[2])
{
  double middle = upright ? 0.5 * (key->x0 + key->x1) : 0.5 * (key->y0 + key->y1);
  cairo_move_to(cairo, key->x0, key->y0);
  if (upright && point[1] > 0.0)
    cairo_line_to(cairo, middle, key->y0 - point[1]);
  cairo_line_to(cairo, key->x1, key->y0);
  if (!upright && point[1] > 0.0)
    cairo_line_to(cairo, key->x1 + point[1], middle);
  cairo_line_to(cairo, key->x1, key->y1);
  if (upright && point[0] > 0.0)
    cairo_line_to(cairo, middle, key->y1 + point[0]);
  cairo_line_to(cairo, key->x0, key->y1);
  if (!upright && point[0] > 0.0)
    cairo_line_to(cairo, key->x0 - point[0], middle);
  cairo_close_path(cairo);
}

void fg__draw_ramp(cairo_t *cairo, const fg__page_box *key, bool upright,
                   const double point[2], const fg__palette *palette)
{
  cairo_pattern_t *ramp = upright
                              ? cairo_pattern_create_linear(0.0, key->y1, 0.0, key->y0)
                              : cairo_pattern_create_linear(key->x0, 0.0, key->x1, 0.0);
  const int steps = palette->bands ? palette->bands : FG__PALETTE_SAMPLES - 1;
  for (int k = 0; k <= steps; ++k) {
    const double at = (double)k / steps;
    const fg__color before = fg__palette_color(palette, at - 0.5 / steps),
                    after = fg__palette_color(palette, at);
    if (palette->bands && k > 0) /* two colours at the edge of two bands */
      cairo_pattern_add_color_stop_rgb(ramp, at, before.red, before.green, before.blue);
    if (!palette->bands || k < steps)
      cairo_pattern_add_color_stop_rgb(ramp, at, after.red, after.green, after.blue);
  }
  add_key(cairo, key, upright, point);
  cairo_set_source(cairo, ramp);
  cairo_fill_preserve(cairo);
  cairo_pattern_destroy(ramp);
}

static void draw_color_key(cairo_t *cairo, const fg__page *page,
                           const fg__palette *palette)
{
  fg__draw_ramp(cairo, &page->color_key, page->color_key_upright, page->color_key_point,
                palette);
  cairo_set_line_width(cairo, frame_width);
  set_color(cairo, ink);
  cairo_stroke(cairo);
}

static void draw_lines(cairo_t *cairo, const fg__page *page)
{
  cairo_set_line_width(cairo, frame_width);
  set_color(cairo, ink);
  if (page->framed)
    add_box(cairo, &page->frame);
  for (int k = 0; k < page->line_count; ++k) {
    cairo_move_to(cairo, page->line[k].x0, page->line[k].y0);
    cairo_line_to(cairo, page->line[k].x1, page->line[k].y1);
  }
  cairo_stroke(cairo);
}

static void draw_text(cairo_t *cairo, const fg__page_text *text, bool shapes)
{
  set_color(cairo, text->quiet ? quiet_ink : ink);
  cairo_save(cairo);
  cairo_translate(cairo, text->x, text->y);
  if (text->upwards)
    cairo_rotate(cairo, -0.5 * acos(-1.0));
  cairo_move_to(cairo, 0.0, 0.0);
  fg__text_draw(cairo, text->text, text->size, text->bold, shapes);
  cairo_restore(cairo);
}

void fg__draw_texts(fg__surface_file *surface, const fg__page *page, bool shapes)
{
  const bool written = surface->format == FG__SURFACE_SVG && !shapes;
  for (int k = 0; k < page->text_count; ++k) {
    const fg__page_text *text = &page->text[k];
    if (written)
      fg__svg_texts_add(&surface->texts, surface->cairo, text,
                        text->quiet ? quiet_ink : ink);
    else
      draw_text(surface->cairo, text, shapes);
  }
}

void fg__draw_key(cairo_t *cairo, const fg__page *page, const fg__palette *palette)
{
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
  if (page->has_color_key)
    draw_color_key(cairo, page, palette);
  draw_lines(cairo, page);
}

void fg__draw_white(cairo_t *cairo)
{
  cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
  cairo_paint(cairo); /* pixels that reach past the page's edge, too */
}

void fg__draw_inside(cairo_t *cairo, const fg__page *page, const fg__scene *scene,
                     const fg__style *style)
{
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_save(cairo);
  add_box(cairo, &page->frame);
  cairo_clip(cairo);
  if (style->map)
    fg__map_clip(cairo, style->map);
  if (style->background)
    draw_background(cairo, &style->background_box, style->background);
  draw_areas(cairo, scene, style);
  cairo_save(cairo);
  cairo_reset_clip(cairo); /* a map's is written for every path, and none is cut */
  fg__symbols_draw(cairo, page, style->low, style->critical);
  cairo_restore(cairo);
  draw_arrows(cairo, page, scene, style);
  draw_skeletons(cairo, scene);
  cairo_restore(cairo);
}

static void draw_halos(cairo_t *cairo, const fg__page *page)
{
  cairo_set_source_rgba(cairo, 1.0, 1.0, 1.0, 0.9);
  for (int k = 0; k < page->text_count; ++k) {
    const fg__page_text *text = &page->text[k];
    if (!text->halo)
      continue;
    cairo_move_to(cairo, text->x, text->y);
    fg__text_stroke(cairo, text->text, text->size, text->bold,
                    2.0 * halo_width * text->size);
  }
}

void fg__draw_round(cairo_t *cairo, const fg__page *page, const fg__palette *palette,
                    const fg__style *style, const fg__polygons *reference)
{
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
  if (page->has_color_key)
    draw_color_key(cairo, page, palette);
  if (style->map)
    fg__map_draw_outline(cairo, style->map);
  if (style->map && !style->map_style.transparent)
    draw_halos(cairo, page);
  draw_lines(cairo, page);
  for (int k = 0; k < page->symbol_count; ++k)
    fg__symbol_draw(cairo, &page->symbol[k], 0.0);
  if (page->has_size_key && reference->count) {
    fg__draw_path(cairo, reference);
    set_color(cairo, quiet_ink);
    cairo_fill(cairo);
  }
}
