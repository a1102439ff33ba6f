#include "picture/page/draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/caption.h"
#include "picture/page/texture_image.h"
#include "picture/surface/surface.h"

/* A0 paper is 3370 points high; a page six times that is a mistake. */
static const double largest_page = 20000.0;
static const double usual_pixels_per_point = 2.0;

/* Cairo's image surfaces end at 32767 pixels a side; 2^28 pixels take 1 GiB. */
static const double most_pixels_a_side = 32767.0;
static const double most_pixels = 268435456.0;

static const fg__color usual_tint = {0.845, 0.895, 0.950};

/* Of clusters that no arrows shall stand out from. */
static const fg__color lone_tint = {0.56, 0.68, 0.83};

/* A texture as it is outshines what is drawn on it; by eye, on winds and vortices.
 * Stripes are black and white with little between: paler, they are not darker than land.
 */
static const double usual_fade = 0.7, stripes_fade = 0.85;
static const double most_background = 16384.0;

/* Where the frame shows a small part of the domain, the texture of all of it has at most
 * so many pixels for each of the frame, so that it does not cost hundreds of pictures. */
static const double background_beyond = 16.0;

/* Checked so that NaN fails too. */
static bool size_usable(double size)
{
  return size >= 0.0 && size <= largest_page;
}

static fg_status check_options(fg_context *context, const fg_picture_options *options)
{
  if (!size_usable(options->width) || !size_usable(options->height))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: %g x %g points, each must lie between 0 and %g",
                    options->width, options->height, largest_page);
  if (!(options->pixels_per_point >= 0.0) || !isfinite(options->pixels_per_point))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: %g pixels a point, a positive number is needed",
                    options->pixels_per_point);
  if (!(options->font_size >= 0.0) || options->font_size > largest_page)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a font of %g points, it must lie between 0 and %g",
                    options->font_size, largest_page);
  if (!isfinite(options->speed_min) || !isfinite(options->speed_max) ||
      options->speed_max < options->speed_min)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: the colour key cannot run from %g to %g",
                    options->speed_min, options->speed_max);
  if (!(options->background_fade >= 0.0 && options->background_fade <= 1.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a background faded by %g, it must lie between 0 and 1",
                    options->background_fade);
  return FG_STATUS_OK;
}

static void describe_axes(fg__page_plan *plan, const fg_field_arrays *field,
                          const double low[2], const double high[2])
{
  if (field->scale == FG_SCALE_GEO) {
    fg__axis_of_degrees(&plan->axis[0], low[0], high[0], FG__TICKS_LONGITUDE);
    fg__axis_of_degrees(&plan->axis[1], low[1], high[1], FG__TICKS_LATITUDE);
    return;
  }
  bool shared = strcmp(field->axis_units[0], field->axis_units[1]) == 0;
  double larger = fmax(high[0] - low[0], high[1] - low[1]);
  for (int k = 0; k < 2; ++k)
    fg__axis_of_numbers(&plan->axis[k], low[k], high[k],
                        shared ? larger : high[k] - low[k], field->axis_name[k],
                        field->axis_units[k]);
}

/* Lengths in kilometres on the ground, where a map has about one scale; elsewhere no key
 * can tell them. */
static void describe_length(fg__page_plan *plan, const fg__plane *plane)
{
  if (plane->kind == FG__PLANE_NONE)
    return;
  const double kilometres = 1e-3 * fg__plane_true_metres(plane);
  const double extent = kilometres * (plane->high[0] - plane->low[0]);
  plan->size_key = plan->size_key && kilometres > 0.0;
  fg__axis_of_numbers(&plan->length, 0.0, extent, extent, "", "km");
  plan->length.factor *= kilometres;
}

/* Everything that one picture is made from. */
typedef struct picture {
  fg__page_plan plan;
  fg__page page;
  fg__palette palette;
  fg__style style;
  fg__scene scene;
  fg__plane plane; /* of a field on the Earth */
  fg__graticule graticule;
  fg__map_scene map;
  double low[2], high[2]; /* what the frame shows, in the field's coordinates */
  double pixels_per_point;
  bool outline_text;
} picture;

