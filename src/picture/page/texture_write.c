/* Pictures of textures: pixel for pixel, what is masked covered. */
#include "flowgrain/texture.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "picture/page/draw.h"
#include "picture/page/texture_image.h"
#include "picture/page/texture_key.h"
#include "picture/surface/surface.h"

/* In files without pixels of their own: what the arrows' pictures have in PNG. */
static const double pixels_per_point = 2.0;

static fg_status check_style(fg_context *context, const fg_texture_style *style)
{
  if (!(style->fade >= 0.0 && style->fade <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: fade %g, it must lie between 0 and 1", style->fade);
  if (!isfinite(style->speed_min) || !isfinite(style->speed_max) ||
      style->speed_max < style->speed_min)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "texture: speeds cannot run from %g to %g", style->speed_min,
                    style->speed_max);
  return FG_STATUS_OK;
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
  fg_status status = fg__scene_mask(out, context, &page, field, low);
  for (size_t n = 0; !status && n < out->point_count; ++n)
    out->point[n][1] *= size[1] / tall;
  return status;
}

static void paint(cairo_t *cairo, cairo_surface_t *image, const fg__polygons *mask,
                  const fg_texture_style *style, fg__color mask_color)
{
  cairo_set_source_surface(cairo, image, 0.0, 0.0);
  if (style->transparent && mask->count) {
    /* all but the mask: the rectangle less its polygons */
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_rectangle(cairo, 0.0, 0.0, cairo_image_surface_get_width(image),
                    cairo_image_surface_get_height(image));
    fg__draw_path(cairo, mask);
    cairo_clip(cairo);
  }
  cairo_paint(cairo);
  if (!style->transparent && mask->count)
    fg__draw_mask(cairo, mask, mask_color);
}

/* A page as large as the image; with a key when the style wants it. */
static fg_status plan_page(fg__page *page, fg__palette *palette, fg_context *context,
                           const fg_field *field, const fg_texture_arrays *texture,
                           const fg_texture_style *style)
{
  const double wide = texture->size[0] / pixels_per_point;
  const double high = texture->size[1] / pixels_per_point;
  *page = (fg__page){.width = wide, .height = high, .frame = {.x1 = wide, .y1 = high}};
  fg_status status = fg__palette_create(palette, context, style->palette);
  if (status || !style->key || !style->palette || palette->uniform)
    return status;
  double range[2];
  status = fg__texture_range(range, context, texture, style);
  if (!status)
    fg__texture_key_place(page, range, fg_field_contents(field)->velocity_units);
  return status;
}

static fg_status write(fg_context *context, const char *path, cairo_surface_t *image,
                       const fg__polygons *mask, const fg_texture_style *style,
                       fg__color mask_color, const fg__page *page,
                       const fg__palette *palette)
{
  fg__surface_file surface;
  fg_status status = fg__surface_file_open(&surface, context, path, page->width,
                                           page->height, pixels_per_point, NULL);
  if (status)
    return status;
  if (page->has_color_key) {
    if (!style->transparent) {
      cairo_set_source_rgb(surface.cairo, 1.0, 1.0, 1.0);
      cairo_paint(surface.cairo);
    }
    fg__draw_key(surface.cairo, page, palette);
    fg__draw_texts(&surface, page, false);
  }
  cairo_scale(surface.cairo, 1.0 / pixels_per_point, 1.0 / pixels_per_point);
  paint(surface.cairo, image, mask, style, mask_color);
  return fg__surface_file_close(&surface, context, FG_STATUS_OK);
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
  fg__color mask_color = fg__usual_mask;
  fg__polygons mask = {0};
  cairo_surface_t *image = NULL;
  fg__palette palette;
  fg__page *page = fg__allocate(1, sizeof *page);
  if (!page)
    return fg__fail_memory(context, "a page", sizeof *page);
  fg_status status = fg__surface_file_format_check(context, path);
  if (!status)
    status = check_style(context, &settled);
  if (!status)
    status = fg__color_choose(&mask_color, context, settled.mask_color, fg__usual_mask);
  if (!status)
    status = find_mask(&mask, context, field, contents->size);
  if (!status)
    status = fg__texture_image(&image, context, contents, &settled);
  if (!status)
    status = plan_page(page, &palette, context, field, contents, &settled);
  if (!status)
    status = write(context, path, image, &mask, &settled, mask_color, page, &palette);
  free(page);
  cairo_surface_destroy(image);
  fg__polygons_clear(&mask);
  return status;
}
