#include "picture/surface/surface.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "file/checksum.h"
#include "picture/surface/svg_ids.h"

fg__surface_file_format fg__surface_file_format_of(const char *path)
{
  static const char *const ends[] = {".svg", ".pdf", ".png"};
  size_t length = strlen(path);
  for (int k = 0; k < FG__SURFACE_UNKNOWN; ++k)
    if (length > 4 && strcasecmp(path + length - 4, ends[k]) == 0)
      return (fg__surface_file_format)k;
  return FG__SURFACE_UNKNOWN;
}

fg_status fg__surface_options_check(fg_context *context, double pixels_per_point,
                                    double font_size, double speed_min, double speed_max)
{
  if (!(pixels_per_point >= 0.0) || !isfinite(pixels_per_point))
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: %g pixels a point, a positive number is needed",
                    pixels_per_point);
  if (!(font_size >= 0.0) || font_size > FG__LARGEST_PAGE)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: a font of %g points, it must lie between 0 and %g",
                    font_size, FG__LARGEST_PAGE);
  if (!isfinite(speed_min) || !isfinite(speed_max) || speed_max < speed_min)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "picture: the colour key cannot run from %g to %g", speed_min,
                    speed_max);
  return FG_STATUS_OK;
}

fg_status fg__surface_file_format_check(fg_context *context, const char *path)
{
  if (fg__surface_file_format_of(path) != FG__SURFACE_UNKNOWN)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_UNSUPPORTED,
                  "%s: pictures are written as .svg, .pdf or .png", path);
}

/* What Cairo's streams call, with the file as their closure. */
static cairo_status_t write_bytes(void *closure, const unsigned char *bytes,
                                  unsigned int count)
{
  fg__whole_file *file = closure;
  if (file->error)
    return CAIRO_STATUS_WRITE_ERROR;
  if (fwrite(bytes, 1, count, file->stream) == count)
    return CAIRO_STATUS_SUCCESS;
  file->error = errno ? errno : EIO;
  return CAIRO_STATUS_WRITE_ERROR;
}

/* Of PNG: after the signature and IHDR, which are the first 33 bytes of every file, goes
 * the chunk pHYs with the size of a pixel, so that programs know the picture's own. */
enum { PNG_HEAD = 33, PHYS_DATA = 9, PHYS_CHUNK = 4 + 4 + PHYS_DATA + 4 };

static void put_number(unsigned char out[4], uint32_t number)
{
  for (int k = 0; k < 4; ++k)
    out[k] = (unsigned char)(number >> (24 - 8 * k) & 255);
}

static void make_size_chunk(unsigned char out[PHYS_CHUNK], double pixels_per_point)
{
  static const double points_a_metre = 72.0 / 0.0254;
  const uint32_t pixels = (uint32_t)lround(pixels_per_point * points_a_metre);
  put_number(out, PHYS_DATA);
  memcpy(out + 4, (const unsigned char[]){'p', 'H', 'Y', 's'}, 4);
  put_number(out + 8, pixels);
  put_number(out + 12, pixels);
  out[16] = 1; /* a metre */
  put_number(out + 17, fg__checksum(0, out + 4, 4 + PHYS_DATA));
}

static cairo_status_t write_png(void *closure, const unsigned char *bytes,
                                unsigned int count)
{
  fg__surface_file *page_surface = closure;
  const size_t before = page_surface->png_length;
  const unsigned int head =
      before < PNG_HEAD
          ? (unsigned int)(PNG_HEAD - before < count ? PNG_HEAD - before : count)
          : 0;
  cairo_status_t status = write_bytes(&page_surface->file, bytes, head);
  page_surface->png_length += count;
  if (!status && head && before + head == PNG_HEAD) {
    unsigned char chunk[PHYS_CHUNK];
    make_size_chunk(chunk, page_surface->pixels_per_point);
    status = write_bytes(&page_surface->file, chunk, PHYS_CHUNK);
  }
  return status ? status : write_bytes(&page_surface->file, bytes + head, count - head);
}

/* The same of SVG, which is kept until it is whole. */
static cairo_status_t keep_bytes(void *closure, const unsigned char *bytes,
                                 unsigned int count)
{
  fg__surface_file *page_surface = closure;
  if (!fg__grow((void **)&page_surface->svg, &page_surface->svg_capacity,
                page_surface->svg_length + count, 1))
    return CAIRO_STATUS_NO_MEMORY;
  memcpy(page_surface->svg + page_surface->svg_length, bytes, count);
  page_surface->svg_length += count;
  return CAIRO_STATUS_SUCCESS;
}

