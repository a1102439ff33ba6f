#include "picture/render/solid_picture.h"

#include <cairo.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/threads.h"
#include "picture/caption.h"
#include "picture/page/text.h"
#include "picture/render/box_axes.h"
#include "picture/render/render.h"
#include "picture/silhouette.h"
#include "picture/surface/surface.h"

enum { LEAST_SIZE = 64, LARGEST_SIZE = 8192 };

/* As pictures in 2D have it: 1200 pixels are 480 points. */
static const double usual_pixels_per_point = 2.5, usual_points = 480.0;

/* Points, as in pictures in 2D: 9 at the usual width, growing with the root of the
 * shorter side, and 7 at least, which can be read in print. It is no larger than this
 * share of that side, but for `least_pixels`. */
static const double usual_font = 9.0, smallest_font = 7.0;
static const double largest_font_share = 1.0 / 18.0, least_pixels = 9.0;

/* In font sizes: round all, between the caption, the box with its numbers and the key,
 * and from line to line. */
static const double edge = 1.2, gap = 1.6, line_height = 1.3;

/* Lines of the key's label are no wider than this, in font sizes, and not much wider than
 * this share of the picture. */
static const double widest_label = 14.0, narrowest_label = 6.0, label_share = 0.2;

/* What is written takes at most this share of what the caption and the key leave. */
static const double most_written = 0.7;

/* The box has at least this share of what is left, along one side; else axes have no
 * numbers. */
static const double least_box = 0.4;

/* The white round each arrow, of the picture's larger side. */
static const double halo_share = 0.0021;

/* The least length of a head, likewise. */
static const double head_share = 0.0135;

/* The shorter side is at least this share of the longer one, unless it is given. */
static const double flattest = 0.5;

/* Of the caption's lines. */
static const double title_grey = 0.1, subtitle_grey = 0.4;

/* The colour bar is this much of the picture high. */
static const double bar_share = 0.34;

/* What is written at the axes: numbers and names, of one that is too short for numbers
 * its name alone; the same of one that was once too short, where numbers come and go with
 * the box's size; names alone. */
typedef enum detail_of_axes { NUMBERS = 0, SETTLED, NAMES } detail_of_axes;

typedef struct solid_picture {
  fg__rendering rendering;
  fg__palette palette;
  fg__tick_axis speed;
  fg__box_axes axes;
  fg_surface *silhouette;
  double azimuth, elevation;
  double em;
  double pixels_per_point;
  bool framed, has_key, outline_text;
  char title[FG__CAPTION_BYTES], subtitle[FG__CAPTION_BYTES];
  fg__caption_lines caption;
  fg__bar_label label;
} solid_picture;

static double pixels_per_point(const fg_solid_options *options)
{
  return options->pixels_per_point > 0.0 ? options->pixels_per_point
                                         : usual_pixels_per_point;
}

static int width_of(const fg_solid_options *options)
{
  const double pixels = usual_points * pixels_per_point(options);
  return options->width ? options->width : (int)fmin(pixels, 1e9);
}

static fg_status check_options(fg_context *context, const fg_solid_options *options)
{
  int wide = width_of(options);
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
  return fg__surface_options_check(context, options->pixels_per_point, options->font_size,
                                   options->speed_min, options->speed_max);
}

/* Pixels. */
static double font_size_of(const fg__rendering *r, double pixels_per_point)
{
  const double side = fmin(r->width, r->height), points = side / pixels_per_point;
  const double wanted = fmax(usual_font * sqrt(points / usual_points), smallest_font);
  return fmax(fmin(wanted * pixels_per_point, largest_font_share * side), least_pixels);
}

static void settle_threads(fg__rendering *out, int threads)
{
  out->threads = threads > 0 ? threads : fg__threads_available();
}

/* How low the caption reaches, with some room below it. */
static double caption_end(const solid_picture *p)
{
  return (p->caption.count ? p->caption.count * line_height + gap : edge) * p->em;
}

/* The bar of the colour key: half way up, or just below the caption. */
static fg__pane key_pane(const solid_picture *p, cairo_t *ruler)
{
  const fg__rendering *r = &p->rendering;
  const double high = bar_share * r->height;
  const double lowest =
      caption_end(p) + fg__color_bar_rise(p->em, &p->label) + high / 2.0;
  const double middle = fmax(0.5 * r->height, lowest);
  const double wide = fg__color_bar_width(high, p->em, &p->speed, &p->label, ruler);
  return (fg__pane){r->width - edge * p->em - wide, middle - high / 2.0,
                    r->width - edge * p->em, middle + high / 2.0};
}

/* The height of the picture where the key just fits below the caption. */
static double least_key_height(const solid_picture *p)
{
  return (caption_end(p) + fg__color_bar_rise(p->em, &p->label) + edge * p->em) /
         (1.0 - bar_share);
}

/* What is left for the box and its numbers. */
static fg__pane room_of(const solid_picture *p, cairo_t *ruler)
{
  const fg__rendering *r = &p->rendering;
  const double em = p->em;
  return (fg__pane){edge * em, caption_end(p),
                    p->has_key ? key_pane(p, ruler).x0 - gap * em : r->width - edge * em,
                    r->height - edge * em};
}