/* A label of one's own still tells what was taken out of the numbers. */
static void label_colors(fg__page_plan *plan, const char *wanted,
                         const char *velocity_units)
{
  fg__tick_axis *speed = &plan->speed;
  char label[FG__CAPTION_BYTES];
  if (!wanted)
    return;
  if (speed->offset != 0.0) {
    fg__text_clean(label, sizeof label, wanted);
    fg__axis_of_numbers(speed, speed->low, speed->high, speed->high - speed->low, label,
                        velocity_units);
    return;
  }
  const fg__caption_value units = {"{units}", speed->units};
  snprintf(label, sizeof label, "%.250s%s", wanted,
           *wanted && speed->factor != 1.0 && !strstr(wanted, units.name) ? " ({units})"
                                                                          : "");
  fg__caption_fill(speed->label, label, &units, 1);
  speed->units[0] = '\0';
}

static fg_status plan_picture(picture *out, fg_context *context, const fg_field *whole,
                              const fg_icons *icons, const fg_picture_options *options)
{
  const fg_field_arrays *field = fg_field_contents(whole);
  double range[2];
  fg__page_plan *plan = &out->plan;
  plan->width = options->width;
  plan->height = options->height;
  plan->font_size = options->font_size;
  plan->no_frame = options->no_frame;
  range[0] = options->speed_min;
  range[1] = options->speed_max;
  bool has_speeds = fg__speed_range(range, icons);
  fg__speeds_beyond(plan->speeds_beyond, icons, range);
  bool keys = !options->no_keys && !options->no_arrows;
  plan->color_key = has_speeds && !out->palette.uniform && keys;
  fg__axis_of_numbers(&plan->speed, range[0], range[1], range[1] - range[0], "mean speed",
                      field->velocity_units);
  label_colors(plan, options->label, field->velocity_units);
  if (options->no_frame)
    fg__scene_box(out->low, out->high, field);
  else
    fg__scene_shown(out->low, out->high, whole);
  fg_status status = fg__plane_create(&out->plane, context, whole, out->low, out->high);
  if (!status && out->plane.kind != FG__PLANE_NONE)
    status = fg__graticule_create(&out->graticule, context, &out->plane);
  if (status)
    return status;
  plan->graticule = out->graticule.plane ? &out->graticule : NULL;
  plan->outlined = out->plane.whole;
  describe_axes(plan, field, out->low, out->high);
  const char *const wanted[2] = {options->title, options->subtitle};
  fg__caption_write(plan->title, plan->subtitle, field, options->no_arrows ? NULL : icons,
                    wanted, options->scale_time);
  fg__typical_icon typical;
  status = fg__scene_typical_icon(&typical, context, icons);
  if (status)
    return status;
  plan->size_key = typical.length > 0.0 && keys;
  plan->arrow_length = typical.length;
  describe_length(plan, &out->plane);
  return FG_STATUS_OK;
}

static fg_status lay_out(picture *out, fg_context *context)
{
  cairo_t *ruler = fg__text_ruler();
  fg__page_layout(&out->page, &out->plan, ruler);
  cairo_status_t trouble = cairo_status(ruler);
  cairo_destroy(ruler);
  if (trouble == CAIRO_STATUS_NO_MEMORY)
    return fg__fail_memory(context, "a page's layout", sizeof out->page);
  if (trouble)
    return fg__fail(context, FG_STATUS_UNSUPPORTED, "picture: no text can be drawn: %s",
                    cairo_status_to_string(trouble));
  if (!(out->page.width <= largest_page && out->page.height <= largest_page))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: the domain's shape needs a page of %g x %g points, at most "
                    "%g are drawn",
                    out->page.width, out->page.height, largest_page);
  return FG_STATUS_OK;
}