/* Of a length that was itself made from whole pixels. */
static int count_pixels(double length)
{
  static const double rounding = 1e-6;
  return (int)fmax(ceil(length - rounding), 1.0);
}

static cairo_surface_t *create_surface(fg__surface_file *page_surface, double width,
                                       double height, double pixels, const char *title)
{
  if (page_surface->format == FG__SURFACE_SVG) {
    cairo_surface_t *surface =
        cairo_svg_surface_create_for_stream(keep_bytes, page_surface, width, height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
    return surface;
  }
  if (page_surface->format == FG__SURFACE_PDF) {
    cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
        write_bytes, &page_surface->file, width, height);
    /* Two runs shall give the same bytes. */
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    if (title)
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
    return surface;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_ARGB32, count_pixels(width * pixels),
                                    count_pixels(height * pixels));
}

static fg_status status_of(fg_context *context, cairo_status_t trouble,
                           const fg__whole_file *output)
{
  if (trouble == CAIRO_STATUS_SUCCESS || output->error)
    return FG_STATUS_OK; /* closing the output reports its own error */
  if (trouble == CAIRO_STATUS_NO_MEMORY)
    return fg__fail_memory(context, "a picture", 0);
  return fg__fail(context, FG_STATUS_UNSUPPORTED, "%s: cannot be drawn: %s", output->path,
                  cairo_status_to_string(trouble));
}

fg_status fg__surface_file_open(fg__surface_file *out, fg_context *context,
                                const char *path, double width, double height,
                                double pixels_per_point, const char *title)
{
  *out = (fg__surface_file){.format = fg__surface_file_format_of(path),
                            .pixels_per_point = pixels_per_point};
  fg_status status = fg__surface_file_format_check(context, path);
  if (!status)
    status = fg__whole_file_open(&out->file, context, path);
  if (status)
    return status;
  out->target = create_surface(out, width, height, pixels_per_point, title);
  out->cairo = cairo_create(out->target);
  if (out->format == FG__SURFACE_PNG)
    cairo_scale(out->cairo, pixels_per_point, pixels_per_point);
  return FG_STATUS_OK;
}

/* The texts come last, before the document's end. */
static bool write_svg(const fg__surface_file *page_surface)
{
  static const char end[] = "</svg>";
  size_t drawn = page_surface->svg_length;
  while (drawn > 0 && (page_surface->svg_length - drawn < sizeof end - 1 ||
                       memcmp(page_surface->svg + drawn, end, sizeof end - 1) != 0))
    --drawn;
  FILE *stream = page_surface->file.stream;
  if (page_surface->texts.lacks_memory ||
      !fg__svg_ids_write(stream, page_surface->svg, drawn))
    return false;
  if (page_surface->texts.length)
    fwrite(page_surface->texts.bytes, 1, page_surface->texts.length, stream);
  fwrite(page_surface->svg + drawn, 1, page_surface->svg_length - drawn, stream);
  return true;
}

fg_status fg__surface_file_close(fg__surface_file *page_surface, fg_context *context,
                                 fg_status status)
{
  cairo_show_page(page_surface->cairo);
  cairo_status_t trouble = cairo_status(page_surface->cairo);
  cairo_destroy(page_surface->cairo);
  if (!status && !trouble && page_surface->format == FG__SURFACE_PNG)
    trouble =
        cairo_surface_write_to_png_stream(page_surface->target, write_png, page_surface);
  cairo_surface_finish(page_surface->target);
  if (!trouble)
    trouble = cairo_surface_status(page_surface->target);
  cairo_surface_destroy(page_surface->target);
  errno = 0;
  if (!status && !trouble && page_surface->format == FG__SURFACE_SVG &&
      !write_svg(page_surface))
    trouble = CAIRO_STATUS_NO_MEMORY;
  if (!page_surface->file.error && ferror(page_surface->file.stream))
    page_surface->file.error = errno ? errno : EIO;
  free(page_surface->svg);
  fg__svg_texts_clear(&page_surface->texts);
  if (!status)
    status = status_of(context, trouble, &page_surface->file);
  return fg__whole_file_close(&page_surface->file, context, status);
}
