#include "flowgrain/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/page/figure.h"
#include "picture/page/texture_image.h"
#include "picture/surface/surface.h"
#include "place/domain/domain.h"

/* Cairo's image surfaces end at 32767 pixels a side; 2^28 pixels take 1 GiB. */
static const double most_pixels_a_side = 32767.0;
static const double most_pixels = 268435456.0;

/* A texture as it is outshines what is drawn on it; by eye, on winds and vortices.
 * Stripes are black and white with little between: paler, they are not darker than land.
 */
static const double default_fade = 0.7, stripes_fade = 0.85;
static const double most_background = 16384.0;

/* Where the frame shows a small part of the domain, the texture of all of it has at most
 * so many pixels for each of the frame, so that it does not cost hundreds of pictures. */
static const double background_beyond = 16.0;

/* Axes of two panels differ by less than this share of their length: numbers of files
 * pass through text. On a map, where the shown parts of the Earth may follow what is
 * missing, they have at least so much in common of what they cover together. */
static const double same_share = 1e-6, least_common = 0.5;

static fg_status check_pixels(fg_context *context, const fg__figure *p)
{
  double wide = ceil(p->page.width * p->pixels_per_point);
  double high = ceil(p->page.height * p->pixels_per_point);
  if (wide <= most_pixels_a_side && high <= most_pixels_a_side &&
      wide * high <= most_pixels)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "picture: %g x %g pixels, at most %g a side and %g in all are drawn",
                  wide, high, most_pixels_a_side, most_pixels);
}

static fg_status make_background(fg__style *out, fg_context *context,
                                 const fg__figure *figure, const fg_panel *panel,
                                 const fg_picture_options *options)
{
  const fg_texture_arrays *texture = fg_texture_contents(panel->background);
  fg_texture_style style = {.fade = options->background_fade};
  if (!panel->background)
    return FG_STATUS_OK;
  if (texture->kind == FG_TEXTURE_SPEED) {
    const double range[2] = {figure->plan.speed.low, figure->plan.speed.high};
    return fg__texture_image_speeds(&out->background, context, texture, &figure->palette,
                                    range);
  }
  if (!(style.fade > 0.0))
    style.fade = texture->kind == FG_TEXTURE_STRIPES ? stripes_fade : default_fade;
  return fg__texture_image(&out->background, context, texture, &style);
}

/* What covers a background where data are missing. */
static fg_status make_cover(fg__figure_panel *panel, fg_context *context,
                            const fg__page *page)
{
  const double low[2] = {page->frame.x0, page->frame.y0};
  const double high[2] = {page->frame.x1, page->frame.y1};
  panel->cover.exact = panel->scene.mask;
  panel->scene.mask = (fg__polygons){.point = NULL};
  panel->style.cover = &panel->cover;
  return fg__map_cover_smooth(&panel->cover, context, low, high);
}

/* Coasts and the other lines of a map, once it is known where arrows lie. */
static fg_status make_map(fg__figure *figure, int k, fg_context *context,
                          const fg_picture_options *options)
{
  fg__figure_panel *panel = &figure->panel[k];
  fg__page *page = fg__figure_page(figure, k);
  if (figure->plane.kind == FG__PLANE_NONE)
    return FG_STATUS_OK;
  const fg__map_layers layers = {.no_coast = options->no_coast,
                                 .borders = options->borders,
                                 .no_graticule = options->no_frame};
  fg_status status = fg__map_scene_create(&panel->map, context, page, &figure->graticule,
                                          figure->given[k].field, &layers);
  if (!status)
    status = fg__map_scene_rim(&panel->map, context, &panel->scene.arrows);
  if (status)
    return status;
  panel->style.map = &panel->map;
  panel->style.map_style.on_texture = figure->given[k].background != NULL;
  if (panel->map.coasts && panel->style.map_style.on_texture)
    status = make_cover(panel, context, page);
  if (status || options->no_frame)
    return status;
  cairo_t *ruler = fg__text_ruler();
  if (page->has_degrees)
    fg__map_scene_label(&panel->map, page, &figure->graticule, &panel->scene.arrows,
                        ruler);
  cairo_destroy(ruler);
  return FG_STATUS_OK;
}

