#include "picture/page/sheet.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "picture/page/svg_ids.h"

fg__sheet_format fg__sheet_format_of(const char *path)
{
  static const char *const ends[] = {".svg", ".pdf", ".png"};
  size_t length = strlen(path);
  for (int k = 0; k < FG__SHEET_UNKNOWN; ++k)
    if (length > 4 && strcasecmp(path + length - 4, ends[k]) == 0)
      return (fg__sheet_format)k;
  return FG__SHEET_UNKNOWN;
}

fg_status fg__sheet_format_check(fg_context *context, const char *path)
{
  if (fg__sheet_format_of(path) != FG__SHEET_UNKNOWN)
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

/* The same of SVG, with the sheet. */
static cairo_status_t keep_bytes(void *closure, const unsigned char *bytes,
                                 unsigned int count)
{
  fg__sheet *sheet = closure;
  if (!fg__grow((void **)&sheet->svg, &sheet->svg_capacity, sheet->svg_length + count, 1))
    return CAIRO_STATUS_NO_MEMORY;
  memcpy(sheet->svg + sheet->svg_length, bytes, count);
  sheet->svg_length += count;
  return CAIRO_STATUS_SUCCESS;
}

static cairo_surface_t *create_surface(fg__sheet *sheet, double width, double height,
                                       double pixels, const char *title)
{
  if (sheet->format == FG__SHEET_SVG) {
    cairo_surface_t *surface =
        cairo_svg_surface_create_for_stream(keep_bytes, sheet, width, height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
    return surface;
  }
  if (sheet->format == FG__SHEET_PDF) {
    cairo_surface_t *surface =
        cairo_pdf_surface_create_for_stream(write_bytes, &sheet->file, width, height);
    /* Two runs shall give the same bytes. */
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    if (title)
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
    return surface;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_ARGB32,
                                    (int)fmax(ceil(width * pixels), 1.0),
                                    (int)fmax(ceil(height * pixels), 1.0));
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

fg_status fg__sheet_open(fg__sheet *out, fg_context *context, const char *path,
                         double width, double height, double pixels_per_point,
                         const char *title)
{
  *out = (fg__sheet){.format = fg__sheet_format_of(path)};
  fg_status status = fg__sheet_format_check(context, path);
  if (!status)
    status = fg__whole_file_open(&out->file, context, path);
  if (status)
    return status;
  out->surface = create_surface(out, width, height, pixels_per_point, title);
  out->cairo = cairo_create(out->surface);
  if (out->format == FG__SHEET_PNG)
    cairo_scale(out->cairo, pixels_per_point, pixels_per_point);
  return FG_STATUS_OK;
}

fg_status fg__sheet_close(fg__sheet *sheet, fg_context *context, fg_status status)
{
  cairo_show_page(sheet->cairo);
  cairo_status_t trouble = cairo_status(sheet->cairo);
  cairo_destroy(sheet->cairo);
  if (!status && !trouble && sheet->format == FG__SHEET_PNG)
    trouble =
        cairo_surface_write_to_png_stream(sheet->surface, write_bytes, &sheet->file);
  cairo_surface_finish(sheet->surface);
  if (!trouble)
    trouble = cairo_surface_status(sheet->surface);
  cairo_surface_destroy(sheet->surface);
  errno = 0;
  if (!status && !trouble && sheet->format == FG__SHEET_SVG &&
      !fg__svg_ids_write(sheet->file.stream, sheet->svg, sheet->svg_length))
    trouble = CAIRO_STATUS_NO_MEMORY;
  if (!sheet->file.error && ferror(sheet->file.stream))
    sheet->file.error = errno ? errno : EIO;
  free(sheet->svg);
  if (!status)
    status = status_of(context, trouble, &sheet->file);
  return fg__whole_file_close(&sheet->file, context, status);
}
