#include "picture/render/solid_picture.h"

#include <cairo.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/memory.h"
#include "picture/caption.h"
#include "picture/page/text.h"
#include "picture/render/box_axes.h"
#include "picture/render/render.h"
#include "picture/silhouette.h"
#include "picture/surface/surface.h"

enum { USUAL_SIZE = 1200, LEAST_SIZE = 64, LARGEST_SIZE = 8192 };

/* As pictures in 2D have it: 1200 pixels are 480 points. */
static const double pixels_per_point = 2.5;

/* The font size in sides of the picture, and the least, pixels. */
static const double font_share = 1.0 / 58.0, least_font = 9.0;

/* Room round the box for what is written, in font sizes. */
static const double left_room = 4.2, right_room = 2.6, key_room = 6.0, bottom_room = 4.2,
                    top_room = 1.5, line_height = 1.3, edge = 1.2;

/* The white round each arrow, of the picture's larger side. */
static const double halo_share = 0.0021;

/* The least length of a head, likewise. */
static const double head_share = 0.0135;

/* The height is at least this share of the width, unless it is given. */
static const double flattest = 0.5;

/* The colour bar is this much of the picture high. */
static const double bar_share = 0.34;

typedef struct solid_picture {
  fg__rendering rendering;
  fg__palette palette;
  fg__tick_axis speed;
  fg__box_axes axes;
  fg_surface *silhouette;
  double azimuth, elevation;
  double em;
  bool framed, has_key;
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
} solid_picture;

static fg_status check_options(fg_context *context, const fg_solid_options *options)
{
  int wide = options->width ? options->width : USUAL_SIZE;
  int high = options->height ? options->height : wide;
  if (wide < LEAST_SIZE || wide > LARGEST_SIZE || high < LEAST_SIZE ||
      high > LARGEST_SIZE)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: %d x %d pixels, each must lie between %d and %d", wide,
                    high, LEAST_SIZE, LARGEST_SIZE);
  if (!(fabs(options->azimuth) <= 3600.0) || !(fabs(options->elevation) <= 90.0))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a view from azimuth %g, elevation %g degrees; the second "
                    "must lie between -90 and 90",
                    options->azimuth, options->elevation);
  if (!isfinite(options->speed_min) || !isfinite(options->speed_max) ||
      options->speed_max < options->speed_min)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: the colour key cannot run from %g to %g",
                    options->speed_min, options->speed_max);
  return FG_STATUS_OK;
}

static void settle_threads(fg__rendering *out, int threads)
{
  long cores = threads > 0 ? threads : sysconf(_SC_NPROCESSORS_ONLN);
  out->threads = cores > 1 ? (int)cores : 1;
}

/* Where the box goes: the rest of the picture. */
static fg__pane box_pane(const solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  double em = p->em, rows = (p->title[0] != 0) + (p->subtitle[0] != 0);
  if (!p->framed)
    return (fg__pane){edge * em, edge * em, r->width - edge * em, r->height - edge * em};
  return (fg__pane){left_room * em, (top_room + rows * line_height) * em,
                    r->width - (p->has_key ? right_room + key_room : right_room) * em,
                    r->height - bottom_room * em};
}

/* The box's highest corner and its lowest, pixels from above. */
static void box_rows(const fg__rendering *r, double *highest, double *lowest)
{
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (int c = 0; c < 8; ++c) {
    double corner[3], at[2];
    for (int k = 0; k < 3; ++k)
      corner[k] = c >> k & 1 ? r->view_box.half[k] : -r->view_box.half[k];
    fg__camera_project(&r->camera, corner, at);
    low = fmin(low, at[1]);
    high = fmax(high, at[1]);
  }
  *highest = low;
  *lowest = high;
}

/* Of a height that is not given, no more below the box than its numbers need. */
static void trim(solid_picture *p, cairo_t *ruler)
{
  fg__rendering *r = &p->rendering;
  double highest, lowest, least = flattest * r->width;
  box_rows(r, &highest, &lowest);
  lowest = fmax(lowest, fg__box_axes_place(&p->axes, &r->view_box, &r->camera, ruler));
  r->height = (int)fmin(r->height, fmax(ceil(lowest + edge * p->em), least));
}

static void lay_out(solid_picture *p, const fg_field_arrays *field,
                    const fg_solid_options *options)
{
  fg__rendering *r = &p->rendering;
  fg__pane pane = box_pane(p);
  double azimuth = p->azimuth, elevation = p->elevation;
  fg__view_box_of(&r->view_box, field);
  fg__camera_look(&r->camera, &r->view_box, azimuth, elevation, &pane);
  if (options->height == 0) { /* no more of it than a flat box needs */
    double highest, lowest;
    box_rows(r, &highest, &lowest);
    double unused = pane.y1 - pane.y0 - (lowest - highest);
    r->height -= (int)fmin(unused, (1.0 - flattest) * r->width);
    pane = box_pane(p);
    fg__camera_look(&r->camera, &r->view_box, azimuth, elevation, &pane);
  }
  cairo_t *ruler = fg__text_ruler();
  fg__box_axes_of(&p->axes, field, &r->view_box, &r->camera, p->em, ruler);
  if (options->height == 0 && p->framed)
    trim(p, ruler);
  cairo_destroy(ruler);
}

/* What is made of the field: the view, the colours' ends and the outline. */
static fg_status explore(solid_picture *p, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_solid_options *options)
{
  fg__rendering *r = &p->rendering;
  fg_status status = FG_STATUS_OK;
  p->azimuth = options->azimuth;
  p->elevation = options->elevation;
  if (!options->has_view)
    status = fg_solid_best_view(&p->azimuth, &p->elevation, context, field, icons);
  r->range[0] = options->speed_min;
  r->range[1] = options->speed_max;
  if (!status && !(r->range[1] > r->range[0]))
    status = fg_solid_speed_range(r->range, context, field, icons);
  if (!status)
    status = fg__silhouette_create(&p->silhouette, context, field);
  r->silhouette = p->silhouette;
  return status;
}