/* Where data are missing; gaps that lines go over are not shown. */
static fg_status make_mask(fg__figure *figure, int k, fg_context *context)
{
  const fg_panel *given = &figure->given[k];
  fg_field *filled = NULL;
  fg_status status = given->background
                         ? FG_STATUS_OK
                         : fg__place_without_gaps(&filled, context, given->field);
  if (!status)
    status = fg__scene_mask(&figure->panel[k].scene.mask, context,
                            fg__figure_page(figure, k), filled ? filled : given->field,
                            figure->low, &figure->plane.outline);
  fg_field_destroy(filled);
  return status;
}

static fg_status make_panel(fg__figure *figure, int k, fg_context *context,
                            const fg_picture_options *options)
{
  fg__figure_panel *panel = &figure->panel[k];
  const fg_panel *given = &figure->given[k];
  const fg__page *page = fg__figure_page(figure, k);
  const double range[2] = {figure->plan.speed.low, figure->plan.speed.high};
  /* coasts show what is missing, but with a background land is where the mask is */
  const bool masked =
      figure->plane.kind == FG__PLANE_NONE || options->no_coast || given->background;
  fg_status status = fg__scene_create(
      &panel->scene, context, page, given->field, figure->low, figure->high,
      options->tint ? fg_density_contents(given->density) : NULL,
      options->no_arrows ? NULL : given->icons, &figure->arrows, range);
  if (!status && masked)
    status = make_mask(figure, k, context);
  if (!status && (options->skeletons || options->centers))
    status = fg__scene_add_skeletons(&panel->scene, context, page,
                                     fg_field_contents(given->field), figure->low,
                                     figure->high, given->icons, options->skeletons);
  if (!status)
    status = make_map(figure, k, context, options);
  if (!status)
    status = make_background(&panel->style, context, figure, given, options);
  if (!status)
    status = fg__check_stop(context);
  return status;
}

static fg_status render(fg_context *context, const char *path, fg__figure *figure)
{
  static const fg__style plain = {.map = NULL};
  const fg__page *page = &figure->page;
  fg__surface_file surface;
  fg_status status =
      fg__surface_file_open(&surface, context, path, page->width, page->height,
                            figure->pixels_per_point, figure->plan.title);
  if (status)
    return status;
  if (!figure->transparent)
    fg__draw_white(surface.cairo);
  for (int k = 0; k < figure->count; ++k) {
    const fg__figure_panel *panel = &figure->panel[k];
    const fg__page *its = fg__figure_page(figure, k);
    fg__draw_inside(surface.cairo, its, &panel->scene, &panel->style);
    fg__draw_round(surface.cairo, its, &figure->palette, &panel->style,
                   &figure->reference);
    fg__draw_texts(&surface, its, figure->outline_text);
  }
  if (figure->plan.panels) {
    fg__draw_round(surface.cairo, page, &figure->palette, &plain, &figure->reference);
    fg__draw_texts(&surface, page, figure->outline_text);
  }
  return fg__surface_file_close(&surface, context, FG_STATUS_OK);
}

static int pixels_of(double length)
{
  return (int)fmin(fmax(floor(length + 0.5), 1.0), most_background);
}

static fg_status measure(int size[2], fg_context *context, const fg_panel *panel,
                         int count, bool several, const fg_picture_options *options)
{
  const fg_picture_options defaults = {0};
  fg__figure *figure = NULL;
  fg_status status = fg__figure_create(&figure, context, panel, count, several,
                                       options ? options : &defaults);
  if (!status) {
    const fg__page_box *box = &figure->panel[0].style.background_box;
    const fg__page_box *frame = &fg__figure_page(figure, 0)->frame;
    double wide = box->x1 - box->x0, high = box->y1 - box->y0;
    double most = background_beyond * (frame->x1 - frame->x0) * (frame->y1 - frame->y0);
    double pixels = figure->pixels_per_point * fmin(sqrt(most / (wide * high)), 1.0);
    size[0] = pixels_of(pixels * wide);
    size[1] = pixels_of(pixels * high);
  }
  fg__figure_destroy(figure);
  return status;
}