static fg_status check_pixels(fg_context *context, const picture *p)
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

static fg_status render(fg_context *context, const char *path, const picture *p)
{
  const fg__page *page = &p->page;
  fg__surface_file surface;
  fg_status status =
      fg__surface_file_open(&surface, context, path, page->width, page->height,
                            p->pixels_per_point, p->plan.title);
  if (status)
    return status;
  fg__draw(surface.cairo, page, &p->scene, &p->palette, &p->style);
  fg__draw_texts(&surface, page, p->outline_text);
  return fg__surface_file_close(&surface, context, FG_STATUS_OK);
}

/* Where the page has, or would have, the whole domain. */
static fg__page_box domain_box(const picture *p, const fg_field_arrays *field)
{
  double low[2], high[2];
  const fg__page *page = &p->page;
  fg__scene_box(low, high, field);
  return (fg__page_box){page->frame.x0 + page->scale * (low[0] - p->low[0]),
                        page->frame.y1 - page->scale * (high[1] - p->low[1]),
                        page->frame.x0 + page->scale * (high[0] - p->low[0]),
                        page->frame.y1 - page->scale * (low[1] - p->low[1])};
}

static fg_status prepare(picture *p, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_picture_options *options)
{
  fg_status status = check_options(context, options);
  if (!status)
    status = fg__palette_create(&p->palette, context, options->palette);
  if (!status)
    status =
        fg__color_choose(&p->style.mask, context, options->mask_color, fg__usual_mask);
  if (!status)
    status = fg__color_choose(&p->style.tint, context, options->tint_color,
                              options->no_arrows ? lone_tint : usual_tint);
  if (!status)
    status = fg__color_choose(&p->style.map_style.land, context, options->land,
                              fg__usual_land);
  if (!status)
    status = fg__color_choose(&p->style.map_style.missing, context, options->mask_color,
                              fg__usual_missing);
  p->style.transparent = p->style.map_style.transparent = options->transparent;
  p->outline_text = options->outline_text;
  p->pixels_per_point = options->pixels_per_point > 0.0 ? options->pixels_per_point
                                                        : usual_pixels_per_point;
  if (!status)
    status = plan_picture(p, context, field, icons, options);
  if (!status)
    status = lay_out(p, context);
  if (!status)
    p->style.background_box = domain_box(p, fg_field_contents(field));
  return status;
}

/* Fontconfig crashes where memory runs out while it loads fonts, which with cairo took 40
 * MB of address space. So there must be more than that before it begins. */
enum { ROOM_BYTES = 48 << 20 };

static fg_status check_room(fg_context *context)
{
  void *room = fg__allocate(ROOM_BYTES, 1); /* never touched */
  if (!room)
    return fg__fail_memory(context, "a picture", ROOM_BYTES);
  free(room);
  return FG_STATUS_OK;
}

static fg_status make_background(picture *p, fg_context *context,
                                 const fg_picture_options *options)
{
  const fg_texture_arrays *texture = fg_texture_contents(options->background);
  fg_texture_style style = {.fade = options->background_fade};
  if (!(style.fade > 0.0))
    style.fade = texture->kind == FG_TEXTURE_STRIPES ? stripes_fade : usual_fade;
  return fg__texture_image(&p->style.background, context, texture, &style);
}

/* Coasts and the other lines of a map, once it is known where arrows lie. */
static fg_status make_map(picture *p, fg_context *context, const fg_field *field,
                          const fg_picture_options *options)
{
  if (p->plane.kind == FG__PLANE_NONE)
    return FG_STATUS_OK;
  const fg__map_wishes wishes = {.no_coast = options->no_coast,
                                 .borders = options->borders,
                                 .no_graticule = options->no_frame};
  fg_status status =
      fg__map_scene_create(&p->map, context, &p->page, &p->graticule, field, &wishes);
  if (status)
    return status;
  status = fg__map_scene_rim(&p->map, context, &p->scene.arrows);
  if (status)
    return status;
  p->style.map = &p->map;
  p->style.map_style.on_texture = options->background != NULL;
  if (options->no_frame)
    return FG_STATUS_OK;
  cairo_t *ruler = fg__text_ruler();
  fg__map_scene_label(&p->map, &p->page, &p->graticule, &p->scene.arrows, ruler);
  cairo_destroy(ruler);
  return FG_STATUS_OK;
}

