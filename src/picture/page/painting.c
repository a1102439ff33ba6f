#include <math.h>
#include <stdio.h>

#include "brush/canvas.h"
#include "picture/page/bristles.h"
#include "picture/surface/surface.h"

static const double default_pixels_per_point = 2.0;
/* 2^28 pixels take 1 GiB. */
static const double most_pixels = 268435456.0;

typedef struct painting {
  const fg_image_arrays *image;
  const fg_strokes *strokes;
  double points_per_pixel;
  bool ground;
} painting;

static void paint_strokes(const painting *p, fg__polygon_sink *sink, void *closure)
{
  const double width = p->image->width, height = p->image->height;
  const double canvas[4][2] = {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
  double mean[3];
  fg__image_mean(mean, p->image);
  if (p->ground)
    sink(closure, canvas, 4, mean, 1.0);
  for (int n = 0; n < fg_strokes_count(p->strokes); ++n)
    fg__stroke_paint(fg_strokes_at(p->strokes, n), sink, closure);
}

static void fill_polygon(void *closure, const double (*point)[2], int count,
                         const double color[3], double opacity)
{
  cairo_t *cairo = closure;
  for (int n = 0; n < count; ++n)
    cairo_line_to(cairo, point[n][0], point[n][1]);
  cairo_close_path(cairo);
  cairo_set_source_rgba(cairo, color[0], color[1], color[2], opacity);
  cairo_fill(cairo);
}

static void paint(cairo_t *cairo, const painting *p)
{
  cairo_scale(cairo, p->points_per_pixel, p->points_per_pixel);
  cairo_rectangle(cairo, 0.0, 0.0, p->image->width, p->image->height);
  cairo_clip(cairo);
  paint_strokes(p, fill_polygon, cairo);
}

/* Cairo's own SVG would be four times as long: here coordinates are whole numbers of a
 * twentieth of a pixel, from point to point. */
enum { SVG_UNITS = 20 };

static void print_polygon(void *closure, const double (*point)[2], int count,
                          const double color[3], double opacity)
{
  FILE *stream = closure;
  long x = 0, y = 0;
  bool lines = false; /* have begun */
  fprintf(stream, "<path fill=\"#%02x%02x%02x\"", (unsigned)(color[0] * 255.0 + 0.5),
          (unsigned)(color[1] * 255.0 + 0.5), (unsigned)(color[2] * 255.0 + 0.5));
  if (opacity < 1.0)
    fprintf(stream, " fill-opacity=\"%.2f\"", opacity);
  fputs(" d=\"", stream);
  for (int n = 0; n < count; ++n) {
    long to_x = lround(point[n][0] * SVG_UNITS), to_y = lround(point[n][1] * SVG_UNITS);
    if (n > 0 && to_x == x && to_y == y)
      continue;
    fprintf(stream, "%s%ld %ld", n == 0 ? "m" : lines ? " " : "l", to_x - x, to_y - y);
    lines = n > 0;
    x = to_x;
    y = to_y;
  }
  fputs("z\"/>\n", stream);
}

static fg_status write_svg(fg_context *context, const char *path, const painting *p,
                           double width, double height)
{
  fg__whole_file file;
  fg_status status = fg__whole_file_open(&file, context, path);
  if (status)
    return status;
  fprintf(file.stream,
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%gpt\" height=\"%gpt\" "
          "viewBox=\"0 0 %d %d\">\n<g transform=\"scale(%g)\">\n",
          width, height, p->image->width, p->image->height, 1.0 / SVG_UNITS);
  paint_strokes(p, print_polygon, file.stream);
  fputs("</g>\n</svg>\n", file.stream);
  return fg__whole_file_close(&file, context, FG_STATUS_OK);
}

fg_status fg_painting_write(fg_context *context, const char *path, const fg_image *image,
                            const fg_strokes *strokes, const fg_painting_options *options)
{
  if (!path || !image || !strokes)
    return fg__fail(context, FG_STATUS_ARGUMENT, "painting: a NULL argument");
  fg_painting_options o = {0};
  if (options)
    o = *options;
  painting p = {.image = fg_image_contents(image),
                .strokes = strokes,
                .ground = !o.transparent && !fg_image_contents(image)->alpha};
  double width = o.width == 0.0 ? p.image->width : o.width;
  p.points_per_pixel = width / p.image->width;
  double pixels =
      o.pixels_per_point == 0.0 ? default_pixels_per_point : o.pixels_per_point;
  double height = p.points_per_pixel * p.image->height;
  if (!(width > 0.0 && width <= FG__LARGEST_PAGE && height <= FG__LARGEST_PAGE))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "painting: %g x %g points, each must lie between 0 and %g", width,
                    height, FG__LARGEST_PAGE);
  if (!(pixels > 0.0 && width * pixels * height * pixels <= most_pixels))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "painting: %g x %g pixels, at most %g in all are drawn",
                    ceil(width * pixels), ceil(height * pixels), most_pixels);
  if (fg__surface_file_format_of(path) == FG__SURFACE_SVG)
    return write_svg(context, path, &p, width, height);
  fg__surface_file surface;
  fg_status status =
      fg__surface_file_open(&surface, context, path, width, height, pixels, NULL);
  if (status)
    return status;
  paint(surface.cairo, &p);
  return fg__surface_file_close(&surface, context, FG_STATUS_OK);
}