/* What the box takes of the picture. */
static fg__pane box_bounds(const fg__rendering *r)
{
  fg__pane out = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (int c = 0; c < 8; ++c) {
    double corner[3], at[2];
    for (int k = 0; k < 3; ++k)
      corner[k] = c >> k & 1 ? r->view_box.half[k] : -r->view_box.half[k];
    fg__camera_project(&r->camera, corner, at);
    out = (fg__pane){fmin(out.x0, at[0]), fmin(out.y0, at[1]), fmax(out.x1, at[0]),
                     fmax(out.y1, at[1])};
  }
  return out;
}

/* Takes room off either end, in proportion where there is too little. */
static void shrink(double *low, double *high, double below, double above)
{
  const double whole = *high - *low, most = most_written * whole;
  const double share = below + above > most ? most / (below + above) : 1.0;
  *low += share * below;
  *high -= share * above;
}

/* Whether a view of the box may stay: what is written round it lies in the room, or not
 * far beyond, and leaves it a fair share. */
static bool is_fair(const fg__pane *all, const fg__pane *box, const fg__pane *room,
                    double em)
{
  const double slack = edge / 2.0 * em;
  return all->x0 > room->x0 - slack && all->x1 < room->x1 + slack &&
         all->y0 > room->y0 - slack && all->y1 < room->y1 + slack &&
         (box->x1 - box->x0 > least_box * (room->x1 - room->x0) ||
          box->y1 - box->y0 > least_box * (room->y1 - room->y0));
}

/* Takes the numbers off the axes that are too short for them, and off those that `bare`
 * has and `keeps`. Returns whether it has more than before. */
static bool strip(solid_picture *p, const fg_field_arrays *field, bool bare[3],
                  bool keeps)
{
  bool more = false;
  for (int k = 0; k < 3; ++k) {
    const bool is_short = !p->axes.edge[k][k];
    more = more || (is_short && !bare[k]);
    bare[k] = is_short || (keeps && bare[k]);
    if (bare[k])
      fg__box_axes_bare(&p->axes, field, k);
  }
  return more;
}

/* Looks at the box so that it and what is written round it fill the room; *all becomes
 * what they take. Returns whether that may stay. */
static bool look(solid_picture *p, fg__pane *all, const fg_field_arrays *field,
                 detail_of_axes detail, cairo_t *ruler)
{
  enum { TURNS = 3 }; /* numbers change a little with the box's size */
  fg__rendering *r = &p->rendering;
  const fg__pane room = room_of(p, ruler);
  const bool named = detail == NAMES;
  fg__pane box, written = {0}; /* written: how far it reaches out of the box */
  bool bare[3] = {named, named, named};
  for (int turn = 0; turn < (detail == NUMBERS ? TURNS : 3 * TURNS); ++turn) {
    fg__pane pane = room, least = {0};
    if (detail != NUMBERS)
      least = written;
    shrink(&pane.x0, &pane.x1, written.x0, written.x1);
    shrink(&pane.y0, &pane.y1, written.y0, written.y1);
    fg__camera_look(&r->camera, &r->view_box, p->azimuth, p->elevation, &pane);
    *all = box = box_bounds(r);
    fg__box_axes_of(&p->axes, field, &r->view_box, &r->camera, p->em, ruler);
    if (strip(p, field, bare, detail != NUMBERS))
      least = (fg__pane){0};
    if (p->framed)
      fg__box_axes_place(&p->axes, all, &r->view_box, &r->camera, ruler);
    written =
        (fg__pane){fmax(box.x0 - all->x0, least.x0), fmax(box.y0 - all->y0, least.y0),
                   fmax(all->x1 - box.x1, least.x1), fmax(all->y1 - box.y1, least.y1)};
  }
  return is_fair(all, &box, &room, p->em);
}

/* Returns what the box and what is written round it take. */
static fg__pane fit(solid_picture *p, const fg_field_arrays *field, cairo_t *ruler)
{
  fg__pane all;
  int detail = NUMBERS;
  while (!look(p, &all, field, (detail_of_axes)detail, ruler) && detail < NAMES)
    ++detail;
  return all;
}

/* Breaks what is written into lines that fit the picture. */
static void break_texts(solid_picture *p, cairo_t *ruler)
{
  const double em = p->em, width = p->rendering.width - 2.0 * edge * em;
  const double share = fmax(label_share * p->rendering.width, narrowest_label * em);
  fg__caption_break(&p->caption, ruler, p->title, p->subtitle, em, em, width);
  p->label.size =
      fg__page_fit_lines(p->label.line, FG__LABEL_LINES, &p->label.count, ruler,
                         p->speed.label, em, false, fmin(share, widest_label * em));
}