static void end(picture *p)
{
  cairo_surface_destroy(p->style.background);
  fg__scene_clear(&p->scene);
  fg__map_scene_clear(&p->map);
  fg__graticule_clear(&p->graticule);
  fg__plane_clear(&p->plane);
  free(p);
}

static int pixels_of(double length)
{
  return (int)fmin(fmax(floor(length + 0.5), 1.0), most_background);
}

fg_status fg_picture_frame(int size[2], fg_context *context, const fg_field *field,
                           const fg_icons *icons, const fg_picture_options *options)
{
  if (!size || !field || !icons || fg_field_contents(field)->dimension != 2)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a NULL argument, or a field in 3 dimensions");
  const fg_picture_options usual = {0};
  picture *p = fg__allocate(1, sizeof *p);
  if (!p)
    return fg__fail_memory(context, "a picture", sizeof *p);
  fg_status status = check_room(context);
  if (!status)
    status = prepare(p, context, field, icons, options ? options : &usual);
  if (!status) {
    const fg__page_box *box = &p->style.background_box, *frame = &p->page.frame;
    double wide = box->x1 - box->x0, high = box->y1 - box->y0;
    double most = background_beyond * (frame->x1 - frame->x0) * (frame->y1 - frame->y0);
    double pixels = p->pixels_per_point * fmin(sqrt(most / (wide * high)), 1.0);
    size[0] = pixels_of(pixels * wide);
    size[1] = pixels_of(pixels * high);
  }
  end(p);
  return status;
}

fg_status fg_picture_write(fg_context *context, const char *path, const fg_field *field,
                           const fg_density *density, const fg_icons *icons,
                           const fg_picture_options *options)
{
  if (!path || !field || !icons)
    return fg__fail(context, FG_STATUS_ARGUMENT, "picture: a NULL argument");
  fg_picture_options settled = {0};
  if (options)
    settled = *options;
  if (density && settled.scale_time == 0.0)
    settled.scale_time = fg_density_contents(density)->time;
  options = &settled;
  fg_status status = fg__surface_file_format_check(context, path);
  if (status)
    return status;
  if (options->tint && !density)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a tint of the clusters needs their density");
  const fg_field_arrays *contents = fg_field_contents(field);
  if (contents->dimension != 2 ||
      (density && fg_density_contents(density)->dimension != 2))
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "%s: this version draws no fields in 3 dimensions", path);
  picture *p = fg__allocate(1, sizeof *p);
  if (!p)
    return fg__fail_memory(context, "a picture", sizeof *p);
  status = check_room(context);
  if (!status)
    status = prepare(p, context, field, icons, options);
  if (!status && fg__surface_file_format_of(path) == FG__SURFACE_PNG)
    status = check_pixels(context, p);
  const double range[2] = {p->plan.speed.low, p->plan.speed.high};
  if (!status)
    status = fg__scene_create(&p->scene, context, &p->page, field, p->low, p->high,
                              options->tint ? fg_density_contents(density) : NULL,
                              options->no_arrows ? NULL : icons, &p->palette, range);
  if (!status && (options->skeletons || options->centers))
    status = fg__scene_add_skeletons(&p->scene, context, &p->page, contents, p->low,
                                     p->high, icons, options->skeletons);
  if (!status)
    status = make_map(p, context, field, options);
  if (!status && options->background)
    status = make_background(p, context, options);
  if (!status)
    status = fg__check_stop(context);
  if (!status)
    status = render(context, path, p);
  end(p);
  return status;
}