static fg_status prepare(solid_picture *p, fg_context *context, const fg_field *field,
                         const fg_icons *icons, const fg_solid_options *options)
{
  const fg_field_arrays *about = fg_field_contents(field);
  fg__rendering *r = &p->rendering;
  fg_status status = check_options(context, options);
  if (!status)
    status = fg__palette_create(&p->palette, context, options->palette);
  if (!status)
    status = explore(p, context, field, icons, options);
  if (status)
    return status;
  r->width = options->width ? options->width : USUAL_SIZE;
  r->height = options->height ? options->height : r->width;
  r->halo = halo_share * fmax(r->width, r->height);
  r->least_head = head_share * fmax(r->width, r->height);
  r->icons = icons;
  r->field = field;
  r->surface = options->surface;
  r->palette = &p->palette;
  bool has_speeds = fg__speed_range(r->range, icons);
  p->framed = r->walls = !options->no_frame;
  p->has_key = p->framed && has_speeds && !p->palette.uniform;
  r->transparent = options->transparent;
  settle_threads(r, options->threads);
  p->em = fmax(font_share * fmin(r->width, r->height), least_font);
  fg__axis_of_numbers(&p->speed, r->range[0], r->range[1], r->range[1] - r->range[0],
                      "speed", about->velocity_units);
  const char *const wanted[2] = {options->title, NULL};
  if (p->framed)
    fg__caption_write(p->title, p->subtitle, about, icons, wanted, options->scale_time);
  lay_out(p, about, options);
  return FG_STATUS_OK;
}

static void draw_line_of_text(cairo_t *cairo, char *text, double em, double width,
                              bool bold, double *y)
{
  if (!text[0])
    return;
  *y += line_height * em;
  fg__text_shorten(cairo, text, FG__CAPTION_BYTES, em, bold, width);
  cairo_move_to(cairo, edge * em, *y);
  fg__text_draw(cairo, text, em, bold);
}

/* The colour bar, where there is one. */
static void draw_key(cairo_t *cairo, solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  if (!p->has_key)
    return;
  double em = p->em, high = bar_share * r->height, middle = 0.5 * r->height;
  fg__pane pane = {r->width - key_room * em, middle - high / 2.0, r->width - edge * em,
                   middle + high / 2.0};
  bool beyond[2];
  fg__speeds_beyond(beyond, r->icons, r->range);
  fg__color_bar_draw(cairo, &pane, em, &p->palette, &p->speed, beyond);
  p->axes.kept = fg__color_bar_box(&pane, em, &p->speed, beyond, cairo);
}

static void draw_words(cairo_t *cairo, solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  double em = p->em, y = 0.4 * em, width = r->width - 2.0 * edge * em;
  draw_key(cairo, p);
  fg__box_axes_place(&p->axes, &r->view_box, &r->camera, cairo);
  fg__box_axes_draw(cairo, &p->axes, &r->view_box, &r->camera);
  cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
  draw_line_of_text(cairo, p->title, em, width, true, &y);
  cairo_set_source_rgb(cairo, 0.4, 0.4, 0.4);
  draw_line_of_text(cairo, p->subtitle, em, width, false, &y);
}

/* Renders the arrows to an image; it is to be destroyed. */
static fg_status render(cairo_surface_t **out, fg_context *context, solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  *out = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, r->width, r->height);
  if (cairo_surface_status(*out))
    return fg__fail_memory(context, "a picture", (size_t)r->width * (size_t)r->height);
  cairo_surface_flush(*out);
  unsigned char *bytes = cairo_image_surface_get_data(*out);
  int stride = cairo_image_surface_get_stride(*out) / (int)sizeof(uint32_t);
  fg_status status = fg__render(context, r, (uint32_t *)(void *)bytes, stride);
  cairo_surface_mark_dirty(*out);
  return status;
}

static fg_status draw(fg_context *context, const char *path, solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  cairo_surface_t *image;
  fg__surface_file surface;
  fg_status status = render(&image, context, p);
  if (!status)
    status =
        fg__surface_file_open(&surface, context, path, r->width / pixels_per_point,
                              r->height / pixels_per_point, pixels_per_point, p->title);
  if (!status) {
    cairo_scale(surface.cairo, 1.0 / pixels_per_point, 1.0 / pixels_per_point);
    cairo_set_source_surface(surface.cairo, image, 0.0, 0.0);
    cairo_paint(surface.cairo);
    if (p->framed)
      draw_words(surface.cairo, p);
    status = fg__surface_file_close(&surface, context, FG_STATUS_OK);
  }
  cairo_surface_destroy(image);
  return status;
}

fg_status fg__solid_picture_write(fg_context *context, const char *path,
                                  const fg_field *field, const fg_icons *icons,
                                  const fg_solid_options *options)
{
  const fg_field_arrays *contents = fg_field_contents(field);
  fg_status status = fg__surface_file_format_check(context, path);
  if (status)
    return status;
  if (contents->dimension != 3)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "%s: a picture of solids of a field in %d dimensions", path,
                    contents->dimension);
  solid_picture *p = fg__allocate(1, sizeof *p);
  if (!p)
    return fg__fail_memory(context, "a picture", sizeof *p);
  status = prepare(p, context, field, icons, options);
  if (!status)
    status = draw(context, path, p);
  fg_surface_destroy(p->silhouette);
  free(p);
  return status;
}