/* A panel by itself. */
static fg_status check_panel(fg_context *context, const char *path, const fg_panel *panel,
                             const fg_picture_options *options)
{
  if (options->tint && !panel->density)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a tint of the clusters needs their density");
  if (fg_field_contents(panel->field)->dimension != 2 ||
      (panel->density && fg_density_contents(panel->density)->dimension != 2))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: this version draws no fields in 3 dimensions", path);
  return FG_STATUS_OK;
}

static bool differ(const char *a, const char *b)
{
  return strcmp(a ? a : "", b ? b : "") != 0;
}

static const char *or_none(const char *text)
{
  return text && *text ? text : "none";
}

/* What a message calls a panel. */
enum { NAME_BYTES = 256 };

static const char *name_of(char out[NAME_BYTES], const fg_panel *panel, int k)
{
  if (panel[k].name)
    snprintf(out, NAME_BYTES, "%.*s", NAME_BYTES - 1, panel[k].name);
  else
    snprintf(out, NAME_BYTES, "panel %d", k + 1);
  return out;
}

/* Whether one key tells the speeds of panel k and of the first. */
static fg_status check_components(fg_context *context, const char *path,
                                  const fg_panel *panel, int k)
{
  const fg_field_arrays *first = fg_field_contents(panel[0].field);
  const fg_field_arrays *field = fg_field_contents(panel[k].field);
  char names[2][NAME_BYTES];
  name_of(names[0], panel, 0);
  name_of(names[1], panel, k);
  if (differ(first->velocity_units, field->velocity_units))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %s has the units %s, and %s %s: panels have one colour key",
                    path, names[1], or_none(field->velocity_units), names[0],
                    or_none(first->velocity_units));
  if (differ(first->velocity_name[0], field->velocity_name[0]) ||
      differ(first->velocity_name[1], field->velocity_name[1]))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %s shows %s, %s, and %s %s, %s: panels show the same components",
                    path, names[1], field->velocity_name[0], field->velocity_name[1],
                    names[0], first->velocity_name[0], first->velocity_name[1]);
  return FG_STATUS_OK;
}

/* Whether one map or box is of both. */
static fg_status check_place(fg_context *context, const char *path, const fg_panel *panel,
                             int k)
{
  const fg_field_arrays *first = fg_field_contents(panel[0].field);
  const fg_field_arrays *field = fg_field_contents(panel[k].field);
  const bool on_map = first->projection || first->scale == FG_SCALE_GEO;
  char names[2][NAME_BYTES];
  double low[2][2], high[2][2];
  name_of(names[0], panel, 0);
  name_of(names[1], panel, k);
  if (first->scale != field->scale || differ(first->projection, field->projection))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: %s has the projection %s, and %s %s: panels have one map", path,
                    names[1], or_none(field->projection), names[0],
                    or_none(first->projection));
  fg__scene_box(low[0], high[0], first);
  fg__scene_box(low[1], high[1], field);
  for (int i = 0; i < 2; ++i) {
    const double common = fmin(high[0][i], high[1][i]) - fmax(low[0][i], low[1][i]);
    const double all = fmax(high[0][i], high[1][i]) - fmin(low[0][i], low[1][i]);
    if (common < (on_map ? least_common : 1.0 - same_share) * all)
      return fg__fail(
          context, FG_STATUS_ARGUMENT,
          "%s: %s reaches from %g to %g along %s, and %s from %g to %g: panels "
          "show the same region",
          path, names[1], low[1][i], high[1][i], i ? "y" : "x", names[0], low[0][i],
          high[0][i]);
  }
  return FG_STATUS_OK;
}