/* The width that the caption needs. */
static double caption_width(const solid_picture *p, cairo_t *ruler)
{
  const fg__caption_lines *lines = &p->caption;
  double widest = 0.0;
  for (int n = 0; n < lines->count; ++n) {
    const bool bold = n < lines->titles;
    widest = fmax(widest, fg__text_width(ruler, lines->line[n],
                                         bold ? lines->title_size : lines->size, bold));
  }
  return widest + 2.0 * edge * p->em;
}

/* Sides that are not given are no longer than the box needs. */
static void trim(solid_picture *p, const fg__pane *used, const fg_solid_options *options,
                 cairo_t *ruler)
{
  fg__rendering *r = &p->rendering;
  const fg__pane room = room_of(p, ruler);
  const double spare[2] = {room.x1 - room.x0 - (used->x1 - used->x0),
                           room.y1 - room.y0 - (used->y1 - used->y0)};
  const double size[2] = {r->width, r->height};
  double least[2] = {fmax(flattest * size[1], caption_width(p, ruler)),
                     fmax(flattest * size[0], p->has_key ? least_key_height(p) : 0.0)};
  for (int k = 0; k < 2; ++k)
    least[k] = fmax(ceil(size[k] - spare[k]), ceil(least[k]));
  if (options->width == 0)
    r->width = (int)fmin(r->width, least[0]);
  if (options->height == 0)
    r->height = (int)fmin(r->height, least[1]);
}

/* In a small picture the key would reach below it. */
static bool has_room_for_key(const solid_picture *p, cairo_t *ruler)
{
  return key_pane(p, ruler).y1 <= p->rendering.height - edge * p->em;
}

static void lay_out(solid_picture *p, const fg_field_arrays *field,
                    const fg_solid_options *options)
{
  cairo_t *ruler = fg__text_ruler();
  break_texts(p, ruler);
  fg__view_box_of(&p->rendering.view_box, field);
  p->has_key = p->has_key && has_room_for_key(p, ruler);
  const fg__pane used = fit(p, field, ruler);
  trim(p, &used, options, ruler);
  p->has_key = p->has_key && has_room_for_key(p, ruler);
  fit(p, field, ruler);
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
  r->width = width_of(options);
  r->height = options->height ? options->height : r->width;
  r->halo = halo_share * fmax(r->width, r->height);
  r->least_head = head_share * fmax(r->width, r->height);
  r->icons = icons;
  r->field = field;
  r->surface = options->surface;
  r->palette = &p->palette;
  bool has_speeds = fg__speed_range(r->range, icons);
  p->pixels_per_point = pixels_per_point(options);
  p->outline_text = options->outline_text;
  p->framed = r->walls = !options->no_frame;
  p->has_key = p->framed && has_speeds && !p->palette.uniform && !options->no_keys;
  r->transparent = options->transparent;
  settle_threads(r, options->threads);
  p->em = options->font_size > 0.0 ? options->font_size * p->pixels_per_point
                                   : font_size_of(r, p->pixels_per_point);
  fg__axis_of_numbers(&p->speed, r->range[0], r->range[1], r->range[1] - r->range[0],
                      "speed", about->velocity_units);
  fg__caption_label_speeds(&p->speed, options->label, about->velocity_units);
  const char *const wanted[2] = {options->title, options->subtitle};
  if (p->framed)
    fg__caption_write(p->title, p->subtitle, about, icons, wanted, options->scale_time);
  lay_out(p, about, options);
  return FG_STATUS_OK;
}

static void draw_caption(fg__surface_file *surface, const solid_picture *p)
{
  double y = 0.4 * p->em;
  const fg__caption_lines *lines = &p->caption;
  for (int n = 0; n < lines->count; ++n) {
    const bool bold = n < lines->titles;
    const fg__writer writer = {surface, bold ? lines->title_size : lines->size,
                               p->outline_text};
    y += line_height * p->em;
    fg__write_text(&writer, lines->line[n], (const double[2]){edge * p->em, y}, bold,
                   bold ? title_grey : subtitle_grey, FG__ALIGN_START);
  }
}

static void draw_words(fg__surface_file *surface, const solid_picture *p)
{
  const fg__rendering *r = &p->rendering;
  const fg__writer writer = {surface, p->em, p->outline_text};
  if (p->has_key) {
    const fg__pane pane = key_pane(p, surface->cairo);
    bool beyond[2];
    fg__speeds_beyond(beyond, r->icons, r->range);
    fg__color_bar_draw(&writer, &pane, &p->palette, &p->speed, &p->label, beyond);
  }
  fg__box_axes_draw(&writer, &p->axes, &r->view_box, &r->camera);
  draw_caption(surface, p);
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
  const double pixels = p->pixels_per_point;
  cairo_surface_t *image;
  fg__surface_file surface;
  fg_status status = render(&image, context, p);
  if (!status)
    status = fg__surface_file_open(&surface, context, path, r->width / pixels,
                                   r->height / pixels, pixels, p->title);
  if (!status) {
    cairo_scale(surface.cairo, 1.0 / pixels, 1.0 / pixels);
    cairo_set_source_surface(surface.cairo, image, 0.0, 0.0);
    cairo_paint(surface.cairo);
    if (p->framed)
      draw_words(&surface, p);
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
