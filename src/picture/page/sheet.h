/* The sheet that a picture is drawn on, and the file that it becomes. */
#ifndef FG__SHEET_H
#define FG__SHEET_H

#include <cairo.h>

#include "file/whole_file.h"

typedef enum fg__sheet_format {
  FG__SHEET_SVG,
  FG__SHEET_PDF,
  FG__SHEET_PNG,
  FG__SHEET_UNKNOWN
} fg__sheet_format;

/* The format that a path's end names; UNKNOWN is reported by fg__sheet_open. */
fg__sheet_format fg__sheet_format_of(const char *path);

typedef struct fg__sheet {
  fg__sheet_format format;
  fg__whole_file file;
  cairo_surface_t *surface;
  cairo_t *cairo; /* draws in points */
  char *svg;      /* the file as Cairo writes it */
  size_t svg_length, svg_capacity;
} fg__sheet;

/* Opens a sheet of width x height points, which in PNG has pixels_per_point. title: for
 * PDF, or NULL. FILE_ACCESS, UNSUPPORTED (the path's end), MEMORY; after a failure there
 * is nothing to close. */
fg_status fg__sheet_open(fg__sheet *out, fg_context *context, const char *path,
                         double width, double height, double pixels_per_point,
                         const char *title);

/* Fails for formats that are not known, as fg__sheet_open would. UNSUPPORTED. */
fg_status fg__sheet_format_check(fg_context *context, const char *path);

/* Finishes the drawing; with status OK the file takes its name when it is whole,
 * otherwise nothing is left. Returns `status`, or what went wrong now. FILE_ACCESS,
 * UNSUPPORTED, MEMORY. */
fg_status fg__sheet_close(fg__sheet *sheet, fg_context *context, fg_status status);

#endif
