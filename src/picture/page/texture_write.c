/* Pictures of textures: pixel for pixel, what is masked covered. */
#include "flowgrain/texture.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/page/draw.h"
#include "picture/page/texture_image.h"
#include "picture/surface/surface.h"

/* In files without pixels of their own: what the arrows' pictures have in PNG. */
static const double default_density = 2.0;

/* Points: the least and largest width, which is what PDF readers promise to show. */
static const double narrowest = 36.0, widest = 14400.0;

static fg_status check_style(fg_context *context, const fg_texture_style *style)
{
  if (!(style->fade >= 0.0 && style->fade <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: fade %g, it must lie between 0 and 1", style->fade);
  if (style->width != 0.0 && !(style->width >= narrowest && style->width <= widest))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: a width of %g points, it must lie between %g and %g",
                    style->width, narrowest, widest);
  return fg__surface_options_check(context, 0.0, style->font_size, style->speed_min,
                                   style->speed_max);
}

/* The outlines of what is masked, in pixels; y is stretched, should pixels not be square.
 */
static fg_status find_mask(fg__polygons *out, fg_context *context, const fg_field *field,
                           const int size[2])
{
  double low[2], high[2];
  fg__scene_box(low, high, fg_field_contents(field));
  const double scale = size[0] / (high[0] - low[0]);
  const double tall = scale * (high[1] - low[1]);
  const fg__page page = {.scale = scale, .frame = {0.0, 0.0, size[0], tall}};
  fg_status status = fg__scene_mask(out, context, &page, field, low, NULL);
  for (size_t n = 0; !status && n < out->point_count; ++n)
    out->point[n][1] *= size[1] / tall;
  return status;
}

/* What is painted: an image, and what covers it. */
typedef struct painted {
  cairo_surface_t *image;
  double pixels_per_point;
  fg__polygons mask;   /* pixels */
  fg__map_cover cover; /* of a map, points: what was the mask */
  fg__color mask_color;
  bool transparent;
  bool on_map;
  fg__map_scene map;
  fg__map_style map_style;
} painted;

/* Of a field on the Earth: coasts on a page that is as large as the image. */
static fg_status find_coasts(painted *out, fg_context *context, const fg_field *field,
                             const int size[2], const fg_texture_style *style)
{
  double low[2], high[2];
  fg__plane plane;
  const fg__map_layers layers = {.borders = style->borders, .no_graticule = true};
  if (style->no_coast)
    return FG_STATUS_OK;
  fg__scene_box(low, high, fg_field_contents(field));
  const double wide = size[0] / out->pixels_per_point;
  const double tall = size[1] / out->pixels_per_point;
  const fg__page page = {.scale = wide / (high[0] - low[0]),
                         .frame = {0.0, 0.0, wide, tall}};
  fg_status status = fg__plane_create(&plane, context, field, low, high);
  fg__graticule *graticule = fg__allocate(1, sizeof *graticule);
  if (!status && !graticule)
    status = fg__fail_memory(context, "a map", sizeof *graticule);
  if (!status && plane.kind != FG__PLANE_NONE) {
    /* the image shows the whole box, not what an outline bounds */
    fg__scene_box(plane.low, plane.high, fg_field_contents(field));
    graticule->plane = &plane;
    status = fg__map_scene_create(&out->map, context, &page, graticule, field, &layers);
    out->on_map = !status;
    for (size_t n = 0; n < out->mask.point_count; ++n)
      for (int k = 0; k < 2; ++k)
        out->mask.point[n][k] /= out->pixels_per_point;
    out->cover.exact = out->mask;
    out->mask = (fg__polygons){.point = NULL};
    if (!status)
      status = fg__map_cover_smooth(&out->cover, context, (double[2]){0.0, 0.0},
                                    (double[2]){wide, tall});
  }
  free(graticule);
  fg__plane_clear(&plane);
  return status;
}

static void paint_image(cairo_t *cairo, const painted *p)
{
  cairo_set_source_surface(cairo, p->image, 0.0, 0.0);
  cairo_paint(cairo);
}

/* All but the mask: a rectangle of width and height less its polygons. */
static void clip_to_known(cairo_t *cairo, const fg__polygons *mask, double wide,
                          double high)
{
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_rectangle(cairo, 0.0, 0.0, wide, high);
  fg__draw_path(cairo, mask);
  cairo_clip(cairo);
}

static void paint(cairo_t *cairo, const painted *p)
{
  cairo_scale(cairo, 1.0 / p->pixels_per_point, 1.0 / p->pixels_per_point);
  if (p->transparent && p->mask.count)
    clip_to_known(cairo, &p->mask, cairo_image_surface_get_width(p->image),
                  cairo_image_surface_get_height(p->image));
  paint_image(cairo, p);
  if (!p->transparent && p->mask.count)
    fg__draw_mask(cairo, &p->mask, p->mask_color);
}

static void paint_map(cairo_t *cairo, const painted *p)
{
  const double wide = cairo_image_surface_get_width(p->image) / p->pixels_per_point;
  const double high = cairo_image_surface_get_height(p->image) / p->pixels_per_point;
  cairo_rectangle(cairo, 0.0, 0.0, wide, high);
  cairo_clip(cairo);
  if (!p->transparent) {
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_paint(cairo);
  }
  fg__map_clip(cairo, &p->map);
  cairo_save(cairo);
  if (p->transparent && p->cover.smooth.count)
    clip_to_known(cairo, &p->cover.smooth, wide, high);
  cairo_scale(cairo, 1.0 / p->pixels_per_point, 1.0 / p->pixels_per_point);
  paint_image(cairo, p);
  cairo_restore(cairo);
  if (!p->transparent)
    fg__map_draw_land(cairo, &p->map, &p->map_style, &p->cover);
  fg__map_draw_lines(cairo, &p->map, &p->map_style);
  cairo_reset_clip(cairo);
  fg__map_draw_outline_in(cairo, &p->map, wide, high);
}

static fg_status plan_key(fg__page_plan *plan, fg_context *context, const fg_field *field,
                          const fg_texture_arrays *texture, const fg_texture_style *style)
{
  const char *units = fg_field_contents(field)->velocity_units;
  double range[2];
  const fg_status status = fg__texture_range(range, context, texture, style);
  if (status)
    return status;
  plan->color_key = true;
  fg__axis_of_numbers(&plan->speed, range[0], range[1], range[1] - range[0], "speed",
                      units);
  fg__caption_label_speeds(&plan->speed, style->label, units);
  if (style->speed_max > style->speed_min)
    fg__texture_beyond(plan->speeds_beyond, texture, range);
  return FG_STATUS_OK;
}

/* A page as large as the image; with a caption and a key when the style wants them. */
static fg_status plan_page(fg__page *page, fg__palette *palette, fg_context *context,
                           const painted *p, const fg_field *field,
                           const fg_texture_arrays *texture,
                           const fg_texture_style *style)
{
  const double wide = texture->size[0] / p->pixels_per_point;
  const double high = texture->size[1] / p->pixels_per_point;
  const char *const wanted[2] = {style->title ? style->title : "",
                                 style->subtitle ? style->subtitle : ""};
  *page = (fg__page){.width = wide, .height = high, .frame = {.x1 = wide, .y1 = high}};
  fg__page_plan *plan = fg__allocate(1, sizeof *plan);
  if (!plan)
    return fg__fail_memory(context, "a page", sizeof *plan);
  plan->width = wide;
  plan->short_key = p->on_map;
  plan->font_size = style->font_size;
  fg__caption_write(plan->title, plan->subtitle, fg_field_contents(field), NULL, wanted,
                    0.0);
  fg_status status = fg__palette_create(palette, context, style->palette);
  if (!status && style->key && style->palette && !palette->uniform)
    status = plan_key(plan, context, field, texture, style);
  if (!status)
    fg__page_place_lone(page, plan, 1.0 / p->pixels_per_point);
  free(plan);
  return status;
}

static fg_status write(fg_context *context, const char *path, const painted *p,
                       const fg__page *page, const fg__palette *palette,
                       const fg_texture_style *style)
{
  fg__surface_file surface;
  fg_status status = fg__surface_file_open(&surface, context, path, page->width,
                                           page->height, p->pixels_per_point, NULL);
  if (status)
    return status;
  if (page->text_count > 0 && !p->transparent) {
    cairo_set_source_rgb(surface.cairo, 1.0, 1.0, 1.0);
    cairo_paint(surface.cairo);
  }
  if (page->has_color_key)
    fg__draw_key(surface.cairo, page, palette);
  if (page->text_count > 0)
    fg__draw_texts(&surface, page, style->outline_text);
  cairo_translate(surface.cairo, page->frame.x0, page->frame.y0);
  if (p->on_map)
    paint_map(surface.cairo, p);
  else
    paint(surface.cairo, p);
  return fg__surface_file_close(&surface, context, FG_STATUS_OK);
}

static fg_status choose_colors(painted *p, fg_context *context,
                               const fg_texture_style *style)
{
  p->transparent = style->transparent;
  p->map_style = (fg__map_style){.transparent = style->transparent, .on_texture = true};
  fg_status status =
      fg__color_choose(&p->mask_color, context, style->mask_color, fg__default_mask);
  if (!status)
    status = fg__color_choose(&p->map_style.missing, context, style->mask_color,
                              fg__default_missing);
  if (!status)
    status = fg__color_choose(&p->map_style.land, context, style->land, fg__default_land);
  return status;
}

fg_status fg_texture_write(fg_context *context, const char *path, const fg_field *field,
                           const fg_texture *texture, const fg_texture_style *style)
{
  if (!path || !field || !texture)
    return fg__fail(context, FG_STATUS_ARGUMENT, "texture: a NULL argument");
  fg_texture_style settled = {0};
  if (style)
    settled = *style;
  const fg_texture_arrays *contents = fg_texture_contents(texture);
  if (contents->kind == FG_TEXTURE_SPEED && !settled.palette)
    settled.palette = fg_picture_palettes()[0];
  painted p = {.image = NULL};
  fg__palette palette;
  fg__page *page = fg__allocate(1, sizeof *page);
  if (!page)
    return fg__fail_memory(context, "a page", sizeof *page);
  fg_status status = fg__surface_file_format_check(context, path);
  if (!status)
    status = check_style(context, &settled);
  p.pixels_per_point =
      settled.width > 0.0 ? contents->size[0] / settled.width : default_density;
  if (!status)
    status = choose_colors(&p, context, &settled);
  if (!status)
    status = find_mask(&p.mask, context, field, contents->size);
  if (!status)
    status = find_coasts(&p, context, field, contents->size, &settled);
  if (!status)
    status = fg__texture_image(&p.image, context, contents, &settled);
  if (!status)
    status = plan_page(page, &palette, context, &p, field, contents, &settled);
  if (!status)
    status = write(context, path, &p, page, &palette, &settled);
  free(page);
  cairo_surface_destroy(p.image);
  fg__polygons_clear(&p.mask);
  fg__map_cover_clear(&p.cover);
  fg__map_scene_clear(&p.map);
  return status;
}