static fg_status check_panels(fg_context *context, const char *path,
                              const fg_panel *panel, int count,
                              const fg_picture_options *options)
{
  if (!panel || count < 1 || count > FG_MOST_PANELS)
    return fg__fail(context, FG_STATUS_ARGUMENT, "%s: %d panels, 1 to %d are drawn", path,
                    panel ? count : 0, FG_MOST_PANELS);
  for (int k = 0; k < count; ++k) {
    if (!panel[k].field || !panel[k].icons)
      return fg__fail(context, FG_STATUS_ARGUMENT,
                      "%s: panel %d has no field or no icons", path, k + 1);
    fg_status status = check_panel(context, path, &panel[k], options);
    if (!status)
      status = check_components(context, path, panel, k);
    if (!status)
      status = check_place(context, path, panel, k);
    if (status)
      return status;
  }
  return FG_STATUS_OK;
}

static fg_status tell_key_width(double *out, fg_context *context,
                                const fg__figure *figure)
{
  const size_t panels = (size_t)figure->plan.panels;
  fg__page *page = fg__allocate(panels + 1, sizeof *page);
  if (!page)
    return fg__fail_memory(context, "a page's layout", (panels + 1) * sizeof *page);
  *out = fg__page_key_width(page, panels ? page + 1 : NULL, &figure->plan);
  free(page);
  return FG_STATUS_OK;
}

static fg_status write(fg_context *context, const char *path, const fg_panel *panel,
                       int count, bool several, const fg_picture_options *options)
{
  fg__figure *figure = NULL;
  fg_status status = fg__figure_create(&figure, context, panel, count, several, options);
  if (!status && fg__surface_file_format_of(path) == FG__SURFACE_PNG)
    status = check_pixels(context, figure);
  for (int k = 0; k < count && !status; ++k)
    status = make_panel(figure, k, context, options);
  if (!status && !options->no_arrows)
    status =
        fg__scene_reference(&figure->reference, context, &figure->page, &figure->typical);
  if (!status)
    status = render(context, path, figure);
  if (!status && options->key_width)
    status = tell_key_width(options->key_width, context, figure);
  fg__figure_destroy(figure);
  return status;
}

fg_status fg_picture_frame(int size[2], fg_context *context, const fg_field *field,
                           const fg_icons *icons, const fg_picture_options *options)
{
  if (!size || !field || !icons || fg_field_contents(field)->dimension != 2)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a NULL argument, or a field in 3 dimensions");
  const fg_panel panel = {
      .field = field, .icons = icons, .scale_time = options ? options->scale_time : 0.0};
  return measure(size, context, &panel, 1, false, options);
}

fg_status fg_panels_frame(int size[2], fg_context *context, const fg_panel *panels,
                          int count, const fg_picture_options *options)
{
  fg_picture_options untinted = {0};
  if (options)
    untinted = *options;
  untinted.tint = false;
  if (!size)
    return fg__fail(context, FG_STATUS_ARGUMENT, "panels: a NULL argument");
  fg_status status = check_panels(context, "panels", panels, count, &untinted);
  return status ? status : measure(size, context, panels, count, true, &untinted);
}

fg_status fg_picture_write(fg_context *context, const char *path, const fg_field *field,
                           const fg_density *density, const fg_icons *icons,
                           const fg_picture_options *options)
{
  const fg_picture_options defaults = {0};
  if (!path || !field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "picture: a NULL argument");
  if (!options)
    options = &defaults;
  const fg_panel panel = {.field = field,
                          .icons = icons,
                          .density = density,
                          .background = options->background,
                          .scale_time = options->scale_time};
  fg_status status = fg__surface_file_format_check(context, path);
  if (!status)
    status = check_panel(context, path, &panel, options);
  return status ? status : write(context, path, &panel, 1, false, options);
}

fg_status fg_panels_write(fg_context *context, const char *path, const fg_panel *panels,
                          int count, const fg_picture_options *options)
{
  const fg_picture_options defaults = {0};
  if (!path)
    return fg__fail(context, FG_STATUS_ARGUMENT, "panels: a NULL argument");
  if (!options)
    options = &defaults;
  fg_status status = fg__surface_file_format_check(context, path);
  if (!status)
    status = check_panels(context, path, panels, count, options);
  return status ? status : write(context, path, panels, count, true, options);
}
